// Times a step of hanging cloth: every engine, scene, mesh, size and number of threads.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "cases.h"
#include "hanging_step.h"
#include "heap.h"
#include "project_engine.h"

namespace cloth_bench
{
namespace
{

constexpr double WARM_UP_TIME = 1.0;     ///< simulated before the first step is timed [s]
constexpr double WARM_UP_UPDATES = 2e7;  ///< but no more steps x particles than that
constexpr double UPDATES = 1.5e6;        ///< timed in a repetition: steps x particles
constexpr int COUNTED_STEPS = 50;        ///< in which allocations are counted
constexpr int SAME_BITS_STEPS = 100;

struct StepCase
{
  EngineKind engine;
  SceneKind scene;
  MeshKind mesh;
  int side;
  int threads;

  std::string name() const
  {
    return "step/" + nameOf(engine) + "/" + nameOf(scene) + "/" + nameOf(mesh) + "/" +
           std::to_string(side) + "/threads:" + std::to_string(threads);
  }
};

/// A cloth that goes on from repetition to repetition.
struct Running
{
  std::unique_ptr<Engine> engine;
  HangingStep step;
  double bytes = 0.0;        ///< on the heap [B]
  double allocations = 0.0;  ///< of operator new in a step
};

int warmUpSteps(const Engine& engine, double time_step)
{
  return static_cast<int>(std::min(WARM_UP_TIME / time_step, WARM_UP_UPDATES / engine.particles()));
}

std::unique_ptr<Running> start(const StepCase& c, const std::string& garment)
{
  auto running = std::make_unique<Running>();
  running->step = hangingStep(c.engine, c.mesh, c.side, garment);
  {
    const Scene scene = makeScene(c.scene, c.mesh, c.side, garment);
    const double before = heapInUse();
    running->engine = makeEngine(c.engine, scene, running->step.time_step, c.threads);
    running->engine->step();
    running->bytes = heapInUse() - before;
  }
  Engine& engine = *running->engine;
  const int warm_up = warmUpSteps(engine, running->step.time_step);
  for (int i = 0; i < warm_up; ++i)
  {
    engine.step();
  }
  const std::int64_t before = allocations();
  const int counted = std::min(warm_up, COUNTED_STEPS);
  for (int i = 0; i < counted; ++i)
  {
    engine.step();
  }
  running->allocations = static_cast<double>(allocations() - before) / std::max(1, counted);
  return running;
}

/// Cloths are made when they are first needed, and kept: repetitions come in random order.
Running& find(const StepCase& c, const std::string& garment)
{
  static std::map<std::string, std::unique_ptr<Running>> all;
  std::unique_ptr<Running>& running = all[c.name()];
  if (!running)
  {
    running = start(c, garment);
  }
  return *running;
}

void timeSteps(benchmark::State& state, const StepCase& c, const std::string& garment)
{
  using benchmark::Counter;
  Running& running = find(c, garment);
  Engine& engine = *running.engine;
  for (auto _ : state)
  {
    engine.step();
  }
  if (!std::isfinite(engine.fastest()))
  {
    state.SkipWithError("the cloth ran away or tore");
    return;
  }
  const double particles = engine.particles();
  state.counters["particles"] = particles;
  state.counters["time_step_ms"] = 1e3 * running.step.time_step;
  state.counters["elongation_p99_percent"] = 100.0 * running.step.elongation;
  state.counters["step_is_scaled"] = running.step.scaled ? 1.0 : 0.0;
  state.counters["bytes_per_particle"] = running.bytes / particles;
  state.counters["allocations_per_step"] = running.allocations;
  state.counters["ns_per_particle"] =
      Counter(1e-9 * particles, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["real_time_factor"] =
      Counter(running.step.time_step, Counter::kIsIterationInvariantRate);
}

/// One thread is timed in its own CPU time, which other processes disturb least; several can only
/// be timed by the clock.
void add(const StepCase& c, const std::string& garment)
{
  const double particles = c.mesh == MeshKind::GARMENT ? 600.0 : double(c.side) * c.side;
  const bool huge = particles > 5e5;
  const int least = huge ? 7 : 20;  // three repetitions of 7 steps are more than 20
  auto* const registered = registerCase(
      c.name(), [c, garment](benchmark::State& state) { timeSteps(state, c, garment); });
  registered->Iterations(std::max(least, static_cast<int>(UPDATES / particles)))
      ->Repetitions(huge ? 3 : 7)
      ->Unit(benchmark::kMicrosecond);
  if (c.threads > 1)
  {
    registered->UseRealTime();
  }
}

void checkBits(benchmark::State& state, int side, const std::vector<int>& threads)
{
  const Scene scene = makeScene(SceneKind::BALL, MeshKind::GRID, side);
  const double time_step = hangingStep(EngineKind::XPBD, MeshKind::GRID, side, "").time_step;
  bool same = true;
  for (auto _ : state)
  {
    std::vector<std::uint64_t> hashes;
    for (int count : threads)
    {
      cloth::Simulation simulation =
          makeSimulation(scene, projectParams(EngineKind::XPBD, scene, time_step, count));
      for (int i = 0; i < SAME_BITS_STEPS; ++i)
      {
        simulation.step();
      }
      hashes.push_back(simulation.stateHash());
    }
    same = std::count(hashes.begin(), hashes.end(), hashes.front()) ==
           static_cast<std::ptrdiff_t>(hashes.size());
  }
  state.counters["same_bits"] = same ? 1.0 : 0.0;
  if (!same)
  {
    state.SkipWithError("the bits depend on the number of threads");
  }
}

}  // namespace

void registerSteps(const Options& options)
{
  constexpr EngineKind OWN[] = { EngineKind::XPBD, EngineKind::XPBD_LINES,
                                 EngineKind::FORCE_SPRINGS };
  constexpr EngineKind PEERS[] = { EngineKind::NAIVE, EngineKind::NAIVE_SCATTERED,
                                   EngineKind::BULLET };
  for (int side : { 30, 100, 300, 1000 })
  {
    for (SceneKind scene : { SceneKind::HUNG, SceneKind::WINDY, SceneKind::BALL })
    {
      for (MeshKind mesh : { MeshKind::GRID, MeshKind::IRREGULAR })
      {
        const bool own_too_slow = side > 300 && mesh == MeshKind::IRREGULAR;
        const bool peer_too_slow = side > 100 && scene != SceneKind::HUNG;
        for (EngineKind engine : OWN)
        {
          const bool lines_too_slow =
              engine == EngineKind::XPBD_LINES && side > 300 && scene != SceneKind::HUNG;
          for (int threads : options.threads)
          {
            if (!own_too_slow && !lines_too_slow)
            {
              add({ engine, scene, mesh, side, threads }, {});
            }
          }
        }
        for (EngineKind engine : PEERS)
        {
          if (isHere(engine) && !peer_too_slow && !own_too_slow)
          {
            add({ engine, scene, mesh, side, 1 }, {});
          }
        }
      }
    }
  }
  for (EngineKind engine : { EngineKind::XPBD, EngineKind::XPBD_LINES, EngineKind::FORCE_SPRINGS,
                             EngineKind::NAIVE, EngineKind::BULLET })
  {
    if (!options.garment.empty() && isHere(engine))
    {
      add({ engine, SceneKind::HUNG, MeshKind::GARMENT, 0, 1 }, options.garment);
    }
  }
}

void registerSameBits(const Options& options)
{
  for (int side : { 30, 100, 300 })
  {
    const std::vector<int> threads = options.threads;
    registerCase("same_bits/" + std::to_string(side),
                 [side, threads](benchmark::State& state) { checkBits(state, side, threads); })
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
  }
}

}  // namespace cloth_bench
