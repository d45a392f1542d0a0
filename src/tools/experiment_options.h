// What the command line of thesis_experiments asks for.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cloth_tearing/experiments/thesis_world.h"

namespace cloth
{

class UsageError : public std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// Empty lists: what the experiment does by itself.
struct Options
{
  std::string experiment;
  std::vector<int> resolutions;
  std::vector<RectanglePattern> meshes;
  std::vector<int> seeds;
  std::vector<double> time_steps;  ///< [s]
  std::optional<double> grading;   ///< else 1, or what the experiment is about
  SolverKind solver = SolverKind::XPBD;
  bool lines = false;  ///< see SolverParams
  std::string output;  ///< folder; empty = none

  /// Fills the empty lists, then every combination; meshes that have no seed come once.
  std::vector<Setting> settings(const std::vector<int>& default_resolutions,
                                const std::vector<RectanglePattern>& default_meshes,
                                const std::vector<int>& default_seeds) const;
};

/// @throws UsageError naming option, value and limit
Options parseOptions(const std::vector<std::string>& arguments);

const char* nameOf(RectanglePattern pattern);

/// Of the solver.
const char* solverName(SolverKind solver, bool lines);

/// Mesh, resolution and, where it matters, seed: to name a run or a file.
std::string clothName(const Setting& setting);

/// All that a run can be made with, so that no two runs share a file: clothName(), the seed of
/// every mesh, and whatever is not the default.
std::string fileName(const Setting& setting);

extern const std::vector<RectanglePattern> ALL_MESHES;

}  // namespace cloth
