// Gravity, air friction and wind as accelerations.
#include "cloth_tearing/core/forces.h"

#include <algorithm>
#include <cmath>

#include "cloth_tearing/core/kernels.h"

namespace cloth
{
namespace
{

void addWind(const Cloth& cloth, const Environment& environment, Vec3Array& acceleration)
{
  const Vec3 wind = environment.wind.cast<Real>();
  const auto drag = static_cast<Real>(environment.wind_drag);
  const ParticleState& state = cloth.state;
  for (int i = 0; i < cloth.mesh.triangleCount(); ++i)
  {
    const auto& corners = cloth.mesh.triangle({ i }).particles;
    const int a = corners[0].index;
    const int b = corners[1].index;
    const int c = corners[2].index;
    const Vec3 normal = (state.position[b] - state.position[a])
                            .cross(state.position[c] - state.position[a]);  // twice the area long
    const Real twice_area = std::sqrt(normal.squaredNorm());
    if (!(twice_area > 0))
    {
      continue;
    }
    const Vec3 velocity = (state.velocity[a] + state.velocity[b] + state.velocity[c]) / Real(3);
    const Real normal_speed = (wind - velocity).dot(normal) / twice_area;
    // Overstretched cloth has grown by its holes: no more than its rest area resists the air.
    const auto area = std::min(twice_area / Real(2), static_cast<Real>(cloth.rest.area[i]));
    const Vec3 on_corner = (drag * normal_speed * area / (Real(3) * twice_area)) * normal;
    for (int p : { a, b, c })
    {
      const Real inverse_mass = state.inverse_mass[p] > 0
                                    ? state.inverse_mass[p]
                                    : static_cast<Real>(1.0 / cloth.rest.mass[p]);
      acceleration[p] += inverse_mass * on_corner;
    }
  }
}

}  // namespace

void outerAccelerations(const Cloth& cloth, const Environment& environment, Vec3Array& acceleration)
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
    addWind(cloth, environment, acceleration);
  }
}

}  // namespace cloth
