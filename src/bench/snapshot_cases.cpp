// Times the copy of the cloth that leaves the core for drawing and measuring.
#include "cases.h"
#include "project_engine.h"

namespace cloth_bench
{

void registerSnapshot()
{
  registerCase("snapshot/100",
               [](benchmark::State& state)
               {
                 const Scene scene = makeScene(SceneKind::HUNG, MeshKind::GRID, 100);
                 const cloth::Simulation simulation =
                     makeSimulation(scene, projectParams(EngineKind::XPBD, scene, 0.0005, 1));
                 for (auto _ : state)
                 {
                   benchmark::DoNotOptimize(simulation.snapshot());
                 }
               })
      ->Repetitions(7)
      ->MinTime(0.05)
      ->Unit(benchmark::kMicrosecond);
}

}  // namespace cloth_bench
