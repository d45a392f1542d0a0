// Throws balls and judges by geometry what became of them.
#include "cloth_tearing/experiments/ball_experiment.h"

#include <algorithm>
#include <cmath>

namespace cloth
{
namespace
{

constexpr double AFTER = 2.0;   ///< watched so long after a ball has passed as far behind [s]
constexpr int SAMPLE = 10;      ///< contact is looked at every so many steps
constexpr int PEAK_SAMPLE = 5;  ///< and strain every so many

/// Particles at the lower edge of the material, copies among them.
std::vector<int> hemOf(const Cloth& cloth)
{
  std::vector<int> hem;
  for (int t = 0; t < cloth.mesh.triangleCount(); ++t)
  {
    const Triangle& triangle = cloth.mesh.triangle({ t });
    for (int k = 0; k < 3; ++k)
    {
      if (triangle.uv[k].y() < 1e-9)
      {
        hem.push_back(triangle.particles[k].index);
      }
    }
  }
  std::sort(hem.begin(), hem.end());
  hem.erase(std::unique(hem.begin(), hem.end()), hem.end());
  return hem;
}

bool touches(const Cloth& cloth, const Sphere& ball, double margin)
{
  const double reach = ball.radius + margin;
  return std::any_of(cloth.state.position.begin(), cloth.state.position.end(),
                     [&](const Vec3& x)
                     { return (x.cast<double>() - ball.center).squaredNorm() < reach * reach; });
}

/// Whether the hem, where the ball is, lies above the ball's centre while they touch.
bool slides(const Cloth& cloth, const Sphere& ball, double margin)
{
  const std::vector<int> hem = hemOf(cloth);
  const auto above = [&](int i)
  {
    const Vec3d x = cloth.state.position[i].cast<double>();
    return std::abs(x.x() - ball.center.x()) < 0.5 * ball.radius && x.z() > ball.center.z();
  };
  return std::any_of(hem.begin(), hem.end(), above) && touches(cloth, ball, margin);
}

double lifetime(const BallThrow& thrown)
{
  return 2.0 * BALL_START / thrown.speed + AFTER;
}

std::uint64_t start(Simulation& simulation, const BallThrow& thrown, double hanging_height)
{
  ThrowRequest request;
  request.center = Vec3d(thrown.aside, -BALL_START, -hanging_height * (1.0 - thrown.height));
  request.velocity = Vec3d(0.0, thrown.speed, 0.0);
  request.radius = thrown.radius;
  request.lifetime = lifetime(thrown);
  return simulation.throwSphere(request);
}

/// Keeps for each ball what it does to the cloth.
class BallWatch
{
public:
  explicit BallWatch(std::size_t balls) : outcomes_(balls) {}

  std::size_t thrown() const { return ids_.size(); }
  void add(std::uint64_t id) { ids_.push_back(id); }

  void count(const StepReport& report)
  {
    peak_strain_ = std::max(peak_strain_, report.max_strain);
    for (const TearEvent& tear : report.tears)
    {
      ++outcomes_[ballOf(tear)].tears[static_cast<int>(tear.kind)];
    }
  }

  void look(const Simulation& simulation)
  {
    const double margin = 2.0 * simulation.params().contact.thickness;
    for (const Sphere& ball : simulation.spheres())
    {
      bool& slid = outcomes_[indexOf(ball.id)].slid;
      slid = slid || slides(simulation.cloth(), ball, margin);
    }
  }

  std::vector<BallOutcome> outcomes(const Cloth& cloth) const
  {
    std::vector<BallOutcome> outcomes = outcomes_;
    for (BallOutcome& outcome : outcomes)
    {
      outcome.peak_strain = peak_strain_;
      outcome.torn_length = tornLength(cloth);
      outcome.pieces = cloth.damage.pieces;
    }
    return outcomes;
  }

private:
  std::size_t indexOf(std::uint64_t id) const
  {
    return std::find(ids_.begin(), ids_.end(), id) - ids_.begin();
  }

  /// The ball that is nearest to a tear; the last one thrown if they are all gone.
  std::size_t ballOf(const TearEvent& tear) const
  {
    const std::size_t index = indexOf(tear.cause.id);
    const bool by_ball = tear.cause.kind == CauseKind::THROWN_SPHERE && index < ids_.size();
    return by_ball ? index : ids_.size() - 1;
  }

  std::vector<BallOutcome> outcomes_;
  std::vector<std::uint64_t> ids_;  ///< of the balls thrown so far
  double peak_strain_ = 0.0;
};

}  // namespace

const std::array<BallThrow, 5> THESIS_THROWS = { {
    { "1: r 0.5, v 3", 0.5, 3.0, 0.68, true },
    { "2: r 1, v 3, low", 1.0, 3.0, 0.15, false },
    { "3: r 1, v 3, high", 1.0, 3.0, 0.80, true },
    { "4: r 2, v 3", 2.0, 3.0, 0.42, false },
    { "5: r 2, v 10", 2.0, 10.0, 0.42, true },
} };

const std::array<BallThrow, 3> THREE_BALLS = { {
    { "figure 4.1, middle", 0.5, 3.0, 0.60, true, 0.03 },
    { "figure 4.1, left", 0.5, 3.0, 0.66, true, -1.5 },
    { "figure 4.1, right", 0.5, 3.0, 0.66, true, 1.5 },
} };

const char* BallOutcome::inWords() const
{
  return toreThrough() ? "torn through" : total() == 0 ? "not torn" : "torn, not through";
}

std::vector<BallOutcome> throwBalls(Simulation& simulation, const std::vector<BallThrow>& throws,
                                    double interval, const Watch& watch)
{
  const double dt = simulation.params().solver.time_step;
  const double hanging_height = hangingHeight(simulation);
  const auto stepsIn = [&](double time) { return std::lround(time / dt); };
  const long steps = stepsIn((throws.size() - 1) * interval + lifetime(throws.back()));
  BallWatch balls(throws.size());
  for (long i = 0; i < steps; ++i)
  {
    if (balls.thrown() < throws.size() && i == stepsIn(balls.thrown() * interval))
    {
      balls.add(start(simulation, throws[balls.thrown()], hanging_height));
    }
    const StepReport report = stepOrThrow(simulation);
    balls.count(report);
    if (i % SAMPLE == 0)
    {
      balls.look(simulation);
    }
    if (watch)
    {
      watch(simulation, report);
    }
  }
  return balls.outcomes(simulation.cloth());
}

BallOutcome throwBall(Simulation& simulation, const BallThrow& thrown, const Watch& watch)
{
  return throwBalls(simulation, { thrown }, 0.0, watch).front();
}

BallPeaks peaksOf(Simulation& simulation, const BallThrow& thrown)
{
  TearRules off = simulation.params().tearing;
  off.enabled = false;
  simulation.setTearRules(off);
  // With thresholds of 1 a utilisation is the strain that was read, over the hem's factor.
  TearRules patch = off;
  patch.tear_strain = 1.0;
  TearRules local_hem = patch;
  local_hem.tear_radius = 0.0;
  Tearing reading_patch(patch);
  Tearing reading_local(local_hem);

  BallPeaks peaks;
  long steps = 0;
  const BallOutcome outcome = throwBall(
      simulation, thrown,
      [&](const Simulation& now, const StepReport&)
      {
        if (++steps % PEAK_SAMPLE == 0)
        {
          peaks.patch = std::max(peaks.patch, reading_patch.worst(now.cloth()).utilisation());
          peaks.local_hem =
              std::max(peaks.local_hem, reading_local.worst(now.cloth()).utilisation());
        }
      });
  peaks.local = outcome.peak_strain;
  return peaks;
}

}  // namespace cloth
