// Those who listen: they come, look at each message and go.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/Config.h>
#include <geometry_msgs/WrenchStamped.h>
#include <ros/callback_queue.h>
#include <visualization_msgs/InteractiveMarkerUpdate.h>

#include <functional>

#include "users.h"

using namespace cloth_tearing;  // NOLINT: the messages are what all of this is about

namespace soak
{

namespace
{

/// What has to hold from message to message of one subscription.
class Order
{
public:
  void next(const SimulationStatus& status, Problems& found)
  {
    if (status.time < time_ || status.epoch < epoch_ || status.refusals < refusals_)
    {
      found.push_back("time, epoch or refusals went back");
    }
    time_ = status.time;
    epoch_ = status.epoch;
    refusals_ = status.refusals;
  }
  void next(const ClothSurface& surface, Problems& found) { nextTime(surface, found); }
  void next(const GraspStates& states, Problems& found) { nextTime(states, found); }
  void next(const TearEvents& message, Problems& found) { nextEvents(message, found); }
  void next(const GraspEvents& message, Problems& found) { nextEvents(message, found); }
  template <class Message>
  void next(const Message& /*message*/, Problems& /*found*/)
  {
  }

private:
  template <class Message>
  void nextTime(const Message& message, Problems& found)
  {
    if (message.time < time_ || message.epoch < epoch_)
    {
      found.push_back("time or epoch went back");
    }
    time_ = message.time;
    epoch_ = message.epoch;
  }

  /// A topic may drop messages, but the numbers rise.
  template <class Message>
  void nextEvents(const Message& message, Problems& found)
  {
    if (message.events.empty() || message.events.front().sequence <= sequence_)
    {
      found.push_back("no events, or numbers that do not rise");
      return;
    }
    sequence_ = message.events.back().sequence;
  }

  double time_ = 0.0;
  std::uint32_t epoch_ = 0;
  std::uint64_t refusals_ = 0;
  std::uint64_t sequence_ = 0;
};

class Listener : public User
{
public:
  Listener(World& world, std::uint64_t seed) : User(world, seed)
  {
    node_.setCallbackQueue(&queue_);
  }

private:
  void act() override
  {
    std::vector<ros::Subscriber> topics;
    for (int i = 1 + dice_.below(4); i > 0; --i)
    {
      topics.push_back(someTopic());
    }
    const bool stands_still = dice_.oneIn(4);
    const ros::WallTime until = ros::WallTime::now() + ros::WallDuration(dice_.between(0.02, 3.0));
    while (ros::WallTime::now() < until && world_.pause(std::chrono::milliseconds(5)))
    {
      if (!stands_still)
      {
        queue_.callAvailable();
      }
    }
    topics.clear();
    queue_.clear();
  }

  template <class Message>
  ros::Subscriber listen(const std::string& name, const std::string& kind)
  {
    const auto order = std::make_shared<Order>();
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
        [this, kind, order](const boost::shared_ptr<const Message>& message)
    {
      world_.check(kind, *message);
      Problems found;
      order->next(*message, found);
      for (const std::string& problem : found)
      {
        world_.fail(kind, problem);
      }
      world_.count(kind + " heard");
    };
    const auto queue_size = static_cast<std::uint32_t>(dice_.oneIn(2) ? 1 : 1000);
    return node_.subscribe<Message>(name, queue_size, callback);
  }

  ros::Subscriber someTopic()
  {
    const std::string& node = world_.node();
    switch (dice_.below(10))
    {
      case 0:
        return listen<visualization_msgs::MarkerArray>(node + "/markers", "markers");
      case 1:
        return listen<ClothSurface>(node + "/surface", "surface");
      case 2:
        return listen<SimulationStatus>(node + "/status", "status");
      case 3:
        return listen<GraspStates>(node + "/grasp_states", "grasp_states");
      case 4:
        return listen<GraspEvents>(node + "/grasp_events", "grasp_events");
      case 5:
        return listen<TearEvents>(node + "/tear_events", "tear_events");
      case 6:
        return listen<diagnostic_msgs::DiagnosticArray>("/diagnostics", "diagnostics");
      case 7:
        return listen<visualization_msgs::InteractiveMarkerUpdate>(node + "/handles/update",
                                                                   "handles/update");
      case 8:
        return listen<dynamic_reconfigure::Config>(node + "/material/parameter_updates",
                                                   "parameter_updates");
      default:
        return someWrench();
    }
  }

  ros::Subscriber someWrench()
  {
    const std::vector<std::uint64_t> grasps = world_.grasps();
    const std::uint64_t grasp = grasps.empty() ? 1 : dice_.oneOf(grasps);
    return listen<geometry_msgs::WrenchStamped>(
        world_.node() + "/grasps/" + std::to_string(grasp) + "/wrench", "wrench");
  }

  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
};

}  // namespace

std::unique_ptr<User> makeListener(World& world, std::uint64_t seed)
{
  return std::make_unique<Listener>(world, seed);
}

}  // namespace soak
