// How the node's process begins and ends: exit status, registration, and what it says.
#include <cloth_tearing/SimulationStatus.h>
#include <cloth_tearing/Step.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/xmlrpc_manager.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <future>

#include "child_process.h"
#include "node_client.h"

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

cloth_tearing::Step::Response step(std::uint32_t steps)
{
  cloth_tearing::Step::Request request;
  request.steps = steps;
  return ask<cloth_tearing::Step>(NODE + "/step", request);
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

TEST_F(NodeProcessTest, EndsCleanlyOnSigintAndSigterm)
{
  for (const int signal : { SIGINT, SIGTERM })
  {
    ChildProcess node = startNode();
    ASSERT_TRUE(step(0).success);
    EXPECT_TRUE(registered());

    node.signal(signal);

    EXPECT_EQ(node.exitStatus(), 0) << strsignal(signal);
    EXPECT_FALSE(registered()) << strsignal(signal);
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

TEST_F(NodeProcessTest, EndsCleanlyWithinALongStep)
{
  ChildProcess node = startNode();
  const std::uint64_t begin = step(1).step;
  auto long_step =
      std::async(std::launch::async,
                 []
                 {
                   cloth_tearing::Step call;
                   call.request.steps = 4000000000U;
                   return ros::service::call(NODE + "/step", call) && call.response.success;
                 });
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(PATIENCE);
  std::uint64_t now = begin;
  {
    Collector<cloth_tearing::SimulationStatus> status(NODE + "/status");
    now = status.waitFor("the step is under way", [begin](const auto& s) { return s.step > begin; })
              .step;
  }
  ASSERT_GT(now, begin);

  node.signal(SIGINT);

  EXPECT_EQ(node.exitStatus(), 0);
  EXPECT_LT(ros::WallTime::now(), deadline);
  EXPECT_FALSE(registered());
  EXPECT_FALSE(long_step.get()) << "the step was not done";
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
