// Spheres and floor push the cloth.
#pragma once

#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/material.h"
#include "cloth_tearing/core/near_triangles.h"
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
  /// @param workers share the looking for what is near; nullptr: nobody does
  void resolve(Cloth& cloth, std::vector<Sphere>& spheres, const ContactParams& params, double dt,
               WorkerPool* workers = nullptr);

  /// Takes over what a tear has changed. To be told after each step; resolve() would find it out at
  /// greater cost.
  void follow(const Cloth& cloth) { near_.follow(cloth); }

  /// Another cloth comes next.
  void startOver() { near_ = NearTriangles(); }

  /// What spheres and floor did to the momentum of the cloth in the last resolve() [N s].
  const Vec3d& impulse() const { return impulse_; }

  /// Particles that the last resolve() may have moved, each once.
  const std::vector<int>& pushed() const { return pushed_; }

private:
  void resolveSphere(Cloth& cloth, Sphere& sphere, const ContactParams& params, double dt,
                     WorkerPool* workers);
  template <class Part>
  auto partAll(const Mesh& mesh, const Sphere& sphere, const Part& part);
  Vec3d resolveFloor(Cloth& cloth, const ContactParams& params, double dt, WorkerPool* workers);
  void landTiles(ParticleState& state, const kernels::Floor& floor, int begin, int end,
                 const Real* inverse_mass);
  Vec3d impulseOfFloor(const ParticleState& state);
  void notePushed(int particle);

  Vec3d impulse_ = Vec3d::Zero();
  NearTriangles near_;
  std::vector<int> pushed_;
  std::vector<char> is_pushed_;   ///< by particle
  Vec3Array change_;              ///< of velocities by the floor, by particle, scratch [m/s]
  std::vector<unsigned> landed_;  ///< by tile: a bit for each particle on the floor, scratch
};

/// Whether `point` lies inside a sphere or below the floor.
bool isInsideObstacle(const Vec3& point, const std::vector<Sphere>& spheres,
                      const ContactParams& params);

}  // namespace cloth
