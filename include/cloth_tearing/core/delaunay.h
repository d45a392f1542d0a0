// Makes the triangles of a flat triangulation as round as its points allow, by flipping edges.
#pragma once

#include <array>
#include <vector>

#include "cloth_tearing/core/types.h"

namespace cloth
{

/// Corners of a flat triangle, counter-clockwise, as indices into a list of points.
using FlatTriangle = std::array<int, 3>;

/// Twice the area of (a, b, c) [m^2]; positive if they turn counter-clockwise.
double signedArea2(const Vec2d& a, const Vec2d& b, const Vec2d& c);

/// Flips inner edges until the triangulation is Delaunay: the smallest angles are then as large as
/// they can be. Border edges and the number of triangles stay. No triangle ever turns over.
///
/// `triangles` are counter-clockwise, of positive area, and do not overlap. The result depends on
/// their order only where four points lie on a circle.
void flipToDelaunay(const std::vector<Vec2d>& points, std::vector<FlatTriangle>& triangles);

}  // namespace cloth
