// How the node is doing, on /diagnostics.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <chrono>

#include "cloth_tearing/node/conversions.h"

namespace cloth_tearing
{

/// How the simulation runs: an error if it paused itself, a warning while it is paused, late or
/// waits for a clock.
void describeSolver(const StatusSource& source, diagnostic_updater::DiagnosticStatusWrapper& entry);

/// What has become of the cloth. Torn cloth is what this is about: always well.
void describeTopology(const StatusSource& source,
                      diagnostic_updater::DiagnosticStatusWrapper& entry);

/// The entries `solver` and `topology`, once a second on the steady clock: also where ROS time
/// stands still. Of one thread.
class Diagnostics
{
public:
  using Clock = std::chrono::steady_clock;

  /// @param node private: its name is in front of the entries'
  explicit Diagnostics(ros::NodeHandle node);
  Diagnostics(const Diagnostics&) = delete;
  Diagnostics& operator=(const Diagnostics&) = delete;

  bool heard() const { return topic_.getNumSubscribers() > 0; }

  /// When there is something to publish, if anybody listens.
  Clock::time_point due() const { return due_; }
  bool isDue() const { return heard() && Clock::now() >= due_; }
  void publish(const StatusSource& source);

private:
  ros::Publisher topic_;  ///< only to know who listens
  diagnostic_updater::Updater updater_;
  StatusSource source_;  ///< what the entries are made of
  Clock::time_point due_;
};

}  // namespace cloth_tearing
