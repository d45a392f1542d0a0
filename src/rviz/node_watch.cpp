// What a window hears of one node, and which nodes there are.
#include "cloth_tearing/rviz/node_watch.h"

#include <ros/master.h>
#include <ros/message_traits.h>
#include <ros/node_handle.h>

#include <chrono>
#include <utility>

namespace cloth_tearing
{

using dynamic_reconfigure::Config;

namespace
{

constexpr std::chrono::milliseconds TICK{ 250 };
constexpr std::chrono::seconds SILENCE{ 2 };
constexpr std::chrono::seconds LOOK_EVERY{ 2 };

const std::string STATUS = "/status";

bool isOver(const QElapsedTimer& timer, std::chrono::milliseconds limit)
{
  return !timer.isValid() || timer.hasExpired(limit.count());
}

/// The node that has this topic; empty if it is no status.
std::string nodeOf(const ros::master::TopicInfo& topic)
{
  const bool is_status =
      topic.datatype == ros::message_traits::datatype<SimulationStatus>() &&
      topic.name.size() > STATUS.size() &&
      topic.name.compare(topic.name.size() - STATUS.size(), STATUS.size(), STATUS) == 0;
  return is_status ? topic.name.substr(0, topic.name.size() - STATUS.size()) : "";
}

}  // namespace

/// Subscribes and asks the master, which may take long. What comes is told by the global queue.
class NodeWatch::Ears
{
public:
  explicit Ears(NodeWatch& watch) : watch_(watch) {}

  Seen look(const std::string& node)
  {
    Seen seen;
    ros::master::V_TopicInfo topics;
    // Without a master, all but check() waits until there is one.
    seen.master = ros::master::check() && ros::master::getTopics(topics);
    if (seen.master)
    {
      listenTo(node);
    }
    for (const ros::master::TopicInfo& topic : topics)
    {
      const std::string name = nodeOf(topic);
      if (!name.empty())
      {
        seen.nodes.append(QString::fromStdString(name));
      }
    }
    seen.nodes.sort();
    return seen;
  }

private:
  void listenTo(const std::string& node)
  {
    if (node == node_)
    {
      return;
    }
    topics_.clear();
    hear<SimulationStatus>(node, STATUS, [this](const auto& status) { watch_.onStatus(status); });
    for (const std::string server : { "", "/tearing" })
    {
      hear<Config>(node, server + "/parameter_updates",
                   [this, name = QString::fromStdString(server).mid(1)](const auto& values)
                   { Q_EMIT watch_.valuesCame(name, values); });
    }
    node_ = node;
  }

  template <class Message, class Take>
  void hear(const std::string& node, const std::string& topic, Take take)
  {
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
        [this, node, take](const boost::shared_ptr<const Message>& message)
    {
      if (node == watch_.node())  // else it is late
      {
        take(*message);
      }
    };
    topics_.push_back(ros::NodeHandle().subscribe<Message>(node + topic, 1, callback));
  }

  NodeWatch& watch_;
  std::string node_;
  std::vector<ros::Subscriber> topics_;
};

NodeWatch::NodeWatch() : ears_(std::make_shared<Ears>(*this))
{
  connect(&timer_, &QTimer::timeout, this, &NodeWatch::onTimer);
}

NodeWatch::~NodeWatch() = default;

void NodeWatch::follow(const std::string& node)
{
  node_ = node;
  silence_.clear();
  heard_.start();
  timer_.start(TICK);
  master_.cut();  // what it would say is of the node before
  look();
}

void NodeWatch::look()
{
  looking_ = true;
  looked_.start();
  master_.run([ears = ears_, node = node_] { return ears->look(node); },
              [this](const Seen& seen) { onLook(seen); });
}

void NodeWatch::onLook(const Seen& seen)
{
  looking_ = false;
  const bool changed = seen.nodes != seen_.nodes;
  seen_ = seen;
  if (changed)
  {
    Q_EMIT nodesCame(seen.nodes);
  }
}

void NodeWatch::onStatus(const SimulationStatus& status)
{
  silence_.clear();
  heard_.start();
  Q_EMIT statusCame(status);
}

void NodeWatch::onTimer()
{
  if (!looking_ && isOver(looked_, LOOK_EVERY))
  {
    look();
  }
  const QString silence = isOver(heard_, SILENCE) ? this->silence() : QString();
  if (silence != silence_)
  {
    silence_ = silence;
    Q_EMIT fellSilent(silence);
  }
}

QString NodeWatch::silence() const
{
  if (!seen_.master)
  {
    return "no ROS master";
  }
  return seen_.nodes.contains(QString::fromStdString(node_)) ? "silent" : "not running";
}

}  // namespace cloth_tearing
