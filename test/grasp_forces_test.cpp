// Claims of forces: what a grasp feels, and that the forces on the cloth add up.
#include <gtest/gtest.h>

#include "scenes.h"

namespace cloth
{
namespace
{

using GraspForces = WithBothSolvers;

/// Takes hold of what is within `radius` of `point`.
std::uint64_t take(Simulation& simulation, const Vec3d& point, double radius)
{
  GraspRequest request;
  request.point = point;
  request.radius = radius;
  request.frame.position = point;
  return simulation.grasp(request).id;
}

const Grasp& graspOf(const Simulation& simulation, std::uint64_t id)
{
  const auto& all = simulation.grasps();
  return *std::find_if(all.begin(), all.end(), [id](const Grasp& g) { return g.id == id; });
}

Vec3d weightOf(const Simulation& simulation)
{
  return simulation.summary().mass * simulation.params().environment.gravity;
}

Vec3d sumOf(const ForceBalance& b)
{
  return b.grasp + b.pin + b.contact + b.limiter + b.weight + b.air;
}

/// Air thick enough for cloth to come to rest soon, and a limiter that is out of the way.
SimulationParams calm(SolverKind solver)
{
  SimulationParams params = untearable(solver);
  params.environment.air_friction = 5.0;
  params.solver.max_strain = 0.5;
  return params;
}

TEST_P(GraspForces, OfTwoGraspsCarryTheWeightOfAHangingCloth)
{
  Simulation simulation(upright(sheet(0.5, 0.5, 11, 11)), {}, calm(GetParam()));
  const std::uint64_t left = take(simulation, Vec3d(-0.25, 0.0, 0.0), 0.06);
  const std::uint64_t right = take(simulation, Vec3d(0.25, 0.0, 0.0), 0.06);
  int limited = 0;
  for (int i = 0; i < 6000; ++i)
  {
    run(simulation, 1);
    limited += simulation.limitedSprings();
  }
  EXPECT_EQ(limited, 0) << "the limiter did not act";

  const Vec3d carried = graspOf(simulation, left).smoothed.force +  // the cloth pulls down on them
                        graspOf(simulation, right).smoothed.force;
  const Vec3d weight = weightOf(simulation);
  EXPECT_LT((carried - weight).norm(), 0.01 * weight.norm()) << carried.transpose();
  EXPECT_LT(
      (graspOf(simulation, left).wrench.force + graspOf(simulation, right).wrench.force - weight)
          .norm(),
      0.01 * weight.norm())
      << "in a single step too";
  EXPECT_GT(graspOf(simulation, left).wrench.force.x(), 0.0) << "and it sags between them";
}

TEST_P(GraspForces, OfTwoGrippersThatPullAStripAreEqualAndOpposite)
{
  SimulationParams params = calm(GetParam());
  params.environment = vacuum().environment;  // no weight
  Simulation simulation(sheet(0.4, 0.1, 17, 5), {}, params);
  const std::uint64_t left = take(simulation, Vec3d(-0.2, -0.05, 0.0), 0.06);
  const std::uint64_t right = take(simulation, Vec3d(0.2, -0.05, 0.0), 0.06);
  DragTarget target;
  target.linear_speed = 0.05;
  target.pose.position = Vec3d(0.22, -0.05, 0.0);
  simulation.drag(right, target);
  int limited = 0;
  for (int i = 0; i < 4000; ++i)
  {
    run(simulation, 1);
    limited += simulation.limitedSprings();
  }
  EXPECT_EQ(limited, 0) << "the limiter did not act";

  const Vec3d a = graspOf(simulation, left).smoothed.force;
  const Vec3d b = graspOf(simulation, right).smoothed.force;
  EXPECT_GT(a.x(), 0.1) << "the strip draws it to the middle";
  EXPECT_LT((a + b).norm(), 0.01 * a.norm()) << a.transpose() << " and " << b.transpose();
}

TEST_P(GraspForces, OfTwoGrippersThatMeetInASpringAreItsOwn)
{
  // All four particles are held: what is between them is stretched all the same.
  SimulationParams params = calm(GetParam());
  params.environment = vacuum().environment;
  Simulation simulation(sheet(0.1, 0.1, 2, 2), {}, params);
  const std::uint64_t left = take(simulation, Vec3d(-0.05, -0.05, 0.0), 0.06);
  const std::uint64_t right = take(simulation, Vec3d(0.05, -0.05, 0.0), 0.06);
  DragTarget target;
  target.pose.position = Vec3d(0.06, -0.05, 0.0);
  simulation.drag(right, target);
  run(simulation, 500);

  Vec3d pull = Vec3d::Zero();  // of all springs between the left particles and the right ones
  const Cloth& cloth = simulation.cloth();
  for (const auto* table : { &cloth.springs.structural, &cloth.springs.bend_shear })
  {
    for (const SpringLaw& law : *table)
    {
      if (law.active())
      {
        const bool a_left = cloth.state.position[law.a].x() < 0;
        const bool b_left = cloth.state.position[law.b].x() < 0;
        const Vec3d d = (cloth.state.position[law.b] - cloth.state.position[law.a]).cast<double>();
        const Vec3d force = law.stiffness * (d.norm() - law.rest) * d.normalized();
        pull += a_left == b_left ? Vec3d(Vec3d::Zero()) : a_left ? force : Vec3d(-force);
      }
    }
  }
  EXPECT_GT(pull.x(), 0.1);
  EXPECT_LT((graspOf(simulation, left).wrench.force - pull).norm(), 1e-3 * pull.norm());
  EXPECT_LT((graspOf(simulation, right).wrench.force + pull).norm(), 1e-3 * pull.norm());
}

/// A curtain with two pins and a gripper that swings it round, in wind, struck by a ball, over a
/// floor that it comes to touch.
void checkBalance(SolverKind solver, double max_strain, bool expect_limiter)
{
  SimulationParams params = untearable(solver);
  params.solver.max_strain = max_strain;
  params.environment.wind = Vec3d(0.5, 2.0, 0.0);
  params.contact.floor = true;
  params.contact.floor_height = -0.7;
  const ClothModel flat = sheet(0.6, 0.6, 13, 13);
  Simulation simulation(upright(flat), { 0, 6 }, params);
  const std::uint64_t grasp = take(simulation, Vec3d(0.3, 0.0, -0.3), 0.08);
  ThrowRequest ball;
  ball.center = Vec3d(-0.1, -0.4, -0.3);
  ball.velocity = Vec3d(0.0, 3.0, 0.0);
  ball.mass = 0.05;
  simulation.throwSphere(ball);
  const double weight = weightOf(simulation).norm();
  const double dt = params.solver.time_step;
  Vec3d before = momentum(simulation.cloth());
  double worst = 0.0;
  double struck = 0.0;
  double swung = 0.0;
  int limited = 0;
  for (int i = 0; i < 1500; ++i)
  {
    if (i % 250 == 0)
    {
      DragTarget target;
      target.pose.position = Vec3d(0.3, i % 500 == 0 ? 0.3 : -0.3, -0.4);
      target.pose.rotation = Quatd(0.8, 0.0, 0.0, i % 500 == 0 ? 0.6 : -0.6);
      target.linear_speed = 1.5;
      target.angular_speed = 3.0;
      simulation.drag(grasp, target);
    }
    run(simulation, 1);
    limited += simulation.limitedSprings();
    const ForceBalance balance = simulation.forceBalance();
    worst = std::max(worst, (sumOf(balance) - balance.momentum_rate).norm());
    const Vec3d after = momentum(simulation.cloth());
    EXPECT_LT((balance.momentum_rate - (after - before) / dt).norm(), 0.01 * weight) << i;
    EXPECT_LT((balance.grasp + graspOf(simulation, grasp).wrench.force).norm(), 1e-9) << i;
    before = after;
    struck = std::max(struck, balance.contact.norm());
    swung = std::max(swung, balance.momentum_rate.norm());
  }
  EXPECT_LT(worst, 0.01 * weight);
  EXPECT_GT(struck, weight) << "the ball struck";
  EXPECT_GT(swung, weight) << "the cloth swung";
  EXPECT_EQ(limited > 0, expect_limiter) << "whether the limiter acted";
  EXPECT_LT((simulation.forceBalance().weight - weightOf(simulation)).norm(), 1e-9);
}

TEST(ForceBalanceOfXpbd, AddsUpInEachStepWithAllKindsOfForces)
{
  checkBalance(SolverKind::XPBD, 0.1, false);
}

TEST(ForceBalanceOfForceSprings, AddsUpInEachStepWithAllKindsOfForces)
{
  checkBalance(SolverKind::FORCE_SPRINGS, 3.0, false);
}

TEST(ForceBalanceOfForceSprings, AddsUpInEachStepWhileTheLimiterActs)
{
  checkBalance(SolverKind::FORCE_SPRINGS, 0.05, true);
}

TEST_P(GraspForces, KeepTheBalanceOfTheLastStepWhenTheClothIsChangedAfterIt)
{
  Simulation simulation(upright(sheet(0.5, 0.5, 11, 11)), {}, calm(GetParam()));
  const std::uint64_t grasp = take(simulation, Vec3d(-0.25, 0.0, 0.0), 0.06);
  run(simulation, 200);
  const ForceBalance balance = simulation.forceBalance();

  simulation.release(grasp);
  EXPECT_EQ(simulation.forceBalance().grasp, balance.grasp);
  EXPECT_EQ(simulation.forceBalance().momentum_rate, balance.momentum_rate);
  simulation.reset();
  EXPECT_EQ(simulation.forceBalance().momentum_rate, Vec3d::Zero().eval());
}

/// A small sheet that hangs from its upper edge and is pulled down by its lower one until it tears.
Simulation pulledApart(const SimulationParams& params)
{
  const ClothModel flat = sheet(0.3, 0.3, 7, 7);
  Simulation simulation(upright(flat), edgeOf(flat, "top"), params);
  DragTarget target;
  target.pose.position = Vec3d(0.0, 0.0, -0.7);
  target.linear_speed = 0.5;
  simulation.drag(take(simulation, Vec3d(0.0, 0.0, -0.3), 0.06), target);
  return simulation;
}

TEST_P(GraspForces, AddUpInAStepThatTears)
{
  SimulationParams params = tearable(GetParam());
  params.solver.max_substeps = 64;
  Simulation simulation = pulledApart(params);
  const double weight = weightOf(simulation).norm();
  int torn = 0;
  double strongest = 0.0;
  for (int i = 0; i < 800; ++i)
  {
    torn += run(simulation, 1).empty() ? 0 : 1;
    const ForceBalance balance = simulation.forceBalance();
    strongest = std::max(strongest, balance.grasp.norm());
    EXPECT_LT((sumOf(balance) - balance.momentum_rate).norm(),
              0.01 * std::max(weight, balance.grasp.norm()))
        << i;
  }
  EXPECT_GE(torn, 3);
  EXPECT_GT(strongest, 10.0 * weight);
}

TEST_P(GraspForces, AreNearlyTheSameIfFirstAskedForAfterATear)
{
  SimulationParams params = tearable(GetParam());
  params.solver.max_substeps = 64;
  Simulation simulation = pulledApart(params);
  int torn = 0;
  double strongest = 0.0;
  for (int i = 0; i < 800; ++i)
  {
    Simulation asked = simulation;
    asked.forceBalance();
    run(asked, 1);
    torn += run(simulation, 1).empty() ? 0 : 1;
    const Simulation unasked = simulation;  // so that `simulation` stays so
    const ForceBalance expected = asked.forceBalance();
    const ForceBalance balance = unasked.forceBalance();
    strongest = std::max(strongest, expected.grasp.norm());
    EXPECT_LT((balance.weight - expected.weight).norm(), 1e-9);
    for (const auto part :
         { &ForceBalance::grasp, &ForceBalance::pin, &ForceBalance::momentum_rate })
    {
      EXPECT_LT((balance.*part - expected.*part).norm(), 0.02 * strongest) << i;
    }
  }
  EXPECT_GE(torn, 3);
}

TEST(ForceBalanceOfForceSprings, CountsWhatSliversGainThatAreTreatedAsHeavier)
{
  SimulationParams params = tearable(SolverKind::FORCE_SPRINGS);
  params.solver.max_substeps = 1;  // not enough for what tears leave behind
  Simulation simulation = pulledApart(params);
  double gained = 0.0;
  double strongest = 0.0;
  for (int i = 0; i < 800; ++i)
  {
    run(simulation, 1);
    const ForceBalance balance = simulation.forceBalance();
    gained = std::max(gained, balance.limiter.norm());
    strongest = std::max(strongest, balance.pin.norm());
    EXPECT_LT((sumOf(balance) - balance.momentum_rate).norm(), 0.001 * strongest) << i;
  }
  EXPECT_GT(gained, 0.01 * strongest);
}

TEST_P(GraspForces, OfAGraspOffCentreHaveTheTorqueOfTheWeightThatHangsFromIt)
{
  Simulation simulation(upright(sheet(0.3, 0.3, 7, 7)), {}, calm(GetParam()));
  GraspRequest request;
  request.point = Vec3d(0.0, 0.0, 0.0);
  request.radius = 0.2;  // the upper edge but its corners, and some below
  request.frame.position = Vec3d(0.3, 0.4, 0.0);
  request.frame.rotation = Quatd(0.6, 0.8, 0.0, 0.0);  // must not matter
  simulation.grasp(request);
  run(simulation, 6000);

  const Cloth& cloth = simulation.cloth();
  const Grasp& grasp = simulation.grasps().at(0);
  Vec3d torque = Vec3d::Zero();
  for (int i = 0; i < cloth.state.size(); ++i)
  {
    const Vec3d arm = cloth.state.position[i].cast<double>() - grasp.pose.position;
    torque += arm.cross(cloth.rest.mass[i] * simulation.params().environment.gravity);
  }
  EXPECT_GT(torque.norm(), 0.04);
  EXPECT_LT((grasp.smoothed.torque - torque).norm(), 0.01 * torque.norm())
      << grasp.smoothed.torque.transpose() << " for " << torque.transpose();
}

TEST_P(GraspForces, AreSmoothedOverTheirTimeConstantAndNotAtAllWithoutOne)
{
  for (double filter : { 0.0, 0.05 })
  {
    SimulationParams params = calm(GetParam());
    params.grasp_force_filter = filter;
    Simulation simulation(upright(sheet(0.3, 0.3, 7, 7)), {}, params);
    const std::uint64_t id = take(simulation, Vec3d(0.0, 0.0, 0.0), 0.06);
    Vec3d expected = Vec3d::Zero();
    double peak = 0.0;
    const double share = 0.001 / (filter + 0.001);
    for (int i = 0; i < 100; ++i)
    {
      run(simulation, 1);
      const Grasp& grasp = graspOf(simulation, id);
      expected += share * (grasp.wrench.force - expected);
      peak = std::max(peak, grasp.wrench.force.norm());
      EXPECT_LT((grasp.smoothed.force - expected).norm(), 1e-9);
      EXPECT_NEAR(grasp.peak_force, peak, 1e-9);
    }
  }
}

TEST_P(GraspForces, OfWindOnACoveredPatchReachTheGripper)
{
  // All of it is held: what the wind does to it, its holder feels.
  SimulationParams params = calm(GetParam());
  params.environment = vacuum().environment;
  params.environment.wind = Vec3d(0.0, 0.0, 2.0);
  params.environment.wind_drag = 0.5;
  Simulation simulation(sheet(0.2, 0.2, 5, 5), {}, params);
  const std::uint64_t id = take(simulation, Vec3d(0.0, -0.1, 0.0), 1.0);
  run(simulation, 10);
  EXPECT_NEAR(graspOf(simulation, id).wrench.force.z(), 0.5 * 2.0 * 0.04, 1e-4);
}

TEST(SphereForce, IsTheOppositeOfWhatItDoesToTheCloth)
{
  SimulationParams params = untearable();
  Simulation simulation(sheet(0.5, 0.5, 11, 11), wholeBorder(sheet(0.5, 0.5, 11, 11)), params);
  Sphere sphere;
  sphere.center = Vec3d(0.0, -0.25, -0.2);
  sphere.radius = 0.1;
  sphere.velocity = Vec3d(0.0, 0.0, 0.5);
  simulation.setSpheres({ sphere });
  double most = 0.0;
  for (int i = 0; i < 300; ++i)
  {
    run(simulation, 1);
    const Vec3d force = simulation.spheres().at(0).force;
    EXPECT_LT((force + simulation.forceBalance().contact).norm(), 1e-9);
    most = std::max(most, -force.z());
  }
  EXPECT_GT(most, 0.1) << "the cloth pushes it back";
}

TEST_P(GraspForces, AreTheSameBitsInEveryRun)
{
  const auto play = []
  {
    SimulationParams params = tearable(GetParam());
    params.solver.max_substeps = 64;
    Simulation simulation(upright(sheet(0.3, 0.3, 7, 7)), { 0, 1, 2, 3, 4, 5, 6 }, params);
    const std::uint64_t grasp = take(simulation, Vec3d(0.0, 0.0, -0.3), 0.06);
    Pose pose;
    pose.position = Vec3d(0.0, 0.0, -0.6);
    pose.rotation = Quatd(0.6, 0.0, 0.8, 0.0);
    simulation.steer(grasp, pose, 0.3);
    run(simulation, 400);
    return std::make_pair(simulation.stateHash(), graspOf(simulation, grasp).smoothed.force);
  };
  EXPECT_EQ(play(), play());
}

INSTANTIATE_TEST_SUITE_P(Solvers, GraspForces, bothSolvers(), solverName);

}  // namespace
}  // namespace cloth
