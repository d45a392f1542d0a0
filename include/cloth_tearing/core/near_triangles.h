// Triangles that a sphere may touch in a step.
#pragma once

#include <cstdint>
#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/kernels.h"
#include "cloth_tearing/core/triangle_tiles.h"
#include "cloth_tearing/core/worker_pool.h"

namespace cloth
{

/// Looks tile by tile, then triangle by triangle: cloth far from a sphere costs next to nothing.
class NearTriangles
{
public:
  /// Finds those whose swept box overlaps the sphere's: not all three corners stay beyond the same
  /// side. Pieces at rest have none.
  /// @param start of the sphere's centre [m]; so is `end`
  /// @param reach that cloth is kept away from it [m]
  void find(const Cloth& cloth, const Vec3& start, const Vec3& end, Real reach,
            WorkerPool* workers);

  /// What find() found, ascending.
  const std::vector<TriangleId>& all() const { return all_; }

  /// Whether one of them may come closer to the sphere than its reach; false if it does not, with
  /// some to spare.
  bool mayTouch(const Triangle& triangle) const
  {
    const auto& p = triangle.particles;
    return !holds_ || (sides_[p[0].index] & sides_[p[1].index] & sides_[p[2].index]) == 0;
  }

  /// A particle was pushed: nobody knows where it is now.
  void forget(int particle) { sides_[particle] = 0; }

  /// The sphere gave way and ends at `end` [m].
  void moved(const Vec3& end);

  /// Takes over what a tear has changed, if it has ever looked.
  void follow(const Cloth& cloth);

private:
  void lookAtTiles(const ParticleState& state, WorkerPool* workers);
  bool mayBeNear(int tile) const;
  void lookAtTriangles(const Cloth& cloth, int tile);
  void lookAtParticles(const ParticleState& state, int tile);
  void collect();

  TriangleTiles tiles_;
  kernels::Ball ball_{};
  bool holds_ = false;                     ///< the sphere is still about where `ball_` is
  std::vector<unsigned char> tile_sides_;  ///< see kernels::Set, by tile
  std::vector<unsigned> sides_;            ///< the same by particle, in tiles that were looked at
  std::vector<char> looked_at_;            ///< by tile
  std::vector<std::uint64_t> found_;       ///< a bit for each triangle
  std::vector<TriangleId> all_;
};

}  // namespace cloth
