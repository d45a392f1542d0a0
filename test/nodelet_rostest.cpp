// The node as a nodelet: the same cloth, several in one process, and what happens to bad ones.
#include <cloth_tearing/CollisionSpheres.h>
#include <cloth_tearing/SimulationStatus.h>
#include <cloth_tearing/Step.h>
#include <nodelet/NodeletList.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <rosgraph_msgs/Log.h>

#include <algorithm>
#include <future>

#include "node_client.h"

using cloth_tearing::CollisionSpheres;
using cloth_tearing::SimulationStatus;
using rosgraph_msgs::Log;

namespace
{

cloth_tearing::Step::Response step(const std::string& node, std::uint32_t steps)
{
  cloth_tearing::Step::Request request;
  request.steps = steps;
  return ask<cloth_tearing::Step>(node + "/step", request);
}

/// The manager has no other answer to a nodelet that fails than to fail the call.
bool load(const std::string& name)
{
  nodelet::NodeletLoad call;
  call.request.name = name;
  call.request.type = "cloth_tearing/ClothNodelet";
  return ros::service::call("/manager/load_nodelet", call) && call.response.success;
}

bool unload(const std::string& name)
{
  nodelet::NodeletUnload::Request request;
  request.name = name;
  return ask<nodelet::NodeletUnload>("/manager/unload_nodelet", request).success;
}

bool isLoaded(const std::string& name)
{
  const auto nodelets = ask<nodelet::NodeletList>("/manager/list").nodelets;
  return std::count(nodelets.begin(), nodelets.end(), name) > 0;
}

}  // namespace

TEST(ClothNodelet, IsTheSameClothAsTheNode)
{
  const cloth_tearing::Step::Response loaded = step("/loaded", 100);

  ASSERT_TRUE(loaded.success) << loaded.message;
  EXPECT_EQ(loaded.state_hash, step("/node", 100).state_hash);
  EXPECT_TRUE(isLoaded("/loaded"));
}

TEST(ClothNodelet, HearsItsSpheresWhereItWasToldTo)
{
  Collector<SimulationStatus> status("/loaded/status");
  ros::Publisher balls = ros::NodeHandle().advertise<CollisionSpheres>("/balls", 1, true);
  CollisionSpheres message;
  message.header.frame_id = "world";
  message.spheres.resize(1);
  message.spheres[0].id = 1;
  message.spheres[0].center.y = -1.0;
  message.spheres[0].radius = 0.05;

  balls.publish(message);

  status.waitFor("the remapped sphere", [](const SimulationStatus& s) { return s.spheres == 1; });
}

TEST(ClothNodelet, SharesItsManagerWithAnotherAndLeavesIt)
{
  ASSERT_TRUE(load("/second/sheet"));
  const std::uint64_t mine = step("/loaded", 0).state_hash;
  const std::uint64_t theirs = step("/second/sheet", 50).state_hash;
  EXPECT_EQ(step("/loaded", 0).state_hash, mine) << "it heard nothing of this";
  {
    Collector<SimulationStatus> status("/second/sheet/status");
    EXPECT_EQ(status.first().header.frame_id, "map");
  }

  auto long_step =
      std::async(std::launch::async,
                 []
                 {
                   cloth_tearing::Step call;
                   call.request.steps = 4000000000U;
                   return ros::service::call("/second/sheet/step", call) && call.response.success;
                 });
  {
    Collector<SimulationStatus> status("/second/sheet/status");
    status.waitFor("the long step is under way",
                   [](const SimulationStatus& s) { return s.step > 50; });
  }
  ASSERT_TRUE(unload("/second/sheet")) << "in the midst of a step";
  ASSERT_EQ(long_step.wait_for(std::chrono::duration<double>(PATIENCE)), std::future_status::ready);
  EXPECT_FALSE(long_step.get()) << "the step was not done";
  EXPECT_FALSE(ros::service::exists("/second/sheet/step", false));

  ASSERT_TRUE(load("/second/sheet")) << "and it may come again";
  EXPECT_EQ(step("/second/sheet", 50).state_hash, theirs);
  EXPECT_TRUE(unload("/second/sheet"));
}

TEST(ClothNodelet, IsNotLoadedWithNonsenseAndLeavesTheOthersAlone)
{
  Collector<Log> log("/rosout");
  const auto saidFatally = [&log](const std::string& text)
  {
    const std::vector<Log> lines = log.all();
    return std::any_of(
        lines.begin(), lines.end(),
        [&text](const Log& line)
        { return line.level == Log::FATAL && line.msg.find(text) != std::string::npos; });
  };
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(PATIENCE);
  do  // again until the log reaches us
  {
    EXPECT_FALSE(load("/wrong"));
    EXPECT_FALSE(load("/lost"));
  } while (!(saidFatally("of /wrong") && saidFatally("/lost")) && ros::WallTime::now() < deadline);

  EXPECT_TRUE(saidFatally("/nowhere/cloth.obj"));
  EXPECT_TRUE(saidFatally("time_step is the text \"fast\""));
  EXPECT_TRUE(saidFatally("did you mean material/stiffness?"));
  EXPECT_FALSE(isLoaded("/wrong"));
  EXPECT_FALSE(isLoaded("/lost"));
  EXPECT_TRUE(step("/loaded", 1).success);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "nodelet_rostest");
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
