// The woven checker that stands for a texture: where its lines cut a triangle, and its colours.
#include "cloth_tearing/node/checker.h"

#include <algorithm>
#include <cmath>

namespace cloth_tearing
{

namespace
{

constexpr double MOST_CHECKS = 1024.0;  // across the box around one triangle
constexpr double SLIVER = 1e-6;         // smallest part, as a fraction of the triangle
constexpr double LARGEST_CHECK = 1e6;   // beyond, a check has no number
constexpr int BLOCK = 4;                // checks of one colour along u and v

/// A corner of a part: its place in checks, and its weights in the triangle.
struct Corner
{
  cloth::Vec2d place;
  std::array<double, 3> weights;
};
using Polygon = std::vector<Corner>;

Corner between(const Corner& a, const Corner& b, double fraction)
{
  Corner c;
  c.place = a.place + fraction * (b.place - a.place);
  for (int i = 0; i < 3; ++i)
  {
    c.weights[i] = a.weights[i] + fraction * (b.weights[i] - a.weights[i]);
  }
  return c;
}

/// The part of a convex polygon on which sign * (coordinate - line) >= 0.
Polygon clipped(const Polygon& polygon, int axis, double line, double sign)
{
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Corner& from = polygon[i];
    const Corner& to = polygon[(i + 1) % polygon.size()];
    const double a = sign * (from.place[axis] - line);
    const double b = sign * (to.place[axis] - line);
    if (a >= 0.0)
    {
      kept.push_back(from);
    }
    if ((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0))
    {
      kept.push_back(between(from, to, a / (a - b)));
    }
  }
  return kept;
}

/// The part of a convex polygon between two neighbouring lines.
Polygon strip(const Polygon& polygon, int axis, int index)
{
  return clipped(clipped(polygon, axis, index, 1.0), axis, index + 1.0, -1.0);
}

/// The checks that `polygon` reaches along `axis`: first and last.
std::array<int, 2> reach(const Polygon& polygon, int axis)
{
  double low = polygon[0].place[axis];
  double high = low;
  for (const Corner& corner : polygon)
  {
    low = std::min(low, corner.place[axis]);
    high = std::max(high, corner.place[axis]);
  }
  const int first = static_cast<int>(std::floor(low));
  return { first, std::max(first, static_cast<int>(std::ceil(high)) - 1) };
}

double triangleArea(const cloth::Vec2d& a, const cloth::Vec2d& b, const cloth::Vec2d& c)
{
  return 0.5 * std::abs((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
}

PaintedCorner painted(const Corner& corner, const Color& color)
{
  PaintedCorner result;
  for (int i = 0; i < 3; ++i)
  {
    result.weights[i] = static_cast<float>(corner.weights[i]);
  }
  result.color = color;
  return result;
}

/// Appends a convex polygon as triangles round its first corner.
void append(std::vector<PaintedCorner>& corners, const Polygon& polygon, const Color& color,
            double least_area)
{
  for (std::size_t i = 2; i < polygon.size(); ++i)
  {
    if (triangleArea(polygon[0].place, polygon[i - 1].place, polygon[i].place) > least_area)
    {
      corners.push_back(painted(polygon[0], color));
      corners.push_back(painted(polygon[i - 1], color));
      corners.push_back(painted(polygon[i], color));
    }
  }
}

int wrapped(int value, int count)
{
  return ((value % count) + count) % count;
}

bool countable(const Polygon& triangle)
{
  return std::all_of(triangle.begin(), triangle.end(),
                     [](const Corner& corner)
                     {
                       return std::abs(corner.place.x()) < LARGEST_CHECK &&
                              std::abs(corner.place.y()) < LARGEST_CHECK;
                     });
}

/// The whole triangle in the colour at its middle.
std::vector<PaintedCorner> whole(const Polygon& triangle)
{
  Color color = checkColor(0, 0);
  if (countable(triangle))
  {
    const cloth::Vec2d middle = (triangle[0].place + triangle[1].place + triangle[2].place) / 3.0;
    color = checkColor(static_cast<int>(std::floor(middle.x())),
                       static_cast<int>(std::floor(middle.y())));
  }
  return { painted(triangle[0], color), painted(triangle[1], color), painted(triangle[2], color) };
}

}  // namespace

Color checkColor(int column, int row)
{
  static const std::array<Color, 5> COLORS = { { { 0.72F, 0.13F, 0.16F },
                                                 { 0.10F, 0.32F, 0.58F },
                                                 { 0.88F, 0.58F, 0.12F },
                                                 { 0.13F, 0.48F, 0.34F },
                                                 { 0.42F, 0.20F, 0.50F } } };
  if (wrapped(column + row, 2) == 1)
  {
    return { 0.95F, 0.92F, 0.84F };
  }
  const auto block = [](int check) { return (check - wrapped(check, BLOCK)) / BLOCK; };
  return COLORS[wrapped(block(column) + 2 * block(row), COLORS.size())];
}

std::vector<PaintedCorner> cutByChecks(const std::array<cloth::Vec2d, 3>& uv, int checks)
{
  const Polygon triangle = { { checks * uv[0], { 1.0, 0.0, 0.0 } },
                             { checks * uv[1], { 0.0, 1.0, 0.0 } },
                             { checks * uv[2], { 0.0, 0.0, 1.0 } } };
  const double area = triangleArea(triangle[0].place, triangle[1].place, triangle[2].place);
  if (!countable(triangle) || !(area > 0.0))
  {
    return whole(triangle);
  }
  const std::array<int, 2> columns = reach(triangle, 0);
  const std::array<int, 2> rows = reach(triangle, 1);
  if ((columns[1] - columns[0] + 1.0) * (rows[1] - rows[0] + 1.0) > MOST_CHECKS)
  {
    return whole(triangle);
  }
  std::vector<PaintedCorner> corners;
  for (int column = columns[0]; column <= columns[1]; ++column)
  {
    const Polygon slice = strip(triangle, 0, column);
    if (slice.size() < 3)
    {
      continue;
    }
    const std::array<int, 2> slice_rows = reach(slice, 1);
    for (int row = slice_rows[0]; row <= slice_rows[1]; ++row)
    {
      append(corners, strip(slice, 1, row), checkColor(column, row), SLIVER * area);
    }
  }
  return corners;
}

}  // namespace cloth_tearing
