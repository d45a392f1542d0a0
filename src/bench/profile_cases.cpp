// Times the thesis' cloth of 4.3: while it is torn some 500 times, and afterwards.
#include <memory>

#include "cases.h"
#include "cloth_tearing/experiments/profile_experiment.h"

namespace cloth_bench
{
namespace
{

constexpr double FAR = 1000.0;  ///< pieces that fall are still stepped so far away [m]
constexpr int STEPS = 500;      ///< timed in a repetition

const cloth::Simulation& hungCloth()
{
  static const cloth::Simulation hung = cloth::profileCloth(cloth::Setting{});
  return hung;
}

void timeProfile(benchmark::State& state)
{
  cloth::ProfileOutcome outcome;
  for (auto _ : state)
  {
    cloth::Simulation simulation = hungCloth();
    outcome = cloth::profile(simulation);
    state.SetIterationTime(outcome.update());
  }
  const auto edit = static_cast<int>(cloth::StepPhase::EDIT);
  state.counters["tears"] = outcome.tears();
  state.counters["tearing_percent"] = 100.0 * (outcome.detecting() + outcome.editing());
  state.counters["us_per_tear"] = 1e6 * outcome.time[edit] / outcome.tears();
  state.counters["real_time_factor"] = cloth::PROFILE_TIME / outcome.update();
}

/// The same cloth, torn; every piece of it is still stepped.
cloth::Simulation tornCloth()
{
  cloth::Simulation simulation = hungCloth();
  cloth::Tuning tuning = cloth::tuningOf(simulation.params());
  tuning.contact.bounds_min = cloth::Vec3d::Constant(-FAR);
  tuning.contact.bounds_max = cloth::Vec3d::Constant(FAR);
  simulation.tune(tuning);
  cloth::profile(simulation);
  simulation.releaseAll();
  return simulation;
}

void timeAfterTears(benchmark::State& state, bool torn)
{
  static std::unique_ptr<cloth::Simulation> cloths[2];
  std::unique_ptr<cloth::Simulation>& simulation = cloths[torn ? 1 : 0];
  if (!simulation)
  {
    simulation = std::make_unique<cloth::Simulation>(torn ? tornCloth() : hungCloth());
  }
  for (auto _ : state)
  {
    simulation->step();
  }
  const double particles = simulation->cloth().state.size();
  state.counters["particles"] = particles;
  state.counters["tears"] = static_cast<double>(simulation->revision());
  state.counters["pieces_at_rest"] = simulation->cloth().damage.pieces_at_rest;
  state.counters["ns_per_particle"] =
      benchmark::Counter(1e-9 * particles, benchmark::Counter::kIsIterationInvariantRate |
                                               benchmark::Counter::kInvert);
}

}  // namespace

void registerProfile()
{
  registerCase("profile/30", timeProfile)
      ->Iterations(1)
      ->UseManualTime()
      ->Repetitions(5)
      ->Unit(benchmark::kMillisecond);
  for (bool torn : { false, true })
  {
    registerCase(torn ? "after_tears/torn" : "after_tears/untorn",
                 [torn](benchmark::State& state) { timeAfterTears(state, torn); })
        ->Iterations(STEPS)
        ->Repetitions(7)
        ->Unit(benchmark::kMicrosecond);
  }
}

}  // namespace cloth_bench
