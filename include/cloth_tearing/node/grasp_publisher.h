// Publishes what grasps feel and what happens to them.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <set>

#include "cloth_tearing/core/simulation.h"
#include "cloth_tearing/node/conversions.h"
#include "cloth_tearing/node/grasp_conversions.h"

namespace cloth_tearing
{

/// Events as they come; states and wrenches whenever their turn has come. There is a topic
/// grasps/<id>/wrench for each grasp while it holds: in the frame that it follows, as controllers
/// expect it, or else at the origin of the grasp frame, along the axes of frame_id.
class GraspPublisher
{
public:
  /// @param node private
  GraspPublisher(const ros::NodeHandle& node, const Placement& placement);

  /// Publishes the events that are new. For the loop's thread.
  /// @return whether there were any
  bool publishEvents(const cloth::Simulation& simulation);

  /// Opens topics for new grasps, closes those of old ones. This and the rest is for one thread,
  /// which may wait for the master.
  void openWrenches();

  /// Whether somebody listens to a wrench.
  bool heard() const;

  /// @param states its header is complete
  void publishWrenches(const GraspStates& states) const;

private:
  ros::NodeHandle node_;
  Placement placement_;
  ros::Publisher events_;
  std::uint64_t told_ = 0;  ///< number of the last event that was published

  std::mutex mutex_;
  std::set<std::uint64_t> held_;  ///< grasps that there are; guarded by mutex_

  std::map<std::uint64_t, ros::Publisher> wrenches_;  ///< by grasp
};

}  // namespace cloth_tearing
