// Holds one node's cloth on behalf of a pointer.
#include "cloth_tearing/rviz/cloth_hold.h"

#include <QCoreApplication>
#include <chrono>
#include <thread>
#include <utility>

#include "cloth_tearing/GraspTargets.h"

namespace cloth_tearing
{

namespace
{

constexpr double PATIENCE = 2.0;       // with an answer, before it is told [s]
constexpr double LAST_PATIENCE = 1.0;  // with an answer, before the end [s]
constexpr std::chrono::milliseconds PAUSE{ 5 };
constexpr std::uint32_t QUEUE = 10;

double now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

geometry_msgs::Point toPoint(const cloth::Vec3d& x)
{
  geometry_msgs::Point point;
  point.x = x.x();
  point.y = x.y();
  point.z = x.z();
  return point;
}

}  // namespace

ClothHold::ClothHold(const ros::NodeHandle& node, const std::string& cloth_node)
    : node_(node, cloth_node), state_(cloth_node)
{
  targets_ = node_.advertise<GraspTargets>("grasp_targets", QUEUE);
}

ClothHold::~ClothHold()
{
  letGo(false);
  // What was only asked for can be let go when its answer has been heard.
  const double deadline = now() + LAST_PATIENCE;
  while (state_.phase() == HoldState::Phase::ASKED && now() < deadline)
  {
    std::this_thread::sleep_for(PAUSE);
    QCoreApplication::sendPostedEvents(&caller_);
  }
}

void ClothHold::take(const std::string& frame, const cloth::Vec3d& point, double radius)
{
  if (busy())
  {
    return;
  }
  frame_ = frame;
  target_.reset();
  Grasp::Request request;
  request.header.frame_id = frame;
  request.point = toPoint(point);
  request.radius = radius;
  if (state_.phase() == HoldState::Phase::ASKED)
  {
    next_ = request;
    return;
  }
  ask(request);
}

void ClothHold::ask(const Grasp::Request& request)
{
  listen();
  state_.ask();
  caller_.call<Grasp>(node_.resolveName("grasp"), request,
                      [this](const auto& answer)
                      {
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

/// A message that nobody gets is not sent, and a node that is silent gets one when it is back.
void ClothHold::sendTarget()
{
  if (!target_ || state_.phase() != HoldState::Phase::HELD || state_.silent(now()) ||
      targets_.getNumSubscribers() == 0)
  {
    return;
  }
  GraspTargets message;
  message.header.frame_id = frame_;
  message.targets.resize(1);
  message.targets[0].grasp_id = state_.grasp();
  message.targets[0].pose.position = toPoint(*target_);
  targets_.publish(message);
  target_.reset();
}

std::string ClothHold::words() const
{
  const double waiting = caller_.waiting();
  if (waiting > PATIENCE)
  {
    return node_.getNamespace() + " has not answered for " +
           std::to_string(static_cast<int>(waiting)) + " s";
  }
  return state_.words(now());
}

}  // namespace cloth_tearing
