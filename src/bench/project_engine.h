// The parameters with which this project's own solvers are measured.
#pragma once

#include "cloth_tearing/core/simulation.h"
#include "engine.h"

namespace cloth_bench
{

/// With tearing on, at the thresholds of config/cloth.yaml: nothing tears unless it is pulled.
cloth::SimulationParams projectParams(EngineKind kind, const Scene& scene, double time_step,
                                      int threads);

/// At Scene::start, with its ball.
/// @throws cloth::Refusal if the cloth is too soft at this time step
cloth::Simulation makeSimulation(const Scene& scene, const cloth::SimulationParams& params);

}  // namespace cloth_bench
