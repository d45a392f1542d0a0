// Finds where a ray meets a cloth, and how near the cloth comes to a point.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cloth_tearing/core/types.h"

namespace cloth_tearing
{

struct Ray
{
  cloth::Vec3d origin;     ///< [m]
  cloth::Vec3d direction;  ///< of length 1

  cloth::Vec3d at(double distance) const { return origin + distance * direction; }
};

/// How far from its origin the ray first meets one of the triangles, from either side [m]; none if
/// it misses all of them. Nothing slips through between triangles that share an edge or a corner.
///
/// @param positions of particles [m]
/// @param triangles three particles each
std::optional<double> firstHit(const Ray& ray, const std::vector<cloth::Vec3>& positions,
                               const std::vector<std::uint32_t>& triangles);

/// From a point to the nearest triangle [m]; infinite if there is none.
double distanceTo(const cloth::Vec3d& point, const std::vector<cloth::Vec3>& positions,
                  const std::vector<std::uint32_t>& triangles);

}  // namespace cloth_tearing
