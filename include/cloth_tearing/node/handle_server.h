// Serves handles: interactive markers by which any rviz takes hold of cloth and spheres.
#pragma once

#include <interactive_markers/interactive_marker_server.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "cloth_tearing/node/grasp_services.h"
#include "cloth_tearing/node/handle_markers.h"
#include "cloth_tearing/node/node_params.h"
#include "cloth_tearing/node/request_server.h"
#include "cloth_tearing/node/sphere_services.h"

namespace cloth_tearing
{

/// ~handles/update, ~handles/update_full and ~handles/feedback. What is asked for by a handle is
/// done, checked and refused as it is by the services.
///
/// One thread does all of it; that of the marker server only takes feedback in.
class HandleServer
{
public:
  /// @param grasps, spheres outlive it
  HandleServer(const NodeContext& context, const HandleParams& params, GraspServices& grasps,
               SphereServices& spheres);
  ~HandleServer();

private:
  using Clock = std::chrono::steady_clock;  // ROS time may stand still
  using Feedback = visualization_msgs::InteractiveMarkerFeedback;

  /// Why somebody was refused, for as long as it is shown.
  struct Note
  {
    std::string reason;
    Clock::time_point until;
  };

  /// What is to be shown of the simulation.
  struct World
  {
    std::vector<Handle> handles;      ///< all but the hand
    std::optional<cloth::Pose> home;  ///< of the hand, where an epoch begins
  };

  void take(const Feedback::ConstPtr& feedback);
  void run();

  void obey(const Feedback& feedback);
  void obey(const Feedback& feedback, const Handle& handle);
  void move(const Handle& handle, const Feedback& feedback);
  void catchSphere(const Handle& handle);
  void letGo();
  void letGo(cloth::Simulation& simulation) const;
  void command(const Handle& handle, std::uint32_t entry);
  void release(const Handle& handle, bool pin);
  void throwAtCloth(const Handle& handle);
  void remove(const Handle& handle);
  void takeHold();
  void throwBall();
  void changePins(bool pin);

  void show();
  World look();
  void showHandle(Handle handle);
  void place(const std::string& name, const geometry_msgs::Pose& pose);
  void eraseAllBut(const std::set<std::string>& present);
  void forgetWhatIsOver();

  NodeContext context_;
  HandleParams params_;
  GraspServices& grasps_;
  SphereServices& spheres_;

  // of the thread
  cloth::Pose hand_;
  std::optional<std::uint32_t> epoch_;  ///< that was seen last
  std::map<std::string, Handle> shown_;
  std::set<std::string> erased_;                      ///< of late
  std::map<std::string, Clock::time_point> dragged_;  ///< handles under a pointer, when last heard
  std::map<std::string, Note> notes_;

  std::mutex mutex_;  // guards what follows; the last to be locked
  std::condition_variable wake_;
  bool stopping_ = false;
  std::vector<Feedback::ConstPtr> inbox_;
  std::map<std::string, geometry_msgs::Pose> placed_;  ///< where the server is to have each handle

  std::unique_ptr<interactive_markers::InteractiveMarkerServer> server_;
  std::thread thread_;  ///< last: it starts when everything else is there
};

}  // namespace cloth_tearing
