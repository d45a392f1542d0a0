// Fills a tf buffer from /tf and /tf_static.
#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <string>

#include "cloth_tearing/node/request_server.h"

namespace cloth_tearing
{

/// Does what tf2_ros::TransformListener does, on a thread of its own as that does. But that one
/// would make room for as many transforms as a message says it has.
class TransformFeed
{
public:
  /// @param buffer, requests outlive it
  TransformFeed(tf2::BufferCore& buffer, RequestServer& requests);

private:
  ros::Subscriber listen(const std::string& topic, bool is_static, RequestServer& requests);
  void take(const tf2_msgs::TFMessage& message, bool is_static);
  void forgetFuture();

  tf2::BufferCore& buffer_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  ros::Time last_update_;
  ros::Subscriber moving_;
  ros::Subscriber static_;
  ros::AsyncSpinner spinner_;  ///< last: it calls take()
};

}  // namespace cloth_tearing
