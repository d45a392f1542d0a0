// A cloth node as a robot's program sees it: its services and its pull, each a function.
#pragma once

#include <actionlib/client/simple_action_client.h>
#include <cloth_tearing/Drag.h>
#include <cloth_tearing/GetGraspEvents.h>
#include <cloth_tearing/GetTearEvents.h>
#include <cloth_tearing/Grasp.h>
#include <cloth_tearing/GraspStates.h>
#include <cloth_tearing/NamedState.h>
#include <cloth_tearing/Pin.h>
#include <cloth_tearing/PullAction.h>
#include <cloth_tearing/Release.h>
#include <cloth_tearing/Step.h>
#include <cloth_tearing/ThrowSphere.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace cloth_tearing
{

/// The node refused, with its reason, or did not answer.
class ClothError : public std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// Places are geometry_msgs/Point [m] in `frame`; whatever needs more than this has its Request
/// filled by hand and sent by call(). Waits on the wall clock, so that a paused simulation, or one
/// that makes the time itself, does not hold it up; needs nobody who spins.
///
/// All functions throw ClothError with the node's own words when it refuses, and when the node is
/// not there, or does not speak, within the patience.
class ClothClient
{
public:
  /// @param node the cloth's name, such as "/cloth"
  /// @param frame of all places that are given
  /// @param patience how long to wait for the node to be there [s]
  explicit ClothClient(const std::string& node = "/cloth", const std::string& frame = "world",
                       double patience = 10.0)
      : node_(ros::names::resolve(node)), frame_(frame), patience_(patience)
  {
  }

  const std::string& node() const { return node_; }
  const std::string& frame() const { return frame_; }

  /// Any service below the node's name.
  /// @return what it answered, which is a success
  template <class Service>
  typename Service::Response call(const std::string& name,
                                  const typename Service::Request& request = {}) const
  {
    Service both;
    both.request = request;
    waitFor(name);
    if (!ros::service::call(node_ + "/" + name, both))
    {
      throw ClothError(node_ + "/" + name + " was not answered");
    }
    if (!both.response.success)
    {
      throw ClothError(node_ + "/" + name + ": " + both.response.message);
    }
    return both.response;
  }

  /// Takes hold of the cloth around `point`.
  /// @param radius [m]; 0 = the nearest particle
  /// @param force_limit [N]; 0 = never slips
  /// @param gripper_frame a tf frame to follow; empty = none
  /// @param keep_alive it lets go when neither drag() nor ~grasp_targets has named it for so long
  ///        [s of wall time]; 0 = never
  Grasp::Response grasp(const geometry_msgs::Point& point, double radius = 0.0,
                        double force_limit = 0.0, const std::string& gripper_frame = "",
                        double keep_alive = 0.0) const
  {
    Grasp::Request request;
    request.header.frame_id = frame_;
    request.point = point;
    request.radius = radius;
    request.force_limit = force_limit;
    request.gripper_frame = gripper_frame;
    request.keep_alive = keep_alive;
    return call<Grasp>("grasp", request);
  }

  /// Sends a grasp straight to `target` without turning, at `speed` [m/s].
  void drag(std::uint64_t grasp, const geometry_msgs::Point& target, double speed) const
  {
    Drag::Request request;
    request.header.frame_id = frame_;
    request.grasp_id = grasp;
    request.target.position = target;
    request.linear_speed = speed;
    call<Drag>("drag", request);
  }

  /// @param grasp 0 = all
  /// @param pin whether what it held is pinned where it is
  void release(std::uint64_t grasp = 0, bool pin = false) const
  {
    Release::Request request;
    request.grasp_id = grasp;
    request.pin = pin;
    call<Release>("release", request);
  }

  /// Pins or frees all particles within `radius` [m]. @return how many that changed
  std::uint32_t pin(const geometry_msgs::Point& point, double radius) const
  {
    return changePins("pin", point, radius);
  }
  std::uint32_t unpin(const geometry_msgs::Point& point, double radius) const
  {
    return changePins("unpin", point, radius);
  }

  /// Throws a ball. @return its id
  std::uint64_t throwSphere(const geometry_msgs::Point& center, double radius,
                            const geometry_msgs::Vector3& velocity, double mass = 0.0) const
  {
    ThrowSphere::Request request;
    request.header.frame_id = frame_;
    request.center = center;
    request.radius = radius;
    request.velocity = velocity;
    request.mass = mass;
    return call<ThrowSphere>("throw_sphere", request).sphere_id;
  }

  void pause() const { call<std_srvs::Trigger>("pause"); }
  void resume() const { call<std_srvs::Trigger>("resume"); }
  void reset() const { call<std_srvs::Trigger>("reset"); }

  /// Does so many steps of a cloth that is paused, or whose pace is "step"; 0 only asks.
  Step::Response step(std::uint32_t steps) const
  {
    Step::Request request;
    request.steps = steps;
    return call<Step>("step", request);
  }

  /// @param file whether the state outlives the node
  NamedState::Response saveState(const std::string& name, bool file = false) const
  {
    return nameState("save_state", name, file);
  }
  NamedState::Response restoreState(const std::string& name, bool file = false) const
  {
    return nameState("restore_state", name, file);
  }

  /// How a grasp is doing now: its force, and how near the cloth beside it is to tearing.
  GraspState graspState(std::uint64_t grasp) const
  {
    const std::string topic = node_ + "/grasp_states";
    const GraspStatesConstPtr states = hear<GraspStates>(topic);
    for (const GraspState& state : states->grasps)
    {
      if (state.grasp_id == grasp)
      {
        return state;
      }
    }
    throw ClothError(topic + ": there is no grasp " + std::to_string(grasp));
  }

  /// What happened to grasps from sequence number `since` on.
  std::vector<GraspEvent> graspEvents(std::uint64_t since = 0) const
  {
    GetGraspEvents::Request request;
    request.since = since;
    return call<GetGraspEvents>("get_grasp_events", request).events;
  }

  /// All tears from sequence number `since` on.
  std::vector<TearEvent> tears(std::uint64_t since = 0) const
  {
    GetTearEvents::Request request;
    request.since = since;
    return call<GetTearEvents>("get_tear_events", request).events;
  }

  /// Pulls, or predicts a pull, and waits for its end for `limit` [s] of wall time. A pull needs a
  /// simulation that goes on, a prediction does not.
  /// @throws ClothError also if it could not begin, or was not over in time: it is then cancelled
  PullResult pull(const PullGoal& goal, double limit) const { return run("pull", goal, limit); }
  PullResult predictPull(const PullGoal& goal, double limit) const
  {
    return run("predict_pull", goal, limit);
  }

private:
  using Clock = std::chrono::steady_clock;

  static Clock::time_point after(double seconds)
  {
    return Clock::now() +
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }

  /// Until `ready()`, or for so long. @return whether it is
  template <class Ready>
  static bool waitUntil(double seconds, Ready ready)
  {
    const Clock::time_point deadline = after(seconds);
    while (!ready())
    {
      if (!ros::ok() || Clock::now() > deadline)
      {
        return false;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
  }

  void waitFor(const std::string& service) const
  {
    const std::string name = node_ + "/" + service;
    if (!waitUntil(patience_, [&name] { return ros::service::exists(name, false); }))
    {
      throw ClothError("nobody serves " + name);
    }
  }

  /// The next message of a topic, or the one that it keeps for late comers.
  template <class Message>
  boost::shared_ptr<const Message> hear(const std::string& topic) const
  {
    using Pointer = boost::shared_ptr<const Message>;
    Pointer heard;
    ros::CallbackQueue queue;
    const boost::function<void(const Pointer&)> take = [&heard](const Pointer& message)
    { heard = message; };
    auto options =
        ros::SubscribeOptions::create<Message>(topic, 1, take, ros::VoidConstPtr(), &queue);
    const ros::Subscriber subscriber = ros::NodeHandle().subscribe(options);
    const auto is_heard = [&heard, &queue]
    {
      queue.callAvailable();
      return heard != nullptr;
    };
    if (!waitUntil(patience_, is_heard))
    {
      throw ClothError("nothing is heard on " + topic);
    }
    return heard;
  }

  std::uint32_t changePins(const std::string& name, const geometry_msgs::Point& point,
                           double radius) const
  {
    Pin::Request request;
    request.header.frame_id = frame_;
    request.point = point;
    request.radius = radius;
    return call<Pin>(name, request).changed;
  }

  NamedState::Response nameState(const std::string& service, const std::string& name,
                                 bool file) const
  {
    NamedState::Request request;
    request.name = name;
    request.file = file;
    return call<NamedState>(service, request);
  }

  PullResult run(const std::string& name, const PullGoal& goal, double limit) const
  {
    actionlib::SimpleActionClient<PullAction> client(node_ + "/" + name);
    if (!waitUntil(patience_, [&client] { return client.isServerConnected(); }))
    {
      throw ClothError("nobody serves the action " + node_ + "/" + name);
    }
    client.sendGoal(goal);
    if (!waitUntil(limit, [&client] { return client.getState().isDone(); }))
    {
      client.cancelGoal();
      throw ClothError(node_ + "/" + name + " was not over in time");
    }
    const PullResultConstPtr result = client.getResult();
    if (!result)
    {
      throw ClothError(node_ + "/" + name + " ended without a result");
    }
    if (result->outcome == PullResult::REFUSED)
    {
      throw ClothError(node_ + "/" + name + ": " + result->message);
    }
    return *result;
  }

  std::string node_;
  std::string frame_;
  double patience_;
};

}  // namespace cloth_tearing
