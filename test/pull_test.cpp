// Claims of pulls: each way to end, in the very step, and what they tell.
#include "cloth_tearing/core/pull.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace cloth
{
namespace
{

/// A curtain of 0.3 m, pinned above, with a gripper at the middle of its lower border.
class Pulled : public WithBothSolvers
{
protected:
  Pulled()
  {
    grasp = take(Vec3d(0.0, 0.0, -0.3), 0.06);
    run(simulation, 50);
  }

  static SimulationParams params()
  {
    SimulationParams params = tearable(GetParam());
    params.solver.max_substeps = 64;
    return params;
  }
  std::uint64_t take(const Vec3d& point, double radius)
  {
    GraspRequest request;
    request.point = point;
    request.radius = radius;
    request.frame.position = point;
    return simulation.grasp(request).id;
  }
  PullRequest down(double distance) const
  {
    PullRequest request;
    request.grasp = grasp;
    request.target.pose.position = Vec3d(0.0, 0.0, -0.3 - distance);
    request.target.linear_speed = 0.5;
    return request;
  }
  /// Steps until a pull has ended.
  PullEnd end(int most = 3000)
  {
    const std::uint64_t last = simulation.loggedPullEnds()[1];
    for (int i = 0; i < most && simulation.loggedPullEnds()[1] == last; ++i)
    {
      const std::vector<TearEvent> more = run(simulation, 1);
      tears.insert(tears.end(), more.begin(), more.end());
    }
    const std::vector<PullEnd> ends = simulation.pullEndsSince(last + 1, 10);
    EXPECT_EQ(ends.size(), 1u);
    return ends.empty() ? PullEnd() : ends[0];
  }
  void expectToStandStill()
  {
    const Pose pose = simulation.grasps().at(0).pose;
    EXPECT_FALSE(simulation.grasps()[0].moving());
    run(simulation, 5);
    EXPECT_EQ(simulation.grasps()[0].pose.position, pose.position);
  }
  int caused() const
  {
    return static_cast<int>(std::count_if(tears.begin(), tears.end(),
                                          [this](const TearEvent& event) {
                                            return event.cause.kind == CauseKind::GRASP &&
                                                   event.cause.id == grasp;
                                          }));
  }

  ClothModel flat = sheet(0.3, 0.3, 7, 7);
  Simulation simulation{ upright(flat), edgeOf(flat, "top"), params() };
  std::uint64_t grasp = 0;
  std::vector<TearEvent> tears;
};

TEST_P(Pulled, GraspArrivesAndTellsTheWay)
{
  const std::uint64_t id = simulation.pull(down(0.0199));  // 0.5 mm a step
  double fraction = -1.0;
  double peak = 0.0;
  for (int i = 0; i < 39; ++i)
  {
    run(simulation, 1);
    ASSERT_EQ(simulation.pulls().size(), 1u);
    const PullProgress progress = simulation.pulls()[0];
    EXPECT_EQ(progress.pull, id);
    EXPECT_EQ(progress.grasp, grasp);
    EXPECT_GT(progress.fraction, fraction);
    EXPECT_NEAR(progress.fraction, (i + 1) * 0.0005 / 0.0199, 1e-9);
    EXPECT_EQ(progress.force, simulation.grasps()[0].force());
    peak = std::max(peak, progress.force);
    fraction = progress.fraction;
  }
  const PullEnd ended = end(1);
  peak = std::max(peak, simulation.grasps()[0].force());
  EXPECT_EQ(ended.outcome, PullOutcome::ARRIVED);
  EXPECT_EQ(ended.message, "arrived");
  EXPECT_EQ(ended.progress.pull, id);
  EXPECT_EQ(ended.progress.fraction, 1.0);
  EXPECT_NEAR(ended.progress.travelled, 0.0199, 1e-9);
  EXPECT_NEAR(ended.progress.duration, 0.04, 1e-9);
  EXPECT_NEAR(ended.progress.peak_force, peak, 1e-12);
  EXPECT_EQ(ended.progress.tears, 0);
  EXPECT_GT(ended.first_tear, ended.last_tear) << "no tears";
  EXPECT_EQ(ended.held_particles, static_cast<int>(simulation.grasps()[0].held.size()));
  EXPECT_EQ(ended.pieces, 1);
  EXPECT_TRUE(simulation.pulls().empty());
  expectToStandStill();
}

TEST_P(Pulled, GraspStopsInTheStepInWhichTheForceExceeds)
{
  PullRequest request = down(0.5);
  request.stop_force = 1.5;
  simulation.pull(request);
  double before = 0.0;
  int steps = 0;
  while (!simulation.pulls().empty() && ++steps < 2000)
  {
    before = simulation.grasps()[0].force();
    run(simulation, 1);
  }
  const PullEnd ended = simulation.pullEndsSince(1, 1).at(0);
  EXPECT_EQ(ended.outcome, PullOutcome::FORCE);
  EXPECT_LE(before, 1.5);
  EXPECT_GT(ended.progress.force, 1.5);
  EXPECT_EQ(ended.progress.force, simulation.grasps()[0].force());
  EXPECT_GT(ended.progress.fraction, 0.0);
  EXPECT_LT(ended.progress.fraction, 1.0);
  EXPECT_NEAR(ended.progress.fraction, ended.progress.travelled / 0.5, 1e-9);
  expectToStandStill();
}

TEST_P(Pulled, GraspStopsAfterItsTears)
{
  PullRequest request = down(0.5);
  request.stop_tears = 3;
  simulation.pull(request);
  const PullEnd ended = end();
  EXPECT_EQ(ended.outcome, PullOutcome::TEARS);
  EXPECT_GE(ended.progress.tears, 3);
  EXPECT_EQ(ended.progress.tears, caused());
  EXPECT_EQ(ended.first_tear, 1u);
  EXPECT_EQ(ended.last_tear, tears.size());
  EXPECT_EQ(ended.pieces, simulation.cloth().damage.pieces);
  EXPECT_NE(ended.message.find("stop_tears is 3"), std::string::npos) << ended.message;
  expectToStandStill();
}

TEST_P(Pulled, GraspCountsOnlyTheTearsThatItCaused)
{
  const std::uint64_t other = take(Vec3d(-0.15, 0.0, -0.3), 0.02);
  PullRequest request = down(0.05);
  request.stop_tears = 1;
  request.grasp = other;
  request.target.pose.position = Vec3d(-0.7, 0.0, -0.6);
  simulation.pull(request);
  PullRequest still = down(0.01);
  still.target.linear_speed = 0.01;
  simulation.pull(still);
  const PullEnd first = end();
  EXPECT_EQ(first.progress.grasp, other) << "goals of two grasps run side by side";
  EXPECT_EQ(first.outcome, PullOutcome::TEARS);
  const PullEnd second = end();
  EXPECT_EQ(second.progress.grasp, grasp);
  EXPECT_EQ(second.outcome, PullOutcome::ARRIVED);
  EXPECT_EQ(second.progress.tears, caused());
  EXPECT_LT(caused(), static_cast<int>(tears.size()));
  EXPECT_EQ(second.last_tear - second.first_tear + 1, tears.size()) << "all tears under way";
}

TEST_P(Pulled, GraspThatSlipsIsLost)
{
  simulation.release(grasp);
  GraspRequest weak;
  weak.point = Vec3d(0.0, 0.0, -0.3);
  weak.frame.position = weak.point;
  weak.radius = 0.06;
  weak.force_limit = 1.0;
  grasp = simulation.grasp(weak).id;
  simulation.pull(down(0.5));
  const PullEnd ended = end();
  EXPECT_EQ(ended.outcome, PullOutcome::LOST);
  EXPECT_NE(ended.message.find("exceeds force_limit = 1"), std::string::npos) << ended.message;
  EXPECT_GT(ended.held_particles, 0);
  EXPECT_TRUE(simulation.grasps().empty());
}

TEST_P(Pulled, GraspThatIsReleasedOrResetIsLost)
{
  simulation.pull(down(0.1));
  run(simulation, 10);
  simulation.release(grasp, "let go by hand");
  PullEnd ended = simulation.pullEndsSince(1, 1).at(0);
  EXPECT_EQ(ended.outcome, PullOutcome::LOST);
  EXPECT_EQ(ended.message, "let go by hand");
  EXPECT_NEAR(ended.progress.travelled, 0.005, 1e-9);

  simulation.reset();
  grasp = take(Vec3d(0.0, 0.0, -0.3), 0.06);
  simulation.pull(down(0.1));
  simulation.reset();
  ended = simulation.pullEndsSince(2, 1).at(0);
  EXPECT_EQ(ended.outcome, PullOutcome::LOST);
  EXPECT_EQ(ended.message, "the cloth was reset");
}

TEST_P(Pulled, GraspStandsStillWhenCancelled)
{
  const std::uint64_t id = simulation.pull(down(0.1));
  run(simulation, 10);
  EXPECT_FALSE(simulation.cancelPull(id + 1));
  EXPECT_TRUE(simulation.cancelPull(id));
  EXPECT_FALSE(simulation.cancelPull(id)) << "it has ended";
  const PullEnd ended = simulation.pullEndsSince(1, 1).at(0);
  EXPECT_EQ(ended.outcome, PullOutcome::CANCELLED);
  EXPECT_NEAR(ended.progress.travelled, 0.005, 1e-9);
  expectToStandStill();
}

TEST_P(Pulled, GraspIsTakenOverByTheNextPullDragOrStream)
{
  const std::uint64_t first = simulation.pull(down(0.1));
  const std::uint64_t second = simulation.pull(down(0.05));
  EXPECT_NE(first, second);
  EXPECT_EQ(simulation.pulls().at(0).pull, second);
  simulation.drag(grasp, down(0.02).target);
  simulation.pull(down(0.1));
  simulation.steer(grasp, down(0.02).target.pose, 0.1);
  const std::vector<PullEnd> ends = simulation.pullEndsSince(1, 10);
  ASSERT_EQ(ends.size(), 3u);
  for (const PullEnd& ended : ends)
  {
    EXPECT_EQ(ended.outcome, PullOutcome::CANCELLED);
    EXPECT_EQ(ended.message, "another command moves the grasp now");
  }
  EXPECT_TRUE(simulation.pulls().empty());
  EXPECT_TRUE(simulation.grasps()[0].moving());
}

TEST_P(Pulled, GraspLetsGoInTheEndIfAskedTo)
{
  PullRequest request = down(0.01);
  request.release = true;
  simulation.pull(request);
  const PullEnd ended = end();
  EXPECT_EQ(ended.outcome, PullOutcome::ARRIVED);
  EXPECT_GT(ended.held_particles, 0);
  EXPECT_TRUE(simulation.grasps().empty());
  const GraspEvent event = simulation.graspEventsSince(2, 10).back();
  EXPECT_EQ(event.kind, GraspEventKind::RELEASED);
  EXPECT_EQ(event.reason, "its pull ended: arrived");
}

TEST_P(Pulled, CopyGoesOnAsTheOriginalAndLeavesItAlone)
{
  PullRequest request = down(0.5);
  request.stop_tears = 2;
  Simulation copy = simulation;
  copy.pull(request);
  const std::uint64_t hash = simulation.stateHash();
  while (!copy.pulls().empty())
  {
    run(copy, 1);
  }
  EXPECT_EQ(simulation.stateHash(), hash);
  EXPECT_TRUE(simulation.pulls().empty());
  simulation.pull(request);
  const PullEnd ended = end();
  const PullEnd foretold = copy.pullEndsSince(1, 1).at(0);
  EXPECT_EQ(ended.progress.duration, foretold.progress.duration);
  EXPECT_EQ(ended.progress.peak_force, foretold.progress.peak_force);
  EXPECT_EQ(simulation.stateHash(), copy.stateHash());
}

TEST_P(Pulled, RequestIsRefusedWithAllThatIsWrongWithItAndChangesNothing)
{
  simulation.pull(down(0.1));
  const std::uint64_t hash = simulation.stateHash();
  PullRequest bad = down(0.1);
  bad.target.linear_speed = 0.0;
  bad.stop_force = -1.0;
  bad.stop_tears = -2;
  const std::string words = refusalOf([&] { simulation.pull(bad); });
  for (const char* part : { "linear_speed [m/s] is 0", "stop_force [N] is -1", "stop_tears is -2" })
  {
    EXPECT_NE(words.find(part), std::string::npos) << words;
  }
  bad = down(0.1);
  bad.grasp = 77;
  EXPECT_EQ(refusalOf([&] { simulation.pull(bad); }), "there is no grasp 77");
  EXPECT_EQ(simulation.stateHash(), hash);
  EXPECT_EQ(simulation.loggedPullEnds()[1], 0u) << "the one under way goes on";
}

INSTANTIATE_TEST_SUITE_P(Solvers, Pulled, bothSolvers(), solverName);

}  // namespace
}  // namespace cloth
