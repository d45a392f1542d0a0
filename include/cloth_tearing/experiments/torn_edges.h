// Where the cracks of a sheet run, in its material.
#pragma once

#include <vector>

#include "cloth_tearing/core/cloth.h"

namespace cloth
{

/// One side of an edge that a tear opened, where it lay in the untorn sheet.
struct TornEdge
{
  Vec2d start;  ///< [m], from the lower left corner of the sheet
  Vec2d end;    ///< [m]

  double length() const { return (end - start).norm(); }
};

/// Where a corner of a triangle lay in an untorn sheet of `size` [m]: its texture position, which
/// survives every tear (3.3).
Vec2d materialPosition(const Triangle& triangle, int corner, const Vec2d& size);

/// All torn edges, both sides of each; what the sheet was cut before it moved is not among them.
std::vector<TornEdge> tornEdges(const Cloth& cloth, const Vec2d& size);

/// Total length of the edges [m].
double lengthOf(const std::vector<TornEdge>& edges);

/// Length-weighted mean place of the edges [m].
/// @throws std::invalid_argument if there are no edges
Vec2d middleOf(const std::vector<TornEdge>& edges);

/// Angle between `axis` and the line along which the edges lie, 0 to 90 degrees: the principal axis
/// of their length about their middle. A crack that zigzags through a lattice is seen as the line
/// that it makes, not as its teeth.
/// @throws std::invalid_argument if there are no edges
double lineAngleTo(const std::vector<TornEdge>& edges, const Vec2d& axis);

/// Length-weighted mean of the angle between edges and `axis`, each 0 to 90 degrees; 45 for edges
/// in every direction.
/// @throws std::invalid_argument if there are no edges
double meanAngleTo(const std::vector<TornEdge>& edges, const Vec2d& axis);

}  // namespace cloth
