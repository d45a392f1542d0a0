// Carries parameters from the parameter server into the node and names everything wrong with them.
#include "cloth_tearing/node/params_loader.h"

#include <stdexcept>
#include <string>

#include "cloth_tearing/node/param_reader.h"

namespace cloth_tearing
{

namespace
{

void readNode(ParamReader& reader, NodeParams& params)
{
  reader.read("frame_id", params.frame_id);
  reader.read("cloth_pose/position", params.cloth_pose.position);
  reader.read("cloth_pose/rotation", params.cloth_pose.rotation);
  reader.readChoice<cloth::Pace>("pace",
                                 { { "wall", cloth::Pace::WALL },
                                   { "free", cloth::Pace::FREE },
                                   { "step", cloth::Pace::STEP },
                                   { "clock", cloth::Pace::CLOCK } },
                                 params.pace);
  reader.read("speed", params.speed);
  reader.read("paused", params.paused);
  reader.read("publish_clock", params.publish_clock);
  reader.read("clock_rate", params.clock_rate);
  reader.read("tf_patience", params.tf_patience);
  reader.read("command_patience", params.command_patience);
  reader.read("frame_timeout", params.frame_timeout);
  reader.readChoice<LostFrame>("lost_frame",
                               { { "hold", LostFrame::HOLD }, { "release", LostFrame::RELEASE } },
                               params.lost_frame);
  reader.read("grasp_state_rate", params.grasp_state_rate);
  reader.read("marker_rate", params.marker_rate);
  reader.read("surface_rate", params.surface_rate);
  reader.read("status_rate", params.status_rate);
  reader.read("master_period", params.master_period);
  reader.read("state_folder", params.states.folder);
  reader.read("max_states", params.states.max_states);
  reader.read("max_state_memory", params.states.max_state_memory);
  reader.read("recording_folder", params.recording.folder);
  reader.read("recording_limit", params.recording.limit);
}

void readLimits(ParamReader& reader, NodeParams& params)
{
  cloth::Limits& limits = params.simulation.limits;
  reader.read("limits/particles", limits.particles);
  reader.read("limits/triangles", limits.triangles);
  reader.read("limits/spheres", limits.spheres);
  reader.read("limits/grasps", limits.grasps);
  reader.read("limits/model_file", params.max_model_file);
  reader.read("limits/commands", params.max_commands);
}

void readHandles(ParamReader& reader, HandleParams& handles)
{
  reader.read("handles/enabled", handles.enabled);
  reader.read("handles/rate", handles.rate);
  reader.read("handles/radius", handles.radius);
  reader.read("handles/throw_speed", handles.throw_speed);
  reader.read("handles/ball_radius", handles.ball_radius);
}

void readRectangle(ParamReader& reader, cloth::RectangleParams& rectangle)
{
  reader.read("rectangle/width", rectangle.width);
  reader.read("rectangle/height", rectangle.height);
  reader.read("rectangle/columns", rectangle.columns);
  reader.read("rectangle/rows", rectangle.rows);
  readPattern(reader, "rectangle/pattern", rectangle.pattern);
  reader.read("rectangle/grading", rectangle.grading);
  reader.read("rectangle/jitter", rectangle.jitter);
  readSeed(reader, "rectangle/seed", rectangle.seed);
  std::vector<std::vector<double>> slits;
  reader.readRows("rectangle/slits", 4, slits);
  for (const std::vector<double>& s : slits)
  {
    rectangle.slits.push_back({ cloth::Vec2d(s[0], s[1]), cloth::Vec2d(s[2], s[3]) });
  }
}

void readModel(ParamReader& reader, NodeParams& params)
{
  reader.read("model_file", params.model_file);
  reader.read("model_folders", params.model_folders);
  reader.read("export_folder", params.export_folder);
  reader.read("import/scale", params.import.scale);
  reader.read("import/weld_distance", params.import.weld_distance);
  readRectangle(reader, params.rectangle);
  reader.readChoice<cloth::RestShapeSource>(
      "rest_shape",
      { { "imported", cloth::RestShapeSource::IMPORTED }, { "uv", cloth::RestShapeSource::UV } },
      params.simulation.rest_shape);
  reader.read("pins/edges", params.pins.edges);
  reader.read("pins/particles", params.pins.particles);
  std::vector<std::vector<double>> regions;
  reader.readRows("pins/regions", 4, regions);
  for (const std::vector<double>& r : regions)
  {
    params.pins.regions.push_back({ cloth::Vec3d(r[0], r[1], r[2]), r[3] });
  }
}

void readPhysics(ParamReader& reader, cloth::SimulationParams& simulation)
{
  readSolver(reader, simulation.solver.kind);
  reader.read("time_step", simulation.solver.time_step);
  reader.read("max_strain", simulation.solver.max_strain);
  reader.read("max_substeps", simulation.solver.max_substeps);
  reader.read("lines", simulation.solver.lines);
  reader.read("max_grasp_distance", simulation.max_grasp_distance);
  reader.read("grasp_force_filter", simulation.grasp_force_filter);
  reader.read("max_gripper_speed", simulation.max_gripper_speed);
  reader.read("max_gripper_turn", simulation.max_gripper_turn);
  reader.read("max_speed", simulation.max_speed);
  reader.read("runaway_strain", simulation.runaway_strain);
  reader.read("threads", simulation.threads);
  reader.read("tear_log_size", simulation.tear_log_size);

  reader.read("material/areal_density", simulation.material.areal_density);
  reader.readChoice<cloth::StiffnessLaw>("material/stiffness_law", stiffnessLaws(),
                                         simulation.material.stiffness_law);
  reader.read("material/stiffness", simulation.material.stiffness);
  reader.read("material/bend_shear_stiffness", simulation.material.bend_shear_stiffness);
  reader.read("material/damping", simulation.material.damping);

  reader.read("environment/gravity", simulation.environment.gravity);
  reader.read("environment/air_friction", simulation.environment.air_friction);
  reader.read("environment/wind", simulation.environment.wind);
  reader.read("environment/wind_drag", simulation.environment.wind_drag);
}

void readTearing(ParamReader& reader, cloth::TearRules& rules)
{
  reader.read("tearing/enabled", rules.enabled);
  reader.read("tearing/tear_strain", rules.tear_strain);
  reader.read("tearing/weak_tear_strain", rules.weak_tear_strain);
  reader.read("tearing/one_point_tear_strain", rules.one_point_tear_strain);
  reader.read("tearing/tear_radius", rules.tear_radius);
  reader.read("tearing/crack_length", rules.crack_length);
  reader.read("tearing/hem_factor", rules.hem_factor);
  reader.read("tearing/hem_width", rules.hem_width);
  reader.read("tearing/max_tears_per_step", rules.max_tears_per_step);
  reader.read("tearing/min_length", rules.min_length);
  reader.read("tearing/min_altitude", rules.min_altitude);
}

cloth::StrengthParams::Line strengthLine(const std::vector<double>& row)
{
  return { cloth::Vec3d(row[0], row[1], row[2]), cloth::Vec3d(row[3], row[4], row[5]), row[6],
           row[7] };
}

void readStrength(ParamReader& reader, cloth::StrengthParams& strength)
{
  reader.read("strength/scatter", strength.scatter);
  readSeed(reader, "strength/seed", strength.seed);
  std::vector<std::vector<double>> spots;
  reader.readRows("strength/spots", 5, spots);
  for (const std::vector<double>& s : spots)
  {
    strength.spots.push_back({ cloth::Vec3d(s[0], s[1], s[2]), s[3], s[4] });
  }
  std::vector<std::vector<double>> lines;
  reader.readRows("strength/lines", 8, lines);
  for (const std::vector<double>& line : lines)
  {
    strength.lines.push_back(strengthLine(line));
  }
  std::vector<std::vector<double>> perforations;
  reader.readRows("strength/perforations", 10, perforations);
  for (const std::vector<double>& p : perforations)
  {
    strength.perforations.push_back({ strengthLine(p), p[8], p[9] });
  }
  reader.read("strength/border_factor", strength.border_factor);
  reader.read("strength/border_width", strength.border_width);
}

void readContact(ParamReader& reader, cloth::ContactParams& contact)
{
  reader.read("contact/friction", contact.friction);
  reader.read("contact/thickness", contact.thickness);
  reader.read("contact/push_speed", contact.push_speed);
  reader.read("contact/floor", contact.floor);
  reader.read("contact/floor_height", contact.floor_height);
  reader.read("contact/floor_friction", contact.floor_friction);
  reader.read("contact/bounds_min", contact.bounds_min);
  reader.read("contact/bounds_max", contact.bounds_max);
  reader.read("contact/max_sphere_speed", contact.max_sphere_speed);
  reader.read("contact/sphere_timeout", contact.sphere_timeout);
}

void readAll(ParamReader& reader, NodeParams& params)
{
  readNode(reader, params);
  readLimits(reader, params);
  readMarkers(reader, params.markers);
  readHandles(reader, params.handles);
  readModel(reader, params);
  readPhysics(reader, params.simulation);
  readTearing(reader, params.simulation.tearing);
  readStrength(reader, params.simulation.strength);
  readContact(reader, params.simulation.contact);
}

}  // namespace

const std::map<std::string, cloth::StiffnessLaw>& stiffnessLaws()
{
  static const std::map<std::string, cloth::StiffnessLaw> names = {
    { "per_width", cloth::StiffnessLaw::PER_WIDTH },
    { "per_spring", cloth::StiffnessLaw::PER_SPRING }
  };
  return names;
}

void readMarkers(ParamReader& reader, MarkerStyle& style)
{
  reader.readChoice<Coloring>("markers/coloring",
                              { { "texture", Coloring::TEXTURE },
                                { "strain", Coloring::STRAIN },
                                { "plain", Coloring::PLAIN },
                                { "wireframe", Coloring::WIREFRAME } },
                              style.coloring);
  reader.read("markers/checks", style.checks);
  reader.read("markers/strain_range", style.strain_range);
  reader.read("markers/plain_color", style.plain_color);
  reader.read("markers/edge_width", style.edge_width);
  reader.read("markers/point_size", style.point_size);
}

void readPattern(ParamReader& reader, const std::string& name, cloth::RectanglePattern& pattern)
{
  reader.readChoice<cloth::RectanglePattern>(
      name,
      { { "one_diagonal", cloth::RectanglePattern::ONE_DIAGONAL },
        { "alternating", cloth::RectanglePattern::ALTERNATING },
        { "irregular", cloth::RectanglePattern::IRREGULAR } },
      pattern);
}

void readSeed(ParamReader& reader, const std::string& name, std::uint64_t& seed)
{
  int given = static_cast<int>(seed);
  reader.read(name, given);
  if (given < 0)
  {
    reader.note(name + " is " + std::to_string(given) + ", must be at least 0");
  }
  seed = static_cast<std::uint64_t>(given);
}

void readSolver(ParamReader& reader, cloth::SolverKind& solver)
{
  reader.readChoice<cloth::SolverKind>("solver",
                                       { { "xpbd", cloth::SolverKind::XPBD },
                                         { "force_springs", cloth::SolverKind::FORCE_SPRINGS } },
                                       solver);
}

LoadedParams loadParams(const XmlRpc::XmlRpcValue& tree)
{
  LoadedParams loaded;
  ParamReader reader(tree);
  readAll(reader, loaded.params);
  reader.noteLeftOver();
  loaded.problems = reader.problems();
  const std::vector<std::string> unusable = problems(loaded.params);
  loaded.problems.insert(loaded.problems.end(), unusable.begin(), unusable.end());
  return loaded;
}

void refuseWrongParams(const std::string& name_space, const std::vector<std::string>& problems)
{
  if (problems.empty())
  {
    return;
  }
  std::string all = std::to_string(problems.size()) + " wrong parameters of " + name_space + ":";
  for (const std::string& problem : problems)
  {
    all += "\n  " + problem;
  }
  throw std::invalid_argument(all);
}

std::vector<std::string> parameterNames()
{
  NodeParams params;
  ParamReader reader((XmlRpc::XmlRpcValue()));
  readAll(reader, params);
  return { reader.known().begin(), reader.known().end() };
}

}  // namespace cloth_tearing
