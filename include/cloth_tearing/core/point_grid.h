// Finds which places lie near some of them.
#pragma once

#include <vector>

#include "cloth_tearing/core/types.h"

namespace cloth
{

/// Marks the positions that lie within `width` [m] of one of `places`, indices into `positions`,
/// which are marked themselves; none if `width` is 0. Distance is measured in space, not along the
/// cloth.
std::vector<char> positionsNear(const std::vector<Vec3d>& positions, const std::vector<int>& places,
                                double width);

}  // namespace cloth
