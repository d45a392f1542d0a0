// The promises of ~save_state and ~restore_state, on running nodes that are stepped.
#include <cloth_tearing/CollisionSpheres.h>
#include <cloth_tearing/Drag.h>
#include <cloth_tearing/GetTearEvents.h>
#include <cloth_tearing/Grasp.h>
#include <cloth_tearing/GraspStates.h>
#include <cloth_tearing/NamedState.h>
#include <cloth_tearing/Release.h>
#include <cloth_tearing/Step.h>
#include <cloth_tearing/ThrowSphere.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/transform_broadcaster.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <future>

#include "node_client.h"

using namespace cloth_tearing;  // NOLINT: the messages are what all of this is about

namespace
{

std::string state_folder;  // NOLINT: set by main()

Step::Response step(std::uint32_t steps, const std::string& node = "/cloth")
{
  Step::Request request;
  request.steps = steps;
  return ask<Step>(node + "/step", request);
}

NamedState::Response named(const std::string& service, const std::string& name, bool file = false)
{
  NamedState::Request request;
  request.name = name;
  request.file = file;
  return ask<NamedState>(service, request);
}

std::vector<std::uint64_t> hashesOf(const std::string& node)
{
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < 30; ++i)
  {
    hashes.push_back(step(i < 15 ? 1 : 10, node).state_hash);
  }
  return hashes;
}

/// From the untorn cloth: a gripper tears it, and a ball flies in.
void tear()
{
  ask<std_srvs::Trigger>("/cloth/reset");
  Grasp::Request grasp;
  grasp.header.frame_id = "world";
  grasp.point.z = 1.2;
  grasp.radius = 0.06;
  const Grasp::Response taken = ask<Grasp>("/cloth/grasp", grasp);
  ASSERT_TRUE(taken.success) << taken.message;
  Drag::Request drag;
  drag.header.frame_id = "world";
  drag.grasp_id = taken.grasp_id;
  drag.target.position.x = 0.1;
  drag.target.position.y = -0.2;
  drag.target.position.z = 0.2;
  drag.target.orientation.w = 1.0;
  drag.linear_speed = 2.0;
  drag.angular_speed = 1.0;
  const Drag::Response dragged = ask<Drag>("/cloth/drag", drag);
  ASSERT_TRUE(dragged.success) << dragged.message;
  ThrowSphere::Request ball;
  ball.header.frame_id = "world";
  ball.center.x = -0.1;
  ball.center.y = -0.5;
  ball.center.z = 1.35;
  ball.velocity.y = 3.0;
  ball.radius = 0.05;
  ball.lifetime = 5.0;
  const ThrowSphere::Response thrown = ask<ThrowSphere>("/cloth/throw_sphere", ball);
  ASSERT_TRUE(thrown.success) << thrown.message;
  const Step::Response torn = step(200);
  ASSERT_GT(torn.tears, 0u) << "it has to tear before the state is saved";
}

TEST(StateServices, GoOnFromASavedStateBitForBit)
{
  tear();
  const NamedState::Response saved = named("/cloth/save_state", "torn");
  ASSERT_TRUE(saved.success) << saved.message;
  EXPECT_EQ(saved.step, 200u);
  const Step::Response before = step(0);
  EXPECT_EQ(saved.state_hash, before.state_hash);
  const std::vector<std::uint64_t> hashes = hashesOf("/cloth");
  EXPECT_GT(step(0).step, 300u);

  const NamedState::Response restored = named("/cloth/restore_state", "torn");

  ASSERT_TRUE(restored.success) << restored.message;
  EXPECT_EQ(restored.step, 200u);
  EXPECT_EQ(restored.state_hash, saved.state_hash);
  const Step::Response after = step(0);
  EXPECT_EQ(after.step, 200u);
  EXPECT_EQ(after.epoch, before.epoch + 1);
  EXPECT_GT(after.time, before.time);
  EXPECT_EQ(hashesOf("/cloth"), hashes);
}

TEST(StateServices, GoOnFromAFileInAnotherNodeWithTheTearsOfTheCloth)
{
  tear();
  const NamedState::Response saved = named("/cloth/save_state", "torn", true);
  ASSERT_TRUE(saved.success) << saved.message;

  const NamedState::Response restored = named("/other/restore_state", "torn", true);

  ASSERT_TRUE(restored.success) << restored.message;
  EXPECT_EQ(restored.state_hash, saved.state_hash);
  EXPECT_EQ(hashesOf("/other"), hashesOf("/cloth"));
  const GetTearEvents::Response events = ask<GetTearEvents>("/other/get_tear_events");
  ASSERT_FALSE(events.events.empty());
  EXPECT_EQ(events.events.front().sequence, 1u);
  EXPECT_LE(events.events.front().step, 200u) << "one from before the state was saved";
}

/// Tells where the frame "finger" is, now: at half the height of the cloth, `y` [m] behind it.
void tellFinger(tf2_ros::TransformBroadcaster& broadcaster, double y)
{
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "world";
  transform.header.stamp = ros::Time::now();
  transform.child_frame_id = "finger";
  transform.transform.translation.y = y;
  transform.transform.translation.z = 1.2;
  transform.transform.rotation.w = 1.0;
  broadcaster.sendTransform(transform);
}

/// How hard spheres pushed the cloth of `node` in the last step [N].
double contactForce(const std::string& node)
{
  const Step::Response now = step(0, node);
  Collector<GraspStates> heard(node + "/grasp_states");
  const geometry_msgs::Vector3 force =
      heard
          .waitFor("the states of now", [&now](const GraspStates& states)
                   { return states.epoch == now.epoch && states.step == now.step; })
          .contact_force;
  return std::hypot(force.x, force.y, force.z);
}

/// A sphere that follows the frame "finger".
class FingerState : public testing::Test
{
protected:
  /// Saves the cloth with the sphere in front of it, and takes the sphere away.
  void SetUp() override
  {
    ask<std_srvs::Trigger>("/cloth/reset");
    CollisionSpheres message;
    message.spheres.resize(1);
    message.spheres[0].frame = "finger";
    message.spheres[0].radius = 0.05;
    const std::uint64_t without = step(0).state_hash;
    const auto sends = [&](const CollisionSpheres& spheres)
    {
      tellFinger(broadcaster_, -0.3);
      spheres_.publish(spheres);
      return step(0).state_hash;
    };
    ASSERT_TRUE(isSoon([&] { return sends(message) != without; }));
    const NamedState::Response saved = named("/cloth/save_state", "finger", true);
    ASSERT_TRUE(saved.success) << saved.message;
    ASSERT_TRUE(isSoon([&] { return sends(CollisionSpheres()) == without; }));
  }

  static void restore(const std::string& node)
  {
    const NamedState::Response restored = named(node + "/restore_state", "finger", true);
    ASSERT_TRUE(restored.success) << restored.message;
  }

  /// Moves the finger until the sphere pushes the cloth.
  bool pushes(const std::string& node)
  {
    double y = -0.3;
    return isSoon(
        [&]
        {
          y = std::min(y + 0.02, 0.1);
          tellFinger(broadcaster_, y);
          step(20, node);
          return contactForce(node) > 0.0;
        });
  }

  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher spheres_ = ros::NodeHandle().advertise<CollisionSpheres>("/cloth/spheres", 1);
};

TEST_F(FingerState, FollowsTheFingerInTheNodeThatSavedItAndInAnother)
{
  restore("/cloth");
  EXPECT_TRUE(pushes("/cloth"));
  restore("/other");
  EXPECT_TRUE(pushes("/other"));
}

TEST_F(FingerState, GoesToWhereTheFingerHasMovedMeanwhile)
{
  restore("/cloth");
  ASSERT_TRUE(pushes("/cloth"));

  restore("/cloth");

  EXPECT_EQ(contactForce("/cloth"), 0.0) << "it is in front of the cloth again";
  double force = 0.0;
  for (int i = 0; i < 50 && force == 0.0; ++i)
  {
    step(5);
    force = contactForce("/cloth");
  }
  EXPECT_GT(force, 0.0);
}

TEST(StateServices, RefuseTheStateOfAClothInAnotherPlace)
{
  ASSERT_TRUE(named("/cloth/save_state", "here", true).success);
  const std::uint64_t before = step(0, "/elsewhere").state_hash;

  const NamedState::Response refused = named("/elsewhere/restore_state", "here", true);

  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("\"world at (0, 0, 1.5)\""), std::string::npos) << refused.message;
  EXPECT_NE(refused.message.find("\"world at (0, 0, 1)\""), std::string::npos) << refused.message;
  EXPECT_EQ(step(0, "/elsewhere").state_hash, before);
}

TEST(StateServices, CutsAStepShortThatIsUnderWay)
{
  ask<std_srvs::Trigger>("/cloth/reset");
  ASSERT_TRUE(named("/cloth/save_state", "start").success);
  auto answer = std::async(std::launch::async, [] { return step(100000000); });
  NamedState::Response restored;
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(PATIENCE);
  do  // the step may not have begun yet
  {
    restored = named("/cloth/restore_state", "start");
  } while (answer.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready &&
           ros::WallTime::now() < deadline);

  ASSERT_TRUE(restored.success) << restored.message;
  EXPECT_NE(answer.get().message.find("restored"), std::string::npos);
  EXPECT_EQ(step(0).step, 0u);
}

TEST(StateServices, RefuseWhatIsNoStateAndChangeNothing)
{
  ASSERT_TRUE(named("/cloth/save_state", "whole", true).success);
  const std::string whole = state_folder + "/whole.cloth";
  ASSERT_TRUE(std::filesystem::exists(whole));
  std::filesystem::copy(whole, state_folder + "/short.cloth");
  std::filesystem::resize_file(state_folder + "/short.cloth", 1000);
  std::filesystem::copy(whole, state_folder + "/changed.cloth");
  std::fstream(state_folder + "/changed.cloth", std::ios::in | std::ios::out | std::ios::binary)
      .seekp(5000)
      .put('\x5a')
      .put('\xa5');
  std::ofstream(state_folder + "/text.cloth") << "no state at all, but long enough for its head";
  const Step::Response before = step(0);

  const auto reason = [](const std::string& name, bool file)
  {
    const NamedState::Response response = named("/cloth/restore_state", name, file);
    EXPECT_FALSE(response.success) << name;
    return response.message;
  };
  EXPECT_NE(reason("unknown", false).find("no state \"unknown\""), std::string::npos);
  EXPECT_NE(reason("unknown", true).find(state_folder + "/unknown.cloth"), std::string::npos);
  EXPECT_NE(reason("../whole", true).find("name is"), std::string::npos);
  EXPECT_NE(reason("short", true).find("damaged"), std::string::npos);
  EXPECT_NE(reason("changed", true).find("damaged"), std::string::npos);
  EXPECT_NE(reason("text", true).find("no saved state"), std::string::npos);

  const Step::Response after = step(0);
  EXPECT_EQ(after.epoch, before.epoch);
  EXPECT_EQ(after.step, before.step);
  EXPECT_EQ(after.state_hash, before.state_hash);
}

TEST(StateServices, RefuseWhatTheirParametersDoNotAllow)
{
  const auto reason = [](const NamedState::Response& response)
  {
    EXPECT_FALSE(response.success);
    return response.message;
  };
  EXPECT_NE(reason(named("/bare/save_state", "a", true)).find("state_folder"), std::string::npos);
  EXPECT_NE(reason(named("/bare/restore_state", "a", true)).find("state_folder"),
            std::string::npos);
  EXPECT_NE(reason(named("/bare/save_state", "a b")).find("name is"), std::string::npos);
  ASSERT_TRUE(named("/bare/save_state", "a").success);
  ASSERT_TRUE(named("/bare/save_state", "b").success);
  EXPECT_NE(reason(named("/bare/save_state", "c")).find("max_states is 2"), std::string::npos);
}

}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "state_services_rostest");
  const ros::NodeHandle node("~");
  ros::AsyncSpinner spinner(1);
  spinner.start();
  state_folder = node.param<std::string>("state_folder", "");
  const int failed = RUN_ALL_TESTS();
  std::filesystem::remove_all(state_folder);
  return failed;
}
