// Spheres and floor push the cloth.
#pragma once

#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/material.h"
#include "cloth_tearing/core/obstacles.h"

namespace cloth
{

/// Moves the spheres for `dt` [s]: kinematic ones with their velocity, dynamic ones under gravity
/// and onto the floor. Streamed ones stand still once their time is up; thrown ones are removed
/// then, or when they leave the bounds.
void moveSpheres(std::vector<Sphere>& spheres, const ContactParams& params,
                 const Environment& environment, double dt);

/// Contact of triangles with spheres that move (4.1), and of particles with the floor.
///
/// The motion of both over the step is swept, so that a small or fast ball does not slip between
/// particles. Cloth that touches moves on no slower than the surface, with Coulomb friction; cloth
/// that was inside from the start is pushed out at push_speed at most.
class SphereContact
{
public:
  /// Corrects positions and velocities at the end of a step of `dt` [s], and the velocities of
  /// dynamic spheres.
  void resolve(Cloth& cloth, std::vector<Sphere>& spheres, const ContactParams& params, double dt);

  /// What spheres and floor did to the momentum of the cloth in the last resolve() [N s].
  const Vec3d& impulse() const { return impulse_; }

  /// Particles that the last resolve() may have moved, maybe more than once.
  const std::vector<int>& pushed() const { return pushed_; }

private:
  void findNear(const Cloth& cloth, const Sphere& sphere, const ContactParams& params);
  Vec3d resolveFloor(Cloth& cloth, const ContactParams& params, double dt);
  void resolveSphere(Cloth& cloth, Sphere& sphere, const ContactParams& params, double dt);

  Vec3d impulse_ = Vec3d::Zero();
  std::vector<TriangleId> near_;      ///< scratch: triangles that the sphere may touch in this step
  std::vector<unsigned char> sides_;  ///< scratch: of its box on which each particle stays
  std::vector<int> pushed_;
};

/// Whether `point` lies inside a sphere or below the floor.
bool isInsideObstacle(const Vec3& point, const std::vector<Sphere>& spheres,
                      const ContactParams& params);

}  // namespace cloth
