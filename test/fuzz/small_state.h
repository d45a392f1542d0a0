// A small simulation in which everything is going on, and its saved states.
#pragma once

#include <string>
#include <vector>

#include "cloth_tearing/core/mesh_builder.h"
#include "cloth_tearing/core/simulation.h"

namespace cloth
{
namespace fuzz
{

/// Three by three particles, held above, in wind, with a gripper that drags and two spheres.
inline Simulation smallSimulation(SolverKind solver, bool lines = false)
{
  RectangleParams rectangle_params;
  rectangle_params.columns = 3;
  rectangle_params.rows = 3;
  rectangle_params.width = 0.2;
  rectangle_params.height = 0.2;
  SimulationParams params;
  params.solver.kind = solver;
  params.solver.lines = lines;
  params.solver.max_substeps = 64;
  params.threads = 1;
  params.environment.wind = Vec3d(0.0, 0.0, 1.0);
  Simulation simulation(rectangle(rectangle_params), { 0, 2 }, params);

  GraspRequest request;
  request.point = Vec3d(0.0, -0.2, 0.0);
  request.radius = 0.1;
  request.frame.position = request.point;
  DragTarget target;
  target.pose.position = Vec3d(0.0, -1.0, 0.2);
  target.linear_speed = 2.0;
  simulation.drag(simulation.grasp(request).id, target);
  Sphere streamed;
  streamed.center = Vec3d(0.1, -0.1, -0.1);
  streamed.radius = 0.05;
  simulation.setSpheres({ streamed });
  ThrowRequest thrown;
  thrown.center = Vec3d(-0.1, -0.1, -0.3);
  thrown.velocity = Vec3d(0.0, 0.0, 5.0);
  thrown.radius = 0.05;
  thrown.mass = 0.1;
  simulation.throwSphere(thrown);
  return simulation;
}

/// What it is like with each solver, at the beginning and when it has torn.
inline std::vector<std::string> smallStates()
{
  constexpr int STEPS = 300;
  std::vector<std::string> states;
  for (Simulation simulation :
       { smallSimulation(SolverKind::XPBD), smallSimulation(SolverKind::XPBD, true),
         smallSimulation(SolverKind::FORCE_SPRINGS) })
  {
    states.push_back(simulation.save());
    while (simulation.stepCount() < STEPS)
    {
      simulation.step();
    }
    states.push_back(simulation.save());
  }
  return states;
}

}  // namespace fuzz
}  // namespace cloth
