// Along which springs a particle gives way (3.2.2, figures 3.13 to 3.15).
#pragma once

#include <optional>
#include <vector>

#include "cloth_tearing/core/cloth.h"

namespace cloth
{

/// One spring where the fan is open, since the tear arrives at the particle; two, one on each
/// side of the pull, where it is closed.
struct TearPath
{
  std::vector<SpringId> springs;
  double resistance = 0.0;  ///< of the spring that holds against the pull, along it [N]
};

/// The way a tear goes on at `p` when `stretched` pulls at it.
///
/// Of the springs in the same fan, the one with the greatest tension against the pull resists
/// (compressed springs do not). Between it and the stretched one, on the side where both hang
/// together through triangles, the spring nearest the perpendicular of the pull is the path; ties
/// by id. If nothing lies between, the next most resisting spring counts.
///
/// @return none if nothing resists, or nothing lies between
std::optional<TearPath> findTearPath(const Cloth& cloth, ParticleId p, SpringId stretched);

/// Tension of the spring in the fan of `stretched` at `p` that resists its pull most [N]; 0 if none
/// does.
double resistanceAt(const Cloth& cloth, ParticleId p, SpringId stretched);

}  // namespace cloth
