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
                             Vec3Array& acceleration)
{
  const ParticleState& state = cloth.state;
  const Vec3 gravity = environment.gravity.cast<Real>();
  const auto friction = static_cast<Real>(environment.air_friction);
  acceleration.resize(state.size());
  for (int k = 0; k < 3; ++k)
  {
    kernels::best().accelerate(acceleration.axis(k), state.velocity.axis(k), gravity[k], friction,
                               state.size());
  }
  if (environment.wind_drag > 0.0)
  {
    if (!triangles_.made())
    {
      triangles_ = TriangleRuns(untorn);
    }
    follow(cloth);
    addWind(cloth, environment, acceleration);
  }
}

void OuterForces::follow(const Cloth& cloth)
{
  if (triangles_.made())
  {
    triangles_.follow(cloth.mesh, cloth.rest, cloth.springs);
  }
}

void OuterForces::addWind(const Cloth& cloth, const Environment& environment,
                          Vec3Array& acceleration)
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
  for (int k = 0; k < 3; ++k)
  {
    kernels::best().add_force(acceleration.axis(k), force_.axis(k), state.inverse_mass.data(),
                              state.size());
  }
  for (int i = 0; i < state.size(); ++i)
  {
    if (!(state.inverse_mass[i] > 0))
    {
      acceleration[i] += static_cast<Real>(1.0 / cloth.rest.mass[i]) * force_[i];
    }
  }
}

}  // namespace cloth
