// Finds the way from any frame into the cloth frame, or says why there is none.
#pragma once

#include <std_msgs/Header.h>
#include <tf2/buffer_core.h>

#include <atomic>
#include <chrono>
#include <string>

#include "cloth_tearing/core/types.h"
#include "cloth_tearing/node/conversions.h"

namespace cloth_tearing
{

/// May be asked from several threads at once.
class Frames
{
public:
  /// @param patience how long toCloth() waits for a transform, on the steady clock
  Frames(const Placement& placement, std::chrono::duration<double> patience);

  /// The transform from the header's frame at its stamp (0 = latest) into the cloth frame. The
  /// node's own frame needs no tf.
  /// @throws cloth::Refusal if frame_id is empty or there is no transform in time
  cloth::Pose toCloth(const std_msgs::Header& header) const;

  /// The same for a frame that is named elsewhere.
  /// @param field that names it, for the reason
  cloth::Pose toCloth(const std::string& frame, const ros::Time& stamp,
                      const std::string& field) const;

  /// Where a frame is, by the newest transform there is. Does not wait.
  struct Latest
  {
    cloth::Pose pose;     ///< cloth frame
    ros::Time stamp;      ///< of the oldest transform on the way; 0 = all of them are static
    std::string problem;  ///< why there is none; empty if there is
  };
  Latest latest(const std::string& frame) const;

  /// Where transforms are to be put.
  tf2::BufferCore& buffer() { return buffer_; }

  /// Ends all waiting, now and from now on.
  void stopWaiting() { waiting_ = false; }

private:
  bool canTransform(const std::string& frame, const ros::Time& stamp, std::string& why) const;

  Placement placement_;
  std::chrono::duration<double> patience_;
  std::atomic<bool> waiting_{ true };
  tf2::BufferCore buffer_;
};

}  // namespace cloth_tearing
