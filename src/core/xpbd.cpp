// One Gauss-Seidel sweep of compliant distance constraints.
#include "cloth_tearing/core/xpbd.h"

#include <algorithm>
#include <numeric>

namespace cloth
{
namespace
{

using kernels::Particles;
using kernels::Record;

/// Copies what springs read of a group's particles into its records.
void pack(const Particles& particles, const std::vector<int>& of, std::vector<Record>& way,
          std::vector<Record>& start)
{
  for (std::size_t r = 1; r < of.size(); ++r)
  {
    const int p = of[r];
    way[r] = { particles.way[0][p], particles.way[1][p], particles.way[2][p],
               particles.inverse_mass[p] };
    start[r] = { particles.start[0][p], particles.start[1][p], particles.start[2][p], 0 };
  }
}

void unpack(const std::vector<Record>& way, const std::vector<int>& of, const Particles& particles)
{
  for (std::size_t r = 1; r < of.size(); ++r)
  {
    const int p = of[r];
    particles.way[0][p] = way[r].x;
    particles.way[1][p] = way[r].y;
    particles.way[2][p] = way[r].z;
  }
}

}  // namespace

std::unique_ptr<Solver> XpbdSolver::clone() const
{
  return std::make_unique<XpbdSolver>(*this);
}

/// Brings the blocks up to the springs of now.
void XpbdSolver::arrange(const SpringTable& springs, int particles)
{
  if (!arranged())
  {
    blocks_ = recalled_.empty() ? SpringBlocks(springs, particles)
                                : SpringBlocks(springs, particles, recalled_);
    recalled_.clear();
    seen_ = springs.changes.count();
  }
  if (seen_ != springs.changes.count())
  {
    if (!springs.changes.since(seen_, changed_))
    {
      changed_.resize(springs.structural.size());
      std::iota(changed_.begin(), changed_.end(), 0);
    }
    blocks_.follow(springs, particles, changed_);
    seen_ = springs.changes.count();
  }
  if (blocks_.watched() != watched_)
  {
    blocks_.watch(springs, watched_);
  }
}

void XpbdSolver::follow(const SpringTable& springs, int particles)
{
  if (arranged())
  {
    arrange(springs, particles);
  }
}

SolverMemory XpbdSolver::memory() const
{
  SolverMemory memory;
  memory.blocks = arranged() ? blocks_.toNumbers() : recalled_;
  return memory;
}

void XpbdSolver::recall(const SolverMemory& memory)
{
  recalled_ = memory.blocks;
}

void XpbdSolver::advance(ParticleState& state, const SpringTable& springs,
                         const Vec3Array& acceleration, double dt)
{
  const auto h = static_cast<Real>(dt);
  const int count = state.size();
  arrange(springs, count);
  way_.resize(count);
  held_.resize(count);
  held_.setZero();
  held_scale_ = 1.0 / (dt * dt);

  Particles particles{};
  particles.inverse_mass = state.inverse_mass.data();
  for (int k = 0; k < 3; ++k)
  {
    particles.way[k] = way_.axis(k);
    particles.start[k] = state.previous.axis(k);
    particles.held[k] = held_.axis(k);
  }
  clearNotes(springs.structural.size());
  const auto& groups = blocks_.groups();
  const auto& phases = blocks_.phases();
  scratch_.resize(groups.size());
  const int stretches = phases[1];
  shared(stretches,
         [&](int i)
         {
           const Range range = stretch(i, count);
           predict(state, acceleration, range, h);
           solve(groups[i], scratch_[i], particles, h);
         });
  for (int phase = 1; phase < 3; ++phase)
  {
    shared(phases[phase + 1] - phases[phase],
           [&](int i)
           {
             const int g = phases[phase] + i;
             solve(groups[g], scratch_[g], particles, h);
           });
  }
  shared(stretches, [&](int i) { finish(state, stretch(i, count), h); });
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    note(scratch_[g].run_notes, groups[g].run_links);
    note(scratch_[g].loose_notes, groups[g].loose_links);
  }
  std::sort(stretched_.begin(), stretched_.end());
}

/// The particles of a group of the first phase; the last takes those that tears have added as well.
XpbdSolver::Range XpbdSolver::stretch(int group, int particles) const
{
  const bool last = group + 1 == blocks_.phases()[1];
  return { blocks_.groups()[group].begin, last ? particles : blocks_.groups()[group].end };
}

void XpbdSolver::predict(const ParticleState& state, const Vec3Array& acceleration, Range range,
                         float dt)
{
  const int first = range.begin;
  for (int k = 0; k < 3; ++k)
  {
    kernels::best().predict(way_.axis(k) + first, state.velocity.axis(k) + first,
                            acceleration.axis(k) + first, state.inverse_mass.data() + first,
                            state.previous.axis(k) + first, state.position.axis(k) + first, dt,
                            range.end - first);
  }
}

void XpbdSolver::finish(ParticleState& state, Range range, float dt) const
{
  const int first = range.begin;
  for (int k = 0; k < 3; ++k)
  {
    kernels::best().finish(way_.axis(k) + first, state.previous.axis(k) + first,
                           state.inverse_mass.data() + first, dt, state.position.axis(k) + first,
                           state.velocity.axis(k) + first, range.end - first);
  }
}

void XpbdSolver::solve(const SpringGroup& group, Scratch& scratch, const Particles& particles,
                       float dt)
{
  const kernels::Set& loops = kernels::best();
  scratch.run_notes.resize(group.run_ends.size());
  scratch.run_notes.resize(
      loops.sweep_runs(particles, group.run_ends.data(), group.run_lanes.data(),
                       static_cast<int>(group.run_ends.size()), dt, scratch.run_notes.data()));
  if (group.loose_ends.empty())
  {
    scratch.loose_notes.clear();
    return;
  }
  scratch.way.resize(group.particles.size());
  scratch.start.resize(group.particles.size());
  pack(particles, group.particles, scratch.way, scratch.start);
  scratch.loose_notes.resize(group.loose_ends.size());
  scratch.loose_notes.resize(loops.sweep_records(
      { scratch.way.data(), scratch.start.data(), group.particles.data() }, particles.held,
      group.loose_ends.data(), group.loose_lanes.data(), static_cast<int>(group.loose_ends.size()),
      dt, scratch.loose_notes.data()));
  unpack(scratch.way, group.particles, particles);
}

void XpbdSolver::note(const std::vector<kernels::Note>& notes, const std::vector<Links>& links)
{
  for (const kernels::Note& note : notes)
  {
    for (int lane = 0; lane < kernels::LANES; ++lane)
    {
      if ((note.lanes >> lane & 1U) != 0 && links[note.block][lane] >= 0)
      {
        stretched_.push_back(links[note.block][lane] / 2);
      }
    }
  }
}

double XpbdSolver::stiffnessNumber(const ParticleState& state, const SpringTable& springs,
                                   double dt) const
{
  std::vector<double> numbers;
  for (const SpringLaw& spring : springs.structural)
  {
    if (spring.active())
    {
      const double w = state.inverse_mass[spring.a] + state.inverse_mass[spring.b];
      numbers.push_back(w * spring.stiffness * dt * dt);
    }
  }
  if (numbers.empty())
  {
    return 0.0;
  }
  const auto nine_tenths =
      numbers.begin() + static_cast<std::ptrdiff_t>(9 * (numbers.size() - 1) / 10);
  std::nth_element(numbers.begin(), nine_tenths, numbers.end());
  return *nine_tenths;
}

}  // namespace cloth
