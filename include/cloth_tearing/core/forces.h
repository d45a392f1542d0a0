// Outer accelerations: gravity, air friction, wind.
#pragma once

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/material.h"
#include "cloth_tearing/core/triangle_runs.h"
#include "cloth_tearing/core/worker_pool.h"

namespace cloth
{

/// What acts on a cloth from outside but for obstacles, and what it takes to sum that up.
class OuterForces
{
public:
  /// Writes the acceleration of every particle [m/s^2] (2.1.1). Wind presses on each triangle along
  /// its normal, in proportion to its area (its rest area at most) and to the normal speed of the
  /// air against it (Provot 1995). Held particles get it too: it does not move them, but whoever
  /// holds them feels it.
  /// @param untorn what the cloth was torn from, the same each time until startOver()
  /// @param workers share the work; nullptr: nobody does
  void accelerate(const Cloth& cloth, const Mesh& untorn, const Environment& environment,
                  Vec3Array& acceleration, WorkerPool* workers = nullptr);

  /// Takes over what a tear has changed. To be told after each step; accelerate() would find it out
  /// at greater cost.
  void follow(const Cloth& cloth);

  /// Another cloth comes next.
  void startOver() { *this = OuterForces(); }

private:
  void blow(const Cloth& cloth, const Environment& environment, WorkerPool* workers);
  void blowOn(int group, const Cloth& cloth, const kernels::Air& air);
  void addWind(const Cloth& cloth, Vec3Array& acceleration, int begin, int end) const;

  TriangleRuns triangles_;
  Vec3Array force_;  ///< of the wind, by particle [N]
};

}  // namespace cloth
