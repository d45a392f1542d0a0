// Drags that are watched, and stop on force, on tears or where they arrive.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cloth_tearing/core/types.h"

namespace cloth
{

struct Grasp;

/// A pull under way. Part of the grasp that pulls.
struct PullUnderWay
{
  std::uint64_t id = 0;          ///< 1, 2, ... for the life of the simulation
  Pose start;                    ///< of the grasp frame when it began
  Pose goal;                     ///< where it is to be
  double stop_force = 0.0;       ///< of the smoothed force [N]; 0 = never
  int stop_tears = 0;            ///< 0 = never
  bool release = false;          ///< let go when it ends
  double duration = 0.0;         ///< simulated time since it began [s]
  double peak_force = 0.0;       ///< largest smoothed force since then [N]
  int tears = 0;                 ///< that its grasp caused since then
  std::uint64_t first_tear = 1;  ///< number of the first tear since then, whatever its cause
};

enum class PullOutcome
{
  ARRIVED,
  FORCE,      ///< stopped: stop_force
  TEARS,      ///< stopped: stop_tears
  LOST,       ///< the grasp ended under way
  CANCELLED,  ///< cancelled, or another command moves the grasp now
};

/// How far a pull has come.
struct PullProgress
{
  std::uint64_t pull = 0;
  std::uint64_t grasp = 0;
  double fraction = 0.0;    ///< of the way, and of the turn if that is behind [-], 0 to 1
  double force = 0.0;       ///< smoothed [N]
  double peak_force = 0.0;  ///< largest smoothed force so far [N]
  double travelled = 0.0;   ///< straight distance from the start [m]
  double duration = 0.0;    ///< simulated time from the start [s]
  int tears = 0;            ///< that the grasp caused so far
};

/// How a pull ended.
struct PullEnd
{
  std::uint64_t sequence = 0;  ///< 1, 2, ... for the life of the simulation
  PullOutcome outcome = PullOutcome::ARRIVED;
  std::string message;           ///< in words
  PullProgress progress;         ///< in the end
  int held_particles = 0;        ///< when it ended, before it let go
  std::uint64_t first_tear = 1;  ///< tears of the cloth under way have the numbers from this one
  std::uint64_t last_tear = 0;   ///< to this one; none if that is less
  int pieces = 0;                ///< of cloth in the end
};

/// @param grasp one that pulls
PullProgress progressOf(const Grasp& grasp);

/// Why a pull ends after a step, if it does; in words in `message`.
std::optional<PullOutcome> endOf(const Grasp& grasp, std::string& message);

}  // namespace cloth
