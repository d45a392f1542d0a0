// Solver: compliant distance constraints, one Gauss-Seidel sweep a step.
#pragma once

#include <vector>

#include "cloth_tearing/core/solver.h"

namespace cloth
{

/// XPBD (Macklin, Mueller, Chentanez 2016) with small steps (Macklin et al. 2019): compliance is
/// the inverse stiffness, the multipliers start at zero each step, damping acts inside the
/// constraint. Stable at any step, but one sweep reaches only so far: see stiffnessNumber. Needs no
/// strain limiter.
class XpbdSolver : public Solver
{
public:
  std::unique_ptr<Solver> clone() const override;
  void advance(ParticleState& state, const SpringTable& springs,
               const Vec3Array& acceleration, double dt) override;
  double stiffnessNumber(const ParticleState& state, const SpringTable& springs,
                         double dt) const override;

private:
  Vec3Array displacement_;  ///< by particle, scratch of a step [m]
};

}  // namespace cloth
