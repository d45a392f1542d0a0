// config/cloth.yaml says what is compiled in: every parameter, with its default. config/thesis.yaml
// over it is the world of chapter 4.
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <algorithm>

#include "cloth_tearing/experiments/thesis_world.h"
#include "cloth_tearing/node/params_loader.h"

namespace
{

XmlRpc::XmlRpcValue treeAt(const std::string& name)
{
  XmlRpc::XmlRpcValue tree;
  EXPECT_TRUE(ros::param::get(name, tree));
  return tree;
}

XmlRpc::XmlRpcValue shippedTree()
{
  return treeAt("/cloth_yaml");
}

void listLeaves(const std::string& prefix, const XmlRpc::XmlRpcValue& tree,
                std::vector<std::string>& names)
{
  for (const auto& entry : tree)
  {
    if (entry.second.getType() == XmlRpc::XmlRpcValue::TypeStruct)
    {
      listLeaves(prefix + entry.first + "/", entry.second, names);
    }
    else
    {
      names.push_back(prefix + entry.first);
    }
  }
}

}  // namespace

TEST(ClothYaml, HasEveryParameterAndNoOther)
{
  std::vector<std::string> names;
  listLeaves("", shippedTree(), names);
  std::sort(names.begin(), names.end());

  EXPECT_EQ(names, cloth_tearing::parameterNames());
}

TEST(ClothYaml, CanBeUsed)
{
  const cloth_tearing::LoadedParams shipped = cloth_tearing::loadParams(shippedTree());

  for (const std::string& problem : shipped.problems)
  {
    ADD_FAILURE() << problem;
  }
}

TEST(ClothYaml, SaysTheDefaults)
{
  const cloth_tearing::NodeParams shipped = cloth_tearing::loadParams(shippedTree()).params;
  const cloth_tearing::NodeParams compiled;

  EXPECT_EQ(shipped.frame_id, compiled.frame_id);
  EXPECT_EQ(shipped.cloth_pose.position, compiled.cloth_pose.position);
  EXPECT_TRUE(shipped.cloth_pose.rotation.isApprox(compiled.cloth_pose.rotation, 1e-7));
  EXPECT_EQ(shipped.pace, compiled.pace);
  EXPECT_EQ(shipped.speed, compiled.speed);
  EXPECT_EQ(shipped.paused, compiled.paused);
  EXPECT_EQ(shipped.publish_clock, compiled.publish_clock);
  EXPECT_EQ(shipped.clock_rate, compiled.clock_rate);
  EXPECT_EQ(shipped.max_model_file, compiled.max_model_file);
  EXPECT_EQ(shipped.max_commands, compiled.max_commands);
  EXPECT_EQ(shipped.tf_patience, compiled.tf_patience);
  EXPECT_EQ(shipped.command_patience, compiled.command_patience);
  EXPECT_EQ(shipped.states.folder, compiled.states.folder);
  EXPECT_EQ(shipped.states.max_states, compiled.states.max_states);
  EXPECT_EQ(shipped.states.max_state_memory, compiled.states.max_state_memory);
  EXPECT_EQ(shipped.frame_timeout, compiled.frame_timeout);
  EXPECT_EQ(shipped.lost_frame, compiled.lost_frame);
  EXPECT_EQ(shipped.grasp_state_rate, compiled.grasp_state_rate);
  EXPECT_EQ(shipped.marker_rate, compiled.marker_rate);
  EXPECT_EQ(shipped.surface_rate, compiled.surface_rate);
  EXPECT_EQ(shipped.status_rate, compiled.status_rate);
  EXPECT_EQ(shipped.master_period, compiled.master_period);

  EXPECT_EQ(shipped.markers.coloring, compiled.markers.coloring);
  EXPECT_EQ(shipped.markers.checks, compiled.markers.checks);
  EXPECT_EQ(shipped.markers.strain_range, compiled.markers.strain_range);
  EXPECT_EQ(shipped.markers.plain_color, compiled.markers.plain_color);
  EXPECT_EQ(shipped.markers.edge_width, compiled.markers.edge_width);
  EXPECT_EQ(shipped.markers.point_size, compiled.markers.point_size);

  EXPECT_EQ(shipped.handles.enabled, compiled.handles.enabled);
  EXPECT_EQ(shipped.handles.rate, compiled.handles.rate);
  EXPECT_EQ(shipped.handles.radius, compiled.handles.radius);
  EXPECT_EQ(shipped.handles.throw_speed, compiled.handles.throw_speed);
  EXPECT_EQ(shipped.handles.ball_radius, compiled.handles.ball_radius);
}

TEST(ClothYaml, SaysTheDefaultsOfTheModel)
{
  const cloth_tearing::NodeParams shipped = cloth_tearing::loadParams(shippedTree()).params;
  const cloth_tearing::NodeParams compiled;

  EXPECT_EQ(shipped.model_file, compiled.model_file);
  EXPECT_EQ(shipped.model_folders, compiled.model_folders);
  EXPECT_EQ(shipped.export_folder, compiled.export_folder);
  EXPECT_EQ(shipped.import.scale, compiled.import.scale);
  EXPECT_EQ(shipped.import.weld_distance, compiled.import.weld_distance);
  EXPECT_EQ(shipped.rectangle.width, compiled.rectangle.width);
  EXPECT_EQ(shipped.rectangle.height, compiled.rectangle.height);
  EXPECT_EQ(shipped.rectangle.columns, compiled.rectangle.columns);
  EXPECT_EQ(shipped.rectangle.rows, compiled.rectangle.rows);
  EXPECT_EQ(shipped.rectangle.pattern, compiled.rectangle.pattern);
  EXPECT_EQ(shipped.rectangle.grading, compiled.rectangle.grading);
  EXPECT_EQ(shipped.rectangle.jitter, compiled.rectangle.jitter);
  EXPECT_EQ(shipped.rectangle.seed, compiled.rectangle.seed);
  EXPECT_TRUE(shipped.rectangle.slits.empty());
  EXPECT_EQ(shipped.pins.edges, compiled.pins.edges);
  EXPECT_TRUE(shipped.pins.regions.empty());
  EXPECT_TRUE(shipped.pins.particles.empty());
  EXPECT_EQ(shipped.simulation.rest_shape, compiled.simulation.rest_shape);
}

TEST(ClothYaml, SaysTheDefaultsOfThePhysics)
{
  const cloth::SimulationParams shipped =
      cloth_tearing::loadParams(shippedTree()).params.simulation;
  const cloth::SimulationParams compiled;

  EXPECT_EQ(shipped.solver.kind, compiled.solver.kind);
  EXPECT_EQ(shipped.solver.time_step, compiled.solver.time_step);
  EXPECT_EQ(shipped.solver.max_strain, compiled.solver.max_strain);
  EXPECT_EQ(shipped.solver.max_substeps, compiled.solver.max_substeps);
  EXPECT_EQ(shipped.solver.lines, compiled.solver.lines);
  EXPECT_EQ(shipped.max_grasp_distance, compiled.max_grasp_distance);
  EXPECT_EQ(shipped.grasp_force_filter, compiled.grasp_force_filter);
  EXPECT_EQ(shipped.max_gripper_speed, compiled.max_gripper_speed);
  EXPECT_EQ(shipped.max_gripper_turn, compiled.max_gripper_turn);
  EXPECT_EQ(shipped.max_speed, compiled.max_speed);
  EXPECT_EQ(shipped.runaway_strain, compiled.runaway_strain);
  EXPECT_EQ(shipped.threads, compiled.threads);
  EXPECT_EQ(shipped.tear_log_size, compiled.tear_log_size);
  EXPECT_EQ(shipped.limits.particles, compiled.limits.particles);
  EXPECT_EQ(shipped.limits.triangles, compiled.limits.triangles);
  EXPECT_EQ(shipped.limits.spheres, compiled.limits.spheres);
  EXPECT_EQ(shipped.limits.grasps, compiled.limits.grasps);

  EXPECT_EQ(shipped.material.areal_density, compiled.material.areal_density);
  EXPECT_EQ(shipped.material.stiffness, compiled.material.stiffness);
  EXPECT_EQ(shipped.material.bend_shear_stiffness, compiled.material.bend_shear_stiffness);
  EXPECT_EQ(shipped.material.damping, compiled.material.damping);
  EXPECT_EQ(shipped.environment.gravity, compiled.environment.gravity);
  EXPECT_EQ(shipped.environment.air_friction, compiled.environment.air_friction);
  EXPECT_EQ(shipped.environment.wind, compiled.environment.wind);
  EXPECT_EQ(shipped.environment.wind_drag, compiled.environment.wind_drag);

  EXPECT_EQ(shipped.tearing.enabled, compiled.tearing.enabled);
  EXPECT_EQ(shipped.tearing.tear_strain, compiled.tearing.tear_strain);
  EXPECT_EQ(shipped.tearing.weak_tear_strain, compiled.tearing.weak_tear_strain);
  EXPECT_EQ(shipped.tearing.one_point_tear_strain, compiled.tearing.one_point_tear_strain);
  EXPECT_EQ(shipped.tearing.tear_radius, compiled.tearing.tear_radius);
  EXPECT_EQ(shipped.tearing.crack_length, compiled.tearing.crack_length);
  EXPECT_EQ(shipped.tearing.hem_factor, compiled.tearing.hem_factor);
  EXPECT_EQ(shipped.tearing.hem_width, compiled.tearing.hem_width);
  EXPECT_EQ(shipped.tearing.max_tears_per_step, compiled.tearing.max_tears_per_step);
  EXPECT_EQ(shipped.tearing.min_length, compiled.tearing.min_length);
  EXPECT_EQ(shipped.tearing.min_altitude, compiled.tearing.min_altitude);

  EXPECT_EQ(shipped.strength.scatter, compiled.strength.scatter);
  EXPECT_EQ(shipped.strength.seed, compiled.strength.seed);
  EXPECT_TRUE(shipped.strength.spots.empty());
  EXPECT_TRUE(shipped.strength.lines.empty());
  EXPECT_TRUE(shipped.strength.perforations.empty());
  EXPECT_EQ(shipped.strength.border_factor, compiled.strength.border_factor);
  EXPECT_EQ(shipped.strength.border_width, compiled.strength.border_width);

  EXPECT_EQ(shipped.contact.friction, compiled.contact.friction);
  EXPECT_EQ(shipped.contact.thickness, compiled.contact.thickness);
  EXPECT_EQ(shipped.contact.push_speed, compiled.contact.push_speed);
  EXPECT_EQ(shipped.contact.floor, compiled.contact.floor);
  EXPECT_EQ(shipped.contact.floor_height, compiled.contact.floor_height);
  EXPECT_EQ(shipped.contact.floor_friction, compiled.contact.floor_friction);
  EXPECT_EQ(shipped.contact.bounds_min, compiled.contact.bounds_min);
  EXPECT_EQ(shipped.contact.bounds_max, compiled.contact.bounds_max);
  EXPECT_EQ(shipped.contact.max_sphere_speed, compiled.contact.max_sphere_speed);
  EXPECT_EQ(shipped.contact.sphere_timeout, compiled.contact.sphere_timeout);
}

TEST(ThesisYaml, IsTheClothOfChapter4)
{
  const cloth_tearing::LoadedParams loaded = cloth_tearing::loadParams(treeAt("/thesis_yaml"));
  for (const std::string& problem : loaded.problems)
  {
    ADD_FAILURE() << problem;
  }

  const cloth::Setting setting;  // the experiments' own, to which the file has to be equal
  const cloth::RectangleParams& sheet = loaded.params.rectangle;
  const cloth::RectangleParams thesis_sheet = cloth::thesisSheet(setting);
  EXPECT_EQ(sheet.width, thesis_sheet.width);
  EXPECT_EQ(sheet.height, thesis_sheet.height);
  EXPECT_EQ(sheet.columns, thesis_sheet.columns);
  EXPECT_EQ(sheet.rows, thesis_sheet.rows);
  EXPECT_EQ(loaded.params.pins.edges, std::vector<std::string>{ "top" });

  const cloth::SimulationParams& physics = loaded.params.simulation;
  const cloth::SimulationParams thesis = cloth::thesisParams(setting);
  EXPECT_EQ(physics.solver.time_step, thesis.solver.time_step);
  EXPECT_EQ(physics.material.areal_density, thesis.material.areal_density);
  EXPECT_EQ(physics.material.stiffness_law, thesis.material.stiffness_law);
  EXPECT_EQ(physics.material.stiffness, thesis.material.stiffness);
  EXPECT_EQ(physics.material.bend_shear_stiffness, thesis.material.bend_shear_stiffness);
  EXPECT_EQ(physics.material.damping, thesis.material.damping);
  EXPECT_EQ(physics.environment.gravity, thesis.environment.gravity);
  EXPECT_EQ(physics.environment.air_friction, thesis.environment.air_friction);
  EXPECT_EQ(physics.environment.wind_drag, thesis.environment.wind_drag);
  EXPECT_EQ(physics.contact.friction, thesis.contact.friction);
  EXPECT_EQ(physics.contact.thickness, thesis.contact.thickness);
  EXPECT_EQ(physics.tearing.tear_strain, thesis.tearing.tear_strain);
  EXPECT_EQ(physics.tearing.weak_tear_strain, thesis.tearing.weak_tear_strain);
  EXPECT_EQ(physics.tearing.onePointThreshold(), thesis.tearing.onePointThreshold());
  EXPECT_EQ(physics.tearing.tear_radius, thesis.tearing.tear_radius);
  EXPECT_EQ(physics.tearing.crack_length, thesis.tearing.crack_length);
  EXPECT_EQ(physics.tearing.hem_factor, thesis.tearing.hem_factor);
  EXPECT_EQ(physics.tearing.hem_width, thesis.tearing.hem_width);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "cloth_yaml_rostest");
  ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
