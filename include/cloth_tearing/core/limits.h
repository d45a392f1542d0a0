// How much a cloth takes: the hard ceilings of all that is counted or measured, in one place, and
// the limits below them that a user may set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cloth
{

// -- ceilings: no parameter, request or file goes beyond them ------------------------------------

constexpr int MAX_PARTICLES = 1000000;   ///< of a model; tears add to them
constexpr int MAX_TRIANGLES = 2000000;   ///< likewise
constexpr int MAX_SPHERES = 1000;        ///< at once, streamed and thrown ones together
constexpr int MAX_GRASPS = 1000;         ///< at once
constexpr double MAX_MODEL_FILE = 1000;  ///< [MB]
constexpr double MAX_STATE_FILE = 1e5;   ///< and all states in memory together [MB]
constexpr double MAX_RECORDING = 1e6;    ///< of a run [MB]
constexpr int MAX_STATES = 10000;        ///< in memory
constexpr int MAX_COMMANDS = 10000;      ///< that wait for the simulation's thread
constexpr int MAX_EVENTS_LOGGED = 10000000;
constexpr int MAX_TEARS_PER_STEP = 100000;
constexpr int MAX_STOP_TEARS = 1000000;      ///< after which a pull is to stop
constexpr int MAX_NAMED_PARTICLES = 100000;  ///< in one request
constexpr int MAX_FRAME_NAME = 255;          ///< length of a tf frame's name [characters]

/// [m], cloth frame; farther out, float positions would be too coarse to tear by.
constexpr double MAX_COORDINATE = 1000;
constexpr double MAX_PARTICLE_SPEED = 10000;  ///< [m/s]
constexpr double MAX_SPHERE_SPEED = 1000;     ///< [m/s]
constexpr double MAX_GRIPPER_SPEED = 100;     ///< [m/s]
constexpr double MAX_GRIPPER_TURN = 100;      ///< [rad/s]
constexpr double MAX_LIFETIME = 1e6;          ///< of a thrown sphere [s]
constexpr double MAX_FORCE = 1e6;             ///< that a grasp lets go or a pull stops at [N]

// -- limits that may be set -----------------------------------------------------------------------

/// What is beyond is refused. Those that have been there before stand beside what they belong to:
/// see TearRules, ContactParams and SimulationParams.
struct Limits
{
  int particles = MAX_PARTICLES;  ///< of a model, 1 to MAX_PARTICLES
  int triangles = MAX_TRIANGLES;  ///< of a model, 1 to MAX_TRIANGLES
  int spheres = MAX_SPHERES;      ///< at once, 1 to MAX_SPHERES
  int grasps = MAX_GRASPS;        ///< at once, 1 to MAX_GRASPS
};

/// Everything wrong with `limits`, one sentence each, naming field, value and ceiling.
std::vector<std::string> problems(const Limits& limits);

/// Adds a sentence to `found` if `count` is more than `limit`, which is called `name`.
/// @param things that are counted, such as "spheres"
void checkCount(std::vector<std::string>& found, const std::string& things, std::size_t count,
                const std::string& name, int limit);

}  // namespace cloth
