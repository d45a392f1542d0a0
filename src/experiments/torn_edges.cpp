// Finds torn edges and measures their directions.
#include "cloth_tearing/experiments/torn_edges.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace cloth
{
namespace
{

double checkedLength(const std::vector<TornEdge>& edges)
{
  const double length = lengthOf(edges);
  if (!(length > 0.0))
  {
    throw std::invalid_argument("there are no torn edges to measure");
  }
  return length;
}

}  // namespace

Vec2d materialPosition(const Triangle& triangle, int corner, const Vec2d& size)
{
  return triangle.uv[corner].cwiseProduct(size);
}

std::vector<TornEdge> tornEdges(const Cloth& cloth, const Vec2d& size)
{
  std::vector<TornEdge> edges;
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    const Spring& spring = cloth.mesh.spring({ i });
    if (spring.border() && !cloth.damage.outer[i])
    {
      const Triangle& triangle = cloth.mesh.triangle(spring.triangles[0]);
      const auto place = [&](ParticleId p)
      { return materialPosition(triangle, triangle.cornerOf(p), size); };
      edges.push_back({ place(spring.particles[0]), place(spring.particles[1]) });
    }
  }
  return edges;
}

double lengthOf(const std::vector<TornEdge>& edges)
{
  return std::accumulate(edges.begin(), edges.end(), 0.0,
                         [](double sum, const TornEdge& edge) { return sum + edge.length(); });
}

Vec2d middleOf(const std::vector<TornEdge>& edges)
{
  Vec2d sum = Vec2d::Zero();
  for (const TornEdge& edge : edges)
  {
    sum += edge.length() * 0.5 * (edge.start + edge.end);
  }
  return sum / checkedLength(edges);
}

double lineAngleTo(const std::vector<TornEdge>& edges, const Vec2d& axis)
{
  const Vec2d middle = middleOf(edges);
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (const TornEdge& edge : edges)
  {
    // Of a line from a to b the mean of x y is (a a + b b + (a + b)(a + b)) / 6.
    const Vec2d a = edge.start - middle;
    const Vec2d b = edge.end - middle;
    const Vec2d both = a + b;
    xx += edge.length() * (a.x() * a.x() + b.x() * b.x() + both.x() * both.x());
    xy += edge.length() * (a.x() * a.y() + b.x() * b.y() + both.x() * both.y());
    yy += edge.length() * (a.y() * a.y() + b.y() * b.y() + both.y() * both.y());
  }
  const double line = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const double cosine = std::abs(std::cos(line - std::atan2(axis.y(), axis.x())));
  return std::acos(std::min(1.0, cosine)) * 180.0 / M_PI;
}

double meanAngleTo(const std::vector<TornEdge>& edges, const Vec2d& axis)
{
  double sum = 0.0;
  for (const TornEdge& edge : edges)
  {
    const double cosine = std::abs((edge.end - edge.start).dot(axis)) / axis.norm();
    sum += edge.length() * std::acos(std::min(1.0, cosine / edge.length()));
  }
  return sum / checkedLength(edges) * 180.0 / M_PI;
}

}  // namespace cloth
