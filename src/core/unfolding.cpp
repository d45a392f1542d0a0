// Lays triangles beside their neighbours.
#include "cloth_tearing/core/unfolding.h"

#include <algorithm>

namespace cloth
{
namespace
{

std::array<Vec2d, 3> flatCorners(const RestShape& rest, const Triangle& t)
{
  const double side = rest.length[t.springs[0].index];
  return { Vec2d(0.0, 0.0), Vec2d(side, 0.0),
           apexOnPlane(side, rest.length[t.springs[2].index], rest.length[t.springs[1].index]) };
}

/// What turns `from` into the direction of `to`, which is as long.
Vec2d turnBetween(const Vec2d& from, const Vec2d& to)
{
  return turnedBy({ from.x(), -from.y() }, to) / from.squaredNorm();
}

}  // namespace

int Unfolding::indexOf(const Mesh& mesh, TriangleId t)
{
  indices_.resize(mesh.triangleCount(), -1);
  int& index = indices_[t.index];
  if (index < 0)
  {
    index = size();
    triangles_.push_back(t);
    flat_.emplace_back();
    laid_.push_back(0);
  }
  return index;
}

const FlatTriangle& Unfolding::at(const Mesh& mesh, const RestShape& rest, int index)
{
  if (!laid_[index])
  {
    lay(mesh, rest, index);
    laid_[index] = 1;
  }
  return flat_[index];
}

void Unfolding::lay(const Mesh& mesh, const RestShape& rest, int index)
{
  const TriangleId id = triangles_[index];
  const Triangle& t = mesh.triangle(id);
  FlatTriangle flat;
  flat.corners = flatCorners(rest, t);
  flat.center = (flat.corners[0] + flat.corners[1] + flat.corners[2]) / 3.0;
  flat.area = flat.corners[2].y() > 0.0 ? rest.area[id.index] : 0.0;
  for (int k = 0; k < 3; ++k)
  {
    flat.particles[k] = t.particles[k].index;
    const auto& sides = mesh.spring(t.springs[k]).triangles;
    const TriangleId other = sides[0] == id ? sides[1] : sides[0];
    if (other.valid())
    {
      // Its side runs the other way: both are wound alike.
      const std::array<Vec2d, 3> there = flatCorners(rest, mesh.triangle(other));
      const int side = mesh.triangle(other).sideOf(t.springs[k]);
      const Vec2d& begin = flat.corners[(k + 1) % 3];
      FlatTriangle::Across& across = flat.across[k];
      across.index = indexOf(mesh, other);
      across.turn = turnBetween(there[(side + 1) % 3] - there[side], flat.corners[k] - begin);
      across.shift = begin - turnedBy(across.turn, there[side]);
    }
  }
  flat_[index] = flat;
}

/// Neighbours of what was touched have it in its old plane.
void Unfolding::follow(const Mesh& mesh, const std::vector<TriangleId>& touched)
{
  for (TriangleId t : touched)
  {
    for (SpringId s : mesh.triangle(t).springs)
    {
      for (TriangleId side : mesh.spring(s).triangles)
      {
        if (side.valid())
        {
          forget(side);
        }
      }
    }
  }
}

void Unfolding::forget(TriangleId t)
{
  if (t.index < static_cast<int>(indices_.size()) && indices_[t.index] >= 0)
  {
    laid_[indices_[t.index]] = 0;
  }
}

void Unfolding::forget()
{
  std::fill(laid_.begin(), laid_.end(), 0);
}

}  // namespace cloth
