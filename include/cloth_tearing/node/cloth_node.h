// The node: services and topics around one simulation.
#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <std_srvs/Trigger.h>

#include <memory>

#include "cloth_tearing/core/simulation_loop.h"
#include "cloth_tearing/node/clock_publisher.h"
#include "cloth_tearing/node/cloth_publisher.h"
#include "cloth_tearing/node/conversions.h"
#include "cloth_tearing/node/frame_follower.h"
#include "cloth_tearing/node/frames.h"
#include "cloth_tearing/node/grasp_services.h"
#include "cloth_tearing/node/handle_server.h"
#include "cloth_tearing/node/live_tuning.h"
#include "cloth_tearing/node/master_watchdog.h"
#include "cloth_tearing/node/model_services.h"
#include "cloth_tearing/node/node_params.h"
#include "cloth_tearing/node/pull_server.h"
#include "cloth_tearing/node/request_server.h"
#include "cloth_tearing/node/sphere_services.h"
#include "cloth_tearing/node/state_services.h"
#include "cloth_tearing/node/state_store.h"
#include "cloth_tearing/node/transform_feed.h"

namespace cloth_tearing
{

/// Answers requests on threads of its own: validate, transform, command the loop, answer. ~step has
/// a queue apart, so that a long one holds up nobody. Publishing is ClothPublisher's.
class ClothNode
{
public:
  /// @param node private: everything lives in its namespace
  /// @throws std::exception saying why there is no such cloth
  ClothNode(const ros::NodeHandle& node, const NodeParams& params);

  /// Cuts a ~step under way short and ends all threads.
  ~ClothNode();

private:
  void onGetTearEvents(const GetTearEvents::Request& request, GetTearEvents::Response& response);
  void onStep(const Step::Request& request, Step::Response& response);

  void openRequests();
  NodeContext context();
  void keepFault(const cloth::Simulation& simulation);
  template <class Command>
  void settleFaults(Command command);

  Placement placement_;
  ros::CallbackQueue queue_;
  ros::CallbackQueue step_queue_;
  ros::NodeHandle node_;
  ros::NodeHandle step_node_;
  Frames frames_;
  FrameFollower follower_;  ///< of the loop's thread
  ClothPublisher publisher_;
  ClockPublisher clock_;
  NewestNumber pull_ends_;
  RequestServer requests_;
  TransformFeed transforms_;
  StateStore states_;
  cloth::SimulationLoop loop_;
  GraspServices grasps_;
  SphereServices spheres_;
  PullServer pulls_;
  PullPredictor predictions_;
  StateServices state_services_;
  LiveTuning tuning_;
  ModelServices models_;
  std::unique_ptr<HandleServer> handles_;  ///< none unless wanted
  ros::AsyncSpinner spinner_;
  ros::AsyncSpinner step_spinner_;
  MasterWatchdog watchdog_;
};

}  // namespace cloth_tearing
