// Claim: a step that tears nothing does not allocate.
#include <gtest/gtest.h>

#include "allocations.h"
#include "scenes.h"

namespace cloth
{
namespace
{

Simulation scene(SolverKind solver, bool lines = false)
{
  SimulationParams params = tearable(solver);
  params.solver.max_substeps = 32;
  params.solver.lines = lines;
  params.contact.floor = true;
  params.contact.floor_height = -0.9;
  const ClothModel flat = sheet(1.0, 1.0, 12, 12);
  Simulation simulation(upright(flat), edgeOf(flat, "top"), params);
  Sphere ball;
  ball.center = Vec3d(0, -0.25, -0.5);
  ball.radius = 0.3;
  simulation.setSpheres({ ball });
  GraspRequest request;
  request.point = Vec3d(0.3, 0, -0.3);
  request.radius = 0.15;
  request.frame.position = request.point;
  DragTarget target;
  target.pose.position = request.point + Vec3d(0, 0.2, 0.1);
  target.linear_speed = 0.05;  // on its way all the time
  simulation.drag(simulation.grasp(request).id, target);
  return simulation;
}

/// Steps on and returns how many allocations a step that tore nothing made at most.
long mostInAStep(Simulation& simulation, int steps)
{
  long most = 0;
  for (int i = 0; i < steps; ++i)
  {
    const long before = allocations;
    const StepReport report = simulation.step();
    const long made = allocations - before;
    EXPECT_TRUE(report.fault.empty()) << report.fault;
    if (report.tears.empty())
    {
      most = std::max(most, made);
    }
  }
  return most;
}

class Allocations : public WithBothSolvers
{
};
INSTANTIATE_TEST_SUITE_P(Step, Allocations, bothSolvers(), solverName);

TEST_P(Allocations, AreCounted)
{
  const long before = allocations;
  const std::vector<int> some(100);
  EXPECT_EQ(allocations - before, 1);
}

TEST_P(Allocations, AreNoneInAStepWithSphereGraspAndFloor)
{
  Simulation simulation = scene(GetParam());
  run(simulation, 500);
  EXPECT_EQ(mostInAStep(simulation, 500), 0);
}

TEST(LineAllocations, AreNoneInAStepWithSphereGraspAndFloor)
{
  Simulation simulation = scene(SolverKind::XPBD, true);
  run(simulation, 500);
  EXPECT_EQ(mostInAStep(simulation, 500), 0);
}

TEST_P(Allocations, AreNoneAtRestAfterTearing)
{
  Simulation simulation = scene(GetParam());
  ThrowRequest thrown;
  thrown.center = Vec3d(0.02, -0.4, -0.4);
  thrown.velocity = Vec3d(0, 8, 0);
  thrown.radius = 0.12;
  thrown.lifetime = 1.0;
  simulation.throwSphere(thrown);
  EXPECT_GT(run(simulation, 3000).size(), 5u);
  EXPECT_EQ(mostInAStep(simulation, 500), 0);
}

}  // namespace
}  // namespace cloth
