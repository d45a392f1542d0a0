// Chapter 4's parameters, sheet and settling.
#include "cloth_tearing/experiments/thesis_world.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace cloth
{

SimulationParams thesisParams(const Setting& setting)
{
  SimulationParams params;
  params.solver.kind = setting.solver;
  params.solver.time_step = setting.time_step;
  params.solver.lines = setting.lines;
  params.solver.max_strain = 0.1;
  params.material.areal_density = 0.1;
  params.material.stiffness = 150.0;
  params.material.bend_shear_stiffness = 30.0;
  params.material.damping = 0.02;
  params.environment.gravity = Vec3d(0.0, 0.0, -9.8);
  params.environment.air_friction = 0.4;
  params.environment.wind_drag = 0.0;
  params.contact.friction = 0.0;
  params.contact.thickness = 0.01;
  params.max_grasp_distance = 0.5;

  TearRules& rules = params.tearing;
  rules.tear_radius = 0.3;
  rules.tear_strain = 0.145;
  rules.weak_tear_strain = 0.126;
  rules.one_point_tear_strain = 0.126;
  rules.crack_length = 0.8;
  rules.hem_factor = 2.0;
  rules.hem_width = 0.6;
  if (setting.solver == SolverKind::FORCE_SPRINGS)
  {
    params.material.stiffness_law = StiffnessLaw::PER_SPRING;
    rules.tear_radius = 0.0;
    rules.tear_strain = 0.145;
    rules.weak_tear_strain = 0.12;
    rules.one_point_tear_strain = 0.12;
    rules.crack_length = 0.0;
    rules.hem_factor = 1.0;
  }
  return params;
}

RectangleParams thesisSheet(const Setting& setting)
{
  RectangleParams sheet;
  sheet.width = thesisSheetSize().x();
  sheet.height = thesisSheetSize().y();
  sheet.columns = setting.resolution;
  sheet.rows = setting.resolution;
  sheet.pattern = setting.pattern;
  sheet.seed = setting.seed;
  sheet.grading = setting.grading;
  return sheet;
}

Simulation hungSheet(const RectangleParams& sheet, const SimulationParams& params)
{
  ClothModel model = rectangle(sheet);
  std::vector<int> upper_edge;
  for (std::size_t i = 0; i < model.positions.size(); ++i)
  {
    Vec3d& x = model.positions[i];
    if (x.y() == 0.0)
    {
      upper_edge.push_back(static_cast<int>(i));
    }
    x = Vec3d(x.x(), -x.z(), x.y());
  }
  return Simulation(model, upper_edge, params);
}

void settle(Simulation& simulation, double seconds)
{
  const TearRules rules = simulation.params().tearing;
  TearRules off = rules;
  off.enabled = false;
  simulation.setTearRules(off);
  const auto steps = std::lround(seconds / simulation.params().solver.time_step);
  for (long i = 0; i < steps; ++i)
  {
    stepOrThrow(simulation);
  }
  simulation.setTearRules(rules);
}

Simulation hungCloth(const Setting& setting)
{
  Simulation simulation = hungSheet(thesisSheet(setting), thesisParams(setting));
  settle(simulation, HANGS_STILL);
  return simulation;
}

double hangingHeight(const Simulation& simulation)
{
  double lowest = 0.0;
  for (const Vec3& x : simulation.cloth().state.position)
  {
    lowest = std::min(lowest, static_cast<double>(x.z()));
  }
  return -lowest;
}

StepReport stepOrThrow(Simulation& simulation)
{
  StepReport report = simulation.step();
  if (!report.fault.empty())
  {
    throw std::runtime_error(report.fault);
  }
  return report;
}

double tornLength(const Cloth& cloth)
{
  double length = 0.0;
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    const bool torn = cloth.mesh.spring({ i }).border() && !cloth.damage.outer[i];
    length += torn ? cloth.rest.length[i] : 0.0;
  }
  return length;
}

}  // namespace cloth
