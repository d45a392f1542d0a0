// The node: services and topics around one simulation.
#pragma once

#include <cloth_tearing/Release.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/spinner.h>
#include <ros/subscriber.h>
#include <std_srvs/Trigger.h>

#include <memory>
#include <string>
#include <vector>

#include "cloth_tearing/core/simulation_loop.h"
#include "cloth_tearing/node/cloth_publisher.h"
#include "cloth_tearing/node/conversions.h"
#include "cloth_tearing/node/frames.h"
#include "cloth_tearing/node/node_params.h"

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
  void onGrasp(const Grasp::Request& request, Grasp::Response& response);
  void onDrag(const Drag::Request& request);
  void onRelease(const Release::Request& request, Release::Response& response);
  void onThrowSphere(const ThrowSphere::Request& request, ThrowSphere::Response& response);
  void onGetTearEvents(const GetTearEvents::Request& request, GetTearEvents::Response& response);
  void onStep(const Step::Request& request, Step::Response& response);
  void onSpheres(const CollisionSpheres::ConstPtr& message);

  void openRequests();
  template <class Service, class Work>
  void serve(ros::NodeHandle& node, const std::string& name, Work work);
  template <class Work>
  std::string refusal(const std::string& name, Work work);
  template <class Command>
  void settleFaults(Command command);

  Placement placement_;
  ros::CallbackQueue queue_;
  ros::CallbackQueue step_queue_;
  ros::NodeHandle node_;
  ros::NodeHandle step_node_;
  Frames frames_;
  ClothPublisher publisher_;
  std::unique_ptr<cloth::SimulationLoop> loop_;
  std::vector<ros::ServiceServer> services_;
  ros::Subscriber spheres_;
  ros::AsyncSpinner spinner_;
  ros::AsyncSpinner step_spinner_;
};

}  // namespace cloth_tearing
