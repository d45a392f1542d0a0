// One Gauss-Seidel sweep of compliant distance constraints.
#include "cloth_tearing/core/xpbd.h"

namespace cloth
{
namespace
{

void solve(ParticleState& state, const std::vector<SpringLaw>& springs, Real dt)
{
  for (const SpringLaw& spring : springs)
  {
    if (!spring.active())
    {
      continue;
    }
    const Real wa = state.inverse_mass[spring.a];
    const Real wb = state.inverse_mass[spring.b];
    const Real w = wa + wb;
    Vec3& a = state.position[spring.a];
    Vec3& b = state.position[spring.b];
    const Vec3 d = b - a;
    const Real length = std::sqrt(d.squaredNorm());
    if (!(w > 0) || !(spring.stiffness > 0) || !(length > 0))
    {
      continue;
    }
    const Vec3 n = d / length;
    // compliance and damping of the constraint over this step; see Macklin et al. 2016, eq. 26
    const Real compliance = Real(1) / (spring.stiffness * dt * dt);
    const Real damping = spring.damping / (spring.stiffness * dt);
    const Real stretching = n.dot((b - state.previous[spring.b]) - (a - state.previous[spring.a]));
    const Real lambda =
        ((length - spring.rest) + damping * stretching) / ((Real(1) + damping) * w + compliance);
    a += (wa * lambda) * n;
    b -= (wb * lambda) * n;
  }
}

}  // namespace

std::unique_ptr<Solver> XpbdSolver::clone() const
{
  return std::make_unique<XpbdSolver>(*this);
}

void XpbdSolver::advance(ParticleState& state, const SpringTable& springs,
                         const std::vector<Vec3>& acceleration, double dt)
{
  const auto h = static_cast<Real>(dt);
  for (int i = 0; i < state.size(); ++i)
  {
    if (state.inverse_mass[i] > 0)
    {
      state.position[i] += h * (state.velocity[i] + h * acceleration[i]);
    }
  }
  solve(state, springs.structural, h);
  solve(state, springs.bend_shear, h);
  for (int i = 0; i < state.size(); ++i)
  {
    if (state.inverse_mass[i] > 0)
    {
      state.velocity[i] = (state.position[i] - state.previous[i]) / h;
    }
  }
}

void XpbdSolver::limitStrain(ParticleState&, const SpringTable&)
{
}

Stability XpbdSolver::checkStability(const ParticleState&, const SpringTable&, double)
{
  return {};
}

}  // namespace cloth
