// Grids, random irregular meshes, and slits.
#include "cloth_tearing/core/mesh_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <random>
#include <stdexcept>
#include <utility>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/delaunay.h"

namespace cloth
{
namespace
{

constexpr double MIN_SIZE = 0.001;  // [m]
constexpr double MAX_SIZE = 1000;   // [m]
constexpr double MIN_GRADING = 0.2;
constexpr double MAX_GRADING = 5;
constexpr double MAX_JITTER = 0.5;  // of the local spacing

// After ten rounds of random moves hardly anything of the grid's directions is left.
constexpr int JITTER_ROUNDS = 10;
constexpr double MIN_ROUNDNESS = 0.6;      // equilateral is 1, half a square 0.87
constexpr double MIN_EDGE_SPACINGS = 0.6;  // no edge is made shorter or longer than these,
constexpr double MAX_EDGE_SPACINGS = 1.7;  // in local spacings

std::string joined(const std::vector<std::string>& sentences)
{
  std::string all;
  for (const std::string& sentence : sentences)
  {
    all += (all.empty() ? "" : "; ") + sentence;
  }
  return all;
}

void checkSlitEnd(const std::string& field, const Vec2d& place, const RectangleParams& params,
                  std::vector<std::string>& found)
{
  check(found, field + ".x", place.x(), Range::between(-params.width / 2, params.width / 2));
  check(found, field + ".y", place.y(), Range::between(-params.height, 0));
}

// Places of grid lines from 0 to 1, symmetric, `grading` times further apart at the ends.
std::vector<double> gridLines(int count, double grading)
{
  const double a =
      (grading - 1) / 3;  // the slope of t + a t^3 is 1 in the middle, 1 + 3 a at the ends
  std::vector<double> lines(count);
  for (int i = 0; i < count; ++i)
  {
    const double t = 2.0 * i / (count - 1) - 1;
    lines[i] = ((t + a * t * t * t) / (1 + a) + 1) / 2;
  }
  return lines;
}

std::vector<Vec2d> gridPoints(const RectangleParams& params)
{
  const std::vector<double> across = gridLines(params.columns, params.grading);
  const std::vector<double> down = gridLines(params.rows, params.grading);
  std::vector<Vec2d> points;
  points.reserve(across.size() * down.size());
  for (const double y : down)
  {
    for (const double x : across)
    {
      points.emplace_back(params.width * (x - 0.5), -params.height * y);
    }
  }
  return points;
}

std::vector<FlatTriangle> gridTriangles(const RectangleParams& params)
{
  std::vector<FlatTriangle> triangles;
  triangles.reserve(2 * static_cast<std::size_t>(params.columns - 1) * (params.rows - 1));
  for (int r = 0; r + 1 < params.rows; ++r)
  {
    for (int c = 0; c + 1 < params.columns; ++c)
    {
      const int upper_left = r * params.columns + c;
      const int upper_right = upper_left + 1;
      const int lower_left = upper_left + params.columns;
      const int lower_right = lower_left + 1;
      if (params.pattern == RectanglePattern::ONE_DIAGONAL || (r + c) % 2 == 0)
      {
        triangles.push_back({ lower_left, lower_right, upper_right });
        triangles.push_back({ lower_left, upper_right, upper_left });
      }
      else
      {
        triangles.push_back({ lower_left, lower_right, upper_left });
        triangles.push_back({ lower_right, upper_right, upper_left });
      }
    }
  }
  return triangles;
}

// The triangles at each point, one after the other.
class TrianglesByPoint
{
public:
  TrianglesByPoint(std::size_t points, const std::vector<FlatTriangle>& triangles)
      : first_(points + 1, 0), entries_(3 * triangles.size())
  {
    for (const FlatTriangle& triangle : triangles)
    {
      for (const int p : triangle)
      {
        ++first_[p + 1];
      }
    }
    for (std::size_t p = 0; p < points; ++p)
    {
      first_[p + 1] += first_[p];
    }
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      for (const int p : triangles[t])
      {
        entries_[next[p]++] = static_cast<int>(t);
      }
    }
  }

  const int* begin(int p) const { return entries_.data() + first_[p]; }
  const int* end(int p) const { return entries_.data() + first_[p + 1]; }
  int count(int p) const { return first_[p + 1] - first_[p]; }

private:
  std::vector<int> first_;
  std::vector<int> entries_;
};

// 4 sqrt(3) area / sum of squared sides: 1 if equilateral, 0 if flat, negative if turned over.
double roundness(const Vec2d& a, const Vec2d& b, const Vec2d& c)
{
  const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return 2 * std::sqrt(3.0) * signedArea2(a, b, c) / sides;
}

// Uniform in [-1, 1), the same on every platform (the standard's distributions are not).
double uniform(std::mt19937_64& random)
{
  return static_cast<double>(random() >> 11) * (1.0 / (std::uint64_t{ 1 } << 52)) - 1;
}

// Moves the inner points of a grid at random and keeps the triangles round.
class Jitter
{
public:
  Jitter(const RectangleParams& params, std::vector<Vec2d>& points,
         std::vector<FlatTriangle>& triangles)
      : params_(params), points_(points), triangles_(triangles), random_(params.seed)
  {
    for (int r = 1; r + 1 < params.rows; ++r)
    {
      for (int c = 1; c + 1 < params.columns; ++c)
      {
        inner_.push_back(r * params.columns + c);
        spacing_.push_back(gridSpacing(inner_.back()));
      }
    }
  }

  void run()
  {
    flipToDelaunay(points_, triangles_);
    for (int round = 0; round < JITTER_ROUNDS; ++round)
    {
      const TrianglesByPoint around(points_.size(), triangles_);
      for (std::size_t i = 0; i < inner_.size(); ++i)
      {
        tryToMove(inner_[i], spacing_[i], around);
      }
      flipToDelaunay(points_, triangles_);
    }
  }

private:
  double gridSpacing(int p) const
  {
    double least = std::numeric_limits<double>::infinity();
    for (const int q : { p - 1, p + 1, p - params_.columns, p + params_.columns })
    {
      least = std::min(least, (points_[q] - points_[p]).norm());
    }
    return least;
  }

  void tryToMove(int p, double spacing, const TrianglesByPoint& around)
  {
    const double dx = uniform(random_);
    const double dy = uniform(random_);
    const double reach = params_.jitter * spacing;
    const Vec2d before = points_[p];
    const Shape old_shape = shapeAround(p, around);
    points_[p] = Vec2d(before.x() + reach * dx, before.y() + reach * dy);
    const Shape new_shape = shapeAround(p, around);
    if (new_shape.roundness < std::min(MIN_ROUNDNESS, old_shape.roundness) ||
        new_shape.shortest < std::min(MIN_EDGE_SPACINGS * spacing, old_shape.shortest) ||
        new_shape.longest > std::max(MAX_EDGE_SPACINGS * spacing, old_shape.longest))
    {
      points_[p] = before;
    }
  }

  struct Shape
  {
    double roundness;  // of the least round triangle
    double shortest;   // edge
    double longest;
  };

  Shape shapeAround(int p, const TrianglesByPoint& around) const
  {
    const double infinity = std::numeric_limits<double>::infinity();
    Shape worst = { infinity, infinity, 0 };
    for (const int* t = around.begin(p); t != around.end(p); ++t)
    {
      const FlatTriangle& corners = triangles_[*t];
      worst.roundness =
          std::min(worst.roundness,
                   roundness(points_[corners[0]], points_[corners[1]], points_[corners[2]]));
      for (const int q : corners)
      {
        if (q != p)
        {
          const double length = (points_[q] - points_[p]).norm();
          worst.shortest = std::min(worst.shortest, length);
          worst.longest = std::max(worst.longest, length);
        }
      }
    }
    return worst;
  }

  const RectangleParams& params_;
  std::vector<Vec2d>& points_;
  std::vector<FlatTriangle>& triangles_;
  std::mt19937_64 random_;
  std::vector<int> inner_;
  std::vector<double> spacing_;
};

using Edge = std::pair<int, int>;  // the lower end first

Edge edgeBetween(int a, int b)
{
  return std::minmax(a, b);
}

// Finds where slits run and opens the model along them.
class Cutter
{
public:
  Cutter(const RectangleParams& params, std::vector<Vec2d>& points,
         std::vector<FlatTriangle>& triangles)
      : params_(params), points_(points), triangles_(triangles), around_(points.size(), triangles)
  {
  }

  void run()
  {
    std::vector<std::vector<int>> paths;
    for (const Slit& slit : params_.slits)
    {
      paths.push_back(pathAlong(slit));
      for (std::size_t i = 1; i < paths.back().size(); ++i)
      {
        cut_.push_back(edgeBetween(paths.back()[i - 1], paths.back()[i]));
      }
    }
    std::sort(cut_.begin(), cut_.end());
    refuseSlitsThatOpenNothing(paths);
    for (const std::vector<int>& path : paths)
    {
      for (const int p : path)
      {
        separateSides(p);
      }
    }
  }

private:
  int nearestPoint(const Vec2d& place) const
  {
    const auto closer = [&](const Vec2d& a, const Vec2d& b)
    { return (a - place).squaredNorm() < (b - place).squaredNorm(); };
    return static_cast<int>(std::min_element(points_.begin(), points_.end(), closer) -
                            points_.begin());
  }

  // Dijkstra's shortest path; the lower number wins a tie.
  std::vector<int> pathAlong(const Slit& slit) const
  {
    const int start = nearestPoint(slit.start);
    const int end = nearestPoint(slit.end);
    std::vector<double> cost(points_.size(), std::numeric_limits<double>::infinity());
    std::vector<int> previous(points_.size(), -1);
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open;
    cost[start] = 0;
    open.emplace(0, start);
    while (!open.empty() && open.top().second != end)
    {
      const auto [reached, p] = open.top();
      open.pop();
      if (reached > cost[p])
      {
        continue;
      }
      for (const int* t = around_.begin(p); t != around_.end(p); ++t)
      {
        for (const int q : triangles_[*t])
        {
          const double candidate = reached + edgeCost(p, q, slit);
          if (q != p && candidate < cost[q])
          {
            cost[q] = candidate;
            previous[q] = p;
            open.emplace(candidate, q);
          }
        }
      }
    }
    std::vector<int> path;
    for (int p = end; p >= 0; p = previous[p])
    {
      path.push_back(p);
    }
    return path;
  }

  double edgeCost(int p, int q, const Slit& slit) const
  {
    const Vec2d along = (slit.end - slit.start).normalized();
    const Vec2d middle = (points_[p] + points_[q]) / 2 - slit.start;
    const double offset = std::abs(along.x() * middle.y() - along.y() * middle.x());
    return (points_[q] - points_[p]).norm() * (1 + offset / meanSpacing());
  }

  double meanSpacing() const
  {
    return (params_.width / (params_.columns - 1) + params_.height / (params_.rows - 1)) / 2;
  }

  bool isCut(int a, int b) const
  {
    return std::binary_search(cut_.begin(), cut_.end(), edgeBetween(a, b));
  }

  // The triangles at p in groups that hang together through edges that are not cut.
  std::vector<std::vector<int>> sidesAt(int p) const
  {
    std::vector<int> left(around_.begin(p), around_.end(p));
    std::vector<std::vector<int>> sides;
    while (!left.empty())
    {
      std::vector<int> side = { left.front() };
      left.erase(left.begin());
      for (std::size_t i = 0; i < side.size(); ++i)
      {
        for (std::size_t j = 0; j < left.size();)
        {
          if (hangTogether(p, side[i], left[j]))
          {
            side.push_back(left[j]);
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(j));
          }
          else
          {
            ++j;
          }
        }
      }
      sides.push_back(side);
    }
    return sides;
  }

  bool hangTogether(int p, int t, int u) const
  {
    for (const int q : original(t))
    {
      const FlatTriangle other = original(u);
      if (q != p && std::find(other.begin(), other.end(), q) != other.end())
      {
        return !isCut(p, q);
      }
    }
    return false;
  }

  // Corners as they were before any slit opened.
  FlatTriangle original(int t) const
  {
    FlatTriangle corners = triangles_[t];
    for (int& p : corners)
    {
      const int copy = p - static_cast<int>(original_count_);
      p = copy < 0 ? p : original_of_copy_[copy];
    }
    return corners;
  }

  void refuseSlitsThatOpenNothing(const std::vector<std::vector<int>>& paths) const
  {
    for (std::size_t i = 0; i < paths.size(); ++i)
    {
      const bool opens = std::any_of(paths[i].begin(), paths[i].end(),
                                     [this](int p) { return sidesAt(p).size() > 1; });
      if (!opens)
      {
        throw std::invalid_argument("slits[" + std::to_string(i) +
                                    "] opens nothing: it is shorter than two edges of the mesh, or "
                                    "lies on the border");
      }
    }
  }

  // Every side but the first gets a copy of p. A second call finds nothing left to do: the sides
  // no longer meet in p.
  void separateSides(int p)
  {
    const std::vector<std::vector<int>> sides = sidesAt(p);
    for (std::size_t i = 1; i < sides.size(); ++i)
    {
      if (std::find(triangles_[sides[i].front()].begin(), triangles_[sides[i].front()].end(), p) ==
          triangles_[sides[i].front()].end())
      {
        continue;
      }
      const int copy = static_cast<int>(points_.size());
      points_.push_back(Vec2d(points_[p]));
      original_of_copy_.push_back(p);
      for (const int t : sides[i])
      {
        std::replace(triangles_[t].begin(), triangles_[t].end(), p, copy);
      }
    }
  }

  const RectangleParams& params_;
  std::vector<Vec2d>& points_;
  std::vector<FlatTriangle>& triangles_;
  const TrianglesByPoint around_;
  const std::size_t original_count_ = points_.size();
  std::vector<int> original_of_copy_;
  std::vector<Edge> cut_;
};

ClothModel hungUp(const RectangleParams& params, const std::vector<Vec2d>& points,
                  const std::vector<FlatTriangle>& triangles)
{
  const auto uv = [&](int p)
  { return Vec2d(points[p].x() / params.width + 0.5, 1 + points[p].y() / params.height); };
  ClothModel model;
  model.positions.reserve(points.size());
  for (const Vec2d& point : points)
  {
    model.positions.emplace_back(point.x(), point.y(), 0.0);
  }
  model.triangles.reserve(triangles.size());
  for (const FlatTriangle& corners : triangles)
  {
    model.triangles.push_back({ corners, { uv(corners[0]), uv(corners[1]), uv(corners[2]) } });
  }
  return model;
}

}  // namespace

RectanglePattern rectanglePattern(const std::string& name)
{
  if (name == "one_diagonal")
  {
    return RectanglePattern::ONE_DIAGONAL;
  }
  if (name == "alternating")
  {
    return RectanglePattern::ALTERNATING;
  }
  if (name == "irregular")
  {
    return RectanglePattern::IRREGULAR;
  }
  throw std::invalid_argument("pattern is \"" + name +
                              "\", must be one_diagonal, alternating or irregular");
}

std::vector<std::string> problems(const RectangleParams& params)
{
  std::vector<std::string> found;
  check(found, "width", params.width, Range::between(MIN_SIZE, MAX_SIZE));
  check(found, "height", params.height, Range::between(MIN_SIZE, MAX_SIZE));
  check(found, "columns", params.columns,
        Range::between(2, static_cast<double>(MAX_PARTICLES) / 2));
  check(found, "rows", params.rows, Range::between(2, static_cast<double>(MAX_PARTICLES) / 2));
  const std::int64_t particles = std::int64_t{ params.columns } * params.rows;
  if (params.columns >= 2 && params.rows >= 2 && particles > MAX_PARTICLES)
  {
    found.push_back("columns x rows is " + std::to_string(particles) + ", must be at most " +
                    std::to_string(MAX_PARTICLES));
  }
  check(found, "grading", params.grading, Range::between(MIN_GRADING, MAX_GRADING));
  check(found, "jitter", params.jitter, Range::between(0, MAX_JITTER));
  for (std::size_t i = 0; i < params.slits.size(); ++i)
  {
    const std::string field = "slits[" + std::to_string(i) + "]";
    checkSlitEnd(field + ".start", params.slits[i].start, params, found);
    checkSlitEnd(field + ".end", params.slits[i].end, params, found);
  }
  return found;
}

ClothModel rectangle(const RectangleParams& params)
{
  const std::vector<std::string> found = problems(params);
  if (!found.empty())
  {
    throw std::invalid_argument("rectangle: " + joined(found));
  }
  std::vector<Vec2d> points = gridPoints(params);
  std::vector<FlatTriangle> triangles = gridTriangles(params);
  if (params.pattern == RectanglePattern::IRREGULAR)
  {
    Jitter(params, points, triangles).run();
  }
  Cutter(params, points, triangles).run();
  return hungUp(params, points, triangles);
}

}  // namespace cloth
