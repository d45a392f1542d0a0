// Builds a rectangle of cloth by size and resolution, with slits if wanted.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cloth_tearing/core/cloth_model.h"
#include "cloth_tearing/core/types.h"

namespace cloth
{

/// How the cells of a rectangle are cut into triangles.
enum class RectanglePattern
{
  ONE_DIAGONAL,  ///< every diagonal rises to the right, as in the thesis
  ALTERNATING,   ///< diagonals change direction from cell to cell, like a union jack
  IRREGULAR  ///< inner particles wander at random, triangles are Delaunay: no direction preferred
};

/// The pattern with this name ("one_diagonal", "alternating", "irregular").
///
/// @throws std::invalid_argument for any other name, listing the three
RectanglePattern rectanglePattern(const std::string& name);

/// A straight cut, in the plane of the rectangle: x from -width / 2 to width / 2, y from -height
/// (lower edge) to 0 (upper edge) [m].
struct Slit
{
  Vec2d start = Vec2d::Zero();
  Vec2d end = Vec2d::Zero();
};

/// A rectangle of cloth. The defaults make the mesh of thesis 4.3.
struct RectangleParams
{
  double width = 1.0;   ///< along x [m], 0.001 to 1000
  double height = 1.0;  ///< along y [m], 0.001 to 1000
  int columns = 30;     ///< particles along x, >= 2
  int rows = 30;        ///< particles along y, >= 2; columns x rows <= 1,000,000
  RectanglePattern pattern = RectanglePattern::ONE_DIAGONAL;
  double grading = 1.0;    ///< spacing at the border over spacing in the middle [-], 0.2 to 5
  double jitter = 0.3;     ///< IRREGULAR: one random move, in local spacings [-], 0 to 0.5
  std::uint64_t seed = 1;  ///< IRREGULAR: another number gives another mesh
  std::vector<Slit> slits;
};

/// Everything wrong with `params`, one sentence each, naming field, value and limit; empty if the
/// rectangle can be built.
std::vector<std::string> problems(const RectangleParams& params);

/// A sheet in the x-y plane that hangs down from y = 0, centred on x = 0, its front towards +z.
///
/// Particle r * columns + c is in row r from the top and column c from the left; copies made by
/// slits follow. uv = (x / width + 0.5, 1 + y / height): v is 1 at the upper edge.
///
/// A slit runs along mesh edges, from the particle nearest to its start to the one nearest to its
/// end (the lower number of two equally near), on the path for which the sum of edge length x (1 +
/// distance of the edge's middle from the straight line / mean spacing) is least. The triangles
/// on its two sides no longer share the particles it passes; an end inside the cloth stays whole,
/// an end on the border, or on another slit, opens.
///
/// @throws std::invalid_argument naming every problem, or a slit that opens nothing because it is
///   shorter than two edges or lies on the border
ClothModel rectangle(const RectangleParams& params);

}  // namespace cloth
