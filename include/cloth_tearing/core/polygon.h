// Cuts one polygon in space into triangles.
#pragma once

#include <vector>

#include "cloth_tearing/core/delaunay.h"
#include "cloth_tearing/core/types.h"

namespace cloth
{

/// What became of a polygon.
enum class PolygonVerdict
{
  CUT,             ///< into corners - 2 triangles
  NO_AREA,         ///< all corners lie on a line
  CROSSES_ITSELF,  ///< or touches itself, seen along its normal
};

struct PolygonCut
{
  PolygonVerdict verdict = PolygonVerdict::CUT;
  std::vector<FlatTriangle> triangles;  ///< corners as indices into the polygon, wound as it is
};

/// Cuts a polygon in its best-fit plane (by Newell's normal: the sum of its area vectors) and
/// makes the triangles as round as the corners allow, so that there is no sliver that need not be.
/// Corners on a straight side are no obstacle. Costs at most O(corners^2) as polygons go.
///
/// @param corners three or more, in order
/// @param tolerance what counts as no length [m]
PolygonCut cutPolygon(const std::vector<Vec3d>& corners, double tolerance);

}  // namespace cloth
