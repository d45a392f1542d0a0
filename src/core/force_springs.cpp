// Damped spring forces, symplectic Euler, limiter, and the check of the step.
#include "cloth_tearing/core/force_springs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cloth
{
namespace
{

/// How much of the stable range is used: a spring between two light particles is stiffer than
/// either alone shows.
constexpr double SAFETY = 0.9;

}  // namespace

ForceSprings::ForceSprings(const SolverParams& params) : params_(params)
{
}

std::unique_ptr<Solver> ForceSprings::clone() const
{
  return std::make_unique<ForceSprings>(*this);
}

void ForceSprings::advance(ParticleState& state, const SpringTable& springs,
                           const Vec3Array& acceleration, double dt)
{
  const auto h = static_cast<Real>(dt / substeps_);
  arrange(springs, state);
  force_.resize(state.size());
  held_.resize(state.size());
  held_.setZero();
  held_scale_ = 1.0 / substeps_;
  added_impulse_.setZero();
  for (int substep = 0; substep < substeps_; ++substep)
  {
    addForces(state);
    if (substep == 0)
    {
      collectNotes(springs.structural.size());
    }
    addImpulse(state, h);
    forStretches(state.size(), [&](Range range) { integrate(state, acceleration, range, h); });
  }
}

void ForceSprings::addForces(const ParticleState& state)
{
  const kernels::Bodies bodies = {
    { state.position.axis(0), state.position.axis(1), state.position.axis(2) },
    { state.velocity.axis(0), state.velocity.axis(1), state.velocity.axis(2) },
    { force_.axis(0), force_.axis(1), force_.axis(2) }
  };
  force_.setZero();
  forGroups([&](int g, Scratch& scratch) { pull(groups()[g], scratch, bodies); });
}

void ForceSprings::pull(const SpringGroup& group, Scratch& scratch, const kernels::Bodies& bodies)
{
  const kernels::Set& loops = kernels::best();
  const auto runs = group.run_ends.size();
  const auto loose = group.loose_ends.size();
  scratch.run_notes.count =
      loops.pull_runs(bodies, group.run_ends.data(), group.run_lanes.data(), static_cast<int>(runs),
                      scratch.run_notes.roomFor(runs));
  scratch.loose_notes.count = 0;
  if (loose == 0)
  {
    return;
  }
  auto& [position, velocity, force] = scratch.records;
  pack(bodies.position, group.particles, position);
  pack(bodies.velocity, group.particles, velocity);
  pack(bodies.force, group.particles, force);
  scratch.loose_notes.count = loops.pull_records(
      { position.data(), velocity.data(), force.data() }, group.loose_ends.data(),
      group.loose_lanes.data(), static_cast<int>(loose), scratch.loose_notes.roomFor(loose));
  unpack(force, group.particles, bodies.force);
}

void ForceSprings::integrate(ParticleState& state, const Vec3Array& acceleration, Range range,
                             Real dt)
{
  const int first = range.begin;
  for (int k = 0; k < 3; ++k)
  {
    kernels::best().integrate(state.position.axis(k) + first, state.velocity.axis(k) + first,
                              acceleration.axis(k) + first, force_.axis(k) + first,
                              state.inverse_mass.data() + first, inverse_mass_limit_.data() + first,
                              held_.axis(k) + first, dt, range.end - first);
  }
}

/// What treating light particles as heavier adds to the momentum of a substep.
void ForceSprings::addImpulse(const ParticleState& state, Real dt)
{
  if (!kernels::best().above(state.inverse_mass.data(), inverse_mass_limit_.data(), state.size()))
  {
    return;
  }
  for (int i = 0; i < state.size(); ++i)
  {
    if (state.inverse_mass[i] > inverse_mass_limit_[i])
    {
      const Real share = inverse_mass_limit_[i] / state.inverse_mass[i] - Real(1);
      added_impulse_ += (dt * share * force_[i]).cast<double>();
    }
  }
}

/// Spring by spring in the order of their ids, which is what decides how far a correction gets: in
/// the order of the blocks the limiter holds more, and the thesis' third ball slides off fine
/// cloth.
void ForceSprings::limitStrain(ParticleState& state, const SpringTable& springs)
{
  const auto most = static_cast<Real>(1.0 + params_.max_strain);
  limited_ = 0;
  for (const SpringLaw& spring : springs.structural)
  {
    if (!spring.active())
    {
      continue;
    }
    const Real wa = state.inverse_mass[spring.a];
    const Real wb = state.inverse_mass[spring.b];
    auto a = state.position[spring.a];
    auto b = state.position[spring.b];
    const Vec3 d = b - a;
    const Real limit = most * spring.rest;
    const Real squared = d.squaredNorm();
    if (!(squared > limit * limit) || !(wa + wb > 0))
    {
      continue;
    }
    ++limited_;
    // Half each, as in the thesis, unless one end is held.
    const Vec3 correction = (Real(1) - limit / std::sqrt(squared)) * d;
    const Real share = wa > 0 && wb > 0 ? Real(0.5) : Real(1);
    if (wa > 0)
    {
      a += share * correction;
    }
    if (wb > 0)
    {
      b -= share * correction;
    }
  }
}

Stability ForceSprings::checkStability(const ParticleState& state, const SpringTable& springs,
                                       double dt, double air_rate)
{
  sumStiffness(state, springs);
  // A particle with its springs is stable while
  // h^2 (2 sum k / m) + 2 h (2 sum c / m) + 2 dt air_rate < 4: air acts once a step.
  const double range = SAFETY * 4.0 - 2.0 * dt * air_rate;
  const auto lightest = [&](int particle, int substeps)
  {
    const double h = dt / substeps;
    const double load =
        h * h * 2.0 * stiffness_sum_[particle] + 2.0 * h * 2.0 * damping_sum_[particle];
    return load > 0.0 ? range / load : std::numeric_limits<double>::max();
  };
  const auto tooLight = [&](int substeps)
  {
    int count = 0;
    for (int i = 0; i < state.size(); ++i)
    {
      count += state.inverse_mass[i] > lightest(i, substeps) ? 1 : 0;
    }
    return count;
  };

  Stability stability{ substeps_, tooLight(substeps_) };
  while (stability.floored > 0 && stability.substeps < params_.max_substeps)
  {
    ++stability.substeps;
    stability.floored = tooLight(stability.substeps);
  }
  substeps_ = stability.substeps;
  inverse_mass_limit_.resize(state.size());
  for (int i = 0; i < state.size(); ++i)
  {
    inverse_mass_limit_[i] = static_cast<Real>(
        std::min(lightest(i, substeps_), double(std::numeric_limits<Real>::max())));
  }
  return stability;
}

SolverMemory ForceSprings::memory() const
{
  SolverMemory memory = BlockSolver::memory();
  memory.substeps = substeps_;
  memory.inverse_mass_limit = inverse_mass_limit_;
  return memory;
}

void ForceSprings::recall(const SolverMemory& memory)
{
  BlockSolver::recall(memory);
  substeps_ = memory.substeps;
  inverse_mass_limit_ = memory.inverse_mass_limit;
}

void ForceSprings::sumStiffness(const ParticleState& state, const SpringTable& springs)
{
  stiffness_sum_.assign(state.size(), 0.0);
  damping_sum_.assign(state.size(), 0.0);
  for (const auto* table : { &springs.structural, &springs.bend_shear })
  {
    for (const SpringLaw& spring : *table)
    {
      if (spring.active())
      {
        for (int end : { spring.a, spring.b })
        {
          stiffness_sum_[end] += spring.stiffness;
          damping_sum_[end] += spring.damping;
        }
      }
    }
  }
}

}  // namespace cloth
