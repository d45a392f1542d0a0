// How each structure of a simulation's state is written and read: one function for both ways.
//
// Each function binds a name to every member of its structure. A structure with one more does not
// compile here until somebody has decided what becomes of it: name it, and transfer it if it
// decides the future. (Then raise STATE_FORMAT in saved_state.cpp.)
#pragma once

#include <algorithm>
#include <cstdint>

#include "cloth_tearing/core/archive.h"
#include "cloth_tearing/core/simulation.h"

namespace cloth
{

// -- parameters -----------------------------------------------------------------------------------

template <class Archive>
void transfer(Archive& archive, Material& material)
{
  auto& [areal_density, stiffness_law, stiffness, bend_shear_stiffness, damping] = material;
  archive("areal_density", areal_density);
  archive.choice("stiffness_law", stiffness_law, StiffnessLaw::PER_SPRING);
  archive("stiffness", stiffness);
  archive("bend_shear_stiffness", bend_shear_stiffness);
  archive("damping", damping);
}

template <class Archive>
void transfer(Archive& archive, Environment& environment)
{
  auto& [gravity, air_friction, wind, wind_drag] = environment;
  archive("gravity", gravity);
  archive("air_friction", air_friction);
  archive("wind", wind);
  archive("wind_drag", wind_drag);
}

template <class Archive>
void transfer(Archive& archive, SolverParams& params)
{
  auto& [kind, time_step, max_strain, max_substeps, lines] = params;
  archive.choice("kind", kind, SolverKind::FORCE_SPRINGS);
  archive("time_step", time_step);
  archive("max_strain", max_strain);
  archive("max_substeps", max_substeps);
  archive("lines", lines);
}

template <class Archive>
void transfer(Archive& archive, TearRules& rules)
{
  auto& [enabled, tear_strain, weak_tear_strain, one_point_tear_strain, tear_radius, crack_length,
         hem_factor, hem_width, max_tears_per_step, min_length, min_altitude] = rules;
  archive("enabled", enabled);
  archive("tear_strain", tear_strain);
  archive("weak_tear_strain", weak_tear_strain);
  archive("one_point_tear_strain", one_point_tear_strain);
  archive("tear_radius", tear_radius);
  archive("crack_length", crack_length);
  archive("hem_factor", hem_factor);
  archive("hem_width", hem_width);
  archive("max_tears_per_step", max_tears_per_step);
  archive("min_length", min_length);
  archive("min_altitude", min_altitude);
}

template <class Archive>
void transfer(Archive& archive, StrengthParams::Spot& spot)
{
  auto& [center, radius, factor] = spot;
  archive("center", center);
  archive("radius", radius);
  archive("factor", factor);
}

template <class Archive>
void transfer(Archive& archive, StrengthParams::Line& line)
{
  auto& [from, to, width, factor] = line;
  archive("from", from);
  archive("to", to);
  archive("width", width);
  archive("factor", factor);
}

template <class Archive>
void transfer(Archive& archive, StrengthParams::Perforation& perforation)
{
  auto& [line, pitch, duty] = perforation;
  archive("line", line);
  archive("pitch", pitch);
  archive("duty", duty);
}

template <class Archive>
void transfer(Archive& archive, StrengthParams& params)
{
  auto& [scatter, seed, spots, lines, perforations, border_factor, border_width] = params;
  archive("scatter", scatter);
  archive("seed", seed);
  archive("spots", spots);
  archive("lines", lines);
  archive("perforations", perforations);
  archive("border_factor", border_factor);
  archive("border_width", border_width);
}

template <class Archive>
void transfer(Archive& archive, ContactParams& params)
{
  auto& [friction, thickness, push_speed, floor, floor_height, floor_friction, bounds_min,
         bounds_max, max_sphere_speed, sphere_timeout] = params;
  archive("friction", friction);
  archive("thickness", thickness);
  archive("push_speed", push_speed);
  archive("floor", floor);
  archive("floor_height", floor_height);
  archive("floor_friction", floor_friction);
  archive("bounds_min", bounds_min);
  archive("bounds_max", bounds_max);
  archive("max_sphere_speed", max_sphere_speed);
  archive("sphere_timeout", sphere_timeout);
}

/// What a step reads. What only requests and logs read is not the cloth's: it stays.
template <class Archive>
void transfer(Archive& archive, SimulationParams& params)
{
  auto& [material, environment, solver, tearing, strength, contact, rest_shape, max_grasp_distance,
         grasp_force_filter, max_gripper_speed, max_gripper_turn, max_speed, runaway_strain,
         threads, tear_log_size, limits, life, place] = params;
  archive("material", material);
  archive("environment", environment);
  archive("solver", solver);
  archive("tearing", tearing);
  archive("strength", strength);
  archive("contact", contact);
  archive.choice("rest_shape", rest_shape, RestShapeSource::UV);
  archive("grasp_force_filter", grasp_force_filter);
  archive("max_gripper_speed", max_gripper_speed);
  archive("max_gripper_turn", max_gripper_turn);
  archive("max_speed", max_speed);
  archive("runaway_strain", runaway_strain);
}

// -- the cloth ------------------------------------------------------------------------------------

template <class Archive>
void transfer(Archive& archive, Spring& spring)
{
  auto& [particles, triangles] = spring;
  archive("particles", particles);
  archive("triangles", triangles);
}

template <class Archive>
void transfer(Archive& archive, Triangle& triangle)
{
  auto& [particles, springs, uv] = triangle;
  archive("particles", particles);
  archive("springs", springs);
  archive("uv", uv);
}

/// The lists of corners, too: their order decides in which order contacts push.
template <class Archive>
void transfer(Archive& archive, Mesh& mesh)
{
  auto& [first_corner, next_corner, springs, triangles] = mesh;
  archive("first_corner", first_corner);
  archive("next_corner", next_corner);
  archive("springs", springs);
  archive("triangles", triangles);
}

template <class Archive>
void transfer(Archive& archive, RestShape& rest)
{
  auto& [areal_density, length, bend_length, area, spacing, mass] = rest;
  archive("areal_density", areal_density);
  archive("length", length);
  archive("bend_length", bend_length);
  archive("area", area);
  archive("spacing", spacing);
  archive("mass", mass);
}

template <class Archive>
void transfer(Archive& archive, ParticleState& state)
{
  auto& [position, velocity, previous, inverse_mass] = state;
  archive("position", position);
  archive("velocity", velocity);
  archive("previous", previous);
  archive("inverse_mass", inverse_mass);
}

template <class Archive>
void transfer(Archive& archive, SpringLaw& law)
{
  auto& [a, b, rest, stiffness, damping] = law;
  archive("a", a);
  archive("b", b);
  archive("rest", rest);
  archive("stiffness", stiffness);
  archive("damping", damping);
}

template <class Archive>
void transfer(Archive& archive, SpringTable& springs)
{
  auto& [structural, bend_shear, changes] = springs;
  static_cast<void>(changes);  // a solver that is restored looks at all springs
  archive("structural", structural);
  archive("bend_shear", bend_shear);
}

template <class Archive>
void transfer(Archive& archive, Damage& damage)
{
  auto& [weak, hinge, at_rest, hem, strength, least_strength, outer, released, parents, tears,
         pieces, pieces_at_rest] = damage;
  archive("weak", weak);
  archive("hinge", hinge);
  archive("at_rest", at_rest);
  archive("hem", hem);
  archive("strength", strength);
  archive("least_strength", least_strength);
  archive("outer", outer);
  archive("released", released);
  archive("parents", parents);
  archive("tears", tears);
  archive("pieces", pieces);
  archive("pieces_at_rest", pieces_at_rest);
}

template <class Archive>
void transfer(Archive& archive, Attachment& attachment)
{
  auto& [kind, grasp] = attachment;
  archive.choice("kind", kind, Attachment::Kind::GRASP);
  archive("grasp", grasp);
}

template <class Archive>
void transfer(Archive& archive, Cloth& cloth)
{
  auto& [material, mesh, rest, state, springs, damage, attachments] = cloth;
  archive("material", material);
  archive("mesh", mesh);
  archive("rest", rest);
  archive("state", state);
  archive("springs", springs);
  archive("damage", damage);
  archive("attachments", attachments);
}

// -- what acts on it ------------------------------------------------------------------------------

template <class Archive>
void transfer(Archive& archive, Pose& pose)
{
  auto& [position, rotation] = pose;
  archive("position", position);
  archive("rotation", rotation);
}

template <class Archive>
void transfer(Archive& archive, DragTarget& target)
{
  auto& [pose, linear_speed, angular_speed] = target;
  archive("pose", pose);
  archive("linear_speed", linear_speed);
  archive("angular_speed", angular_speed);
}

template <class Archive>
void transfer(Archive& archive, Glide& glide)
{
  auto& [goal, time_left] = glide;
  archive("goal", goal);
  archive("time_left", time_left);
}

template <class Archive>
void transfer(Archive& archive, PullUnderWay& pull)
{
  auto& [id, start, goal, stop_force, stop_tears, release, duration, peak_force, tears,
         first_tear] = pull;
  archive("id", id);
  archive("start", start);
  archive("goal", goal);
  archive("stop_force", stop_force);
  archive("stop_tears", stop_tears);
  archive("release", release);
  archive("duration", duration);
  archive("peak_force", peak_force);
  archive("tears", tears);
  archive("first_tear", first_tear);
}

template <class Archive>
void transfer(Archive& archive, Wrench& wrench)
{
  auto& [force, torque] = wrench;
  archive("force", force);
  archive("torque", torque);
}

template <class Archive>
void transfer(Archive& archive, Grasp::Held& held)
{
  auto& [particle, offset] = held;
  archive("particle", particle);
  archive("offset", offset);
}

template <class Archive>
void transfer(Archive& archive, Grasp& grasp)
{
  auto& [id, pose, held, target, glide, pull, force_limit, followed, frame_problem, wrench,
         smoothed, peak_force, loose_pieces] = grasp;
  archive("id", id);
  archive("pose", pose);
  archive("held", held);
  archive("target", target);
  archive("glide", glide);
  archive("pull", pull);
  archive("force_limit", force_limit);
  archive("followed", followed);
  archive("frame_problem", frame_problem);
  archive("wrench", wrench);
  archive("smoothed", smoothed);
  archive("peak_force", peak_force);
  archive("loose_pieces", loose_pieces);
}

/// A number that rises for a life: what is read never lowers it.
template <class Archive>
void transferRising(Archive& archive, const char* name, std::uint64_t& number)
{
  std::uint64_t saved = number;
  archive(name, saved);
  if (Archive::READS)
  {
    number = std::max(number, saved);
  }
}

/// All but the news, which have been told.
template <class Archive>
void transfer(Archive& archive, Grippers& grippers)
{
  auto& [grasps, next, next_pull, news] = grippers;
  archive("grasps", grasps);
  transferRising(archive, "next", next);
  transferRising(archive, "next_pull", next_pull);
}

template <class Archive>
void transfer(Archive& archive, Sphere& sphere)
{
  auto& [source, id, center, previous, velocity, jump, jump_time, radius, mass, fresh, out, age,
         force, time_left, caught, frame, center_in_frame] = sphere;
  archive.choice("source", source, SphereSource::THROWN);
  archive("id", id);
  archive("center", center);
  archive("previous", previous);
  archive("velocity", velocity);
  archive("jump", jump);
  archive("jump_time", jump_time);
  archive("radius", radius);
  archive("mass", mass);
  archive("fresh", fresh);
  archive("out", out);
  archive("age", age);
  archive("force", force);
  archive("time_left", time_left);
  archive("caught", caught);
  archive("frame", frame);
  archive("center_in_frame", center_in_frame);
}

template <class Archive>
void transfer(Archive& archive, SphereSet& set)
{
  auto& [spheres, next_thrown] = set;
  archive("spheres", spheres);
  transferRising(archive, "next_thrown", next_thrown);
}

template <class Archive>
void transfer(Archive& archive, Stability& stability)
{
  auto& [substeps, floored] = stability;
  archive("substeps", substeps);
  archive("floored", floored);
}

template <class Archive>
void transfer(Archive& archive, SolverMemory& memory)
{
  auto& [substeps, inverse_mass_limit, blocks, lines] = memory;
  archive("substeps", substeps);
  archive("inverse_mass_limit", inverse_mass_limit);
  archive("blocks", blocks);
  archive("lines", lines);
}

// -- what happened --------------------------------------------------------------------------------

template <class Archive>
void transfer(Archive& archive, TearEvent::Added& added)
{
  auto& [id, parents] = added;
  archive("id", id);
  archive("parents", parents);
}

template <class Archive>
void transfer(Archive& archive, TearCause& cause)
{
  auto& [kind, id, distance] = cause;
  archive.choice("kind", kind, CauseKind::THROWN_SPHERE);
  archive("id", id);
  archive("distance", distance);
}

template <class Archive>
void transfer(Archive& archive, TearEvent& event)
{
  auto& [sequence, epoch, step, time, kind, particles, spring, path, triangles, position, uv,
         strain, threshold, tension, cause, pieces, loose_area, loose_mass] = event;
  archive("sequence", sequence);
  archive("epoch", epoch);
  archive("step", step);
  archive("time", time);
  archive.choice("kind", kind, TearKind::RELEASED);
  archive("particles", particles);
  archive("spring", spring);
  archive("path", path);
  archive("triangles", triangles);
  archive("position", position);
  archive("uv", uv);
  archive("strain", strain);
  archive("threshold", threshold);
  archive("tension", tension);
  archive("cause", cause);
  archive("pieces", pieces);
  archive("loose_area", loose_area);
  archive("loose_mass", loose_mass);
}

template <class Archive>
void transfer(Archive& archive, EventHistory& history)
{
  auto& [ranges] = history;
  archive("ranges", ranges);
}

// -- everything -----------------------------------------------------------------------------------

/// All but the logs and what is adopted, which are the life's, and what a step or restored() makes
/// anew: contact, tearing, loose_pieces, acceleration, outer, suspects, undo, balance,
/// wanted_until, start_time, start_step, epoch. Who records it is nobody else's matter.
template <class Archive>
void transfer(Archive& archive, Simulation& simulation)
{
  auto& [params, untorn, cloth, solver, contact, tearing, loose_pieces, grippers, spheres,
         acceleration, outer, suspects, undo, stability, log, grasp_log, pull_log, balance,
         wanted_until, history, adopted, tears, start_stability, start_time, start_step, step,
         epoch, workers, recorder] = simulation;
  archive("params", params);
  archive("untorn", untorn);
  archive("cloth", cloth);
  SolverMemory memory = solver->memory();
  archive("solver", memory);
  if (Archive::READS)
  {
    solver = SolverHandle(params.solver);
    solver->recall(memory);
  }
  archive("grippers", grippers);
  archive("spheres", spheres);
  archive("stability", stability);
  archive("start_stability", start_stability);
  archive("history", history);
  archive("tears", tears);
  archive("step", step);
}

}  // namespace cloth
