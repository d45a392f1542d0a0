// Welding by position and collapsing of edges without length.
#include "cloth_tearing/core/vertex_joiner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/triangle_soup.h"

namespace cloth
{
namespace
{

// A file needs one or two; one made to join an edge at a time would never end.
constexpr int MAX_COLLAPSE_ROUNDS = 100;

using Cell = std::array<double, 3>;  // whole numbers; doubles because they may be huge

struct CellHash
{
  std::size_t operator()(const Cell& cell) const
  {
    std::uint64_t hash = 0;
    for (const double index : cell)
    {
      hash = (hash ^ std::hash<double>()(index)) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
  }
};

// Kept vertices by cells twice as wide as the distance: one within reach lies in one of eight.
// Which of them is nearest does not depend on the order of the cells.
class Grid
{
public:
  Grid(const std::vector<Vec3d>& positions, double distance)
      : positions_(positions), distance_(distance)
  {
  }

  void add(int vertex) { cells_[cellOf(positions_[vertex])].push_back(vertex); }

  // The nearest kept vertex within reach, -1 if there is none.
  int nearest(const Vec3d& place) const
  {
    int found = -1;
    double least = distance_;
    for (int corner = 0; corner < 8; ++corner)
    {
      const Vec3d reach((corner & 1) != 0 ? distance_ : -distance_,
                        (corner & 2) != 0 ? distance_ : -distance_,
                        (corner & 4) != 0 ? distance_ : -distance_);
      const auto cell = cells_.find(cellOf(place + reach));
      if (cell == cells_.end())
      {
        continue;
      }
      for (const int vertex : cell->second)
      {
        const double away = (positions_[vertex] - place).norm();
        if (away < least || (away == least && (found < 0 || vertex < found)))
        {
          least = away;
          found = vertex;
        }
      }
    }
    return found;
  }

private:
  Cell cellOf(const Vec3d& place) const
  {
    const double width = 2 * distance_;
    return { std::floor(place.x() / width) + 0.0, std::floor(place.y() / width) + 0.0,
             std::floor(place.z() / width) + 0.0 };  // + 0.0 makes -0 a plain zero
  }

  const std::vector<Vec3d>& positions_;
  double distance_;
  std::unordered_map<Cell, std::vector<int>, CellHash> cells_;
};

}  // namespace

VertexSets::VertexSets(std::size_t count) : parent_(count)
{
  std::iota(parent_.begin(), parent_.end(), 0);
}

int VertexSets::lowest(int vertex) const
{
  while (parent_[vertex] != vertex)
  {
    parent_[vertex] = parent_[parent_[vertex]];
    vertex = parent_[vertex];
  }
  return vertex;
}

bool VertexSets::join(int a, int b)
{
  a = lowest(a);
  b = lowest(b);
  parent_[std::max(a, b)] = std::min(a, b);
  return a != b;
}

void weld(const std::vector<Vec3d>& positions, const std::vector<int>& lines, double distance,
          VertexSets& sets, ImportReport& report)
{
  Grid kept(positions, distance);
  for (int vertex = 0; vertex < static_cast<int>(positions.size()); ++vertex)
  {
    const int near = kept.nearest(positions[vertex]);
    if (near < 0)
    {
      kept.add(vertex);
      continue;
    }
    sets.join(near, vertex);
    const double away = (positions[near] - positions[vertex]).norm();
    reportFinding(report, report.welded_vertices, lines[vertex],
                  "vertex " + std::to_string(vertex + 1) + " is joined to vertex " +
                      std::to_string(near + 1) + ", " + text(away) + " m away");
  }
}

bool collapseShortEdges(const std::vector<Vec3d>& positions, const ObjContent& content,
                        double tolerance, VertexSets& sets, ImportReport& report)
{
  for (int round = 0; round < MAX_COLLAPSE_ROUNDS; ++round)
  {
    bool joined = false;
    for (const ObjFace& face : content.faces)
    {
      for (int i = 0; i < face.corner_count; ++i)
      {
        const int next = (i + 1) % face.corner_count;
        const int a = sets.lowest(content.corners[face.first_corner + i].vertex);
        const int b = sets.lowest(content.corners[face.first_corner + next].vertex);
        if (a != b && (positions[a] - positions[b]).norm() <= tolerance)
        {
          sets.join(a, b);
          joined = true;
          reportFinding(
              report, report.collapsed_edges, face.line,
              "the edge between " + vertexNames(a, b) + " has no length, its ends are joined");
        }
      }
    }
    if (!joined)
    {
      return true;
    }
  }
  return false;
}

}  // namespace cloth
