// Pins that come and go while the cloth moves.
#pragma once

#include <vector>

#include "cloth_tearing/core/cloth.h"

namespace cloth
{

/// Particles within a ball, or by their ids, or both.
struct PinRequest
{
  Vec3d point = Vec3d::Zero();  ///< centre of the ball [m], cloth frame
  double radius = 0.0;          ///< [m], >= 0; 0 = no ball
  std::vector<int> particles;   ///< ids, at most 100000
};

/// From now on they stand still, where they are. The hem of the cloth's own pins stays what it was.
/// @return how many were not pinned before
/// @throws Refusal if nothing is named or within the ball, an id is unknown or was put to rest, or
/// a grasp holds one of them; nothing has changed then
int pin(Cloth& cloth, const PinRequest& request);

/// They are free again; those that are not pinned stay as they are.
/// @return how many were pinned before
/// @throws Refusal if nothing is named or within the ball, or an id is unknown or was put to rest
int unpin(Cloth& cloth, const PinRequest& request);

}  // namespace cloth
