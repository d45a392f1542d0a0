// The snapshot that leaves the core.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
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
  double rest_length;  ///< [m]
};

struct HeldParticle
{
  int particle;
  std::uint64_t grasp;  ///< grasp id; 0 = pinned
};

/// What of the cloth is drawn, and how it hangs together: all that only tears change, and pieces
/// that are put to rest. These have no triangles and springs here, but keep their particles, so
/// that indices are particle ids. Nor is a triangle here that lost two of its springs.
struct SurfaceTopology
{
  std::uint64_t revision = 0;  ///< tears so far
  std::vector<std::array<int, 2>>
      parents;  ///< of each particle; itself twice if it was there first
  std::vector<SurfaceTriangle> triangles;
  std::vector<SurfaceSpring> springs;  ///< those that carry load: released ones are left out
  std::vector<std::array<int, 2>> torn_edges;  ///< ends of each edge that a tear opened
  std::vector<int> weak_points;
};

/// The cloth as it is, for drawing and measuring.
struct Surface
{
  double time = 0.0;  ///< [s]
  std::uint64_t step = 0;
  std::uint32_t epoch = 0;
  std::vector<Vec3> position;  ///< [m], cloth frame
  std::vector<HeldParticle> held;

  /// Never null. Surfaces that share it have the same: what is made of it can be kept with it.
  std::shared_ptr<const SurfaceTopology> topology = std::make_shared<const SurfaceTopology>();
};

SurfaceTopology makeTopology(const Cloth& cloth);

/// Writes over `surface` what moves: positions, and what is held.
void takeMotion(const Cloth& cloth, Surface& surface);

/// All but time, step and epoch, which the cloth does not know.
Surface makeSurface(const Cloth& cloth);

// What follows is of those who need it to ask for. It is written over `result`, whose memory is
// used again.

/// Of each particle: unit, the area-weighted mean of the triangles around; z if there are none.
void findNormals(const Surface& surface, std::vector<Vec3>& result);

/// Of each spring [-]; below 0 it is slack.
void findSpringStrains(const Surface& surface, std::vector<Real>& result);

/// Of each particle: the largest of the springs there, 0 if all are slack [-].
void findParticleStrains(const Surface& surface, std::vector<Real>& result);

/// Everything that is drawn.
struct Snapshot
{
  Surface surface;
  std::vector<Sphere> spheres;
  std::vector<Grasp> grasps;
};

}  // namespace cloth
