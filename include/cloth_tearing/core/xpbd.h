// Solver: compliant distance constraints, one Gauss-Seidel sweep a step.
#pragma once

#include "cloth_tearing/core/block_solver.h"

namespace cloth
{

/// XPBD (Macklin, Mueller, Chentanez 2016) with small steps (Macklin et al. 2019): compliance is
/// the inverse stiffness, the multipliers start at zero each step, damping acts inside the
/// constraint. Stable at any step, but one sweep reaches only so far: see stiffnessNumber. Whole
/// lines of springs that are solved at once reach from end to end: see SpringLines. Needs no strain
/// limiter.
class XpbdSolver : public BlockSolver
{
public:
  /// @param in_lines whether lines of structural springs are solved as wholes
  explicit XpbdSolver(bool in_lines) : BlockSolver(in_lines) {}

  std::unique_ptr<Solver> clone() const override;
  void advance(ParticleState& state, const SpringTable& springs, const Vec3Array& acceleration,
               double dt) override;
  double stiffnessNumber(const ParticleState& state, const SpringTable& springs,
                         double dt) const override;
  double lineNumber(const ParticleState& state, const SpringTable& springs,
                    double dt) const override;

private:
  void predict(const ParticleState& state, const Vec3Array& acceleration, Range range, float dt);
  void finish(ParticleState& state, Range range, float dt) const;
  static void solve(const SpringGroup& group, Scratch& scratch, const kernels::Particles& particles,
                    float dt);
  void solve(const SpringLadder& ladder, Notes& notes, const kernels::Particles& particles,
             float dt) const;

  Vec3Array way_;  ///< of each particle since the step began [m]
};

}  // namespace cloth
