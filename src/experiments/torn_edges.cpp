// Finds torn edges and measures their directions.
#include "cloth_tearing/experiments/torn_edges.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace cloth
{

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

double meanAngleTo(const std::vector<TornEdge>& edges, const Vec2d& axis)
{
  double sum = 0.0;
  double length = 0.0;
  for (const TornEdge& edge : edges)
  {
    const double cosine = std::abs((edge.end - edge.start).dot(axis)) / axis.norm();
    sum += edge.length() * std::acos(std::min(1.0, cosine / edge.length()));
    length += edge.length();
  }
  if (!(length > 0.0))
  {
    throw std::invalid_argument("there are no torn edges to measure");
  }
  return sum / length * 180.0 / M_PI;
}

}  // namespace cloth
