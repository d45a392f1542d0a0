// Lists triangles by tile, and keeps the lists up with tears.
#include "cloth_tearing/core/triangle_tiles.h"

#include <algorithm>

#include "cloth_tearing/core/sort_once.h"

namespace cloth
{
namespace
{

int homeOf(const Triangle& triangle)
{
  const auto& p = triangle.particles;
  return TriangleTiles::tileOf(std::min({ p[0].index, p[1].index, p[2].index }));
}

}  // namespace

void TriangleTiles::follow(const Mesh& mesh, const SpringTable& springs)
{
  if (seen_ == springs.changes.count() && made())
  {
    return;
  }
  if (made() && springs.changes.since(seen_, changed_))
  {
    followChanged(mesh);
  }
  else
  {
    followAll(mesh);
  }
  seen_ = springs.changes.count();
}

void TriangleTiles::followAll(const Mesh& mesh)
{
  first_.clear();
  next_.clear();
  home_.clear();
  reach_.clear();
  grow(mesh);
  for (int t = mesh.triangleCount() - 1; t >= 0; --t)
  {
    put(t, homeOf(mesh.triangle({ t })));
  }
  for (int tile = 0; tile < count(); ++tile)
  {
    findReach(mesh, tile);
  }
}

void TriangleTiles::followChanged(const Mesh& mesh)
{
  grow(mesh);
  tiles_.clear();
  for (int spring : changed_)
  {
    for (TriangleId t : mesh.spring({ spring }).triangles)
    {
      if (t.valid())
      {
        const int home = homeOf(mesh.triangle(t));
        tiles_.push_back(home);
        if (home_[t.index] != home)
        {
          take(t.index);
          put(t.index, home);
        }
      }
    }
  }
  sortOnce(tiles_);
  for (int tile : tiles_)
  {
    findReach(mesh, tile);
  }
}

/// Makes room for what tears have added.
void TriangleTiles::grow(const Mesh& mesh)
{
  first_.resize(tilesFor(mesh.particleCount()), -1);
  reach_.resize(first_.size());
  next_.resize(mesh.triangleCount(), -1);
  home_.resize(mesh.triangleCount(), -1);
}

/// Out of the list that it is in.
void TriangleTiles::take(int triangle)
{
  if (home_[triangle] < 0)
  {
    return;
  }
  tiles_.push_back(home_[triangle]);
  int* link = &first_[home_[triangle]];
  while (*link != triangle)
  {
    link = &next_[*link];
  }
  *link = next_[triangle];
}

void TriangleTiles::put(int triangle, int tile)
{
  int* link = &first_[tile];
  while (*link >= 0 && *link < triangle)
  {
    link = &next_[*link];
  }
  next_[triangle] = *link;
  *link = triangle;
  home_[triangle] = tile;
}

void TriangleTiles::findReach(const Mesh& mesh, int tile)
{
  std::vector<int>& reach = reach_[tile];
  reach.clear();
  forEach(tile,
          [&](TriangleId t)
          {
            for (ParticleId p : mesh.triangle(t).particles)
            {
              const int there = tileOf(p.index);
              if (std::find(reach.begin(), reach.end(), there) == reach.end())
              {
                reach.push_back(there);
              }
            }
          });
  std::sort(reach.begin(), reach.end());
}

}  // namespace cloth
