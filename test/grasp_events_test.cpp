// Claims of what happens to grasps: slips, splits, loose pieces, frames that they follow, and that
// each is told once.
#include <gtest/gtest.h>

#include "cloth_tearing/core/checks.h"
#include "scenes.h"

namespace cloth
{
namespace
{

GraspRequest requestAt(const Vec3d& point, double radius)
{
  GraspRequest request;
  request.point = point;
  request.radius = radius;
  request.frame.position = point;
  return request;
}

DragTarget targetAt(const Vec3d& position, double speed)
{
  DragTarget target;
  target.pose.position = position;
  target.linear_speed = speed;
  return target;
}

std::vector<GraspEvent> eventsOf(const Simulation& simulation)
{
  return simulation.graspEventsSince(1, 1000);
}

std::vector<GraspEvent> eventsOf(const Simulation& simulation, GraspEventKind kind)
{
  std::vector<GraspEvent> found;
  for (const GraspEvent& event : eventsOf(simulation))
  {
    if (event.kind == kind)
    {
      found.push_back(event);
    }
  }
  return found;
}

TEST(GraspEvents, AreNumberedAndLoggedOnceForCommandsAndSteps)
{
  Simulation simulation(upright(sheet(0.5, 0.5, 11, 11)), { 0 }, untearable());
  EXPECT_EQ(simulation.loggedGraspEvents(), (std::array<std::uint64_t, 2>{ 1, 0 }));
  const std::uint64_t first = simulation.grasp(requestAt(Vec3d(0, 0, -0.25), 0.06)).id;
  run(simulation, 10);
  const std::uint64_t second = simulation.grasp(requestAt(Vec3d(0.2, 0, -0.1), 0.0)).id;
  simulation.release(first, "asked to");
  run(simulation, 1);
  simulation.reset();

  const std::vector<GraspEvent> events = eventsOf(simulation);
  ASSERT_EQ(events.size(), 4u);
  EXPECT_EQ(simulation.loggedGraspEvents(), (std::array<std::uint64_t, 2>{ 1, 4 }));
  const auto is =
      [&](std::size_t i, GraspEventKind kind, std::uint64_t grasp, int held, std::uint64_t step)
  {
    EXPECT_EQ(events[i].sequence, i + 1);
    EXPECT_EQ(events[i].kind, kind) << i;
    EXPECT_EQ(events[i].grasp, grasp) << i;
    EXPECT_EQ(events[i].held_particles, held) << i;
    EXPECT_EQ(events[i].step, step) << i;
    EXPECT_EQ(events[i].epoch, 0u) << i;
    EXPECT_NEAR(events[i].time, 0.001 * static_cast<double>(step), 1e-12) << i;
    EXPECT_FALSE(events[i].reason.empty()) << i;
  };
  is(0, GraspEventKind::TAKEN, first, 5, 0);
  is(1, GraspEventKind::TAKEN, second, 1, 10);
  is(2, GraspEventKind::RELEASED, first, 5, 10);
  is(3, GraspEventKind::RELEASED, second, 1, 11);
  EXPECT_EQ(events[0].position, Vec3d(0, 0, -0.25));
  EXPECT_EQ(events[2].reason, "asked to");
  EXPECT_GT(events[2].force, 0.0);
  EXPECT_EQ(events[3].reason, "the cloth was reset");
  EXPECT_EQ(simulation.graspEventsSince(2, 2).at(1).sequence, 3u);
}

class ForceLimit : public WithBothSolvers
{
};

TEST_P(ForceLimit, LetsTheWholeGraspSlipWithAnEventThatNamesTheForce)
{
  SimulationParams params = untearable(GetParam());
  params.solver.max_strain = 0.5;
  params.environment.air_friction = 5.0;
  Simulation simulation(upright(sheet(0.5, 0.5, 11, 11)), {}, params);
  const double weight = simulation.summary().mass * 9.81;
  GraspRequest weak = requestAt(Vec3d(-0.25, 0, 0), 0.11);
  weak.force_limit = 0.9 * weight;
  GraspRequest strong = requestAt(Vec3d(0.25, 0, 0), 0.11);
  strong.force_limit = 3.0 * weight;
  const std::uint64_t slips = simulation.grasp(weak).id;
  const std::uint64_t holds = simulation.grasp(strong).id;
  run(simulation, 3000);
  ASSERT_EQ(simulation.grasps().size(), 2u) << "half the weight and the sag are within the limits";

  const int held = static_cast<int>(simulation.grasps()[0].held.size());
  simulation.drag(slips, targetAt(Vec3d(-0.6, 0, 0), 0.1));
  int steps = 0;
  while (simulation.grasps().size() == 2u && ++steps < 5000)
  {
    run(simulation, 1);
  }

  ASSERT_EQ(simulation.grasps().size(), 1u);
  EXPECT_EQ(simulation.grasps()[0].id, holds);
  const GraspEvent event = eventsOf(simulation, GraspEventKind::SLIPPED).at(0);
  EXPECT_EQ(event.grasp, slips);
  EXPECT_EQ(event.held_particles, held);
  EXPECT_EQ(event.step, simulation.stepCount());
  EXPECT_GT(event.force, 0.9 * weight);
  EXPECT_LT(event.force, 0.95 * weight) << "in the step in which it exceeds the limit";
  EXPECT_NE(event.reason.find("exceeds force_limit = " + text(0.9 * weight)), std::string::npos)
      << event.reason;
  for (const Attachment& attachment : simulation.cloth().attachments)
  {
    EXPECT_NE(attachment.grasp, slips);
  }
}

INSTANTIATE_TEST_SUITE_P(Solvers, ForceLimit, bothSolvers(), solverName);

TEST(ForceLimit, MustBeAForce)
{
  Simulation simulation(sheet(0.5, 0.5, 11, 11), {}, vacuum());
  GraspRequest request = requestAt(Vec3d::Zero(), 0.1);
  request.force_limit = -1.0;
  EXPECT_NE(refusalOf([&] { simulation.grasp(request); }).find("force_limit [N] is -1"),
            std::string::npos);
}

/// A sheet in the x-y plane whose middle line is so weak, up to half of its height, that it tears
/// there from below.
Simulation weakInTheMiddle()
{
  SimulationParams params = tearable();
  params.environment = vacuum().environment;
  params.environment.air_friction = 1.0;
  params.strength.lines.push_back({ Vec3d(0.0, -0.6, 0.0), Vec3d(0.0, -0.28, 0.0), 0.02, 0.3 });
  return { sheet(0.6, 0.6, 25, 25), {}, params };
}

TEST(TornPatch, StaysHeldOnBothSidesAndTellsItOncePerStep)
{
  Simulation simulation = weakInTheMiddle();
  const std::uint64_t clamp = simulation.grasp(requestAt(Vec3d(0.0, -0.2, 0.0), 0.11)).id;
  const std::uint64_t left = simulation.grasp(requestAt(Vec3d(-0.2, -0.6, 0.0), 0.15)).id;
  const std::uint64_t right = simulation.grasp(requestAt(Vec3d(0.2, -0.6, 0.0), 0.15)).id;
  const std::size_t held = simulation.grasps()[0].held.size();
  simulation.drag(left, targetAt(Vec3d(-0.5, -0.6, 0.0), 0.3));
  simulation.drag(right, targetAt(Vec3d(0.5, -0.6, 0.0), 0.3));
  std::vector<GraspEvent> split;
  for (int i = 0; i < 1500 && split.empty(); ++i)
  {
    run(simulation, 1);
    split = eventsOf(simulation, GraspEventKind::SPLIT);
  }

  ASSERT_EQ(split.size(), 1u);
  EXPECT_EQ(split[0].grasp, clamp);
  const Grasp& grasp = simulation.grasps()[0];
  EXPECT_GT(grasp.held.size(), held);
  EXPECT_EQ(static_cast<std::size_t>(split[0].held_particles), grasp.held.size());
  for (const Grasp::Held& h : grasp.held)
  {
    EXPECT_EQ(simulation.cloth().attachments[h.particle.index].grasp, clamp);
    EXPECT_LT((grasp.pose.apply(h.offset).cast<Real>() -
               simulation.cloth().state.position[h.particle.index])
                  .norm(),
              1e-6);
  }
}

/// A sheet with a weak line across, pinned above it and held below.
class TornOff : public ::testing::Test
{
protected:
  static SimulationParams params()
  {
    SimulationParams params = tearable();
    params.strength.lines.push_back({ Vec3d(-0.2, 0.0, -0.14), Vec3d(0.2, 0.0, -0.14), 0.03, 0.3 });
    return params;
  }

  ClothModel flat = sheet(0.3, 0.3, 13, 13);
  Simulation simulation{ upright(flat), edgeOf(flat, "top"), params() };
};

TEST_F(TornOff, PieceThatHangsOnNothingElseIsToldOnceWithAreaAndMass)
{
  const Vec3d low(0.0, 0.0, -0.3);
  const std::uint64_t grasp = simulation.grasp(requestAt(low, 0.151)).id;  // the lower border
  EXPECT_EQ(simulation.grasps()[0].loose_pieces, 0);
  simulation.drag(grasp, targetAt(Vec3d(0.0, 0.0, -0.6), 0.2));
  const double whole = simulation.summary().rest_area;
  std::vector<TearEvent> tears;
  for (int i = 0; i < 2500 && simulation.grasps()[0].loose_pieces == 0; ++i)
  {
    tears = run(simulation, 1);
  }
  ASSERT_EQ(simulation.grasps()[0].loose_pieces, 1);

  const GraspEvent event = eventsOf(simulation, GraspEventKind::HOLDS_LOOSE_PIECE).at(0);
  EXPECT_EQ(event.grasp, grasp);
  EXPECT_EQ(event.step, simulation.stepCount());
  EXPECT_NEAR(event.mass, event.area * simulation.params().material.areal_density, 1e-9);
  EXPECT_GT(event.area, 0.3 * whole);
  EXPECT_LT(event.area, 0.7 * whole);
  double parted = 0.0;
  for (const TearEvent& tear : tears)
  {
    parted = std::max(parted, tear.loose_area);
  }
  EXPECT_GT(parted, 0.0) << "in the step of the last tear";
  run(simulation, 200);
  EXPECT_EQ(eventsOf(simulation, GraspEventKind::HOLDS_LOOSE_PIECE).size(), 1u);
}

TEST(LoosePiece, IsAlsoOneOfWhichAllOthersLetGo)
{
  const ClothModel flat = sheet(0.3, 0.3, 7, 7);
  Simulation simulation(upright(flat), { 0 }, untearable());
  const std::uint64_t left = simulation.grasp(requestAt(Vec3d(-0.15, 0, -0.3), 0.0)).id;
  const std::uint64_t right = simulation.grasp(requestAt(Vec3d(0.15, 0, -0.3), 0.0)).id;
  PinRequest pin;
  pin.particles = { 0 };
  EXPECT_EQ(simulation.unpin(pin), 1);
  EXPECT_EQ(simulation.grasps()[0].loose_pieces, 0) << "the other holds it";
  simulation.release(left);
  EXPECT_EQ(simulation.grasps()[0].loose_pieces, 1);
  const GraspEvent event = eventsOf(simulation, GraspEventKind::HOLDS_LOOSE_PIECE).at(0);
  EXPECT_EQ(event.grasp, right);
  EXPECT_NEAR(event.area, 0.09, 1e-9);
  EXPECT_NEAR(event.mass, 0.09 * 0.15, 1e-9);
  simulation.pin(pin);
  EXPECT_EQ(simulation.grasps()[0].loose_pieces, 0) << "and now it hangs on a pin again";
  EXPECT_EQ(eventsOf(simulation, GraspEventKind::HOLDS_LOOSE_PIECE).size(), 1u);
}

// -- following -----------------------------------------------------------------------------------

class Followed : public ::testing::Test
{
protected:
  Followed()
  {
    GraspRequest request = requestAt(Vec3d(0.0, -0.5, 0.0), 0.11);
    steered = simulation.grasp(request).id;
    request = requestAt(Vec3d(0.3, -0.2, 0.0), 0.11);
    request.followed = "finger";
    follower = simulation.grasp(request).id;
  }

  const Grasp& grasp(std::uint64_t id) const { return simulation.grasps()[id == steered ? 0 : 1]; }
  static Pose poseAt(const Vec3d& position)
  {
    Pose pose;
    pose.position = position;
    return pose;
  }

  Simulation simulation{ sheet(1.0, 1.0, 11, 11), { 0 }, vacuum() };
  std::uint64_t steered = 0;
  std::uint64_t follower = 0;
};

TEST_F(Followed, PoseIsReachedInItsTimeAtConstantSpeedAndHeld)
{
  simulation.follow(follower, poseAt(Vec3d(0.3, -0.2, 0.05)), 0.1);
  const ParticleId p = grasp(follower).held[0].particle;
  double distance = 0.0;
  for (int i = 1; i <= 100; ++i)
  {
    run(simulation, 1);
    EXPECT_NEAR(grasp(follower).pose.position.z() - distance, 0.0005, 1e-9) << i;
    EXPECT_NEAR(simulation.cloth().state.velocity[p.index].z(), 0.5, 2e-3) << i;
    distance = grasp(follower).pose.position.z();
    EXPECT_EQ(grasp(follower).moving(), i < 100) << i;
  }
  EXPECT_EQ(grasp(follower).pose.position, Vec3d(0.3, -0.2, 0.05));
  run(simulation, 1);
  EXPECT_EQ(simulation.cloth().state.velocity[p.index], Vec3::Zero().eval());
}

TEST_F(Followed, PoseIsApproachedNoFasterThanGrippersMayGo)
{
  simulation.follow(follower, poseAt(Vec3d(0.3, -0.2, 0.1)), 0.0);  // by 5 m/s: 20 steps
  run(simulation, 19);
  EXPECT_NEAR(grasp(follower).pose.position.z(), 0.095, 1e-9);
  run(simulation, 1);
  EXPECT_EQ(grasp(follower).pose.position.z(), 0.1);

  Pose turned = grasp(follower).pose;
  turned.rotation = Quatd(0.8, 0.6, 0.0, 0.0);  // 1.287 rad, by 20 rad/s: 65 steps
  simulation.follow(follower, turned, 0.01);
  run(simulation, 60);
  EXPECT_TRUE(grasp(follower).moving());
  run(simulation, 6);
  EXPECT_FALSE(grasp(follower).moving());
  EXPECT_LT((grasp(follower).pose.rotation.coeffs() - turned.rotation.coeffs()).norm(), 1e-12);
}

TEST_F(Followed, RotationIsReachedInItsTimeTheShortWayRound)
{
  Pose turned = grasp(steered).pose;
  turned.rotation = Quatd(-0.995, 0.0, std::sqrt(1 - 0.995 * 0.995), 0.0);  // the same, negative
  const double angle = 2.0 * std::acos(0.995);
  simulation.steer(steered, turned, 0.05);
  run(simulation, 25);
  EXPECT_NEAR(2.0 * std::acos(grasp(steered).pose.rotation.w()), 0.5 * angle, 1e-3 * angle);
  EXPECT_TRUE(grasp(steered).moving());
  run(simulation, 25);
  EXPECT_FALSE(grasp(steered).moving());
}

TEST_F(Followed, StreamOfTargetsIsOneSmoothMotion)
{
  for (int i = 1; i <= 10; ++i)
  {
    simulation.steer(steered, poseAt(Vec3d(0.01 * i, -0.5, 0.0)), 0.02);
    for (int k = 0; k < 20; ++k)
    {
      const double before = grasp(steered).pose.position.x();
      run(simulation, 1);
      EXPECT_NEAR(grasp(steered).pose.position.x() - before, 0.0005, 1e-9);
    }
  }
}

TEST_F(Followed, FrameKeepsOthersFromMovingTheGrasp)
{
  const std::uint64_t hash = simulation.stateHash();
  const std::string words = "grasp 2 follows the frame \"finger\": nothing else can move it";
  PullRequest pull;
  pull.grasp = follower;
  EXPECT_EQ(refusalOf([&] { simulation.drag(follower, targetAt(Vec3d::Zero(), 1.0)); }), words);
  EXPECT_EQ(refusalOf([&] { simulation.steer(follower, Pose(), 0.1); }), words);
  EXPECT_EQ(refusalOf([&] { simulation.pull(pull); }), words);
  EXPECT_EQ(refusalOf([&] { simulation.follow(steered, Pose(), 0.1); }),
            "grasp 1 follows no frame");
  EXPECT_EQ(refusalOf([&] { simulation.frameLost(steered, "?"); }), "grasp 1 follows no frame");
  EXPECT_EQ(refusalOf([&] { simulation.follow(9, Pose(), 0.1); }), "there is no grasp 9");
  EXPECT_NE(refusalOf([&] { simulation.follow(follower, Pose(), -1.0); }).find("time [s] is -1"),
            std::string::npos);
  EXPECT_EQ(simulation.stateHash(), hash);
}

TEST_F(Followed, FrameIsLostAndFoundOnceEach)
{
  simulation.frameFound(follower);
  simulation.frameLost(follower, "no transform from finger to world");
  simulation.frameLost(follower, "still none");
  EXPECT_EQ(grasp(follower).frame_problem, "still none");
  simulation.frameFound(follower);
  simulation.frameFound(follower);
  EXPECT_TRUE(grasp(follower).frame_problem.empty());
  const std::vector<GraspEvent> lost = eventsOf(simulation, GraspEventKind::FRAME_LOST);
  ASSERT_EQ(lost.size(), 1u);
  EXPECT_EQ(lost[0].reason, "no transform from finger to world");
  EXPECT_EQ(eventsOf(simulation, GraspEventKind::FRAME_FOUND).size(), 1u);
}

TEST_F(Followed, StepThatIsUndoneGoesBackInAllThatDecidesTheFuture)
{
  PullRequest pull;
  pull.grasp = steered;
  pull.target = targetAt(Vec3d(0.0, -0.5, 1.0), 50.0);
  pull.stop_force = 1e5;
  simulation.pull(pull);
  simulation.follow(follower, poseAt(Vec3d(0.3, -0.2, 0.05)), 0.1);
  run(simulation, 3);
  StepReport report;
  std::uint64_t before = 0;
  for (int i = 0; i < 100 && report.fault.empty(); ++i)
  {
    if (i == 2)
    {
      pull.target = targetAt(Vec3d(0.0, -0.5, 900.0), 100.0);
      simulation.pull(pull);
    }
    before = simulation.stateHash();
    report = simulation.step();
  }
  ASSERT_FALSE(report.fault.empty());
  EXPECT_EQ(simulation.stateHash(), before);
  EXPECT_EQ(simulation.forceBalance().momentum_rate, Vec3d::Zero().eval());
}

TEST(StateHash, DoesNotKnowTheNumbersOfGrasps)
{
  Simulation fresh(sheet(1.0, 1.0, 11, 11), { 0 }, vacuum());
  Simulation used = fresh;
  used.release(used.grasp(requestAt(Vec3d(0.0, -0.5, 0.0), 0.11)).id);
  EXPECT_EQ(used.stateHash(), fresh.stateHash());
  used.grasp(requestAt(Vec3d(0.0, -0.5, 0.0), 0.11));
  fresh.grasp(requestAt(Vec3d(0.0, -0.5, 0.0), 0.11));
  EXPECT_NE(used.grasps()[0].id, fresh.grasps()[0].id);
  EXPECT_EQ(used.stateHash(), fresh.stateHash());
}

TEST(StateHash, KnowsWhatDecidesTheFutureOfAGrasp)
{
  Simulation plain(sheet(1.0, 1.0, 11, 11), { 0 }, vacuum());
  const std::uint64_t grasp = plain.grasp(requestAt(Vec3d(0.0, -0.5, 0.0), 0.11)).id;
  const std::uint64_t hash = plain.stateHash();
  Pose pose;
  pose.position = Vec3d(0.0, -0.5, 0.1);

  Simulation gliding = plain;
  gliding.steer(grasp, pose, 0.1);
  EXPECT_NE(gliding.stateHash(), hash);
  Simulation longer = plain;
  longer.steer(grasp, pose, 0.2);
  EXPECT_NE(longer.stateHash(), gliding.stateHash());

  Simulation dragged = plain;
  PullRequest pull;
  pull.grasp = grasp;
  pull.target.pose = pose;
  dragged.drag(grasp, pull.target);
  Simulation pulled = plain;
  pulled.pull(pull);
  EXPECT_NE(pulled.stateHash(), dragged.stateHash());
  pull.stop_tears = 1;
  Simulation stopped = plain;
  stopped.pull(pull);
  EXPECT_NE(stopped.stateHash(), pulled.stateHash());

  Simulation limited(sheet(1.0, 1.0, 11, 11), { 0 }, vacuum());
  GraspRequest request = requestAt(Vec3d(0.0, -0.5, 0.0), 0.11);
  request.force_limit = 5.0;
  limited.grasp(request);
  EXPECT_NE(limited.stateHash(), hash);
}

TEST(UtilisationNearAGrasp, IsThatOfTheWorstSpringThere)
{
  SimulationParams params = tearable();
  params.environment = vacuum().environment;
  params.environment.air_friction = 5.0;
  Simulation simulation(sheet(0.6, 0.2, 25, 9), edgeOf(sheet(0.6, 0.2, 25, 9), "left"), params);
  const std::uint64_t pulling = simulation.grasp(requestAt(Vec3d(0.3, -0.1, 0.0), 0.0)).id;
  const std::uint64_t idle = simulation.grasp(requestAt(Vec3d(-0.2, 0.0, 0.0), 0.0)).id;
  EXPECT_LT(simulation.utilisationNear(pulling), 1e-4);
  simulation.drag(pulling, targetAt(Vec3d(0.31, -0.1, 0.0), 0.05));
  run(simulation, 1000);

  const double near = simulation.utilisationNear(pulling);
  EXPECT_GT(near, 0.1);
  EXPECT_EQ(near, simulation.summary().utilisation) << "the worst of all is at the gripper";
  EXPECT_LT(simulation.utilisationNear(idle), 0.5 * near);
  EXPECT_EQ(refusalOf([&] { simulation.utilisationNear(9); }), "there is no grasp 9");
}

}  // namespace
}  // namespace cloth
