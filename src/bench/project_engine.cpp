// This project's two solvers as engines of the benchmark.
#include "project_engine.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace cloth_bench
{
namespace
{

using cloth::SolverKind;
using cloth::Vec3;

class ProjectEngine : public Engine
{
public:
  explicit ProjectEngine(cloth::Simulation simulation) : simulation_(std::move(simulation)) {}

  void step() override
  {
    const cloth::StepReport report = simulation_.step();
    failed_ = failed_ || !report.fault.empty() || !report.tears.empty();
  }

  int particles() const override { return simulation_.cloth().state.size(); }

  std::vector<double> strains() const override
  {
    const cloth::Cloth& cloth = simulation_.cloth();
    std::vector<double> strains;
    for (int i = 0; i < cloth.mesh.springCount(); ++i)
    {
      strains.push_back(cloth.strain({ i }));
    }
    return strains;
  }

  double fastest() const override
  {
    if (failed_)
    {
      return std::numeric_limits<double>::infinity();
    }
    double fastest = 0.0;
    for (int i = 0; i < particles(); ++i)
    {
      fastest = std::max(fastest, double(simulation_.cloth().state.velocity[i].norm()));
    }
    return fastest;
  }

private:
  cloth::Simulation simulation_;
  bool failed_ = false;  ///< it ran away, or is whole no longer
};

}  // namespace

cloth::SimulationParams projectParams(EngineKind kind, const Scene& scene, double time_step,
                                      int threads)
{
  cloth::SimulationParams params;
  params.solver.kind =
      kind == EngineKind::FORCE_SPRINGS ? SolverKind::FORCE_SPRINGS : SolverKind::XPBD;
  params.solver.lines = kind == EngineKind::XPBD_LINES;
  params.solver.time_step = time_step;
  params.material = scene.material;
  params.environment = scene.environment;
  params.solver.max_substeps = 64;  // one that needs more than one is found out
  params.threads = threads;
  return params;
}

cloth::Simulation makeSimulation(const Scene& scene, const cloth::SimulationParams& params)
{
  cloth::Simulation simulation(scene.model, scene.pinned, params);
  std::vector<Vec3> start;
  for (const cloth::Vec3d& x : scene.start)
  {
    start.push_back(x.cast<cloth::Real>());
  }
  simulation.place(start);
  if (scene.ball)
  {
    cloth::Sphere sphere;
    sphere.center = scene.ball->center;
    sphere.radius = scene.ball->radius;
    simulation.setSpheres({ sphere });
  }
  return simulation;
}

std::unique_ptr<Engine> makeProjectEngine(EngineKind kind, const Scene& scene, double time_step,
                                          int threads)
{
  cloth::Simulation simulation =
      makeSimulation(scene, projectParams(kind, scene, time_step, threads));
  const int substeps = simulation.summary().substeps;
  if (substeps > 1)
  {
    throw std::runtime_error("the force springs take " + std::to_string(substeps) +
                             " substeps a step: the time step is too long for one");
  }
  return std::make_unique<ProjectEngine>(std::move(simulation));
}

}  // namespace cloth_bench
