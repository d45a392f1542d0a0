// Tells the simulation's time on /clock, for nodes with use_sim_time.
#include "cloth_tearing/node/clock_publisher.h"

#include <rosgraph_msgs/Clock.h>

#include <cmath>

namespace cloth_tearing
{

namespace
{

/// Steps may come as fast as the machine can, and nobody should miss one.
constexpr std::uint32_t QUEUE = 1000;

/// A message that is due by less is due: time is a sum of rounded steps.
constexpr double TOLERANCE = 1e-6;

rosgraph_msgs::Clock clockOf(std::uint64_t nanoseconds)
{
  rosgraph_msgs::Clock message;
  message.clock.fromNSec(nanoseconds);
  return message;
}

}  // namespace

ClockPublisher::ClockPublisher(ros::NodeHandle node, const NodeParams& params)
    : rate_(params.clock_rate)
{
  if (params.publish_clock)
  {
    publisher_ = node.advertise<rosgraph_msgs::Clock>("/clock", QUEUE, true);
    publisher_.publish(clockOf(1));
  }
}

void ClockPublisher::onStep(double time)
{
  const double due = time * rate_ + TOLERANCE;
  if (!publisher_ || due < next_)
  {
    return;
  }
  next_ = std::floor(due) + 1.0;
  publisher_.publish(clockOf(static_cast<std::uint64_t>(std::llround(time * 1e9))));
}

}  // namespace cloth_tearing
