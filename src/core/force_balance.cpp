// Sums up the forces of a step.
#include "cloth_tearing/core/force_balance.h"

namespace cloth
{

Vec3d StepForces::byHolder(int particle) const
{
  const Vec3 gained = cloth.state.velocity[particle] - velocity_before[particle];
  const Vec3d rate = gained.cast<double>() / dt;
  return cloth.rest.mass[particle] * (rate - acceleration[particle].cast<double>()) -
         solver.heldForce(particle);
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
    const Vec3 gained = cloth.state.velocity[i] - velocity_before[i];
    sum.momentum_rate += mass / dt * gained.cast<double>();
    sum.weight += mass * gravity;
    sum.air += mass * (acceleration[i].cast<double>() - gravity);
    if (cloth.attachments[i].held())
    {
      (cloth.attachments[i].pinned() ? sum.pin : sum.grasp) += byHolder(i);
    }
  }
  return sum;
}

}  // namespace cloth
