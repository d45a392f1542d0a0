// The woven checker that stands for a texture: where its lines cut a triangle, and its colours.
#pragma once

#include <array>
#include <vector>

#include "cloth_tearing/core/types.h"

namespace cloth_tearing
{

/// Red, green and blue, 0 to 1.
using Color = std::array<float, 3>;

/// A corner of a painted triangle.
struct PaintedCorner
{
  std::array<float, 3> weights;  ///< of the corners of the triangle that it lies in; their sum is 1
  Color color;
};

/// The colour of the check in `column`, `row`: every second one cream, the others in one of several
/// colours, the same within a block of checks, so that parts of a torn cloth can be told apart.
Color checkColor(int column, int row);

/// Cuts a triangle along the lines of a checker with `checks` checks in one unit of u and of v.
///
/// @param uv texture position of the triangle's corners
/// @return three corners of one colour for each part, together the whole triangle but for slivers
///   of less than a millionth of it. A triangle across which too many checks fall to be seen, or
///   whose texture has no area, has the colour at its middle.
std::vector<PaintedCorner> cutByChecks(const std::array<cloth::Vec2d, 3>& uv, int checks);

}  // namespace cloth_tearing
