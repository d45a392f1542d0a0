// Lawson's edge flips on a flat triangulation.
#include "cloth_tearing/core/delaunay.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace cloth
{
namespace
{

constexpr int NO_TRIANGLE = -1;

// Flips at almost equal angles would only swap rounding errors, without end.
constexpr double MIN_GAIN = 1e-12;  // sine of the angle by which two opposite angles exceed pi

// Lawson's flips end by themselves; a bound keeps rounding from ever making that a hope.
constexpr std::size_t MAX_FLIPS_PER_TRIANGLE = 200;

struct Side
{
  int triangle;
  int corner;  // the side runs from this corner to the next
};

class Flipper
{
public:
  Flipper(const std::vector<Vec2d>& points, std::vector<FlatTriangle>& triangles)
      : points_(points), triangles_(triangles), across_(triangles.size())
  {
    findNeighbours();
  }

  void run()
  {
    std::vector<Side> doubtful;
    for (int t = static_cast<int>(triangles_.size()) - 1; t >= 0; --t)
    {
      for (int k = 0; k < 3; ++k)
      {
        doubtful.push_back({ t, k });
      }
    }
    std::size_t flips_left = MAX_FLIPS_PER_TRIANGLE * triangles_.size();
    while (!doubtful.empty() && flips_left > 0)
    {
      const Side side = doubtful.back();
      doubtful.pop_back();
      if (isWorthFlipping(side))
      {
        flip(side, doubtful);
        --flips_left;
      }
    }
  }

private:
  const Vec2d& point(int triangle, int corner) const
  {
    return points_[triangles_[triangle][corner % 3]];
  }

  void findNeighbours()
  {
    struct Edge
    {
      int low, high;
      Side side;
    };
    std::vector<Edge> edges;
    edges.reserve(3 * triangles_.size());
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t)
    {
      for (int k = 0; k < 3; ++k)
      {
        const auto ends = std::minmax(triangles_[t][k], triangles_[t][(k + 1) % 3]);
        edges.push_back({ ends.first, ends.second, { t, k } });
        across_[t][k] = { NO_TRIANGLE, 0 };
      }
    }
    std::sort(edges.begin(), edges.end(),
              [](const Edge& a, const Edge& b) {
                return std::tie(a.low, a.high, a.side.triangle) <
                       std::tie(b.low, b.high, b.side.triangle);
              });
    for (std::size_t i = 1; i < edges.size(); ++i)
    {
      if (edges[i].low == edges[i - 1].low && edges[i].high == edges[i - 1].high)
      {
        join(edges[i].side, edges[i - 1].side);
      }
    }
  }

  void join(const Side& a, const Side& b)
  {
    across_[a.triangle][a.corner] = b;
    if (b.triangle != NO_TRIANGLE)
    {
      across_[b.triangle][b.corner] = a;
    }
  }

  // The angles opposite an edge that is not Delaunay add up to more than pi.
  bool isWorthFlipping(const Side& side) const
  {
    const Side other = across_[side.triangle][side.corner];
    if (other.triangle == NO_TRIANGLE)
    {
      return false;
    }
    const Vec2d& a = point(side.triangle, side.corner);
    const Vec2d& b = point(side.triangle, side.corner + 1);
    const Vec2d& near = point(side.triangle, side.corner + 2);
    const Vec2d& far = point(other.triangle, other.corner + 2);
    const double sin_near = signedArea2(near, a, b);
    const double sin_far = signedArea2(far, b, a);
    const double cos_near = (a - near).dot(b - near);
    const double cos_far = (a - far).dot(b - far);
    const double scale = std::sqrt((a - near).squaredNorm() * (b - near).squaredNorm()) *
                         std::sqrt((a - far).squaredNorm() * (b - far).squaredNorm());
    const double sin_of_sum = sin_near * cos_far + cos_near * sin_far;
    if (!(sin_of_sum < -MIN_GAIN * scale))
    {
      return false;
    }
    // Rounding must not make a triangle turn over.
    return std::min(signedArea2(near, a, far), signedArea2(near, far, b)) >
           MIN_GAIN * (sin_near + sin_far);
  }

  // (a, b, near) and (b, a, far) become (near, a, far) and (near, far, b).
  void flip(const Side& side, std::vector<Side>& doubtful)
  {
    const int t = side.triangle;
    const int k = side.corner;
    const int u = across_[t][k].triangle;
    const int j = across_[t][k].corner;
    const int a = triangles_[t][k];
    const int b = triangles_[t][(k + 1) % 3];
    const int near = triangles_[t][(k + 2) % 3];
    const int far = triangles_[u][(j + 2) % 3];
    const Side beyond_b_near = across_[t][(k + 1) % 3];
    const Side beyond_near_a = across_[t][(k + 2) % 3];
    const Side beyond_a_far = across_[u][(j + 1) % 3];
    const Side beyond_far_b = across_[u][(j + 2) % 3];

    triangles_[t] = { near, a, far };
    triangles_[u] = { near, far, b };
    join({ t, 0 }, beyond_near_a);
    join({ t, 1 }, beyond_a_far);
    join({ t, 2 }, { u, 0 });
    join({ u, 1 }, beyond_far_b);
    join({ u, 2 }, beyond_b_near);
    for (const Side& outer : { Side{ t, 0 }, Side{ t, 1 }, Side{ u, 1 }, Side{ u, 2 } })
    {
      doubtful.push_back(outer);
    }
  }

  const std::vector<Vec2d>& points_;
  std::vector<FlatTriangle>& triangles_;
  std::vector<std::array<Side, 3>> across_;
};

}  // namespace

double signedArea2(const Vec2d& a, const Vec2d& b, const Vec2d& c)
{
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

void flipToDelaunay(const std::vector<Vec2d>& points, std::vector<FlatTriangle>& triangles)
{
  Flipper(points, triangles).run();
}

}  // namespace cloth
