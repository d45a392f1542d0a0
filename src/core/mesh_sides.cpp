// Sorts sides into edges and names elements.
#include "cloth_tearing/core/mesh_sides.h"

namespace cloth
{

std::string name(ParticleId p)
{
  return "particle " + std::to_string(p.index);
}
std::string name(SpringId s)
{
  return "spring " + std::to_string(s.index);
}
std::string name(TriangleId t)
{
  return "triangle " + std::to_string(t.index);
}

std::vector<Side> sortedSides(const std::vector<Triangle>& triangles)
{
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int from = triangles[t].particles[k].index;
      const int to = triangles[t].particles[(k + 1) % 3].index;
      sides.push_back(
          { std::min(from, to), std::max(from, to), static_cast<int>(t), k, from > to });
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

std::string edgeProblem(const Side* first, const Side* last)
{
  const std::string edge = "the edge between particles " + std::to_string(first->low) + " and " +
                           std::to_string(first->high);
  if (last - first > 2)
  {
    return edge + " has " + std::to_string(last - first) + " triangles, at most 2 can be joined";
  }
  if (last - first == 2 && first[0].reversed == first[1].reversed)
  {
    return edge + " joins triangles " + std::to_string(first[0].triangle) + " and " +
           std::to_string(first[1].triangle) + ", which are wound against each other";
  }
  return {};
}

}  // namespace cloth
