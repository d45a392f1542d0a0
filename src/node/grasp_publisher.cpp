// Publishes what grasps feel and what happens to them.
#include "cloth_tearing/node/grasp_publisher.h"

#include <geometry_msgs/WrenchStamped.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "cloth_tearing/node/request_server.h"

namespace cloth_tearing
{

namespace
{

constexpr std::uint32_t EVENT_QUEUE = 1000;
constexpr std::uint32_t WRENCH_QUEUE = 10;

geometry_msgs::WrenchStamped wrenchOf(const GraspState& grasp, const std_msgs::Header& header)
{
  geometry_msgs::WrenchStamped message;
  message.header = header;
  message.wrench = grasp.wrench;
  if (!grasp.gripper_frame.empty())
  {
    const geometry_msgs::Quaternion& q = grasp.pose.orientation;
    const cloth::Quatd into_frame = cloth::Quatd(q.w, q.x, q.y, q.z).conjugate();
    message.header.frame_id = grasp.gripper_frame;
    message.wrench.force = toVector3(into_frame * toVector(grasp.wrench.force));
    message.wrench.torque = toVector3(into_frame * toVector(grasp.wrench.torque));
  }
  return message;
}

}  // namespace

GraspPublisher::GraspPublisher(const ros::NodeHandle& node, const Placement& placement)
    : node_(node), placement_(placement)
{
  events_ = node_.advertise<GraspEvents>("grasp_events", EVENT_QUEUE);
}

bool GraspPublisher::publishEvents(const cloth::Simulation& simulation)
{
  const std::uint64_t newest = simulation.loggedGraspEvents()[1];
  if (newest <= told_)
  {
    return false;
  }
  if (events_.getNumSubscribers() > 0)
  {
    GraspEvents message;
    message.header.frame_id = placement_.frame_id;
    message.header.stamp = ros::Time::now();
    message.events = toMessages(simulation.graspEventsSince(told_ + 1, mostOf(0)), placement_);
    events_.publish(message);
  }
  told_ = newest;
  const std::lock_guard<std::mutex> lock(mutex_);
  held_.clear();
  for (const cloth::Grasp& grasp : simulation.grasps())
  {
    held_.insert(grasp.id);
  }
  return true;
}

void GraspPublisher::openWrenches()
{
  std::set<std::uint64_t> held;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    held = held_;
  }
  for (const std::uint64_t grasp : held)
  {
    if (wrenches_.count(grasp) == 0)
    {
      wrenches_[grasp] = node_.advertise<geometry_msgs::WrenchStamped>(
          "grasps/" + std::to_string(grasp) + "/wrench", WRENCH_QUEUE);
    }
  }
  for (auto wrench = wrenches_.begin(); wrench != wrenches_.end();)
  {
    wrench = held.count(wrench->first) > 0 ? std::next(wrench) : wrenches_.erase(wrench);
  }
}

bool GraspPublisher::heard() const
{
  return std::any_of(wrenches_.begin(), wrenches_.end(),
                     [](const auto& wrench) { return wrench.second.getNumSubscribers() > 0; });
}

void GraspPublisher::publishWrenches(const GraspStates& states) const
{
  for (const GraspState& grasp : states.grasps)
  {
    const auto topic = wrenches_.find(grasp.grasp_id);
    if (topic != wrenches_.end() && topic->second.getNumSubscribers() > 0)
    {
      topic->second.publish(wrenchOf(grasp, states.header));
    }
  }
}

}  // namespace cloth_tearing
