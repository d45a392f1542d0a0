// Drags one place of the cloth after the other, and times the parts of each step.
#include "cloth_tearing/experiments/profile_experiment.h"

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "cloth_tearing/experiments/pull.h"

namespace cloth
{
namespace
{

constexpr double PULL_INTERVAL = 0.34;  ///< from a grasp to the next [s]
constexpr double PULL_TIME = 0.3;       ///< a place is pulled for so long at most [s]
constexpr int PULL_TEARS = 8;           ///< after so many tears a place is let go
constexpr double PULL_SPEED = 4.0;      ///< [m/s]
constexpr double GRASP_RADIUS = 0.25;   ///< about one spacing [m]
constexpr double HIGHEST = 0.8;         ///< place of the last pull over the height of the cloth [-]

/// Times the phases of steps on the steady clock.
class PhaseClock : public StepObserver
{
public:
  void enter(StepPhase phase) override
  {
    const auto now = std::chrono::steady_clock::now();
    if (phase != StepPhase::CARRY)
    {
      time_[static_cast<int>(phase_)] += std::chrono::duration<double>(now - since_).count();
    }
    phase_ = phase;
    since_ = now;
  }

  const std::array<double, STEP_PHASES>& time() const { return time_; }

private:
  std::array<double, STEP_PHASES> time_{};  ///< [s]
  StepPhase phase_ = StepPhase::CARRY;
  std::chrono::steady_clock::time_point since_;
};

/// Where pull `number` takes hold, on the texture: rising, and jumping about from side to side by
/// the golden section.
Vec2d placeOf(int number)
{
  const double across = 0.5 + 0.6180339887498949 * number;
  return { across - std::floor(across), HIGHEST * number * PULL_INTERVAL / PROFILE_TIME };
}

/// Towards the front and to one of eight sides.
Vec3d directionOf(int number)
{
  static const double SIDES[8][2] = { { 1, 0 },  { -1, -1 }, { 0, 1 },  { 1, -1 },
                                      { -1, 0 }, { 1, 1 },   { 0, -1 }, { -1, 1 } };
  const double* const side = SIDES[number % 8];
  return Vec3d(side[0], -1.0, side[1]).normalized();
}

Pull pullAt(int number)
{
  Pull pull;
  pull.place = placeOf(number);
  pull.way = PULL_SPEED * PULL_TIME * directionOf(number);
  pull.speed = PULL_SPEED;
  pull.radius = GRASP_RADIUS;
  return pull;
}

/// Takes hold and lets go, between steps.
class Hand
{
public:
  explicit Hand(Simulation& simulation) : simulation_(simulation) {}

  void act()
  {
    const double since = simulation_.time() - start_ - pulls_ * PULL_INTERVAL;
    if (since > -0.5 * simulation_.params().solver.time_step)
    {
      simulation_.releaseAll();
      tears_before_ = simulation_.revision();
      beginPull(simulation_, pullAt(pulls_++));
    }
    else if (since > PULL_TIME - PULL_INTERVAL ||
             simulation_.revision() >= tears_before_ + PULL_TEARS)
    {
      simulation_.releaseAll();
    }
  }

private:
  Simulation& simulation_;
  double start_ = simulation_.time();  ///< [s]
  int pulls_ = 0;
  std::uint64_t tears_before_ = 0;
};

double sum(const std::array<double, STEP_PHASES>& times)
{
  double sum = 0.0;
  for (double time : times)
  {
    sum += time;
  }
  return sum;
}

}  // namespace

int ProfileOutcome::tears() const
{
  return static_cast<int>(after.revision - before.revision);
}

double ProfileOutcome::update() const
{
  return sum(time);
}

double ProfileOutcome::detecting() const
{
  return time[static_cast<int>(StepPhase::DETECT)] / update();
}

double ProfileOutcome::editing() const
{
  return time[static_cast<int>(StepPhase::EDIT)] / update();
}

bool ProfileOutcome::hasThesisCounts() const
{
  return before.particles == 900 && before.springs == 2581 && before.bend_shear_springs == 2465 &&
         before.triangles == 1682;
}

bool ProfileOutcome::hasThesisTears() const
{
  return tears() >= 400 && tears() <= 650;
}

Simulation profileCloth(const Setting& setting)
{
  SimulationParams params = thesisParams(setting);
  params.environment.wind = Vec3d(0.5, 2.0, 0.0);
  params.environment.wind_drag = 0.05;
  Simulation simulation = hungSheet(thesisSheet(setting), params);
  settle(simulation, HANGS_STILL);
  return simulation;
}

ProfileOutcome profile(Simulation& simulation, const Watch& watch)
{
  ProfileOutcome outcome;
  outcome.before = simulation.summary();
  PhaseClock clock;
  Hand hand(simulation);
  const auto steps = std::lround(PROFILE_TIME / simulation.params().solver.time_step);
  const double start = simulation.time();
  double torn_until = 0.0;  // the end of the last second in which something tore
  for (long i = 0; i < steps; ++i)
  {
    hand.act();
    const StepReport report = simulation.step(&clock);
    if (!report.fault.empty())
    {
      throw std::runtime_error(report.fault);
    }
    const double now = simulation.time() - start;
    if (!report.tears.empty() && now > torn_until)
    {
      torn_until = std::ceil(now);
      outcome.torn_time += 1.0;
    }
    if (watch)
    {
      watch(simulation, report);
    }
  }
  outcome.after = simulation.summary();
  outcome.time = clock.time();
  return outcome;
}

}  // namespace cloth
