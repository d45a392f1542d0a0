// Sums up the forces of a step.
#include "cloth_tearing/core/force_balance.h"

namespace cloth
{

int StepForces::origin(int particle) const
{
  while (particle >= static_cast<int>(velocity_before.size()))
  {
    particle = cloth.damage.parents[particle][0];
  }
  return particle;
}

Vec3d StepForces::byHolder(int particle) const
{
  const int before = origin(particle);
  const Vec3 gained = cloth.state.velocity[particle] - velocity_before[before];
  const Vec3d rate = gained.cast<double>() / dt;
  const Vec3d free = cloth.rest.mass[particle] * (rate - acceleration[before].cast<double>());
  return before == particle ? Vec3d(free - solver.heldForce(particle)) : free;
}

ForceBalance StepForces::balance() const
{
  ForceBalance sum;
  sum.contact = contact / dt;
  sum.limiter = solver.addedImpulse() / dt;
  for (int i = 0; i < cloth.state.size(); ++i)
  {
    if (cloth.damage.at_rest[i])
    {
      continue;
    }
    const double mass = cloth.rest.mass[i];
    const int before = origin(i);
    const Vec3 gained = cloth.state.velocity[i] - velocity_before[before];
    sum.momentum_rate += mass / dt * gained.cast<double>();
    sum.weight += mass * gravity;
    sum.air += mass * (acceleration[before].cast<double>() - gravity);
    if (cloth.attachments[i].held())
    {
      (cloth.attachments[i].pinned() ? sum.pin : sum.grasp) += byHolder(i);
    }
  }
  return sum;
}

}  // namespace cloth
