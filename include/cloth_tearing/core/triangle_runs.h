// Triangles whose corners are neighbours in memory, and the others.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "cloth_tearing/core/kernels.h"
#include "cloth_tearing/core/mesh.h"
#include "cloth_tearing/core/rest_shape.h"
#include "cloth_tearing/core/spring_table.h"

namespace cloth
{

/// Triangles that lie side by side, in runs of lanes, for loops over many at a time.
///
/// What lies where depends on the untorn mesh and the torn one alone, not on the tears between
/// them: a restored cloth has the same runs, and the same bits.
class TriangleRuns
{
public:
  TriangleRuns() = default;
  explicit TriangleRuns(const Mesh& untorn);

  bool made() const { return !lanes_.empty(); }

  /// Brings runs up to the cloth of now: a triangle that has got other corners leaves its run.
  /// Costs what `springs` says was changed since the last time.
  void follow(const Mesh& mesh, const RestShape& rest, const SpringTable& springs);

  const std::vector<kernels::TriangleRun>& runs() const { return runs_; }
  const std::vector<kernels::Areas>& areas() const { return areas_; }

  /// Those that lie in no run, ascending.
  const std::vector<int>& loose() const { return loose_; }

private:
  static constexpr std::uint64_t NEVER = std::numeric_limits<std::uint64_t>::max();

  void followAll(const Mesh& mesh, const RestShape& rest);
  void follow(const Mesh& mesh, const RestShape& rest, int triangle);
  bool fits(const Triangle& triangle, int lane) const;

  std::vector<kernels::TriangleRun> runs_;
  std::vector<kernels::Areas> areas_;  ///< of each run [m^2]; 0: no triangle
  std::vector<int> lanes_;             ///< by triangle: LANES times its run, and its lane; -1: none
  std::vector<int> loose_;
  std::uint64_t seen_ = NEVER;  ///< changes of the springs that were followed
  std::vector<int> changed_;    ///< springs, scratch
};

}  // namespace cloth
