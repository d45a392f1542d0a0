// Which forces acted on the cloth in a step, and what they did to its momentum.
#pragma once

#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/solver.h"

namespace cloth
{

/// Forces on all cloth that is not at rest, in one step [N]. Momentum is that of the velocities:
/// grasp + pin + contact + limiter + weight + air = momentum_rate, but for rounding. What tears do
/// to momentum is not among it: they come after.
struct ForceBalance
{
  Vec3d grasp = Vec3d::Zero();    ///< of all grippers on the cloth
  Vec3d pin = Vec3d::Zero();      ///< of all pins on it
  Vec3d contact = Vec3d::Zero();  ///< of spheres and floor on it
  /// Of the solver itself. The limiter of the force springs moves positions only, which is no
  /// force: see Solver::limited(). Light slivers that the solver treats as heavier move on as if
  /// something carried that mass: this.
  Vec3d limiter = Vec3d::Zero();
  Vec3d weight = Vec3d::Zero();
  Vec3d air = Vec3d::Zero();            ///< friction of air, and wind
  Vec3d momentum_rate = Vec3d::Zero();  ///< change of momentum over the step's time
};

/// What a step knows of its forces, until the cloth changes.
struct StepForces
{
  const Cloth& cloth;
  const Solver& solver;
  const Vec3Array& acceleration;     ///< by gravity and air, by particle [m/s^2]
  const Vec3Array& velocity_before;  ///< when the step began, by particle [m/s]
  Vec3d gravity;                     ///< [m/s^2]
  Vec3d contact;                     ///< impulse of spheres and floor on the cloth [N s]
  double dt;                         ///< [s]

  /// What whoever holds the particle exerts on it [N].
  Vec3d byHolder(int particle) const;

  /// The particle that was there in the step: itself, or whose part it is since a tear after it.
  int origin(int particle) const;

  ForceBalance balance() const;
};

}  // namespace cloth
