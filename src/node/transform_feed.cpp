// Fills a tf buffer from /tf and /tf_static.
#include "cloth_tearing/node/transform_feed.h"

#include <ros/console.h>

#include <exception>

#include "cloth_tearing/node/bounded_callbacks.h"

namespace cloth_tearing
{

namespace
{

/// Messages that wait, as with tf2_ros::TransformListener.
constexpr std::uint32_t QUEUE = 100;

constexpr double COMPLAIN_EVERY = 5.0;  // [s]

}  // namespace

TransformFeed::TransformFeed(tf2::BufferCore& buffer, RequestServer& requests)
    : buffer_(buffer), spinner_(1, &queue_)
{
  node_.setCallbackQueue(&queue_);
  moving_ = listen("/tf", false, requests);
  static_ = listen("/tf_static", true, requests);
  spinner_.start();
}

ros::Subscriber TransformFeed::listen(const std::string& topic, bool is_static,
                                      RequestServer& requests)
{
  ros::SubscribeOptions options = boundedSubscription<tf2_msgs::TFMessage>(
      topic, QUEUE,
      [this, is_static](const tf2_msgs::TFMessage::ConstPtr& message)
      { take(*message, is_static); },
      [&requests, topic](const std::string& reason) { requests.refuseBytes(topic, reason); });
  return node_.subscribe(options);
}

void TransformFeed::take(const tf2_msgs::TFMessage& message, bool is_static)
{
  forgetFuture();
  for (const geometry_msgs::TransformStamped& transform : message.transforms)
  {
    try
    {
      buffer_.setTransform(transform, "tf", is_static);
    }
    catch (const std::exception& error)  // tf2 adds up stamps, which may be too large for it
    {
      ROS_WARN_STREAM_THROTTLE(COMPLAIN_EVERY, "A transform of "
                                                   << transform.child_frame_id
                                                   << " was dropped: " << error.what());
    }
  }
}

/// Where time jumps back, as a bag that begins anew, what is in the buffer has not been yet.
void TransformFeed::forgetFuture()
{
  const ros::Time now = ros::Time::now();
  if (now < last_update_)
  {
    ROS_WARN_STREAM("Time went back by " << last_update_.toSec() - now.toSec()
                                         << " s: transforms are forgotten");
    buffer_.clear();
  }
  last_update_ = now;
}

}  // namespace cloth_tearing
