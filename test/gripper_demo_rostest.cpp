// The gripper of the demo pushes the cloth with its fingers, tears it and lets go.
#include <cloth_tearing/SimulationStatus.h>
#include <ros/ros.h>

#include <algorithm>
#include <vector>

#include "cloth_tearing/client/cloth_client.h"
#include "node_client.h"

using namespace cloth_tearing;  // NOLINT: the messages are what all of this is about

namespace
{

/// The first event of a kind; waits for it.
GraspEvent waitFor(const ClothClient& cloth, std::uint8_t kind)
{
  Collector<SimulationStatus> status("/cloth/status");  // comes ten times a second
  GraspEvent found;
  status.waitFor("the gripper to go on",
                 [&](const SimulationStatus&)
                 {
                   const auto events = cloth.graspEvents();
                   const auto event =
                       std::find_if(events.begin(), events.end(),
                                    [kind](const GraspEvent& e) { return e.kind == kind; });
                   const bool there = event != events.end();
                   found = there ? *event : GraspEvent();
                   return there;
                 });
  return found;
}

TEST(GripperDemo, TearsTheClothByItsGraspAndLetsGo)
{
  const ClothClient cloth("/cloth", "world", PATIENCE);

  const GraspEvent taken = waitFor(cloth, GraspEvent::TAKEN);
  const GraspState state = cloth.graspState(taken.grasp_id);
  const GraspEvent released = waitFor(cloth, GraspEvent::RELEASED);

  EXPECT_EQ(state.gripper_frame, "gripper");
  EXPECT_EQ(state.frame_problem, "");
  EXPECT_EQ(released.grasp_id, taken.grasp_id);
  EXPECT_LT(released.position.y, taken.position.y - 0.5) << "it goes with the gripper";
  const auto tears = cloth.tears();
  const auto by_it =
      std::count_if(tears.begin(), tears.end(),
                    [&](const TearEvent& tear)
                    { return tear.cause == TearEvent::GRASP && tear.cause_id == taken.grasp_id; });
  EXPECT_GE(by_it, 5);
}

}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "gripper_demo_rostest");
  const ros::NodeHandle node;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
