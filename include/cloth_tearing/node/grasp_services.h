// Requests that take hold of the cloth, move what they hold, let go, and pin.
#pragma once

#include <cloth_tearing/GetGraspEvents.h>
#include <cloth_tearing/GraspTargets.h>
#include <cloth_tearing/Pin.h>
#include <cloth_tearing/Release.h>
#include <ros/steady_timer.h>

#include <cstdint>
#include <map>
#include <mutex>

#include "cloth_tearing/node/keep_alive.h"
#include "cloth_tearing/node/request_server.h"

namespace cloth_tearing
{

/// ~grasp, ~drag, ~release, ~pin, ~unpin, ~get_grasp_events and ~grasp_targets.
///
/// Some of them are public, for others who ask for the same; they may be called from any thread but
/// the loop's.
class GraspServices
{
public:
  explicit GraspServices(const NodeContext& context);

  /// @throws std::exception with the reason of a refusal, as all of these
  void grasp(const Grasp::Request& request, Grasp::Response& response);
  void release(const Release::Request& request, Release::Response& response);
  void pin(const Pin::Request& request, Pin::Response& response);
  void unpin(const Pin::Request& request, Pin::Response& response);

  /// What ~grasp_targets does.
  void steer(const GraspTargets& message);

private:
  void onDrag(const Drag::Request& request);
  template <class Change>
  void changePins(const Pin::Request& request, Pin::Response& response, Change change);
  void onGetGraspEvents(const GetGraspEvents::Request& request, GetGraspEvents::Response& response);
  void steerAll(cloth::Simulation& simulation, const GraspTargets& message,
                const cloth::Pose& to_cloth);
  void watch(const KeepAlive::Watched& grasp);
  void hear(std::uint64_t grasp);
  void hear(const GraspTargets& message);
  void forget(std::uint64_t grasp);
  void onAliveTimer();
  void endSilent(cloth::Simulation& simulation);

  NodeContext context_;
  ros::Subscriber targets_;
  std::map<std::uint64_t, double> steered_at_;  ///< by grasp, in simulated time [s]; the loop's
  std::mutex alive_mutex_;
  KeepAlive alive_;               ///< guarded by alive_mutex_
  ros::SteadyTimer alive_timer_;  ///< guarded by alive_mutex_; runs while alive_ watches anybody
};

}  // namespace cloth_tearing
