// Outer accelerations: gravity, air friction, wind.
#pragma once

#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/material.h"

namespace cloth
{

/// Writes the acceleration of every particle [m/s^2] (2.1.1). Wind presses on each triangle along
/// its normal, in proportion to its area (its rest area at most) and to the normal speed of the air
/// against it (Provot 1995). Held particles get it too: it does not move them, but whoever holds
/// them feels it.
void outerAccelerations(const Cloth& cloth, const Environment& environment,
                        Vec3Array& acceleration);

}  // namespace cloth
