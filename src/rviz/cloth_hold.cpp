// Holds one node's cloth on behalf of a pointer.
#include "cloth_tearing/rviz/cloth_hold.h"

#include <QCoreApplication>
#include <chrono>
#include <thread>
#include <utility>

#include "cloth_tearing/GraspTargets.h"
#include "cloth_tearing/rviz/vector_messages.h"

namespace cloth_tearing
{

namespace
{

using Clock = std::chrono::steady_clock;

constexpr double KEEP_ALIVE = 2.0;  // the node lets go without us [s]
constexpr double HEARTBEAT = 0.3;   // between two targets at most [s]
constexpr std::chrono::milliseconds PAUSE{ 5 };
constexpr std::uint32_t QUEUE = 10;

double now()
{
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

}  // namespace

ClothHold::ClothHold(const ros::NodeHandle& node, const std::string& cloth_node)
    : node_(node, cloth_node), state_(cloth_node)
{
  targets_ = node_.advertise<GraspTargets>("grasp_targets", QUEUE);
}

ClothHold::~ClothHold()
{
  if (!end_)
  {
    finishBy(Clock::now() + ServiceCaller::LAST_PATIENCE);
  }
  // What was only asked for can be let go when its answer has been heard.
  QCoreApplication::sendPostedEvents(&caller_);
  while (state_.phase() == HoldState::Phase::ASKED && Clock::now() < *end_)
  {
    std::this_thread::sleep_for(PAUSE);
    QCoreApplication::sendPostedEvents(&caller_);
  }
}

void ClothHold::finishBy(Clock::time_point end)
{
  letGo(false);
  end_ = end;
  // The last answer may ask for one more call.
  caller_.finishBy(end + ServiceCaller::LAST_PATIENCE);
}

void ClothHold::take(const std::string& frame, const cloth::Vec3d& point, double radius)
{
  if (busy())
  {
    return;
  }
  frame_ = frame;
  target_ = point;
  is_new_ = false;
  Grasp::Request request;
  request.header.frame_id = frame;
  request.point = toMessage<geometry_msgs::Point>(point);
  request.radius = radius;
  request.keep_alive = KEEP_ALIVE;
  if (state_.phase() == HoldState::Phase::ASKED)
  {
    next_ = request;
    return;
  }
  ask(request);
}

void ClothHold::lead(const cloth::Vec3d& target)
{
  target_ = target;
  is_new_ = true;
}

void ClothHold::ask(const Grasp::Request& request)
{
  listen();
  state_.ask();
  caller_.call<Grasp>(node_.resolveName("grasp"), request,
                      [this](const auto& answer)
                      {
                        sent_at_ = now();
                        if (const auto end = state_.answer(answer.problem, answer.response, now()))
                        {
                          release(*end);
                        }
                        if (const auto next = std::exchange(next_, std::nullopt))
                        {
                          ask(*next);
                        }
                      });
}

void ClothHold::letGo(bool pin)
{
  next_.reset();
  if (const auto end = state_.letGo(pin))
  {
    release(*end);
  }
}

void ClothHold::release(const Release::Request& request)
{
  const bool pin = request.pin != 0;
  caller_.call<Release>(node_.resolveName("release"), request,
                        [this, pin](const auto& answer) { state_.released(answer.problem, pin); });
}

void ClothHold::listen()
{
  if (status_)
  {
    return;
  }
  found_ = false;
  const auto hear = [this](const auto& message) { state_.hear(*message, now()); };
  states_ = node_.subscribe<GraspStates>(
      "grasp_states", QUEUE, [hear](const GraspStates::ConstPtr& message) { hear(message); });
  status_ = node_.subscribe<SimulationStatus>(
      "status", QUEUE, [hear](const SimulationStatus::ConstPtr& message) { hear(message); });
  events_ = node_.subscribe<GraspEvents>("grasp_events", QUEUE,
                                         [this](const GraspEvents::ConstPtr& message)
                                         { state_.hear(*message); });
}

void ClothHold::rest()
{
  states_.shutdown();
  status_.shutdown();
  events_.shutdown();
}

void ClothHold::update()
{
  sendTarget();
  const bool there = status_ && status_.getNumPublishers() > 0;
  if (found_ && !there)
  {
    state_.loseNode();
  }
  found_ = there;
}

/// What is new at once, but to a node that is silent no faster than it takes to stay alive.
bool ClothHold::hasToSpeak() const
{
  const bool at_once = is_new_ && !state_.silent(now());
  return state_.phase() == HoldState::Phase::HELD && (at_once || now() > sent_at_ + HEARTBEAT);
}

/// A message that nobody gets is not sent.
void ClothHold::sendTarget()
{
  if (!hasToSpeak() || targets_.getNumSubscribers() == 0)
  {
    return;
  }
  GraspTargets message;
  message.header.frame_id = frame_;
  message.targets.resize(1);
  message.targets[0].grasp_id = state_.grasp();
  message.targets[0].pose.position = toMessage<geometry_msgs::Point>(target_);
  targets_.publish(message);
  is_new_ = false;
  sent_at_ = now();
}

std::string ClothHold::words() const
{
  const std::string waiting = caller_.waitingFor(node_.getNamespace());
  return waiting.empty() ? state_.words(now()) : waiting;
}

}  // namespace cloth_tearing
