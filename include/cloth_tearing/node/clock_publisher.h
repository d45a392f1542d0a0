// Tells the simulation's time on /clock, for nodes with use_sim_time.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "cloth_tearing/node/node_params.h"

namespace cloth_tearing
{

/// Publishes after the first step at or past each multiple of 1 / clock_rate, so that the same
/// steps give the same messages whatever the pace. Latched: a new subscriber has the last one at
/// once.
class ClockPublisher
{
public:
  /// Advertises /clock if `params` want it, and says 1 ns there: 0 would mean that there is no
  /// time.
  ClockPublisher(ros::NodeHandle node, const NodeParams& params);

  /// To be told after every step, on the loop's thread. @param time of the simulation [s]
  void onStep(double time);

private:
  double rate_;        // [Hz]
  double next_ = 1.0;  // number of the next message to be due
  ros::Publisher publisher_;
};

}  // namespace cloth_tearing
