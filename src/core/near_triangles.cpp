// Boxes round tiles of particles, then round triangles, against a sphere's.
#include "cloth_tearing/core/near_triangles.h"

#include <algorithm>

#include "cloth_tearing/core/spring_lanes.h"

namespace cloth
{
namespace
{

/// Sides of the sphere's box, and directions from its centre, in what kernels say of a particle.
constexpr unsigned BOX = 0x3f;

/// What is kept for a sphere that gives way, as a fraction of its reach: so far it may go.
constexpr Real SPARE = Real(0.01);

/// Tiles that are looked at in one go.
constexpr int TILES = 64;

constexpr int BITS = 64;  ///< of a word

/// From where to where particles have gone, by axis.
struct Way
{
  const float* start[3];
  const float* position[3];
};

/// Of those from `tile` on.
Way wayOf(const ParticleState& state, int tile)
{
  Way way{};
  for (int k = 0; k < 3; ++k)
  {
    way.start[k] = state.previous.axis(k) + tile * kernels::TILE;
    way.position[k] = state.position.axis(k) + tile * kernels::TILE;
  }
  return way;
}

}  // namespace

void NearTriangles::find(const Cloth& cloth, const Vec3& start, const Vec3& end, Real reach,
                         WorkerPool* workers)
{
  tiles_.follow(cloth.mesh, cloth.springs);
  for (int k = 0; k < 3; ++k)
  {
    ball_.low[k] = std::min(start[k], end[k]) - reach;
    ball_.high[k] = std::max(start[k], end[k]) + reach;
    ball_.start[k] = start[k];
    ball_.end[k] = end[k];
  }
  ball_.reach = (1 + 2 * SPARE) * reach;
  holds_ = true;
  lookAtTiles(cloth.state, workers);
  all_.clear();
  for (int tile = 0; tile < tiles_.count(); ++tile)
  {
    if (mayBeNear(tile))
    {
      lookAtTriangles(cloth, tile);
    }
  }
  collect();
}

void NearTriangles::lookAtTiles(const ParticleState& state, WorkerPool* workers)
{
  const int count = tiles_.count();
  tile_sides_.resize(count);
  looked_at_.assign(count, 0);
  sides_.resize(static_cast<std::size_t>(count) * kernels::TILE);
  shareStretches(
      workers, count,
      [&](int begin, int end)
      {
        const Way way = wayOf(state, begin);
        kernels::best().tile_sides(way.start, way.position, ball_, tile_sides_.data() + begin,
                                   end - begin);
      },
      TILES);
}

/// Whether there is no side beyond which all particles of the tile's triangles are.
bool NearTriangles::mayBeNear(int tile) const
{
  unsigned beyond = tile_sides_[tile];
  for (int there : tiles_.reach(tile))
  {
    beyond &= tile_sides_[there];
  }
  return beyond == 0;
}

void NearTriangles::lookAtTriangles(const Cloth& cloth, int tile)
{
  for (int there : tiles_.reach(tile))
  {
    lookAtParticles(cloth.state, there);
  }
  found_.resize((cloth.mesh.triangleCount() + BITS - 1) / BITS);
  tiles_.forEach(tile,
                 [&](TriangleId t)
                 {
                   const auto& p = cloth.mesh.triangle(t).particles;
                   const unsigned beyond =
                       sides_[p[0].index] & sides_[p[1].index] & sides_[p[2].index];
                   if ((beyond & BOX) == 0 && !cloth.damage.at_rest[p[0].index])
                   {
                     found_[t.index / BITS] |= bitOf(t.index % BITS);
                   }
                 });
}

void NearTriangles::lookAtParticles(const ParticleState& state, int tile)
{
  if (looked_at_[tile])
  {
    return;
  }
  looked_at_[tile] = 1;
  const Way way = wayOf(state, tile);
  kernels::best().particle_sides(way.start, way.position, ball_,
                                 sides_.data() + static_cast<std::size_t>(tile) * kernels::TILE);
}

/// Brings what was found into order: which tile it came from is all the same.
void NearTriangles::collect()
{
  for (std::size_t word = 0; word < found_.size(); ++word)
  {
    for (std::uint64_t bits = found_[word]; bits != 0; bits &= bits - 1)
    {
      all_.push_back({ static_cast<int>(word) * BITS + lowestBit(bits) });
    }
    found_[word] = 0;
  }
}

void NearTriangles::moved(const Vec3& end)
{
  const Vec3 before(ball_.end[0], ball_.end[1], ball_.end[2]);
  const Real spare = SPARE * ball_.reach / (1 + 2 * SPARE);
  holds_ = holds_ && (end - before).squaredNorm() <= spare * spare;
}

void NearTriangles::follow(const Cloth& cloth)
{
  if (tiles_.made())
  {
    tiles_.follow(cloth.mesh, cloth.springs);
  }
}

}  // namespace cloth
