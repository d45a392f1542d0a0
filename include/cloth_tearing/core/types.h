// The words of the core: numbers, vectors and typed indices.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#ifdef __FAST_MATH__
#error "cloth_tearing promises the same bits for the same inputs: build it without -ffast-math"
#endif

namespace cloth
{

/// What the step streams through. Lengths, areas, masses, texture and time are double.
using Real = float;

using Vec3 = Eigen::Matrix<Real, 3, 1>;

// Unaligned on purpose: these cross library borders, where alignment would depend on the
// instruction set that each side was compiled for.
using Vec2d = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;
using Vec3d = Eigen::Matrix<double, 3, 1>;
using Quatd = Eigen::Quaternion<double, Eigen::DontAlign>;

/// Index of one kind of element, typed so that a spring cannot be passed for a particle.
/// Stable for the life of the mesh: edits append and repoint, they never renumber or delete.
template <class Tag>
struct Id
{
  int index = -1;  ///< -1 means "none"

  bool valid() const { return index >= 0; }
  friend bool operator==(Id a, Id b) { return a.index == b.index; }
  friend bool operator!=(Id a, Id b) { return a.index != b.index; }
  friend bool operator<(Id a, Id b) { return a.index < b.index; }
};

using ParticleId = Id<struct ParticleTag>;
using SpringId = Id<struct SpringTag>;
using TriangleId = Id<struct TriangleTag>;

/// A rigid placement: x -> position + rotation * x.
struct Pose
{
  Vec3d position = Vec3d::Zero();      ///< [m]
  Quatd rotation = Quatd::Identity();  ///< unit quaternion

  Vec3d apply(const Vec3d& x) const { return position + rotation * x; }
  Vec3d applyInverse(const Vec3d& x) const { return rotation.conjugate() * (x - position); }
};

}  // namespace cloth
