// Springs in blocks that a step solves many at a time, and the order of these.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "cloth_tearing/core/kernels.h"
#include "cloth_tearing/core/spring_lanes.h"
#include "cloth_tearing/core/spring_lines.h"
#include "cloth_tearing/core/spring_table.h"

namespace cloth
{

/// Blocks that touch no other particles than those from `begin` to `end`. The runs are solved
/// first, then the loose blocks.
struct SpringGroup
{
  int begin = 0;
  int end = 0;

  // Runs: springs whose ends are neighbours in memory, which is what makes them fast.
  std::vector<kernels::RunEnds> run_ends;
  std::vector<kernels::Lanes> run_lanes;
  std::vector<Links> run_links;

  // Loose blocks: any other springs. They work on records, copies of the particles that they touch.
  std::vector<kernels::RecordEnds> loose_ends;
  std::vector<kernels::Lanes> loose_lanes;
  std::vector<Links> loose_links;
  std::vector<int> particles;  ///< of each record; of the first, -1: lanes without a spring have it
};

/// All springs of a cloth in blocks of which no two springs share a particle, but for those that
/// lie in lines.
///
/// Where a spring lies depends on the cloth and on its tears one after the other, never on the
/// processor or the number of threads: neither do the bits of a step. A tear costs what it changes.
class SpringBlocks
{
public:
  SpringBlocks() = default;

  /// Arranges all springs of a table anew.
  SpringBlocks(const SpringTable& springs, int particles, const SpringLines& lines = {});

  /// Arranges them as toNumbers() told.
  /// @throws Refusal if that is no sound arrangement of these springs
  SpringBlocks(const SpringTable& springs, int particles, const std::vector<int>& numbers,
               const SpringLines& lines = {});

  /// All that decides where springs lie and where those will that are still to come.
  std::vector<int> toNumbers() const;

  /// Takes over springs that were changed, added or have come to carry nothing, by SpringId; each
  /// that does not fit its place any more goes into a loose block of the last group. The lines are
  /// to follow before.
  void follow(const SpringTable& springs, int particles, const std::vector<int>& changed,
              const SpringLines& lines = {});

  /// Structural springs are noted from now on if their squared length is more than this part of
  /// their squared rest length [-].
  void watch(const SpringTable& springs, Real watched);
  Real watched() const { return watched_; }

  /// Groups of one phase have no particle in common: whoever solves them in whatever order gets the
  /// same bits. phases()[k] is the first group of phase k; the last number is how many there are.
  const std::vector<SpringGroup>& groups() const { return groups_; }
  const std::array<int, 4>& phases() const { return phases_; }

private:
  /// Where a link lies.
  struct Place
  {
    int group = -1;  ///< -1: nowhere, it carries nothing
    int block = 0;   ///< among the runs or the loose blocks
    int lane = 0;
    bool run = false;
  };

  /// Loose blocks that have lanes free: up to 64, a bit for each in the mask of what they touch.
  struct OpenBlocks
  {
    std::vector<std::uint64_t> touching;  ///< by particle
    std::array<int, 64> block{};          ///< of each bit
    std::array<int, 64> filled{};         ///< lanes of it
    std::uint64_t used = 0;
  };

  struct Link
  {
    int link;
    int a;  ///< < b
    int b;
  };

  SpringBlocks(const SpringTable& springs, int particles, int divided);
  void refuseUnsound(int group, const Links& links, const SpringTable& springs) const;
  void readRun(int group, const kernels::RunEnds& ends, const Links& links,
               const SpringTable& springs);
  void readLoose(int group, const Links& links, const SpringTable& springs);
  void readOpen(int bit, int block, int filled);
  int groupOf(int a, int b) const;
  std::vector<Link> makeRuns(int group, std::vector<Link> links, int particles,
                             const SpringTable& springs);
  void addRun(int group, const kernels::RunEnds& ends, const Links& links,
              const SpringTable& springs);
  void addLoose(int group, const Link& link, const SpringTable& springs);
  int openBlock(SpringGroup& group);
  void closeBlock(const SpringGroup& group, int bit);
  void leaveOpenBlock(int block, const std::array<int, 2>& ends);
  int recordOf(SpringGroup& group, int particle);
  void forgetRecords(int group);
  static std::array<int, 2> sorted(const SpringLaw& law);
  std::array<int, 2> endsOf(int link) const;
  void remove(int link);
  void write(int link, const SpringTable& springs);
  void compact(const SpringTable& springs);

  std::vector<SpringGroup> groups_;
  std::array<int, 4> phases_{};
  std::vector<Place> places_;  ///< by link
  OpenBlocks open_;            ///< of the group under construction, later of the last
  std::vector<int> records_;   ///< by particle: its record there; 0: none
  int holes_ = 0;              ///< lanes of the last group's loose blocks that lost their springs
  int divided_ = 0;            ///< particles when the groups were made
  Real watched_ = std::numeric_limits<Real>::infinity();
};

}  // namespace cloth
