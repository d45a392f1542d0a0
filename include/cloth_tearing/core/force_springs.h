// Solver: spring forces, as in the thesis.
#pragma once

#include <vector>

#include "cloth_tearing/core/block_solver.h"

namespace cloth
{

/// Damped springs, symplectic Euler and a limiter of positions (2.1.1, 3.1.2). Cuts the step into
/// substeps where the stiffest particle asks for it; where these run out, slivers of a tear are
/// treated as heavier than they are (their true mass is still what is reported).
class ForceSprings : public BlockSolver
{
public:
  explicit ForceSprings(const SolverParams& params);

  std::unique_ptr<Solver> clone() const override;
  void advance(ParticleState& state, const SpringTable& springs, const Vec3Array& acceleration,
               double dt) override;
  void limitStrain(ParticleState& state, const SpringTable& springs) override;
  Vec3d addedImpulse() const override { return added_impulse_; }
  int limited() const override { return limited_; }
  Stability checkStability(const ParticleState& state, const SpringTable& springs, double dt,
                           double air_rate) override;
  SolverMemory memory() const override;
  void recall(const SolverMemory& memory) override;

private:
  static void pull(const SpringGroup& group, Scratch& scratch, const kernels::Bodies& bodies);
  void addForces(const ParticleState& state);
  void integrate(ParticleState& state, const Vec3Array& acceleration, Range range, Real dt);
  void addImpulse(const ParticleState& state, Real dt);
  void sumStiffness(const ParticleState& state, const SpringTable& springs);

  SolverParams params_;
  int substeps_ = 1;
  int limited_ = 0;                       ///< springs that limitStrain() drew together
  Vec3d added_impulse_ = Vec3d::Zero();   ///< on slivers treated as heavier than they are [N s]
  Vec3Array force_;                       ///< by particle [N]
  std::vector<Real> inverse_mass_limit_;  ///< by particle [1/kg]: lighter ones are treated as this
  std::vector<double> stiffness_sum_;     ///< by particle, scratch of checkStability [N/m]
  std::vector<double> damping_sum_;       ///< the same [N s/m]
};

}  // namespace cloth
