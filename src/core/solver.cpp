// Chooses a solver.
#include "cloth_tearing/core/solver.h"

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/force_springs.h"
#include "cloth_tearing/core/xpbd.h"

namespace cloth
{

std::vector<std::string> problems(const SolverParams& params)
{
  std::vector<std::string> found;
  check(found, "time_step [s]", params.time_step, Range::between(1e-5, 0.02));
  check(found, "max_strain [-]", params.max_strain, Range::between(1e-3, 10.0));
  check(found, "max_substeps", params.max_substeps, Range::between(1, 64));
  if (params.lines && params.kind != SolverKind::XPBD)
  {
    found.emplace_back(
        "lines is true, must be false with the force springs: only XPBD solves lines");
  }
  return found;
}

std::unique_ptr<Solver> makeSolver(const SolverParams& params)
{
  if (params.kind == SolverKind::FORCE_SPRINGS)
  {
    return std::make_unique<ForceSprings>(params);
  }
  return std::make_unique<XpbdSolver>(params.lines);
}

}  // namespace cloth
