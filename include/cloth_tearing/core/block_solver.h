// What both solvers share: springs in blocks, gone through group by group, and lines of them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cloth_tearing/core/solver.h"
#include "cloth_tearing/core/spring_blocks.h"

namespace cloth
{

/// Keeps its springs in blocks, brings these up to tears, and shares the groups among threads.
class BlockSolver : public Solver
{
public:
  /// @param in_lines whether springs that lie in lines are kept in ladders, not in blocks
  explicit BlockSolver(bool in_lines = false) : in_lines_(in_lines) {}

  void follow(const SpringTable& springs, int particles) override;
  SolverMemory memory() const override;
  void recall(const SolverMemory& memory) override;

protected:
  bool inLines() const { return in_lines_; }
  const SpringLines& lines() const { return lines_; }

  /// Notes of blocks; its room only grows.
  struct Notes
  {
    std::vector<kernels::Note> notes;
    int count = 0;

    /// Room for one of each block.
    kernels::Note* roomFor(std::size_t blocks);
  };

  /// What going through a group takes beside the particles.
  struct Scratch
  {
    std::array<std::vector<kernels::Record>, 3> records;  ///< of what loose springs touch
    Notes run_notes;
    Notes loose_notes;
  };

  struct Range
  {
    int begin;
    int end;
  };

  /// Brings lines and blocks up to the springs of now. To be called before what follows.
  void arrange(const SpringTable& springs, const ParticleState& state);

  const std::vector<SpringGroup>& groups() const { return blocks_.groups(); }

  /// Stretches of particles, which together are all of them: groups of the first phase have one.
  int stretches() const { return blocks_.phases()[1]; }
  Range stretch(int group, int particles) const;

  /// Calls work(group, scratch of it), phase by phase; within a phase in any order.
  template <class Work>
  void forGroups(const Work& work)
  {
    const auto& phases = blocks_.phases();
    for (int phase = 0; phase < 3; ++phase)
    {
      const int first = phases[phase];
      share(workers(), phases[phase + 1] - first,
            [&](int i) { work(first + i, scratch_[first + i]); });
    }
  }

  /// Calls work(ladder, notes of it), phase by phase; within a phase in any order.
  template <class Work>
  void forLadders(const Work& work)
  {
    const auto& phases = lines_.phases();
    for (std::size_t phase = 0; phase + 1 < phases.size(); ++phase)
    {
      const int first = phases[phase];
      share(workers(), phases[phase + 1] - first,
            [&](int i) { work(lines_.ladders()[first + i], line_notes_[first + i]); });
    }
  }

  /// Calls work(range) for each stretch, in any order.
  template <class Work>
  void forStretches(int particles, const Work& work) const
  {
    share(workers(), stretches(), [&](int i) { work(stretch(i, particles)); });
  }

  /// Takes what is written in the scratch of all groups and ladders over into stretched().
  void collectNotes(std::size_t springs);

  /// Copies x, y and z of a group's particles into its records, and back.
  static void pack(const float* const axes[3], const std::vector<int>& particles,
                   std::vector<kernels::Record>& records);
  static void unpack(const std::vector<kernels::Record>& records, const std::vector<int>& particles,
                     float* const axes[3]);

private:
  bool arranged() const { return !blocks_.groups().empty(); }
  void begin(const SpringTable& springs, const ParticleState& state);
  void keepUp(const SpringTable& springs, int particles);
  void take(const Notes& notes, const std::vector<Links>& links);

  bool in_lines_;
  SpringLines lines_;
  SpringBlocks blocks_;
  std::uint64_t seen_ = 0;            ///< changes of the springs that both have followed
  SolverMemory recalled_;             ///< what they are to be made from
  std::vector<int> changed_;          ///< springs, scratch
  std::vector<Scratch> scratch_;      ///< by group
  std::vector<Notes> line_notes_;     ///< by ladder
  std::vector<std::uint64_t> noted_;  ///< a bit for each spring, scratch
};

}  // namespace cloth
