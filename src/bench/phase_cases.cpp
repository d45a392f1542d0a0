// Times the parts of a step of hanging cloth.
#include <algorithm>
#include <array>
#include <numeric>

#include "cases.h"
#include "hanging_step.h"
#include "phase_times.h"
#include "project_engine.h"

namespace cloth_bench
{
namespace
{

constexpr double UPDATES = 3e6;       ///< timed: steps x particles
constexpr double WARM_UP = 3e6;       ///< and before that, at most WARM_UP_TIME
constexpr double WARM_UP_TIME = 1.0;  ///< [s]
constexpr int REPETITIONS = 5;

const char* const NAMES[cloth::STEP_PHASES] = { "carry",  "advance", "limit", "contact",
                                                "detect", "check",   "edit" };

void timePhases(benchmark::State& state, EngineKind engine, SceneKind kind, int side)
{
  const Scene scene = makeScene(kind, MeshKind::GRID, side);
  const double time_step = hangingStep(engine, MeshKind::GRID, side, "").time_step;
  cloth::Simulation simulation = makeSimulation(scene, projectParams(engine, scene, time_step, 1));
  const double particles = static_cast<double>(side) * side;
  for (double i = 0.0; i < std::min(WARM_UP / particles, WARM_UP_TIME / time_step); ++i)
  {
    simulation.step();
  }
  PhaseTimes times;
  std::array<double, cloth::STEP_PHASES> sums{};
  for (auto _ : state)
  {
    simulation.step(&times);
    for (int i = 0; i < cloth::STEP_PHASES; ++i)
    {
      sums[i] += times.of(static_cast<cloth::StepPhase>(i));
    }
  }
  const double all = std::accumulate(sums.begin(), sums.end(), 0.0);
  for (int i = 0; i < cloth::STEP_PHASES; ++i)
  {
    state.counters[std::string(NAMES[i]) + "_percent"] = 100.0 * sums[i] / all;
  }
}

}  // namespace

void registerPhases()
{
  for (EngineKind engine : { EngineKind::XPBD, EngineKind::FORCE_SPRINGS })
  {
    for (SceneKind scene : { SceneKind::HUNG, SceneKind::WINDY, SceneKind::BALL })
    {
      for (int side : { 30, 100, 300 })
      {
        registerCase("phases/" + nameOf(engine) + "/" + nameOf(scene) + "/" + std::to_string(side),
                     [=](benchmark::State& state) { timePhases(state, engine, scene, side); })
            ->Iterations(static_cast<int>(UPDATES / side / side))
            ->Repetitions(REPETITIONS)
            ->Unit(benchmark::kMicrosecond);
      }
    }
  }
}

}  // namespace cloth_bench
