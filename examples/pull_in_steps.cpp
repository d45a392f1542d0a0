// Pulls a cloth until it is about to tear, stops, asks what more would tear, and then tears it.
//
//   roslaunch cloth_tearing cloth.launch     and     rosrun cloth_tearing pull_in_steps
//
// Ends with 0 only if the cloth held until it was meant to tear, and then tore.
#include <cloth_tearing/client/cloth_client.h>
#include <ros/ros.h>

#include <cstdio>

namespace
{

constexpr double ENOUGH = 0.8;    // of what the cloth near the gripper can bear [-]; 1 = it tears
constexpr double STRIDE = 0.01;   // [m]
constexpr double LONGEST = 60.0;  // how long a pull may take on the wall clock [s]

cloth_tearing::PullGoal downwards(std::uint64_t grasp, double distance)
{
  cloth_tearing::PullGoal goal;
  goal.header.frame_id = "world";
  goal.grasp_id = grasp;
  goal.direction.z = -1.0;
  goal.distance = distance;
  goal.linear_speed = 0.1;
  return goal;
}

/// Whether it tore only when it was meant to.
bool pullAndTear()
{
  const cloth_tearing::ClothClient cloth("cloth");
  geometry_msgs::Point lower_edge;
  lower_edge.z = 0.5;
  const std::size_t before = cloth.tears().size();
  const std::uint64_t grasp = cloth.grasp(lower_edge, 0.05).grasp_id;

  while (cloth.graspState(grasp).utilisation < ENOUGH)
  {
    cloth.pull(downwards(grasp, STRIDE), LONGEST);
    std::printf("utilisation %.2f\n", cloth.graspState(grasp).utilisation);
  }

  const auto forecast = cloth.predictPull(downwards(grasp, 0.3), LONGEST);
  std::printf("0.3 m more would make %u tears\n", forecast.tears);
  const bool held = cloth.tears().size() == before;
  std::printf("%s\n", held ? "nothing tore yet" : "it tore too early");

  auto goal = downwards(grasp, 0.3);
  goal.stop_tears = 5;
  goal.release = true;
  const auto torn = cloth.pull(goal, LONGEST);
  std::printf("%u tears, at most %.1f N: %s\n", torn.tears, torn.peak_force, torn.message.c_str());
  return held && torn.tears >= goal.stop_tears;
}

}  // namespace

int main(int argc, char** argv)
{
  ros::init(argc, argv, "pull_in_steps");
  const ros::NodeHandle node;
  try
  {
    return pullAndTear() ? 0 : 1;
  }
  catch (const cloth_tearing::ClothError& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
