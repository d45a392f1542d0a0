// One Gauss-Seidel sweep of compliant distance constraints.
#include "cloth_tearing/core/xpbd.h"

#include <algorithm>

namespace cloth
{
namespace
{

/// Adds a pull to those ends of a spring that do not move. Not inlined: few springs have any, and
/// the sweep is to stay lean.
[[gnu::noinline]] void noteHeld(const SpringLaw& spring, const ParticleState& state,
                                const Vec3& pull, Vec3Array& held)
{
  if (state.inverse_mass[spring.a] == 0)
  {
    held[spring.a] += pull;
  }
  if (state.inverse_mass[spring.b] == 0)
  {
    held[spring.b] -= pull;
  }
}

/// Moves `displacement`, the way of each particle since the start of the step. Lengths and speeds
/// come from ways, not from differences of places: these are too coarse for a short step.
/// @param see told of each spring's index and its squared length, when the step began or when its
/// turn came, whichever was longer
/// @param held gathers the pulls on particles that do not move, to be divided by dt^2 [kg m]
template <class See>
void solve(const ParticleState& state, const std::vector<SpringLaw>& springs, Real dt,
           Vec3Array& displacement, Vec3Array& held, const See& see)
{
  for (std::size_t i = 0; i < springs.size(); ++i)
  {
    const SpringLaw& spring = springs[i];
    if (!spring.active())
    {
      continue;
    }
    const Real wa = state.inverse_mass[spring.a];
    const Real wb = state.inverse_mass[spring.b];
    const Real w = wa + wb;
    auto a = displacement[spring.a];
    auto b = displacement[spring.b];
    const Vec3 moved = b - a;
    const Vec3 before = state.previous[spring.b] - state.previous[spring.a];
    const Vec3 d = before + moved;
    const Real squared = d.squaredNorm();
    see(i, std::max(before.squaredNorm(), squared));
    const Real length = std::sqrt(squared);
    if (!(length > 0))
    {
      continue;
    }
    // Macklin et al. 2016, eq. 26, times stiffness dt^2: no compliance to divide by.
    const Real stiffness = spring.stiffness * dt * dt;
    const Real damping = spring.damping * dt;
    const Real lambda = (stiffness * (length - spring.rest) + damping * (d.dot(moved) / length)) /
                        ((stiffness + damping) * w + Real(1));
    const Real pull = lambda / length;
    if (!(wa > 0 && wb > 0))
    {
      noteHeld(spring, state, pull * d, held);
    }
    a += (wa * pull) * d;
    b -= (wb * pull) * d;
  }
}

}  // namespace

std::unique_ptr<Solver> XpbdSolver::clone() const
{
  return std::make_unique<XpbdSolver>(*this);
}

void XpbdSolver::advance(ParticleState& state, const SpringTable& springs,
                         const Vec3Array& acceleration, double dt)
{
  const auto h = static_cast<Real>(dt);
  displacement_.resize(state.size());
  held_.resize(state.size());
  held_scale_ = 1.0 / (dt * dt);
  for (int i = 0; i < state.size(); ++i)
  {
    if (state.inverse_mass[i] > 0)
    {
      displacement_[i] = h * (state.velocity[i] + h * acceleration[i]);
    }
    else
    {
      displacement_[i] = state.position[i] - state.previous[i];
      held_[i].setZero();
    }
  }
  clearNotes(springs.structural.size());
  solve(state, springs.structural, h, displacement_, held_,
        [&](std::size_t i, Real squared) { note(i, springs.structural[i].rest, squared); });
  solve(state, springs.bend_shear, h, displacement_, held_, [](std::size_t, Real) {});
  for (int i = 0; i < state.size(); ++i)
  {
    if (state.inverse_mass[i] > 0)
    {
      state.position[i] = state.previous[i] + displacement_[i];
      state.velocity[i] = displacement_[i] / h;
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
