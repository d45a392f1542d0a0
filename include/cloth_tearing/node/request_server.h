// Hosts services that answer with success and a reason, and counts what was refused.
#pragma once

#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/subscriber.h>

#include <chrono>
#include <cstdint>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/core/simulation_loop.h"
#include "cloth_tearing/node/bounded_callbacks.h"
#include "cloth_tearing/node/cloth_publisher.h"
#include "cloth_tearing/node/conversions.h"
#include "cloth_tearing/node/frame_follower.h"
#include "cloth_tearing/node/frames.h"

namespace cloth_tearing
{

/// Whether a request leaves everything as it is.
enum class Effect
{
  CHANGES,  ///< what was done is published at once
  LOOKS,
};

/// A refusal is an answer with its reason: a callback itself never fails.
class RequestServer
{
public:
  explicit RequestServer(ClothPublisher& publisher) : publisher_(publisher) {}

  /// Answers `name` below `node`'s namespace with `work(request, response)`, whatever it throws
  /// being the reason of a refusal. Service's response has `success` and `message`.
  template <class Service, class Work>
  void serve(ros::NodeHandle& node, const std::string& name, Work work,
             Effect effect = Effect::CHANGES)
  {
    using Request = typename Service::Request;
    using Response = typename Service::Response;
    const auto callback = [this, name, work, effect](Request& request, Response& response)
    {
      response.success = true;
      const std::string reason = refusal(name, [&] { work(request, response); });
      if (!reason.empty())
      {
        response = Response();
        response.message = reason;
      }
      else if (effect == Effect::CHANGES)
      {
        publisher_.touch();
      }
    };
    answer<Service>(node, name, callback);
  }

  /// The same for a service whose response has no room for a reason: `work(request, response)` does
  /// not throw.
  template <class Service, class Work>
  void answer(ros::NodeHandle& node, const std::string& name, Work work)
  {
    ros::AdvertiseServiceOptions options = boundedService<Service>(
        name, work, [this, name](const std::string& reason) { refuseBytes(name, reason); });
    services_.push_back(node.advertiseService(options));
  }

  /// Does `work(message)` with what comes on the topic `name` below `node`'s namespace; whatever it
  /// throws is the reason of a refusal. Until the last copy of what it returns is gone.
  template <class Message, class Work>
  ros::Subscriber listen(ros::NodeHandle& node, const std::string& name, std::uint32_t queue_size,
                         Work work)
  {
    ros::SubscribeOptions options = boundedSubscription<Message>(
        name, queue_size,
        [this, name, work](const boost::shared_ptr<const Message>& message)
        { hear(name, [&] { work(*message); }); },
        [this, name](const std::string& reason) { refuseBytes(name, reason); });
    return node.subscribe(options);
  }

  /// Refuses what came as a request or message of this name and was none. A warning, too: those who
  /// send such bytes may not read their answer.
  void refuseBytes(const std::string& name, const std::string& reason)
  {
    hear(name, [&] { throw cloth::Refusal(reason); });
  }

  /// Does `work`, which came as a message on the topic `name`. Nobody waits for an answer: a
  /// refusal is a warning.
  /// @return why it was refused; empty if it was done
  template <class Work>
  std::string hear(const std::string& name, Work work)
  {
    const std::string reason = refusal(name, work);
    if (reason.empty())
    {
      publisher_.note();  // streams come faster than anything is published
    }
    else if (mayComplain(name))
    {
      ROS_WARN_STREAM("What came on " << name << " was refused: " << reason);
    }
    return reason;
  }

  /// Does `work`, which was asked for as `name`.
  /// @return why it was refused, which was counted; empty if it was done
  template <class Work>
  std::string refusal(const std::string& name, Work work)
  {
    try
    {
      work();
      return "";
    }
    catch (const std::exception& error)  // Refusal and Busy say why; nothing may hide the reason
    {
      const std::string reason = *error.what() == '\0' ? "refused" : error.what();
      publisher_.countRefusal(name, reason);
      return reason;
    }
  }

private:
  using Clock = std::chrono::steady_clock;  // ROS time may stand still

  static constexpr std::chrono::seconds COMPLAIN_EVERY{ 5 };

  /// Whether there was no complaint about this topic for a while.
  bool mayComplain(const std::string& name)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const Clock::time_point now = Clock::now();
    const auto last = complained_.find(name);
    if (last != complained_.end() && now < last->second + COMPLAIN_EVERY)
    {
      return false;
    }
    complained_[name] = now;
    return true;
  }

  ClothPublisher& publisher_;
  std::mutex mutex_;
  std::map<std::string, Clock::time_point> complained_;  ///< by topic; guarded by mutex_
  std::vector<ros::ServiceServer> services_;
};

/// How many entries a request for at most `max_count` wants; 0 = all.
inline std::size_t mostOf(std::uint32_t max_count)
{
  return max_count == 0 ? std::numeric_limits<std::size_t>::max() : max_count;
}

/// What every group of requests works with. All of it outlives the groups.
struct NodeContext
{
  ros::NodeHandle node;  ///< private
  const Placement& placement;
  Frames& frames;
  ClothPublisher& publisher;
  RequestServer& requests;
  cloth::SimulationLoop& loop;
  FrameFollower& follower;
};

}  // namespace cloth_tearing
