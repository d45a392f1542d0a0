// Throws balls and judges by geometry what became of it.
#include "cloth_tearing/experiments/ball_experiment.h"

#include <algorithm>
#include <cmath>

namespace cloth
{
namespace
{

constexpr double START = 3.5;   ///< the ball's centre starts so far in front of the cloth [m]
constexpr double ASIDE = 0.03;  ///< off the middle, which may be a symmetry line of the mesh [m]
constexpr double AFTER = 2.0;   ///< watched so long after it has passed as far behind [s]
constexpr int SAMPLE = 10;      ///< contact and utilisation are looked at every so many steps

/// Particles at the lower edge of the untorn cloth.
std::vector<int> hemOf(const Cloth& cloth)
{
  double lowest = 0.0;
  for (const Vec3& x : cloth.state.position)
  {
    lowest = std::min(lowest, static_cast<double>(x.z()));
  }
  std::vector<int> hem;
  for (int i = 0; i < cloth.mesh.particleCount(); ++i)
  {
    if (cloth.mesh.onBorder({ i }) && cloth.state.position[i].z() < 0.97 * lowest)
    {
      hem.push_back(i);
    }
  }
  return hem;
}

bool touches(const Cloth& cloth, const Sphere& ball, double margin)
{
  const double reach = ball.radius + margin;
  return std::any_of(cloth.state.position.begin(), cloth.state.position.end(),
                     [&](const Vec3& x)
                     { return (x.cast<double>() - ball.center).squaredNorm() < reach * reach; });
}

/// Whether the hem, where the ball is, lies above the ball's centre.
bool hemIsAbove(const Cloth& cloth, const std::vector<int>& hem, const Sphere& ball)
{
  return std::any_of(hem.begin(), hem.end(),
                     [&](int i)
                     {
                       const Vec3d x = cloth.state.position[i].cast<double>();
                       return std::abs(x.x() - ball.center.x()) < 0.5 * ball.radius &&
                              x.z() > ball.center.z();
                     });
}

}  // namespace

const std::array<BallThrow, 5> THESIS_THROWS = { {
    { "1: r 0.5, v 3", 0.5, 3.0, 0.68, true },
    { "2: r 1, v 3, low", 1.0, 3.0, 0.15, false },
    { "3: r 1, v 3, high", 1.0, 3.0, 0.80, true },
    { "4: r 2, v 3", 2.0, 3.0, 0.42, false },
    { "5: r 2, v 10", 2.0, 10.0, 0.42, true },
} };

BallOutcome throwBall(Simulation& simulation, const BallThrow& thrown, const Watch& watch)
{
  const std::vector<int> hem = hemOf(simulation.cloth());
  ThrowRequest request;
  request.center = Vec3d(ASIDE, -START, -hangingHeight(simulation) * (1.0 - thrown.height));
  request.velocity = Vec3d(0.0, thrown.speed, 0.0);
  request.radius = thrown.radius;
  request.lifetime = 2.0 * START / thrown.speed + AFTER;
  simulation.throwSphere(request);

  BallOutcome outcome;
  const SimulationParams& params = simulation.params();
  const auto steps = std::lround(request.lifetime / params.solver.time_step);
  for (long i = 0; i < steps; ++i)
  {
    const StepReport report = stepOrThrow(simulation);
    for (const TearEvent& tear : report.tears)
    {
      ++outcome.tears[static_cast<int>(tear.kind)];
    }
    outcome.peak_strain = std::max(outcome.peak_strain, report.max_strain);
    if (i % SAMPLE == 0 && !simulation.spheres().empty())
    {
      const Sphere& ball = simulation.spheres().front();
      outcome.slid =
          outcome.slid || (hemIsAbove(simulation.cloth(), hem, ball) &&
                           touches(simulation.cloth(), ball, 2.0 * params.contact.thickness));
      if (!params.tearing.enabled)
      {
        outcome.peak_utilisation =
            std::max(outcome.peak_utilisation, simulation.summary().utilisation);
      }
    }
    if (watch)
    {
      watch(simulation, report);
    }
  }
  outcome.torn_length = tornLength(simulation.cloth());
  outcome.pieces = simulation.cloth().damage.pieces;
  return outcome;
}

}  // namespace cloth
