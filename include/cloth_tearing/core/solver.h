// How a step of time moves the cloth: one interface, two solvers.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cloth_tearing/core/particle_state.h"
#include "cloth_tearing/core/spring_table.h"
#include "cloth_tearing/core/worker_pool.h"

namespace cloth
{

enum class SolverKind
{
  XPBD,           ///< compliant constraints, one Gauss-Seidel sweep a step (Macklin et al. 2016)
  FORCE_SPRINGS,  ///< spring forces and symplectic Euler, as in the thesis (2.1.1, 3.1.2)
};

struct SolverParams
{
  SolverKind kind = SolverKind::XPBD;
  double time_step = 0.001;  ///< dt [s], > 0 and <= 0.02
  double max_strain = 0.10;  ///< limiter of the force springs [-], > 0; XPBD needs none (2.1.1)
  int max_substeps = 8;      ///< the force springs may cut a step into this many, 1..64

  /// XPBD alone: whether structural springs that lie in lines are solved together, each line as a
  /// whole. That keeps cloth as stiff as stated at steps two and a half times as long and more.
  bool lines = false;
};

std::vector<std::string> problems(const SolverParams& params);

/// How a solver keeps a step stable.
struct Stability
{
  int substeps = 1;
  int floored = 0;  ///< particles that it treats as heavier than they are, since substeps ran out
};

/// What a solver carries from step to step.
struct SolverMemory
{
  int substeps = 1;
  std::vector<Real> inverse_mass_limit;  ///< by particle [1/kg], > 0; empty where it has none
  std::vector<int> blocks;  ///< see SpringBlocks::toNumbers(); empty: as if it began now
  std::vector<int> lines;   ///< see SpringLines::toNumbers(); empty: none if there are blocks
};

/// Moves particles under springs and outer accelerations. Knows nothing of tearing: it is given
/// the springs anew each step.
class Solver
{
public:
  virtual ~Solver() = default;
  virtual std::unique_ptr<Solver> clone() const = 0;

  /// One symplectic step of `dt` [s] from state.previous, the positions at its start; particles
  /// of inverse mass 0 are where they are to end.
  virtual void advance(ParticleState& state, const SpringTable& springs,
                       const Vec3Array& acceleration, double dt) = 0;

  /// Draws overlong structural springs together, positions only (2.1.1, Provot 1995).
  /// Not every solver needs it.
  virtual void limitStrain(ParticleState& /*state*/, const SpringTable& /*springs*/) {}

  /// Takes over changes of the springs, so that what it carries fits them. To be told after tears;
  /// advance() would do it as well.
  virtual void follow(const SpringTable& /*springs*/, int /*particles*/) {}

  /// Shares its work among these threads from now on; none: does it alone. The bits are the same.
  void shareWork(std::shared_ptr<WorkerPool> workers) { workers_ = std::move(workers); }

  /// From now on advance() notes every structural spring that is stretched by more than `strain`
  /// [-] when the step begins, and may note others that are later in the step. It sees all lengths
  /// anyway: nobody else need measure them again.
  void watch(double strain) { watched_ = static_cast<Real>((1.0 + strain) * (1.0 + strain)); }

  /// What the last advance() noted: indices of springs, ascending.
  const std::vector<int>& stretched() const { return stretched_; }

  /// Sum of the spring forces on a particle of inverse mass 0 in the last advance() [N]: who holds
  /// it feels that.
  Vec3d heldForce(int particle) const { return held_scale_ * held_[particle].cast<double>(); }

  /// What the last advance() did to momentum beyond all forces [N s].
  virtual Vec3d addedImpulse() const { return Vec3d::Zero(); }

  /// How many springs the last limitStrain() drew together. What hangs on them pulls less on its
  /// holders than it weighs: the limiter moves positions, not velocities.
  virtual int limited() const { return 0; }

  /// What it takes to stay stable at a step of `dt` [s] in air that brakes by `air_rate` [1/s]; to
  /// be asked anew after each tear, which makes lighter particles. The solver keeps to the answer
  /// from then on. By default it is stable at any step.
  virtual Stability checkStability(const ParticleState& /*state*/, const SpringTable& /*springs*/,
                                   double /*dt*/, double /*air_rate*/)
  {
    return {};
  }

  /// What it carries from step to step, and the same back. By default nothing.
  virtual SolverMemory memory() const { return {}; }
  virtual void recall(const SolverMemory& /*memory*/) {}

  /// How much of the springs' stiffness a step of `dt` [s] cannot carry: (1/m_a + 1/m_b) k dt^2,
  /// which nine of ten structural springs do not exceed, so that a few slivers do not count. Well
  /// above 1 the cloth is softer than its stiffness says. By default 0: as stiff as stated.
  virtual double stiffnessNumber(const ParticleState& /*state*/, const SpringTable& /*springs*/,
                                 double /*dt*/) const
  {
    return 0.0;
  }

  /// (1/m_a + 1/m_b) k dt^2 as above where whole lines of springs are solved together, which keeps
  /// them as stiff as stated: then waves across the cloth limit the step. Half of it, times the
  /// strain under some tension, is the square of how many springs such a wave crosses in a step.
  /// By default 0: no lines.
  virtual double lineNumber(const ParticleState& /*state*/, const SpringTable& /*springs*/,
                            double /*dt*/) const
  {
    return 0.0;
  }

protected:
  /// Those that it shares its work among; none: nullptr.
  WorkerPool* workers() const { return workers_.get(); }

  Vec3Array held_;           ///< by particle, of those of inverse mass 0: see heldForce()
  double held_scale_ = 0.0;  ///< to [N]
  Real watched_ =
      std::numeric_limits<Real>::infinity();  ///< squared length over squared rest length
  std::vector<int> stretched_;

private:
  std::shared_ptr<WorkerPool> workers_;
};

std::unique_ptr<Solver> makeSolver(const SolverParams& params);

/// Owns a solver. A copy owns a clone.
class SolverHandle
{
public:
  explicit SolverHandle(const SolverParams& params) : solver_(makeSolver(params)) {}
  SolverHandle(const SolverHandle& other) : solver_(other.solver_->clone()) {}
  SolverHandle& operator=(const SolverHandle& other)
  {
    solver_ = other.solver_->clone();
    return *this;
  }
  SolverHandle(SolverHandle&&) = default;
  SolverHandle& operator=(SolverHandle&&) = default;
  ~SolverHandle() = default;

  const Solver& operator*() const { return *solver_; }
  Solver* operator->() { return solver_.get(); }
  const Solver* operator->() const { return solver_.get(); }

private:
  std::unique_ptr<Solver> solver_;
};

}  // namespace cloth
