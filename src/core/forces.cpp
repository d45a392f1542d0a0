// Gravity, air friction and wind as accelerations.
#include "cloth_tearing/core/forces.h"

#include "cloth_tearing/core/kernels.h"

namespace cloth
{
namespace
{

using kernels::LANES;

/// Triangles in no run, as many at a time as there are lanes.
void blowOnLoose(const Cloth& cloth, const std::vector<int>& triangles, const kernels::Air& air)
{
  for (std::size_t first = 0; first < triangles.size(); first += LANES)
  {
    kernels::TriangleEnds ends{};
    kernels::Areas areas{};
    for (std::size_t i = first; i < triangles.size() && i < first + LANES; ++i)
    {
      const auto& p = cloth.mesh.triangle({ triangles[i] }).particles;
      const std::size_t lane = i - first;
      ends.a[lane] = p[0].index;
      ends.b[lane] = p[1].index;
      ends.c[lane] = p[2].index;
      areas.area[lane] = static_cast<float>(cloth.rest.area[triangles[i]]);
    }
    kernels::best().blow_ends(air, ends, areas);
  }
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
    blow(cloth, environment);
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
void OuterForces::blow(const Cloth& cloth, const Environment& environment)
{
  const ParticleState& state = cloth.state;
  force_.resize(state.size());
  force_.setZero();
  kernels::Air air{};
  air.drag = static_cast<float>(environment.wind_drag);
  for (int k = 0; k < 3; ++k)
  {
    air.position[k] = state.position.axis(k);
    air.velocity[k] = state.velocity.axis(k);
    air.force[k] = force_.axis(k);
    air.wind[k] = static_cast<float>(environment.wind[k]);
  }
  kernels::best().blow_runs(air, triangles_.runs().data(), triangles_.areas().data(),
                            static_cast<int>(triangles_.runs().size()));
  blowOnLoose(cloth, triangles_.loose(), air);
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
