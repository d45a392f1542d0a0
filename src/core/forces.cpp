// Gravity, air friction and wind as accelerations.
#include "cloth_tearing/core/forces.h"

#include "cloth_tearing/core/kernels.h"

namespace cloth
{
namespace
{

/// The particles from `first` on.
kernels::Air from(int first, kernels::Air air)
{
  for (int k = 0; k < 3; ++k)
  {
    air.position[k] += first;
    air.velocity[k] += first;
    air.force[k] += first;
  }
  return air;
}

}  // namespace

void OuterForces::accelerate(const Cloth& cloth, const Mesh& untorn, const Environment& environment,
                             Vec3Array& acceleration, WorkerPool* workers)
{
  const ParticleState& state = cloth.state;
  const Vec3 gravity = environment.gravity.cast<Real>();
  const auto friction = static_cast<Real>(environment.air_friction);
  const bool windy = environment.wind_drag > 0.0;
  acceleration.resize(state.size());
  if (windy)
  {
    if (!triangles_.made())
    {
      triangles_ = TriangleRuns(untorn);
    }
    follow(cloth);
    blow(cloth, environment, workers);
  }
  shareStretches(workers, state.size(),
                 [&](int begin, int end)
                 {
                   for (int k = 0; k < 3; ++k)
                   {
                     kernels::best().accelerate(acceleration.axis(k) + begin,
                                                state.velocity.axis(k) + begin, gravity[k],
                                                friction, end - begin);
                   }
                   if (windy)
                   {
                     addWind(cloth, acceleration, begin, end);
                   }
                 });
}

void OuterForces::follow(const Cloth& cloth)
{
  if (triangles_.made())
  {
    triangles_.follow(cloth.mesh, cloth.rest, cloth.springs);
  }
}

/// What the wind does to each particle.
void OuterForces::blow(const Cloth& cloth, const Environment& environment, WorkerPool* workers)
{
  const ParticleState& state = cloth.state;
  force_.resize(state.size());
  kernels::Air air{};
  air.drag = static_cast<float>(environment.wind_drag);
  for (int k = 0; k < 3; ++k)
  {
    air.position[k] = state.position.axis(k);
    air.velocity[k] = state.velocity.axis(k);
    air.force[k] = force_.axis(k);
    air.wind[k] = static_cast<float>(environment.wind[k]);
  }
  const auto& phases = triangles_.phases();
  for (int phase = 0; phase < 3; ++phase)
  {
    const int first = phases[phase];
    share(workers, phases[phase + 1] - first,
          [&](int i)
          {
            if (phase == 0)
            {
              const auto [begin, end] = triangles_.own(i, state.size());
              force_.setZero(begin, end);
            }
            blowOn(first + i, cloth, air);
          });
  }
}

void OuterForces::blowOn(int group, const Cloth& cloth, const kernels::Air& air)
{
  const kernels::Set& loops = kernels::best();
  triangles_.arrange(group, cloth.mesh, cloth.rest);
  const TriangleGroup& triangles = triangles_.groups()[group];
  loops.blow_runs(air, triangles_.runs().data() + triangles.first_run,
                  triangles_.areas().data() + triangles.first_run,
                  triangles.end_run - triangles.first_run);
  loops.blow_ends(from(triangles.low, air), triangles.ends.data(), triangles.areas.data(),
                  static_cast<int>(triangles.ends.size()));
}

void OuterForces::addWind(const Cloth& cloth, Vec3Array& acceleration, int begin, int end) const
{
  const std::vector<Real>& inverse_mass = cloth.state.inverse_mass;
  for (int k = 0; k < 3; ++k)
  {
    kernels::best().add_force(acceleration.axis(k) + begin, force_.axis(k) + begin,
                              inverse_mass.data() + begin, end - begin);
  }
  for (int i = begin; i < end; ++i)
  {
    if (!(inverse_mass[i] > 0))
    {
      acceleration[i] += static_cast<Real>(1.0 / cloth.rest.mass[i]) * force_[i];
    }
  }
}

}  // namespace cloth
