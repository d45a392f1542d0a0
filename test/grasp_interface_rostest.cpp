// The promises to grippers: what they feel, how they move, pull, slip and follow frames.
#include <cloth_tearing/CollisionSpheres.h>
#include <cloth_tearing/GetGraspEvents.h>
#include <cloth_tearing/GraspEvents.h>
#include <cloth_tearing/GraspStates.h>
#include <cloth_tearing/GraspTargets.h>
#include <cloth_tearing/SimulationStatus.h>
#include <cloth_tearing/client/cloth_client.h>
#include <geometry_msgs/WrenchStamped.h>
#include <tf2_ros/transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "node_client.h"

using namespace cloth_tearing;  // NOLINT: the messages are what all of this is about
using PullClient = actionlib::SimpleActionClient<PullAction>;

namespace
{

constexpr double TOP = 1.5;                    // height of the upper edge [m]
constexpr double BOTTOM = TOP - 0.4;           // and of the lower one, before the cloth stretches
constexpr double WEIGHT = 0.12 * 0.16 * 9.81;  // [N]

geometry_msgs::Point at(double x, double z)
{
  geometry_msgs::Point point;
  point.x = x;
  point.z = z;
  return point;
}

PullGoal pullDown(std::uint64_t grasp, double distance)
{
  PullGoal goal;
  goal.header.frame_id = "world";
  goal.grasp_id = grasp;
  goal.direction.z = -1.0;
  goal.distance = distance;
  goal.linear_speed = 0.5;
  return goal;
}

/// A cloth as it was built, asked by its client.
class GraspInterface : public testing::Test
{
protected:
  void SetUp() override
  {
    cloth_.reset();
    free_.reset();
  }

  /// What ~grasp_states tells of the step that the cloth is in now.
  GraspStates states(const ClothClient& cloth)
  {
    const Step::Response now = cloth.step(0);
    Collector<GraspStates> heard(cloth.node() + "/grasp_states");
    return heard.waitFor("the states of now", [&now](const GraspStates& s)
                         { return s.epoch == now.epoch && s.step == now.step; });
  }

  GraspState stateOf(const ClothClient& cloth, std::uint64_t grasp)
  {
    for (const GraspState& state : states(cloth).grasps)
    {
      if (state.grasp_id == grasp)
      {
        return state;
      }
    }
    ADD_FAILURE() << "there is no grasp " << grasp;
    return {};
  }

  /// Sends a goal and waits until it is under way.
  std::unique_ptr<PullClient> begin(const PullGoal& goal, const std::string& node = "/cloth")
  {
    auto client = std::make_unique<PullClient>(node + "/pull", false);
    EXPECT_TRUE(client->waitForServer(ros::Duration(PATIENCE)));
    client->sendGoal(goal);
    EXPECT_TRUE(isSoon(
        [&]
        {
          return client->getState() == actionlib::SimpleClientGoalState::ACTIVE ||
                 client->getState().isDone();
        }));
    return client;
  }

  PullResult endOf(PullClient& client)
  {
    EXPECT_TRUE(client.waitForResult(ros::Duration(PATIENCE)));
    return client.getResult() ? *client.getResult() : PullResult();
  }

  std::vector<GraspEvent> events(const ClothClient& cloth, std::uint8_t kind)
  {
    const std::uint32_t epoch = cloth.step(0).epoch;
    std::vector<GraspEvent> found;
    for (const GraspEvent& event : cloth.call<GetGraspEvents>("get_grasp_events").events)
    {
      if (event.kind == kind && event.epoch == epoch)
      {
        found.push_back(event);
      }
    }
    return found;
  }

  /// Takes hold of the cloth at `place` with a gripper whose frame is there, once tf has heard of
  /// it.
  std::uint64_t graspWith(const std::string& frame, const ClothClient& cloth,
                          const geometry_msgs::Point& place)
  {
    Grasp::Response response;
    EXPECT_TRUE(isSoon(
        [&]
        {
          tell(frame, place.x, place.y, place.z);
          Grasp::Request request;
          request.header.frame_id = "world";
          request.point = place;
          request.radius = 0.05;
          request.gripper_frame = frame;
          response = ask<Grasp>(cloth.node() + "/grasp", request);
          return response.success;
        }))
        << response.message;
    return response.grasp_id;
  }

  /// Tells where `frame` is, now.
  void tell(const std::string& frame, double x, double y, double z)
  {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = "world";
    transform.header.stamp = ros::Time::now();
    transform.child_frame_id = frame;
    transform.transform.translation.x = x;
    transform.transform.translation.y = y;
    transform.transform.translation.z = z;
    transform.transform.rotation.w = 1.0;
    broadcaster_.sendTransform(transform);
  }

  ClothClient cloth_{ "/cloth", "world", PATIENCE };
  ClothClient free_{ "/free", "world", PATIENCE };
  tf2_ros::TransformBroadcaster broadcaster_;
};

void expectRefused(const std::function<void()>& request, const std::string& words)
{
  try
  {
    request();
    ADD_FAILURE() << "not refused, but should be: " << words;
  }
  catch (const ClothError& error)
  {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

double length(const geometry_msgs::Vector3& v)
{
  return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

}  // namespace

TEST_F(GraspInterface, TwoGraspsFeelTheWeightOfTheClothThatHangsOnThem)
{
  free_.grasp(at(-0.2, TOP), 0.05);
  free_.grasp(at(0.2, TOP), 0.05);
  free_.step(8000);

  const GraspStates felt = states(free_);
  ASSERT_EQ(felt.grasps.size(), 2u);
  const double sum = felt.grasps[0].wrench.force.z + felt.grasps[1].wrench.force.z;
  EXPECT_NEAR(sum, -WEIGHT, 0.01 * WEIGHT) << "the cloth pulls them down";
  EXPECT_NEAR(felt.grasp_force.z, WEIGHT, 0.01 * WEIGHT);
  EXPECT_NEAR(felt.weight.z, -WEIGHT, 1e-6);
  EXPECT_EQ(felt.header.frame_id, "world");
}

TEST_F(GraspInterface, ForcesSumUpToTheChangeOfMomentumWhileItSwings)
{
  const std::uint64_t grasp = cloth_.grasp(at(0.0, BOTTOM), 0.05).grasp_id;
  cloth_.drag(grasp, at(0.1, BOTTOM + 0.1), 1.0);
  cloth_.step(150);

  const GraspStates felt = states(cloth_);
  const auto sum = [&](double geometry_msgs::Vector3::*axis)
  {
    return felt.grasp_force.*axis + felt.pin_force.*axis + felt.contact_force.*axis +
           felt.limiter_force.*axis + felt.weight.*axis + felt.air_force.*axis;
  };
  EXPECT_NEAR(sum(&geometry_msgs::Vector3::x), felt.momentum_rate.x, 0.01 * WEIGHT);
  EXPECT_NEAR(sum(&geometry_msgs::Vector3::z), felt.momentum_rate.z, 0.01 * WEIGHT);
  EXPECT_GT(length(felt.momentum_rate), 0.0);
}

TEST_F(GraspInterface, AGraspBeyondItsForceLimitSlipsAndSaysSo)
{
  Collector<GraspEvents> heard("/cloth/grasp_events");
  ASSERT_TRUE(isSoon([&] { return heard.publishers() > 0; }));
  const std::uint64_t grasp = cloth_.grasp(at(0.0, BOTTOM), 0.05, 0.5).grasp_id;
  cloth_.drag(grasp, at(0.0, BOTTOM - 0.3), 0.5);
  cloth_.step(600);

  const std::vector<GraspEvent> slips = events(cloth_, GraspEvent::SLIPPED);
  ASSERT_EQ(slips.size(), 1u);
  EXPECT_EQ(slips[0].grasp_id, grasp);
  EXPECT_GT(slips[0].force, 0.5);
  EXPECT_FALSE(slips[0].reason.empty());
  EXPECT_TRUE(states(cloth_).grasps.empty());
  heard.waitFor("the slip on the topic", [&](const GraspEvents& m)
                { return m.events.back().sequence == slips[0].sequence; });
}

TEST_F(GraspInterface, AGraspThatHoldsAllThatIsLeftSaysHowMuchThatIs)
{
  const std::uint64_t left = free_.grasp(at(-0.2, TOP), 0.05).grasp_id;
  const std::uint64_t right = free_.grasp(at(0.2, TOP), 0.05).grasp_id;
  free_.release(left);

  const std::vector<GraspEvent> loose = events(free_, GraspEvent::HOLDS_LOOSE_PIECE);
  ASSERT_EQ(loose.size(), 1u);
  EXPECT_EQ(loose[0].grasp_id, right);
  EXPECT_NEAR(loose[0].area, 0.16, 1e-6);
  EXPECT_NEAR(loose[0].mass, 0.0192, 1e-6);
  EXPECT_TRUE(stateOf(free_, right).holds_loose_piece);
}

TEST_F(GraspInterface, PinsHoldAndLetGo)
{
  EXPECT_EQ(free_.pin(at(0.2, TOP), 0.01), 1u);
  EXPECT_EQ(free_.pin(at(0.2, TOP), 0.01), 0u) << "pinned already";
  free_.step(200);
  EXPECT_GT(length(states(free_).pin_force), 0.0);

  EXPECT_EQ(free_.unpin(at(0.2, TOP), 0.01), 1u);
  free_.step(1);
  EXPECT_EQ(length(states(free_).pin_force), 0.0);
  expectRefused([&] { free_.pin(at(5.0, TOP), 0.01); }, "0.01");
}

TEST_F(GraspInterface, WhatAGraspHeldIsPinnedInTheInstantThatItLetsGo)
{
  const std::uint64_t grasp = cloth_.grasp(at(0.0, BOTTOM), 0.05).grasp_id;
  cloth_.drag(grasp, at(0.1, BOTTOM), 1.0);
  cloth_.step(50);
  const geometry_msgs::Point place = stateOf(cloth_, grasp).pose.position;

  cloth_.release(grasp, true);

  EXPECT_TRUE(states(cloth_).grasps.empty());
  cloth_.step(500);
  EXPECT_EQ(cloth_.unpin(place, 0.005), 1u) << "the middle of the patch has not moved";
  expectRefused([&] { cloth_.release(grasp, true); }, "there is no grasp");
}

TEST_F(GraspInterface, APullArrives)
{
  const std::uint64_t grasp = cloth_.grasp(at(0.0, BOTTOM), 0.05).grasp_id;
  const auto pull = begin(pullDown(grasp, 0.01));
  EXPECT_EQ(cloth_.step(100).tears, 0u);

  const PullResult result = endOf(*pull);
  EXPECT_EQ(pull->getState(), actionlib::SimpleClientGoalState::SUCCEEDED);
  EXPECT_EQ(result.outcome, PullResult::ARRIVED);
  EXPECT_NEAR(result.travelled, 0.01, 1e-9);
  EXPECT_NEAR(result.duration, 0.02, 0.0011) << "at 0.5 m/s";
  EXPECT_GT(result.peak_force, 0.0);
  EXPECT_EQ(result.pieces, 1u);
}

TEST_F(GraspInterface, APullTellsHowFarItIs)
{
  Collector<PullActionFeedback> heard("/cloth/pull/feedback");
  const std::uint64_t grasp = cloth_.grasp(at(0.0, BOTTOM), 0.05).grasp_id;
  const auto pull = begin(pullDown(grasp, 0.02));
  ASSERT_TRUE(isSoon([&] { return heard.publishers() > 0; }));
  cloth_.step(20);

  const PullActionFeedback half =
      heard.waitFor("half of the way", [](const PullActionFeedback& f)
                    { return std::abs(f.feedback.fraction - 0.5) < 1e-6; });
  EXPECT_GT(half.feedback.force, 0.0);
  EXPECT_GT(half.feedback.utilisation, 0.0);
  EXPECT_EQ(half.feedback.tears, 0u);
}

TEST_F(GraspInterface, APullStopsInTheStepOfTheFirstTear)
{
  PullGoal goal = pullDown(0, 1.0);
  goal.point = at(0.0, BOTTOM);
  goal.radius = 0.03;
  goal.stop_tears = 1;
  const auto pull = begin(goal);
  cloth_.step(2500);

  const PullResult result = endOf(*pull);
  EXPECT_EQ(result.outcome, PullResult::TEARS);
  EXPECT_GE(result.tears, 1u);
  ASSERT_FALSE(result.events.empty());
  const TearEvent& first = result.events.front();
  EXPECT_EQ(first.step, result.events.back().step) << "no step after that of the first tear";
  EXPECT_EQ(first.cause, TearEvent::GRASP);
  EXPECT_EQ(first.cause_id, result.grasp_id);
  EXPECT_FALSE(stateOf(cloth_, result.grasp_id).moving);
}

TEST_F(GraspInterface, APullStopsOnForceAndLetsGoIfItIsToldTo)
{
  const std::uint64_t grasp = cloth_.grasp(at(0.0, BOTTOM), 0.05).grasp_id;
  PullGoal goal = pullDown(grasp, 0.5);
  goal.stop_force = 1.0;
  goal.release = true;
  const auto pull = begin(goal);
  cloth_.step(1000);

  const PullResult result = endOf(*pull);
  EXPECT_EQ(result.outcome, PullResult::FORCE);
  EXPECT_GT(result.peak_force, 1.0);
  EXPECT_LT(result.peak_force, 1.5);
  EXPECT_TRUE(states(cloth_).grasps.empty());
}

TEST_F(GraspInterface, TwoArmsPullAtOnce)
{
  const std::uint64_t left = cloth_.grasp(at(-0.2, BOTTOM), 0.05).grasp_id;
  const std::uint64_t right = cloth_.grasp(at(0.2, BOTTOM), 0.05).grasp_id;
  const auto one = begin(pullDown(left, 0.01));
  const auto other = begin(pullDown(right, 0.02));
  cloth_.step(30);
  EXPECT_EQ(endOf(*one).outcome, PullResult::ARRIVED);
  EXPECT_FALSE(other->getState().isDone()) << "20 of its 40 steps";

  cloth_.step(30);
  EXPECT_EQ(endOf(*other).outcome, PullResult::ARRIVED);
}

TEST_F(GraspInterface, ACancelledPullStandsStill)
{
  const std::uint64_t grasp = cloth_.grasp(at(0.0, BOTTOM), 0.05).grasp_id;
  const auto pull = begin(pullDown(grasp, 0.1));
  cloth_.step(10);
  pull->cancelGoal();

  const PullResult result = endOf(*pull);
  EXPECT_EQ(pull->getState(), actionlib::SimpleClientGoalState::PREEMPTED);
  EXPECT_EQ(result.outcome, PullResult::CANCELLED);
  EXPECT_NEAR(result.travelled, 0.005, 1e-9);
  cloth_.step(50);
  EXPECT_NEAR(stateOf(cloth_, grasp).pose.position.z, BOTTOM - 0.005, 1e-6);
}

TEST_F(GraspInterface, ANewGoalForTheSameGraspPreemptsTheOneBefore)
{
  const std::uint64_t grasp = cloth_.grasp(at(0.0, BOTTOM), 0.05).grasp_id;
  const auto first = begin(pullDown(grasp, 0.1));
  cloth_.step(10);
  const auto second = begin(pullDown(grasp, 0.005));

  EXPECT_EQ(endOf(*first).outcome, PullResult::CANCELLED);
  cloth_.step(30);
  EXPECT_EQ(endOf(*second).outcome, PullResult::ARRIVED);
}

TEST_F(GraspInterface, APullWhoseGraspIsReleasedIsLost)
{
  const std::uint64_t grasp = cloth_.grasp(at(0.0, BOTTOM), 0.05).grasp_id;
  const auto pull = begin(pullDown(grasp, 0.1));
  cloth_.release(grasp);

  EXPECT_EQ(endOf(*pull).outcome, PullResult::LOST);
  EXPECT_EQ(pull->getState(), actionlib::SimpleClientGoalState::ABORTED);
}

TEST_F(GraspInterface, RefusesPullsThatMakeNoSenseAndChangesNothing)
{
  const std::uint64_t before = cloth_.step(0).state_hash;
  struct Case
  {
    std::function<void(PullGoal&)> spoil;
    std::string words;
  };
  const std::vector<Case> cases = {
    { [](PullGoal& g) { g.grasp_id = 99; }, "there is no grasp 99" },
    { [](PullGoal& g) { g.linear_speed = 0.0; }, "linear_speed [m/s] is 0" },
    { [](PullGoal& g) { g.distance = -1.0; }, "distance [m] is -1" },
    { [](PullGoal& g) { g.direction.z = 0.0; }, "direction: its length is 0" },
    { [](PullGoal& g) { g.direction.x = NAN; }, "direction" },
    { [](PullGoal& g) { g.stop_force = -2.0; }, "stop_force [N] is -2" },
    { [](PullGoal& g) { g.header.frame_id = ""; }, "header.frame_id is empty" },
    { [](PullGoal& g) { g.header.frame_id = "nowhere"; }, "nowhere" },
    { [](PullGoal& g) { g.point.x = 50.0; }, "no particle within" },
    { [](PullGoal& g) { g.radius = -1.0; }, "radius" },
  };
  for (const Case& wrong : cases)
  {
    PullGoal goal = pullDown(0, 0.1);
    goal.point = at(0.0, BOTTOM);
    wrong.spoil(goal);
    const auto pull = begin(goal);
    const PullResult result = endOf(*pull);
    EXPECT_EQ(pull->getState(), actionlib::SimpleClientGoalState::REJECTED) << wrong.words;
    EXPECT_EQ(result.outcome, PullResult::REFUSED);
    EXPECT_NE(result.message.find(wrong.words), std::string::npos) << result.message;
    expectRefused([&] { cloth_.predictPull(goal, PATIENCE); }, wrong.words);
  }
  EXPECT_EQ(cloth_.step(0).state_hash, before);
}

TEST_F(GraspInterface, PredictsWhatAPullTearsWithoutTouchingTheCloth)
{
  const std::uint64_t grasp = cloth_.grasp(at(0.0, BOTTOM), 0.05).grasp_id;
  cloth_.step(200);
  const std::uint64_t before = cloth_.step(0).state_hash;

  const PullResult forecast = cloth_.predictPull(pullDown(grasp, 0.4), PATIENCE);

  EXPECT_EQ(cloth_.step(0).state_hash, before);
  EXPECT_TRUE(cloth_.tears().empty() || cloth_.tears().back().epoch < cloth_.step(0).epoch);
  const auto pull = begin(pullDown(grasp, 0.4));
  cloth_.step(900);
  const PullResult real = endOf(*pull);
  EXPECT_GT(real.tears, 0u);
  EXPECT_EQ(forecast.tears, real.tears);
  EXPECT_EQ(forecast.events.size(), real.events.size());
  EXPECT_EQ(forecast.peak_force, real.peak_force);
  EXPECT_EQ(forecast.pieces, real.pieces);
}

TEST_F(GraspInterface, AStreamedTargetIsReachedInTheTimeSinceTheLast)
{
  const std::uint64_t grasp = cloth_.grasp(at(0.0, BOTTOM), 0.05).grasp_id;
  ros::Publisher targets = ros::NodeHandle().advertise<GraspTargets>("/cloth/grasp_targets", 10);
  ASSERT_TRUE(isSoon([&] { return targets.getNumSubscribers() > 0; }));
  GraspTargets message;
  message.header.frame_id = "world";
  message.targets.resize(1);
  message.targets[0].grasp_id = grasp;
  message.targets[0].pose.position = at(0.01, BOTTOM);
  targets.publish(message);
  ASSERT_TRUE(isSoon([&] { return stateOf(cloth_, grasp).moving; }));

  cloth_.step(50);
  EXPECT_NEAR(stateOf(cloth_, grasp).pose.position.x, 0.005, 1e-9) << "half of 0.1 s";
  cloth_.step(51);
  EXPECT_NEAR(stateOf(cloth_, grasp).pose.position.x, 0.01, 1e-9);
  EXPECT_FALSE(stateOf(cloth_, grasp).moving);
}

TEST_F(GraspInterface, AGraspOfWhichNobodySpeaksAnyMoreLetsGo)
{
  const std::uint64_t lasting = cloth_.grasp(at(-0.1, BOTTOM), 0.03).grasp_id;
  const ros::WallTime begin = ros::WallTime::now();
  const std::uint64_t left = cloth_.grasp(at(0.1, BOTTOM), 0.03, 0.0, "", 0.3).grasp_id;

  ASSERT_TRUE(isSoon([&] { return states(cloth_).grasps.size() == 1; }));

  EXPECT_GE((ros::WallTime::now() - begin).toSec(), 0.3);
  EXPECT_EQ(states(cloth_).grasps[0].grasp_id, lasting);
  const std::vector<GraspEvent> released = events(cloth_, GraspEvent::RELEASED);
  ASSERT_EQ(released.size(), 1u);
  EXPECT_EQ(released[0].grasp_id, left);
  EXPECT_EQ(released[0].reason, "nobody has spoken for it for its keep_alive of 0.3 s");
}

TEST_F(GraspInterface, APausedClothIsLetGoToo)
{
  const ClothClient running("/running", "world", PATIENCE);
  running.reset();
  running.pause();
  const std::uint64_t step = running.step(0).step;
  const std::uint64_t left = running.grasp(at(0.1, BOTTOM), 0.03, 0.0, "", 0.3).grasp_id;

  ASSERT_TRUE(isSoon([&] { return states(running).grasps.empty(); }));

  const std::vector<GraspEvent> released = events(running, GraspEvent::RELEASED);
  ASSERT_EQ(released.size(), 1u);
  EXPECT_EQ(released[0].grasp_id, left);
  EXPECT_EQ(running.step(0).step, step);
}

TEST_F(GraspInterface, AGraspLastsAsLongAsItIsSpokenFor)
{
  ros::Publisher targets = ros::NodeHandle().advertise<GraspTargets>("/cloth/grasp_targets", 10);
  ASSERT_TRUE(isSoon([&] { return targets.getNumSubscribers() > 0; }));
  constexpr double KEEP_ALIVE = 1.0;
  const auto steered = cloth_.grasp(at(0.1, BOTTOM), 0.03, 0.0, "", KEEP_ALIVE).grasp_id;
  const auto dragged = cloth_.grasp(at(-0.1, BOTTOM), 0.03, 0.0, "", KEEP_ALIVE).grasp_id;
  GraspTargets message;
  message.header.frame_id = "world";
  message.targets.resize(1);
  message.targets[0].grasp_id = steered;
  message.targets[0].pose.position = at(0.1, BOTTOM);

  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(2.5 * KEEP_ALIVE);
  for (ros::WallRate rate(10.0); ros::WallTime::now() < end; rate.sleep())
  {
    targets.publish(message);
    cloth_.drag(dragged, at(-0.1, BOTTOM), 0.1);
  }

  EXPECT_EQ(states(cloth_).grasps.size(), 2u);
  EXPECT_TRUE(isSoon([&] { return states(cloth_).grasps.empty(); })) << "now nobody speaks";
}

TEST_F(GraspInterface, RefusesAKeepAliveThatMakesNoSense)
{
  for (const double wrong : { -1.0, 3601.0, static_cast<double>(NAN) })
  {
    expectRefused([&] { cloth_.grasp(at(0.1, BOTTOM), 0.03, 0.0, "", wrong); }, "keep_alive [s]");
  }
  EXPECT_TRUE(states(cloth_).grasps.empty());
}

TEST_F(GraspInterface, AStreamMakesNoTopicFasterThanItsRate)
{
  const std::uint64_t grasp = cloth_.grasp(at(0.0, BOTTOM), 0.05).grasp_id;
  ros::Publisher targets = ros::NodeHandle().advertise<GraspTargets>("/cloth/grasp_targets", 10);
  ASSERT_TRUE(isSoon([&] { return targets.getNumSubscribers() > 0; }));
  Collector<SimulationStatus> heard("/cloth/status");
  heard.first();
  const ros::WallTime begin = ros::WallTime::now();
  GraspTargets message;
  message.header.frame_id = "world";
  message.targets.resize(1);
  message.targets[0].grasp_id = grasp;
  for (int i = 0; i < 200; ++i)
  {
    message.targets[0].pose.position = at(1e-5 * i, BOTTOM);
    targets.publish(message);
    cloth_.step(1);
  }
  const std::size_t statuses = heard.all().size();
  const double elapsed = (ros::WallTime::now() - begin).toSec();
  EXPECT_LE(statuses, 10.0 * elapsed + 3.0) << "in " << elapsed << " s, at 10 Hz";
}

TEST_F(GraspInterface, AGraspFollowsItsFrameAndTellsWhenThatIsLost)
{
  const std::uint64_t grasp = graspWith("hand", cloth_, at(0.0, BOTTOM));
  EXPECT_EQ(stateOf(cloth_, grasp).gripper_frame, "hand");
  expectRefused([&] { cloth_.drag(grasp, at(0.0, 1.0), 0.1); }, "follows the frame \"hand\"");
  EXPECT_EQ(cloth_.predictPull(pullDown(grasp, 0.01), PATIENCE).outcome, PullResult::ARRIVED)
      << "as if nothing but the pull moved it";

  EXPECT_TRUE(isSoon(
      [&]
      {
        tell("hand", 0.02, 0.0, BOTTOM);
        cloth_.step(20);
        return std::abs(stateOf(cloth_, grasp).pose.position.x - 0.02) < 1e-9;
      }));
  EXPECT_TRUE(isSoon(
      [&]
      {
        cloth_.step(1);
        return !events(cloth_, GraspEvent::FRAME_LOST).empty();
      }));
  const GraspState lost = stateOf(cloth_, grasp);
  EXPECT_NE(lost.frame_problem.find("frame_timeout"), std::string::npos) << lost.frame_problem;
  EXPECT_NEAR(lost.pose.position.x, 0.02, 1e-9) << "it holds where it was";

  EXPECT_TRUE(isSoon(
      [&]
      {
        tell("hand", 0.02, 0.0, BOTTOM);
        cloth_.step(1);
        return !events(cloth_, GraspEvent::FRAME_FOUND).empty();
      }));
}

TEST_F(GraspInterface, AGraspWithoutItsFrameLetsGoWhereThatIsWanted)
{
  const std::uint64_t grasp = graspWith("arm", free_, at(0.2, TOP));
  EXPECT_TRUE(isSoon(
      [&]
      {
        free_.step(1);
        return states(free_).grasps.empty();
      }));

  const std::vector<GraspEvent> released = events(free_, GraspEvent::RELEASED);
  ASSERT_EQ(released.size(), 1u);
  EXPECT_EQ(released[0].grasp_id, grasp);
  EXPECT_NE(released[0].reason.find("arm"), std::string::npos) << released[0].reason;
}

TEST_F(GraspInterface, AFrameThatIsNotThereIsRefused)
{
  const std::uint64_t before = cloth_.step(0).state_hash;
  expectRefused([&] { cloth_.grasp(at(0.0, BOTTOM), 0.05, 0.0, "no_hand"); },
                "gripper_frame: no transform from no_hand");
  EXPECT_EQ(cloth_.step(0).state_hash, before);
}

TEST_F(GraspInterface, AWrenchIsToldInTheFrameOfItsGripper)
{
  const std::uint64_t grasp = graspWith("tool", free_, at(0.2, TOP));
  Collector<geometry_msgs::WrenchStamped> heard("/free/grasps/" + std::to_string(grasp) +
                                                "/wrench");
  ASSERT_TRUE(isSoon([&] { return heard.publishers() > 0; }));
  ASSERT_TRUE(isSoon(
      [&]
      {
        tell("tool", 0.2, 0.0, TOP);
        free_.step(5);
        return !heard.all().empty();
      }));
  EXPECT_EQ(heard.first().header.frame_id, "tool");
}

TEST_F(GraspInterface, ASphereMovesWithTheLinkThatItIsFixedTo)
{
  ros::Publisher spheres = ros::NodeHandle().advertise<CollisionSpheres>("/cloth/spheres", 1);
  ASSERT_TRUE(isSoon([&] { return spheres.getNumSubscribers() > 0; }));
  CollisionSpheres message;
  message.spheres.resize(1);
  message.spheres[0].id = 4;
  message.spheres[0].frame = "finger";
  message.spheres[0].radius = 0.05;
  const std::uint64_t before = cloth_.step(0).state_hash;
  ASSERT_TRUE(isSoon(
      [&]
      {
        tell("finger", 0.0, -0.3, BOTTOM + 0.1);
        spheres.publish(message);
        return cloth_.step(0).state_hash != before;
      }));

  double y = -0.3;
  EXPECT_TRUE(isSoon(
      [&]
      {
        y = std::min(y + 0.02, 0.1);
        tell("finger", 0.0, y, BOTTOM + 0.1);
        cloth_.step(20);
        return length(states(cloth_).contact_force) > 0.0;
      }))
      << "it pushes the cloth";
  spheres.publish(CollisionSpheres());
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "grasp_interface_rostest");
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
