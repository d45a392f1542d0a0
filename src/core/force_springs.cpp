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

/// @param see told of each spring's index and its squared length
template <class See>
void ForceSprings::addForces(const ParticleState& state, const std::vector<SpringLaw>& springs,
                             const See& see)
{
  for (std::size_t i = 0; i < springs.size(); ++i)
  {
    const SpringLaw& spring = springs[i];
    if (!spring.active())
    {
      continue;
    }
    const Vec3 d = state.position[spring.b] - state.position[spring.a];
    const Real squared = d.squaredNorm();
    see(i, squared);
    const Real length = std::sqrt(squared);
    if (!(length > 0))
    {
      continue;
    }
    const Vec3 n = d / length;
    const Real speed = n.dot(state.velocity[spring.b] - state.velocity[spring.a]);
    const Vec3 force = (spring.stiffness * (length - spring.rest) + spring.damping * speed) * n;
    force_[spring.a] += force;
    force_[spring.b] -= force;
  }
}

void ForceSprings::advance(ParticleState& state, const SpringTable& springs,
                           const Vec3Array& acceleration, double dt)
{
  const auto h = static_cast<Real>(dt / substeps_);
  const auto unseen = [](std::size_t, Real) {};
  const auto seen = [&](std::size_t i, Real squared)
  { noteLong(i, springs.structural[i].rest, squared); };
  clearNotes(springs.structural.size());
  held_.assign(state.size(), Vec3::Zero());
  held_scale_ = 1.0 / substeps_;
  added_impulse_.setZero();
  for (int substep = 0; substep < substeps_; ++substep)
  {
    force_.assign(state.size(), Vec3::Zero());
    if (substep == 0)
    {
      addForces(state, springs.structural, seen);
    }
    else
    {
      addForces(state, springs.structural, unseen);
    }
    addForces(state, springs.bend_shear, unseen);
    for (int i = 0; i < state.size(); ++i)
    {
      if (state.inverse_mass[i] > 0)
      {
        const Real inverse_mass = std::min(state.inverse_mass[i], inverse_mass_limit_[i]);
        state.velocity[i] += h * (acceleration[i] + inverse_mass * force_[i]);
        state.position[i] += h * state.velocity[i];
        if (inverse_mass < state.inverse_mass[i])
        {
          const Real share = inverse_mass / state.inverse_mass[i] - Real(1);
          added_impulse_ += (h * share * force_[i]).cast<double>();
        }
      }
      else
      {
        held_[i] += force_[i];
      }
    }
  }
}

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

void ForceSprings::recall(const SolverMemory& memory)
{
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
