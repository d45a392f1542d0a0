// Keeps the blocks of a solver, and gathers what its threads note.
#include "cloth_tearing/core/block_solver.h"

#include <algorithm>
#include <numeric>

namespace cloth
{
namespace
{

constexpr int WORD = 64;  ///< bits

}  // namespace

void BlockSolver::arrange(const SpringTable& springs, const ParticleState& state)
{
  if (!arranged())
  {
    begin(springs, state);
  }
  keepUp(springs, state.size());
}

/// Blocks that were saved without lines had all springs.
void BlockSolver::begin(const SpringTable& springs, const ParticleState& state)
{
  const int particles = state.size();
  if (!recalled_.lines.empty())
  {
    lines_ = SpringLines(springs, particles, recalled_.lines);
  }
  else if (in_lines_ && recalled_.blocks.empty())
  {
    lines_ = SpringLines(springs, state.previous);
  }
  blocks_ = recalled_.blocks.empty() ? SpringBlocks(springs, particles, lines_)
                                     : SpringBlocks(springs, particles, recalled_.blocks, lines_);
  recalled_ = {};
  seen_ = springs.changes.count();
  scratch_.resize(groups().size());
  line_notes_.resize(lines_.ladders().size());
}

void BlockSolver::keepUp(const SpringTable& springs, int particles)
{
  if (seen_ != springs.changes.count())
  {
    if (!springs.changes.since(seen_, changed_))
    {
      changed_.resize(springs.structural.size());
      std::iota(changed_.begin(), changed_.end(), 0);
    }
    lines_.follow(springs, changed_);
    blocks_.follow(springs, particles, changed_, lines_);
    seen_ = springs.changes.count();
  }
  if (blocks_.watched() != watched_)
  {
    lines_.watch(springs, watched_);
    blocks_.watch(springs, watched_);
  }
}

void BlockSolver::follow(const SpringTable& springs, int particles)
{
  if (arranged())
  {
    keepUp(springs, particles);
  }
}

SolverMemory BlockSolver::memory() const
{
  if (!arranged())
  {
    return recalled_;
  }
  SolverMemory memory;
  memory.blocks = blocks_.toNumbers();
  if (in_lines_)
  {
    memory.lines = lines_.toNumbers();
  }
  return memory;
}

void BlockSolver::recall(const SolverMemory& memory)
{
  recalled_ = memory;
}

/// The last takes those that tears have added as well.
BlockSolver::Range BlockSolver::stretch(int group, int particles) const
{
  const bool last = group + 1 == stretches();
  return { groups()[group].begin, last ? particles : groups()[group].end };
}

void BlockSolver::collectNotes(std::size_t springs)
{
  stretched_.clear();
  if (stretched_.capacity() < springs)
  {
    stretched_.reserve(2 * springs);  // steady steps do not allocate
  }
  noted_.resize(springs / WORD + 1, 0);
  for (std::size_t g = 0; g < scratch_.size(); ++g)
  {
    take(scratch_[g].run_notes, groups()[g].run_links);
    take(scratch_[g].loose_notes, groups()[g].loose_links);
  }
  for (std::size_t i = 0; i < line_notes_.size(); ++i)
  {
    take(line_notes_[i], lines_.ladders()[i].links);
  }
  for (std::size_t word = 0; word < noted_.size(); ++word)
  {
    for (; noted_[word] != 0; noted_[word] &= noted_[word] - 1)
    {
      stretched_.push_back(static_cast<int>(WORD * word) + lowestBit(noted_[word]));
    }
  }
}

/// Marks springs: ascending without being sorted, however many there are.
void BlockSolver::take(const Notes& notes, const std::vector<Links>& links)
{
  for (int i = 0; i < notes.count; ++i)
  {
    const kernels::Note& note = notes.notes[i];
    for (unsigned lanes = note.lanes; lanes != 0; lanes &= lanes - 1)
    {
      const int link = links[note.block][lowestBit(lanes)];
      if (link >= 0)
      {
        noted_[link / 2 / WORD] |= bitOf(link / 2 % WORD);
      }
    }
  }
}

kernels::Note* BlockSolver::Notes::roomFor(std::size_t blocks)
{
  notes.resize(std::max(notes.size(), blocks));
  return notes.data();
}

void BlockSolver::pack(const float* const axes[3], const std::vector<int>& particles,
                       std::vector<kernels::Record>& records)
{
  records.resize(particles.size());
  for (std::size_t r = 1; r < particles.size(); ++r)  // the first is no particle's
  {
    const int p = particles[r];
    records[r].x = axes[0][p];
    records[r].y = axes[1][p];
    records[r].z = axes[2][p];
  }
}

void BlockSolver::unpack(const std::vector<kernels::Record>& records,
                         const std::vector<int>& particles, float* const axes[3])
{
  for (std::size_t r = 1; r < particles.size(); ++r)
  {
    const int p = particles[r];
    axes[0][p] = records[r].x;
    axes[1][p] = records[r].y;
    axes[2][p] = records[r].z;
  }
}

}  // namespace cloth
