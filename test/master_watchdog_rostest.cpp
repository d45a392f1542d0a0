// The master dies and comes back, or stops to answer: the node goes on, is found again, and ends.
#include <arpa/inet.h>
#include <cloth_tearing/ClothSurface.h>
#include <cloth_tearing/CollisionSpheres.h>
#include <cloth_tearing/Grasp.h>
#include <cloth_tearing/GraspTargets.h>
#include <cloth_tearing/SimulationStatus.h>
#include <cloth_tearing/Step.h>
#include <ros/master.h>
#include <std_srvs/Trigger.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "child_process.h"
#include "node_client.h"

using cloth_tearing::ClothSurface;
using cloth_tearing::CollisionSpheres;
using cloth_tearing::Grasp;
using cloth_tearing::GraspTargets;
using cloth_tearing::SimulationStatus;
using cloth_tearing::Step;
using std_srvs::Trigger;

namespace
{

const std::string NODE = "/victim";
constexpr int LIFE = 100;  // of children, if nobody ends them [s]

/// A port that nobody listens on, none of those that the system gives to outgoing connections.
int freePort()
{
  for (int port = 12000 + getpid() % 10000;; ++port)
  {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(static_cast<std::uint16_t>(port));
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int probe = socket(AF_INET, SOCK_STREAM, 0);
    const bool is_free = bind(probe, reinterpret_cast<sockaddr*>(&place), sizeof(place)) == 0;
    close(probe);
    if (is_free)
    {
      return port;
    }
  }
}

const int PORT = freePort();

/// A master, and the node that registered at it.
class MasterWatchdogTest : public testing::Test
{
protected:
  void SetUp() override
  {
    startMaster();
    ros::param::set(NODE + "/rectangle/columns", 5);
    ros::param::set(NODE + "/rectangle/rows", 5);
    ros::param::set(NODE + "/pace", "step");
    ros::param::set(NODE + "/master_period", 0.2);
    node_ = startNode();
    ask<Step>(NODE + "/step");
  }

  void TearDown() override
  {
    node_.reset();
    master_.reset();
  }

  void startMaster()
  {
    master_ = std::make_unique<ChildProcess>(
        std::vector<std::string>{ "rosmaster", "--core", "-p", std::to_string(PORT) }, LIFE);
    ASSERT_TRUE(isSoon([] { return ros::master::check(); })) << "no master";
  }

  void killMaster()
  {
    master_->signalBoth(SIGKILL);
    master_.reset();
  }

  /// The node has to end in good order after `fault` befell the master.
  void endWith(int fault)
  {
    master_->signalBoth(fault);
    EXPECT_TRUE(node_->says("is gone"));
    node_->signal(SIGTERM);
    EXPECT_EQ(node_->exitStatus(), 0);
    master_->signalBoth(SIGKILL);
  }

  static std::unique_ptr<ChildProcess> startNode()
  {
    return std::make_unique<ChildProcess>(
        std::vector<std::string>{ CLOTH_TEARING_NODE, "__name:=victim" }, LIFE);
  }

  std::unique_ptr<ChildProcess> master_;
  std::unique_ptr<ChildProcess> node_;
};

/// A connection to ~step that was made before, and so needs no master.
ros::ServiceClient keptStep()
{
  ros::NodeHandle node;
  return node.serviceClient<Step>(NODE + "/step", true);
}

Step::Response step(ros::ServiceClient& client, std::uint32_t steps)
{
  Step call;
  call.request.steps = steps;
  EXPECT_TRUE(client.call(call)) << "the connection was lost";
  EXPECT_TRUE(call.response.success) << call.response.message;
  return call.response;
}

int count(const std::vector<std::string>& lines, const std::string& text)
{
  return static_cast<int>(std::count_if(lines.begin(), lines.end(),
                                        [&text](const std::string& line)
                                        { return line.find(text) != std::string::npos; }));
}

}  // namespace

TEST_F(MasterWatchdogTest, IsFoundAgainAfterEachOfThreeRestartsAndStepsAsIfNothingHadHappened)
{
  ros::ServiceClient client = keptStep();
  const std::uint64_t undisturbed = step(client, 800).state_hash;
  ASSERT_TRUE(ask<Trigger>(NODE + "/reset").success);
  Collector<SimulationStatus> before(NODE + "/status");
  before.first();

  std::uint64_t now = 0;
  double longest = 0.0;
  for (int restart = 0; restart < 3; ++restart)
  {
    step(client, 100);
    killMaster();
    step(client, 100);
    startMaster();

    const ros::WallTime begin = ros::WallTime::now();
    EXPECT_TRUE(ros::service::waitForService(NODE + "/step", ros::Duration(PATIENCE)));
    longest = std::max(longest, (ros::WallTime::now() - begin).toSec());
    now = step(client, 50).step;
    before.waitFor("of the one from before", [now](const auto& s) { return s.step >= now; });
    Collector<ClothSurface> after(NODE + "/surface");
    after.waitFor("of a new one", [now](const auto& s) { return s.step >= now; });
  }
  EXPECT_EQ(step(client, 50).state_hash, undisturbed);
  std::printf("restarts of the master: 3, back after %.2f s at the latest\n", longest);
}

TEST_F(MasterWatchdogTest, HearsThosePublishersWhichItHeardBeforeAndNewOnes)
{
  ros::NodeHandle handle;
  ros::Publisher old_one = handle.advertise<CollisionSpheres>(NODE + "/spheres", 1);
  ASSERT_TRUE(isSoon([&] { return old_one.getNumSubscribers() > 0; }));

  killMaster();
  node_->signalBoth(SIGSTOP);
  startMaster();
  ros::Publisher new_one = handle.advertise<GraspTargets>(NODE + "/grasp_targets", 1);
  node_->signalBoth(SIGCONT);  // the publisher was there before the node was back
  ASSERT_TRUE(ros::service::waitForService(NODE + "/step", ros::Duration(PATIENCE)));
  EXPECT_TRUE(isSoon([&] { return new_one.getNumSubscribers() > 0; }));

  Collector<SimulationStatus> status(NODE + "/status");
  CollisionSpheres message;
  message.header.frame_id = "world";
  message.spheres.resize(1);
  message.spheres[0].id = 1;
  message.spheres[0].center.y = -1.0;
  message.spheres[0].radius = 0.05;
  old_one.publish(message);
  status.waitFor("the sphere of the publisher from before",
                 [](const SimulationStatus& s) { return s.spheres == 1; });
}

TEST_F(MasterWatchdogTest, SetsItsParametersAgainUnlessThereAreNewOnes)
{
  std::string pace;
  const auto set = [&pace] { return ros::param::get(NODE + "/pace", pace); };
  killMaster();
  startMaster();
  EXPECT_TRUE(isSoon(set));
  EXPECT_EQ(pace, "step");

  killMaster();
  startMaster();
  ros::param::set(NODE + "/speed", 0.5);
  EXPECT_TRUE(ros::service::waitForService(NODE + "/step", ros::Duration(PATIENCE)));
  EXPECT_FALSE(set()) << "they belong to whoever set new ones";
}

TEST_F(MasterWatchdogTest, SaysOnceThatTheMasterIsGoneAndOnceThatItIsBack)
{
  std::vector<std::string> said;
  for (int i = 0; i < 2; ++i)  // what is said too often is said before the next time at the latest
  {
    killMaster();
    EXPECT_TRUE(node_->says("is gone", &said));
    startMaster();
    EXPECT_TRUE(node_->says("registered again", &said));  // when all are: the last of it
  }
  node_->signal(SIGINT);

  for (const std::string& line : node_->lines())
  {
    said.push_back(line);
  }
  EXPECT_EQ(count(said, "is gone"), 2);
  EXPECT_EQ(count(said, "is back") - count(said, "until it is back"), 2);
  EXPECT_EQ(count(said, "registered again"), 2);
  EXPECT_EQ(node_->exitStatus(), 0);
}

TEST_F(MasterWatchdogTest, TakesAGraspWithoutAMasterAndMakesItsTopicKnownLater)
{
  ros::NodeHandle handle;
  ros::ServiceClient client = handle.serviceClient<Grasp>(NODE + "/grasp", true);
  Collector<SimulationStatus> status(NODE + "/status");
  status.first();
  killMaster();
  Grasp call;
  call.request.header.frame_id = "world";
  call.request.point.z = 1.5;
  call.request.radius = 0.3;
  ASSERT_TRUE(client.call(call));
  ASSERT_TRUE(call.response.success) << call.response.message;
  status.waitFor("the grasp", [](const SimulationStatus& s) { return s.grasps == 1; });

  startMaster();

  const std::string wrench = NODE + "/grasps/" + std::to_string(call.response.grasp_id) + "/wrench";
  EXPECT_TRUE(isSoon(
      [&wrench]
      {
        ros::master::V_TopicInfo topics;
        ros::master::getTopics(topics);
        return std::any_of(topics.begin(), topics.end(),
                           [&wrench](const auto& topic) { return topic.name == wrench; });
      }));
}

TEST_F(MasterWatchdogTest, LeavesItsNameToAnotherNodeThatHasTakenIt)
{
  killMaster();
  node_->signalBoth(SIGSTOP);
  startMaster();
  const std::unique_ptr<ChildProcess> another = startNode();
  EXPECT_TRUE(ask<Trigger>(NODE + "/pause").success);

  node_->signalBoth(SIGCONT);

  EXPECT_EQ(node_->exitStatus(), 0);
  EXPECT_TRUE(ask<Trigger>(NODE + "/pause").success);
}

TEST_F(MasterWatchdogTest, EndsWithoutAMaster)
{
  endWith(SIGKILL);
}

TEST_F(MasterWatchdogTest, EndsWithAMasterThatHasStoppedToAnswer)
{
  endWith(SIGSTOP);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  setenv("ROS_MASTER_URI", ("http://127.0.0.1:" + std::to_string(PORT)).c_str(), 1);
  ros::init(argc, argv, "master_watchdog_rostest");
  const ChildProcess first({ "rosmaster", "--core", "-p", std::to_string(PORT) }, LIFE);
  if (!isSoon([] { return ros::master::check(); }))
  {
    return 1;
  }
  ros::NodeHandle node;
  first.signalBoth(SIGKILL);
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
