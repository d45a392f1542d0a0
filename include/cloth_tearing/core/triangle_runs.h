// Triangles whose corners are neighbours in memory, and the others.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "cloth_tearing/core/kernels.h"
#include "cloth_tearing/core/mesh.h"
#include "cloth_tearing/core/rest_shape.h"
#include "cloth_tearing/core/spring_table.h"

namespace cloth
{

/// Triangles that one thread goes through at a time: runs, and loose ones that lie in none.
struct TriangleGroup
{
  int first_run = 0;
  int end_run = 0;
  int low = 0;                              ///< first of the particles of loose ones
  std::vector<int> loose;                   ///< ascending
  std::vector<kernels::TriangleEnds> ends;  ///< of the loose ones, counted from `low`
  std::vector<kernels::Areas> areas;        ///< of the loose ones [m^2]
  bool stale = true;                        ///< `loose` has changed since `ends` were written
};

/// Triangles that lie side by side, in runs of lanes, for loops over many at a time.
///
/// Groups touch particles of two stretches of memory, the group's own and the next: of the first
/// phase no two touch the same one, nor of the second. The last group, which is all of the third,
/// has those that reach further.
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

  /// Writes `ends` and `areas` of a group's loose triangles if they changed. May be called for
  /// several groups at a time.
  void arrange(int group, const Mesh& mesh, const RestShape& rest);

  const std::vector<TriangleGroup>& groups() const { return groups_; }

  /// Groups phases()[i] to phases()[i + 1] - 1 are phase i.
  const std::array<int, 4>& phases() const { return phases_; }

  /// The particles that a group of the first phase touches, and that none of its phase does beside
  /// it: together they are all of `particles`.
  std::array<int, 2> own(int group, int particles) const;

  const std::vector<kernels::TriangleRun>& runs() const { return runs_; }
  const std::vector<kernels::Areas>& areas() const { return areas_; }

  /// Those that lie in no run, ascending.
  std::vector<int> loose() const;

private:
  static constexpr std::uint64_t NEVER = std::numeric_limits<std::uint64_t>::max();

  void makeGroups(const Mesh& untorn);
  void makeRuns(const Mesh& untorn);
  void sortRuns();
  int groupOf(int lowest, int highest) const;
  int groupOf(const Triangle& triangle) const;
  void followAll(const Mesh& mesh, const RestShape& rest);
  void follow(const Mesh& mesh, const RestShape& rest, int triangle);
  void removeLoose(int triangle);
  void addLoose(const Mesh& mesh, int triangle);
  bool fits(const Triangle& triangle, int lane) const;

  std::vector<kernels::TriangleRun> runs_;  ///< group by group
  std::vector<kernels::Areas> areas_;       ///< of each run [m^2]; 0: no triangle
  std::vector<int> lanes_;        ///< by triangle: LANES times its run, and its lane; -1: none
  std::vector<int> loose_group_;  ///< by triangle: in which it is loose; -1: in none
  std::vector<TriangleGroup> groups_;
  std::array<int, 4> phases_{};
  int stretch_ = 0;             ///< so many particles make one
  std::uint64_t seen_ = NEVER;  ///< changes of the springs that were followed
  std::vector<int> changed_;    ///< springs, scratch
};

}  // namespace cloth
