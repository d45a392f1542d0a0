// Solver: compliant distance constraints, one Gauss-Seidel sweep a step.
#pragma once

#include <vector>

#include "cloth_tearing/core/solver.h"
#include "cloth_tearing/core/spring_blocks.h"

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
  void advance(ParticleState& state, const SpringTable& springs, const Vec3Array& acceleration,
               double dt) override;
  void follow(const SpringTable& springs, int particles) override;
  SolverMemory memory() const override;
  void recall(const SolverMemory& memory) override;
  double stiffnessNumber(const ParticleState& state, const SpringTable& springs,
                         double dt) const override;

private:
  /// What solving a group takes beside the particles.
  struct Scratch
  {
    std::vector<kernels::Record> way;
    std::vector<kernels::Record> start;
    std::vector<kernels::Note> run_notes;
    std::vector<kernels::Note> loose_notes;
  };

  struct Range
  {
    int begin;
    int end;
  };

  Range stretch(int group, int particles) const;
  void predict(const ParticleState& state, const Vec3Array& acceleration, Range range, float dt);
  void finish(ParticleState& state, Range range, float dt) const;
  bool arranged() const { return !blocks_.groups().empty(); }
  void arrange(const SpringTable& springs, int particles);
  void solve(const SpringGroup& group, Scratch& scratch, const kernels::Particles& particles,
             float dt);
  void note(const std::vector<kernels::Note>& notes, const std::vector<Links>& links);

  SpringBlocks blocks_;
  std::uint64_t seen_ = 0;        ///< changes of the springs that blocks_ has followed
  std::vector<int> recalled_;     ///< what blocks_ are to be made from; empty: from the springs
  std::vector<int> changed_;      ///< springs, scratch
  std::vector<Scratch> scratch_;  ///< by group
  Vec3Array way_;                 ///< of each particle since the step began [m]
};

}  // namespace cloth
