// The snapshot that leaves the core.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/grasp.h"
#include "cloth_tearing/core/obstacles.h"
#include "cloth_tearing/core/types.h"

namespace cloth
{

/// A face of the surface; indices into Surface::position.
struct SurfaceTriangle
{
  std::array<int, 3> particles;  ///< counter-clockwise from the front
  std::array<Vec2d, 3> uv;       ///< texture position of each corner [-]
};

/// A structural spring of the surface; indices into Surface::position.
struct SurfaceSpring
{
  std::array<int, 2> particles;
  Real strain;  ///< [-]; below 0 it is slack
};

struct HeldParticle
{
  int particle;
  std::uint64_t grasp;  ///< grasp id; 0 = pinned
};

/// The cloth as it is, for drawing and measuring. Pieces put to rest have no triangles and springs
/// here, but keep their particles, so that indices are particle ids. Nor is a triangle here that
/// lost two of its springs.
struct Surface
{
  double time = 0.0;  ///< [s]
  std::uint64_t step = 0;
  std::uint32_t epoch = 0;
  std::uint64_t revision = 0;  ///< tears so far; topology is unchanged while it is
  std::vector<Vec3> position;  ///< [m], cloth frame
  std::vector<Vec3> normal;    ///< unit, the area-weighted mean of the triangles around
  std::vector<Real> strain;    ///< largest of the springs at each particle [-]
  std::vector<std::array<int, 2>>
      parents;  ///< of each particle; itself twice if it was there first
  std::vector<SurfaceTriangle> triangles;
  std::vector<SurfaceSpring> springs;  ///< those that carry load: released ones are left out
  std::vector<std::array<int, 2>> torn_edges;  ///< ends of each edge that a tear opened
  std::vector<int> weak_points;
  std::vector<HeldParticle> held;
};

/// All but time, step and epoch, which the cloth does not know.
Surface makeSurface(const Cloth& cloth);

/// Everything that is drawn.
struct Snapshot
{
  Surface surface;
  std::vector<Sphere> spheres;
  std::vector<Grasp> grasps;
};

}  // namespace cloth
