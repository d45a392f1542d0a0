// The rviz tool that throws balls at the cloth.
#include "cloth_tearing/rviz/throw_tool.h"

#include <rviz/display_context.h>
#include <rviz/properties/float_property.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <pluginlib/class_list_macros.hpp>

#include "cloth_tearing/ThrowSphere.h"
#include "cloth_tearing/rviz/vector_messages.h"

namespace cloth_tearing
{

namespace
{

constexpr double LONGEST_FLIGHT = 0.4;  // to the cloth: from a camera far away too [s]
constexpr double ROOM = 1.1;            // to the cloth at the start, in radii
constexpr int MOST_STEPS_BACK = 30;     // to find it

const char* const KEYS = "<b>Left-Click:</b> Throw a ball. <b>Middle, Right, Wheel:</b> Camera.";

}  // namespace

ThrowTool::ThrowTool()
{
  shortcut_key_ = 't';
  rviz::Property* container = getPropertyContainer();
  radius_ = new rviz::FloatProperty("Radius", 0.06F, "Of the ball [m].", container);
  radius_->setMin(0.001F);
  speed_ = new rviz::FloatProperty("Speed", 8.0F, "Of the ball [m/s].", container);
  speed_->setMin(0.01F);
  mass_ = new rviz::FloatProperty(
      "Mass", 0.0F, "Of the ball [kg]; 0 = it flies straight on, whatever it meets.", container);
  mass_->setMin(0.0F);
  lifetime_ =
      new rviz::FloatProperty("Lifetime", 3.0F, "After which the ball is gone [s].", container);
  lifetime_->setMin(0.01F);
}

ThrowTool::~ThrowTool()
{
  const auto end = std::chrono::steady_clock::now() + ServiceCaller::LAST_PATIENCE;
  for (auto& caller : callers_)
  {
    caller.second.finishBy(end);
  }
}

void ThrowTool::activate()
{
  note_.clear();
}

void ThrowTool::deactivate()
{
  pressed_ = false;
}

int ThrowTool::processMouseEvent(rviz::ViewportMouseEvent& event)
{
  int flags = 0;
  pressed_ = pressed_ && event.left();
  if (leftPressed(event))
  {
    pressed_ = true;
    throwBall(sightOf(event));
  }
  else
  {
    flags = moveCamera(event, pressed_);
  }
  tell();
  return flags;
}

void ThrowTool::throwBall(const Ray& sight)
{
  const std::vector<const ClothDisplay*> cloths = enabledCloths(*context_);
  if (cloths.empty())
  {
    note_ = "There is no cloth to throw at: add a display cloth_tearing/Cloth";
    return;
  }
  const std::optional<PickedCloth> goal = pickCloth(*context_, sight);
  node_ = goal ? goal->node : cloths.front()->clothNode();
  const std::optional<cloth::Vec3d> center = start(sight, goal);
  if (!center)
  {
    note_ = "Not thrown: there is no room for the ball before the cloth";
    return;
  }
  ThrowSphere::Request request;
  request.header.frame_id = context_->getFixedFrame().toStdString();
  request.center = toMessage<geometry_msgs::Point>(*center);
  request.velocity = toMessage<geometry_msgs::Vector3>(speed_->getFloat() * sight.direction);
  request.radius = radius_->getFloat();
  request.mass = mass_->getFloat();
  request.lifetime = lifetime_->getFloat();
  note_ = "Throwing ...";
  callers_[node_].call<ThrowSphere>(
      ros::names::append(node_, "throw_sphere"), request,
      [this, node = node_](const auto& answer)
      {
        const std::string text =
            answer.done()
                ? "Ball " + std::to_string(answer.response.sphere_id) + " flies at " + node
                : "Not thrown: " + answer.problem;
        note_ = QString::fromStdString(text).toHtmlEscaped();
      });
}

/// Before the cloth that it is to hit, no further from it than it flies in a moment, and with room
/// around it.
std::optional<cloth::Vec3d> ThrowTool::start(const Ray& sight,
                                             const std::optional<PickedCloth>& goal) const
{
  const double to_cloth = goal ? goal->distance : distanceToCloth(sight.origin);
  double distance = 0.0;
  if (std::isfinite(to_cloth))
  {
    distance = std::max(0.0, to_cloth - speed_->getFloat() * LONGEST_FLIGHT);
  }
  const double wanted = ROOM * radius_->getFloat();
  for (int step = 0; step < MOST_STEPS_BACK; ++step)
  {
    const double room = distanceToCloth(sight.at(distance));
    if (room >= wanted)
    {
      return sight.at(distance);
    }
    distance -= wanted - room + 0.1 * wanted;
  }
  return std::nullopt;
}

double ThrowTool::distanceToCloth(const cloth::Vec3d& point) const
{
  double nearest = std::numeric_limits<double>::infinity();
  for (const ClothDisplay* cloth : enabledCloths(*context_))
  {
    nearest = std::min(nearest, cloth->distanceFrom(point));
  }
  return nearest;
}

void ThrowTool::update(float /*wall_dt*/, float /*ros_dt*/)
{
  tell();
}

void ThrowTool::tell()
{
  const auto caller = callers_.find(node_);
  const std::string waiting =
      caller == callers_.end() ? std::string() : caller->second.waitingFor(node_);
  const QString said = waiting.empty() ? note_ : QString::fromStdString(waiting).toHtmlEscaped();
  setStatus(said.isEmpty() ? QString(KEYS) : said + ". " + KEYS);
}

}  // namespace cloth_tearing

PLUGINLIB_EXPORT_CLASS(cloth_tearing::ThrowTool, rviz::Tool)
