// Publishes what the simulation does: markers, surface, status, grasps and tears.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "cloth_tearing/core/simulation_loop.h"
#include "cloth_tearing/core/snapshot_taker.h"
#include "cloth_tearing/node/cloth_markers.h"
#include "cloth_tearing/node/conversions.h"
#include "cloth_tearing/node/diagnostics.h"
#include "cloth_tearing/node/grasp_publisher.h"
#include "cloth_tearing/node/kept_message.h"
#include "cloth_tearing/node/node_params.h"

namespace cloth_tearing
{

/// A topic that gives a late subscriber the state of now, not the last one that somebody saw.
///
/// The handle that says "latched" to the other side never publishes, so that nothing old waits in
/// it; a new subscriber only wakes `on_connect`.
class StateTopic
{
public:
  template <class Message>
  static StateTopic advertise(ros::NodeHandle& node, const std::string& name,
                              const boost::function<void()>& on_connect)
  {
    StateTopic topic;
    topic.latch_ = node.advertise<Message>(name, 1, true);
    topic.publisher_ = node.advertise<Message>(
        name, 1, [on_connect](const ros::SingleSubscriberPublisher&) { on_connect(); });
    return topic;
  }

  bool heard() const { return publisher_.getNumSubscribers() > 0; }

  template <class Message>
  void publish(const boost::shared_ptr<Message>& message) const
  {
    publisher_.publish(message);
  }

private:
  ros::Publisher latch_;
  ros::Publisher publisher_;
};

/// Builds nothing that nobody listens to, and nothing twice.
class ClothPublisher
{
public:
  /// @param node private; its callback queue serves new subscribers
  ClothPublisher(ros::NodeHandle node, const NodeParams& params, const Placement& placement);
  ~ClothPublisher();

  /// Starts publishing what `loop` holds, which has to outlive stop().
  void start(cloth::SimulationLoop& loop);
  void stop();

  /// To be told after every step, on the loop's thread.
  void onStep(const cloth::Simulation& simulation, const cloth::StepReport& report);

  /// To be told when commands may have changed something, on the loop's thread.
  void onCommands(const cloth::Simulation& simulation);

  /// Something changed that should be seen as soon as the rates allow.
  void touch();

  /// Something changed that may be seen when its turn comes.
  void note() { ++version_; }

  /// How often the simulation paused itself.
  std::uint64_t faults();

  /// The reasons why the simulation paused itself the first `settled` times are settled.
  void clearFault(std::uint64_t settled);

  /// A request or message was refused.
  void countRefusal(const std::string& name, const std::string& reason);

  /// The run is recorded to the file `path`.
  void recordingBegins(const std::string& path);

  /// It is so no longer.
  void recordingEnds(const std::string& reason);

private:
  using Clock = std::chrono::steady_clock;

  /// A topic and when it is its turn. All but the topic belongs to the publishing thread.
  struct Channel
  {
    StateTopic topic;
    Clock::duration period;
    Clock::time_point due;
    std::uint64_t seen = 0;  ///< version that was published last
    Clock::time_point last;  ///< when it was published last
    bool wanted = false;     ///< at once, even unchanged: by a new subscriber; guarded by mutex_
    bool changed = false;    ///< as soon as its rate allows; guarded by mutex_
  };

  template <class Message>
  void open(ros::NodeHandle& node, const std::string& name, double rate, Channel& channel);

  void run();
  void takeTurns();
  Clock::time_point nextTurn() const;
  bool heard(const Channel& channel) const;
  bool takeTurn(Channel& channel, bool unchanged_too, Clock::time_point now);
  void publishSnapshot(bool markers, bool surface);
  void publishMarkers(const ros::Time& stamp);
  void publishSurface(const ros::Time& stamp);
  StatusSource statusSource();
  void publishStatus();
  void publishGrasps();
  void publishTears(const std::vector<cloth::TearEvent>& tears) const;

  Placement placement_;
  cloth::SimulationLoop* loop_ = nullptr;
  Channel markers_;
  Channel surface_;
  Channel status_;
  Channel grasp_states_;
  ros::Publisher tear_events_;
  Diagnostics diagnostics_;  ///< of the publishing thread
  GraspPublisher grasps_;

  // Of the publishing thread: what is drawn, and how it was told last.
  cloth::SnapshotTaker taker_;
  cloth::Snapshot snapshot_;
  ClothMarkers painter_;
  KeptMessage<visualization_msgs::MarkerArray> marker_message_;
  KeptMessage<ClothSurface> surface_message_;
  std::shared_ptr<const cloth::SurfaceTopology> told_topology_;  ///< in surface_message_

  std::atomic<std::uint64_t> version_{ 1 };  ///< +1 by every step and command
  std::atomic<int> postponed_{ 0 };

  std::mutex mutex_;  // guards what follows
  std::condition_variable wake_;
  bool stopping_ = false;
  bool urgent_ = false;  // somebody wants something at once
  std::string fault_;
  std::uint64_t faults_ = 0;
  std::uint64_t refusals_ = 0;
  std::string last_refusal_;
  std::string recording_;
  std::string recording_problem_;

  std::thread thread_;
};

}  // namespace cloth_tearing
