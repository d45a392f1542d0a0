// How the node's process begins and ends: exit status, registration, and what it says.
#include <cloth_tearing/CollisionSpheres.h>
#include <cloth_tearing/PullActionGoal.h>
#include <cloth_tearing/SimulationStatus.h>
#include <cloth_tearing/Step.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/xmlrpc_manager.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <future>
#include <memory>
#include <thread>

#include "child_process.h"
#include "node_client.h"

using cloth_tearing::CollisionSpheres;
using cloth_tearing::PullActionGoal;
using cloth_tearing::SimulationStatus;
using cloth_tearing::Step;

namespace
{

const std::string NODE = "/victim";

ChildProcess startNode()
{
  return ChildProcess({ CLOTH_TEARING_NODE, "__name:=victim" }, static_cast<int>(PATIENCE));
}

bool registered()
{
  std::vector<std::string> nodes;
  EXPECT_TRUE(ros::master::getNodes(nodes));
  return std::count(nodes.begin(), nodes.end(), NODE) > 0;
}

int repetitions()
{
  const char* const thorough = std::getenv("CLOTH_TEARING_THOROUGH");
  return thorough != nullptr && std::string(thorough) == "1" ? 20 : 2;
}

Step::Response step(std::uint32_t steps)
{
  Step::Request request;
  request.steps = steps;
  return ask<Step>(NODE + "/step", request);
}

/// Keeps the node busy with a long ~step, a pull and spheres that stream as fast as they can.
class Work
{
public:
  Work()
      : step_(std::async(std::launch::async,
                         []
                         {
                           Step call;
                           call.request.steps = 4000000000U;
                           return ros::service::call(NODE + "/step", call) && call.response.success;
                         }))
      , goal_(ros::NodeHandle().advertise<PullActionGoal>(NODE + "/pull/goal", 1))
      , spheres_(ros::NodeHandle().advertise<CollisionSpheres>(NODE + "/spheres", 1))
  {
    Collector<SimulationStatus> status(NODE + "/status");
    EXPECT_TRUE(isSoon(
        [this] { return goal_.getNumSubscribers() > 0 && spheres_.getNumSubscribers() > 0; }));
    stream_ = std::thread([this] { stream(); });
    pull();
    status.waitFor("all of it is under way", [](const SimulationStatus& s)
                   { return s.step > 0 && s.grasps == 1 && s.spheres == 1; });
  }

  /// Once the node has ended.
  ~Work()
  {
    over_ = true;
    stream_.join();
    EXPECT_FALSE(step_.get()) << "the step was not done";
  }

private:
  void pull() const
  {
    PullActionGoal message;
    message.goal.header.frame_id = "world";
    message.goal.point.z = 0.5;
    message.goal.radius = 0.3;
    message.goal.direction.z = -1.0;
    message.goal.distance = 1.0;
    message.goal.linear_speed = 1e-6;
    goal_.publish(message);
  }

  void stream() const
  {
    CollisionSpheres message;
    message.header.frame_id = "world";
    message.spheres.resize(1);
    message.spheres[0].radius = 0.05;
    while (!over_)
    {
      message.spheres[0].center.y = 1.0 + 1e-9 * ++message.header.seq;
      spheres_.publish(message);
      std::this_thread::yield();
    }
  }

  std::future<bool> step_;
  ros::Publisher goal_;
  ros::Publisher spheres_;
  std::atomic<bool> over_{ false };
  std::thread stream_;
};

/// @return how long it took [s]
double endBySignal(int signal, bool busy)
{
  ChildProcess node = startNode();
  EXPECT_TRUE(step(0).success);
  EXPECT_TRUE(registered());
  const std::unique_ptr<Work> work = busy ? std::make_unique<Work>() : nullptr;
  const ros::WallTime begin = ros::WallTime::now();

  node.signal(signal);

  EXPECT_EQ(node.exitStatus(), 0) << strsignal(signal);
  const double taken = (ros::WallTime::now() - begin).toSec();
  EXPECT_FALSE(registered()) << strsignal(signal);
  return taken;
}

class NodeProcessTest : public testing::Test
{
protected:
  void SetUp() override
  {
    ros::param::del(NODE);
    ros::param::set(NODE + "/rectangle/columns", 5);
    ros::param::set(NODE + "/rectangle/rows", 5);
    ros::param::set(NODE + "/pace", "step");
  }
};

}  // namespace

TEST_F(NodeProcessTest, EndsCleanlyOnSigintAndSigtermIdleAndBusy)
{
  for (const int signal : { SIGINT, SIGTERM })
  {
    for (const bool busy : { false, true })
    {
      double longest = 0.0;
      for (int i = 0; i < repetitions(); ++i)
      {
        longest = std::max(longest, endBySignal(signal, busy));
      }
      std::printf("endings: %s, %s: %d, longest %.2f s\n", strsignal(signal),
                  busy ? "busy" : "idle", repetitions(), longest);
    }
  }
}

TEST_F(NodeProcessTest, EndsCleanlyWhileItRunsAsFastAsItCan)
{
  ros::param::set(NODE + "/pace", "free");
  ChildProcess node = startNode();
  step(0);

  node.signal(SIGTERM);

  EXPECT_EQ(node.exitStatus(), 0);
  EXPECT_FALSE(registered());
}

TEST_F(NodeProcessTest, EndsWhenTheMasterAsksItTo)
{
  ChildProcess node = startNode();
  ASSERT_TRUE(step(0).success);
  std::string host;
  std::uint32_t port = 0;
  XmlRpc::XmlRpcValue lookup, answer, uri;
  lookup[0] = "/tester";
  lookup[1] = NODE;
  ASSERT_TRUE(ros::master::execute("lookupNode", lookup, answer, uri, false));
  ASSERT_TRUE(ros::network::splitURI(static_cast<std::string>(uri), host, port));
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue farewell;
  farewell[0] = "/tester";
  farewell[1] = "no more";

  ASSERT_TRUE(client.execute("shutdown", farewell, answer));

  EXPECT_EQ(node.exitStatus(), 0);
}

TEST_F(NodeProcessTest, CanBeEndedWhileItWaitsForAMaster)
{
  const std::string master = ros::master::getURI();
  setenv("ROS_MASTER_URI", "http://127.0.0.1:9", 1);  // nobody serves there
  ChildProcess node = startNode();
  setenv("ROS_MASTER_URI", master.c_str(), 1);
  ASSERT_TRUE(node.says("Waiting for the master"));

  node.signal(SIGTERM);

  EXPECT_EQ(node.exitStatus(), 0);
}

TEST_F(NodeProcessTest, RefusesToRunWithNonsenseAndNamesAllOfIt)
{
  ros::param::set(NODE + "/time_step", "fast");
  ros::param::set(NODE + "/material/stifness", 10.0);
  ros::param::set(NODE + "/tearing/tear_strain", -1.0);
  ros::param::set(NODE + "/pace", "leisurely");
  ChildProcess node = startNode();

  const std::string words = node.rest();
  EXPECT_EQ(node.exitStatus(), 1);
  for (const char* expected :
       { "time_step is the text \"fast\"", "did you mean material/stiffness?",
         "tearing/tear_strain", "pace is the text \"leisurely\", must be one of clock, free" })
  {
    EXPECT_NE(words.find(expected), std::string::npos) << expected << " is not among:\n" << words;
  }
  EXPECT_FALSE(registered());
}

TEST_F(NodeProcessTest, RefusesToRunWithoutAModel)
{
  ros::param::set(NODE + "/model_file", "/nowhere/cloth.obj");
  ChildProcess node = startNode();

  EXPECT_TRUE(node.says("/nowhere/cloth.obj"));
  EXPECT_EQ(node.exitStatus(), 1);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "node_process_rostest");
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
