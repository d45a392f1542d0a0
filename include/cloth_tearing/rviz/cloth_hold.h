// Holds one node's cloth on behalf of a pointer.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>

#include <chrono>
#include <optional>
#include <string>

#include "cloth_tearing/core/types.h"
#include "cloth_tearing/rviz/hold_state.h"
#include "cloth_tearing/rviz/service_caller.h"

namespace cloth_tearing
{

/// Takes hold, leads, lets go by the node's services and topics, one grasp at a time, without ever
/// waiting for the node. Belongs to one thread, which also serves the queue of its node handle.
class ClothHold
{
public:
  ClothHold(const ros::NodeHandle& node, const std::string& cloth_node);

  /// Lets go; waits a moment for the node's answers, or as finishBy() says.
  ~ClothHold();

  /// Lets go for good. Several that are told the same time before the first of them is destroyed
  /// take no longer than one.
  void finishBy(std::chrono::steady_clock::time_point end);

  ClothHold(const ClothHold&) = delete;
  ClothHold& operator=(const ClothHold&) = delete;

  /// Asks for a grasp of what lies around a point [m]; as soon as the last one, that was let go, is
  /// answered. Does nothing while one is held.
  void take(const std::string& frame, const cloth::Vec3d& point, double radius);

  /// The grasp is to be at a point of that frame [m].
  void lead(const cloth::Vec3d& target);

  /// Of the points, as take() was told it last.
  const std::string& frame() const { return frame_; }

  /// Lets go, if need be as soon as the node has answered.
  void letGo(bool pin);

  /// To be called again and again: sends where to, also to say that there is still somebody, and
  /// notices a node that is gone.
  void update();

  /// Does not listen to the node any more, for now.
  void rest();

  /// Whether something is held or asked for that was not let go.
  bool busy() const
  {
    return next_ || (state_.phase() != HoldState::Phase::IDLE && !state_.letsGo());
  }

  /// What to tell, without mark-up; empty = nothing.
  std::string words() const;

private:
  void listen();
  void ask(const Grasp::Request& request);
  void release(const Release::Request& request);
  bool hasToSpeak() const;
  void sendTarget();

  ros::NodeHandle node_;  ///< with the cloth's node for namespace
  HoldState state_;
  std::string frame_;
  std::optional<Grasp::Request> next_;  ///< to be asked for when the last one is answered
  cloth::Vec3d target_{ 0.0, 0.0, 0.0 };
  bool is_new_ = false;   ///< target_ was not sent yet
  double sent_at_ = 0.0;  ///< when one was, or the grasp [s]
  std::optional<std::chrono::steady_clock::time_point> end_;
  ros::Publisher targets_;
  ros::Subscriber states_;
  ros::Subscriber events_;
  ros::Subscriber status_;
  bool found_ = false;  ///< the node publishes
  ServiceCaller caller_;
};

}  // namespace cloth_tearing
