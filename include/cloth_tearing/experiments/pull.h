// A hand that takes hold of a place of the cloth and pulls.
#pragma once

#include "cloth_tearing/core/simulation.h"

namespace cloth
{

struct Pull
{
  Vec2d place = Vec2d::Zero();  ///< on the texture [-]
  Vec3d way = Vec3d::Zero();    ///< from where the cloth is taken hold of [m]
  double speed = 1.0;           ///< [m/s], > 0
  double radius = 0.25;         ///< of the grasp [m], > 0
};

/// Takes hold of the cloth where a particle is that hangs from a pin, the one nearest to the place;
/// none of the hem, which is hard to tear, as long as there are others. Then sends it on its way.
/// @return the grasp's id
/// @throws std::runtime_error if nothing hangs any more; Refusal if it is held already
std::uint64_t beginPull(Simulation& simulation, const Pull& pull);

}  // namespace cloth
