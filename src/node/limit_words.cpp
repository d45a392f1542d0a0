// Tells all limits of a node, for its start.
#include "cloth_tearing/node/limit_words.h"

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/limits.h"

namespace cloth_tearing
{

namespace
{

struct Limit
{
  std::string parameter;  ///< with its unit
  double value;
  double ceiling;
};

std::string number(double value)
{
  const bool whole = value == static_cast<double>(static_cast<long long>(value));
  return whole ? std::to_string(static_cast<long long>(value)) : cloth::text(value);
}

}  // namespace

std::string limitsInWords(const NodeParams& params)
{
  const cloth::SimulationParams& simulation = params.simulation;
  const Limit limits[] = {
    { "limits/particles", double(simulation.limits.particles), cloth::MAX_PARTICLES },
    { "limits/triangles", double(simulation.limits.triangles), cloth::MAX_TRIANGLES },
    { "limits/spheres", double(simulation.limits.spheres), cloth::MAX_SPHERES },
    { "limits/grasps", double(simulation.limits.grasps), cloth::MAX_GRASPS },
    { "limits/model_file [MB]", params.max_model_file, cloth::MAX_MODEL_FILE },
    { "limits/commands", double(params.max_commands), cloth::MAX_COMMANDS },
    { "max_state_memory [MB]", params.states.max_state_memory, cloth::MAX_STATE_FILE },
    { "max_states", double(params.states.max_states), cloth::MAX_STATES },
    { "recording_limit [MB]", params.recording.limit, cloth::MAX_RECORDING },
    { "tear_log_size", double(simulation.tear_log_size), cloth::MAX_EVENTS_LOGGED },
    { "tearing/max_tears_per_step", double(simulation.tearing.max_tears_per_step),
      cloth::MAX_TEARS_PER_STEP },
    { "max_speed [m/s]", simulation.max_speed, cloth::MAX_PARTICLE_SPEED },
    { "contact/max_sphere_speed [m/s]", simulation.contact.max_sphere_speed,
      cloth::MAX_SPHERE_SPEED },
    { "max_gripper_speed [m/s]", simulation.max_gripper_speed, cloth::MAX_GRIPPER_SPEED },
    { "max_gripper_turn [rad/s]", simulation.max_gripper_turn, cloth::MAX_GRIPPER_TURN },
  };
  std::string words = "limits, and how far each may be raised:";
  for (const Limit& limit : limits)
  {
    words += "\n  " + limit.parameter + ": " + number(limit.value) + " of " + number(limit.ceiling);
  }
  return words + "\n  always: coordinates of " + number(cloth::MAX_COORDINATE) +
         " m, speeds of spheres of " + number(cloth::MAX_SPHERE_SPEED) +
         " m/s and of drags and pulls of " + number(cloth::MAX_GRIPPER_SPEED) + " m/s and " +
         number(cloth::MAX_GRIPPER_TURN) + " rad/s, forces of " + number(cloth::MAX_FORCE) +
         " N, " + number(cloth::MAX_NAMED_PARTICLES) + " particles named in one request, " +
         number(cloth::MAX_FRAME_NAME) + " characters in the name of a frame";
}

}  // namespace cloth_tearing
