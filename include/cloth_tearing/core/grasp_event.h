// What happens to grasps, for those who watch.
#pragma once

#include <cstdint>
#include <string>

#include "cloth_tearing/core/types.h"

namespace cloth
{

enum class GraspEventKind
{
  TAKEN,              ///< cloth was taken hold of
  RELEASED,           ///< let go: on request, by a pull that ended so, by a reset
  SLIPPED,            ///< let go because the force exceeded its limit
  SPLIT,              ///< a tear parted the patch that it holds: it goes on holding both sides
  HOLDS_LOOSE_PIECE,  ///< a piece that it holds no longer hangs together with a pin or other grasp
  FRAME_LOST,         ///< the frame that it follows is missing
  FRAME_FOUND,        ///< and is back
};

struct GraspEvent
{
  std::uint64_t sequence = 0;  ///< 1, 2, ... for the life of the simulation, apart from tears
  std::uint32_t epoch = 0;
  std::uint64_t step = 0;
  double time = 0.0;  ///< [s]
  GraspEventKind kind = GraspEventKind::TAKEN;
  std::uint64_t grasp = 0;         ///< grasp id
  int held_particles = 0;          ///< before it lets go
  Vec3d position = Vec3d::Zero();  ///< origin of the grasp frame [m], cloth frame
  double force = 0.0;              ///< between cloth and gripper, smoothed [N]
  double area = 0.0;               ///< rest area of the loose pieces; 0 for other kinds [m^2]
  double mass = 0.0;               ///< their mass; 0 for other kinds [kg]
  std::string reason;              ///< in words
};

}  // namespace cloth
