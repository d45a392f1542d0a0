// The rviz tool that takes the cloth in the hand.
#include "cloth_tearing/rviz/pull_tool.h"

#include <OgreViewport.h>
#include <rviz/display_context.h>
#include <rviz/properties/float_property.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <pluginlib/class_list_macros.hpp>
#include <tuple>

namespace cloth_tearing
{

namespace
{

constexpr float RADIUS = 0.04F;         // [m]
constexpr float LEAST_RADIUS = 0.001F;  // that the wheel sets [m]
constexpr float MOST_RADIUS = 100.0F;   // [m]
constexpr double WHEEL_FACTOR = 1.15;   // of the radius, for one notch
constexpr double NOTCH = 120.0;
constexpr float LEAST_BALL = 0.005F;  // radius of what shows a single particle [m]

const Ogre::ColourValue HOVERING(0.10F, 0.45F, 0.85F, 0.35F);
const Ogre::ColourValue HOLDING(0.95F, 0.55F, 0.10F, 0.35F);

const char* const KEYS_IDLE =
    "<b>Left-Click on cloth:</b> Pull it. <b>Wheel on cloth:</b> Radius "
    "(%1 m). <b>Elsewhere, and Middle, Right:</b> Camera.";
const char* const KEYS_HOLDING =
    "<b>Shift:</b> Away/towards. <b>Release:</b> Let go, with <b>Ctrl:</b> Pin.";

}  // namespace

PullTool::PullTool()
{
  shortcut_key_ = 'l';
  radius_ =
      new rviz::FloatProperty("Radius", RADIUS,
                              "Cloth within this distance of the pointer is held [m]; 0 = the "
                              "nearest particle. The wheel over the cloth changes it.",
                              getPropertyContainer());
  radius_->setMin(0.0F);
  radius_->setMax(MOST_RADIUS);
}

PullTool::~PullTool()
{
  const auto end = std::chrono::steady_clock::now() + ServiceCaller::LAST_PATIENCE;
  for (auto& hold : holds_)
  {
    hold.second.finishBy(end);
  }
}

void PullTool::onInitialize()
{
  ClothTool::onInitialize();
  ball_ = std::make_unique<rviz::Shape>(rviz::Shape::Sphere, scene_manager_);
  ball_->getRootNode()->setVisible(false);
}

void PullTool::activate()
{
  hold_ = nullptr;
  note_.clear();
}

void PullTool::deactivate()
{
  pressed_ = false;
  letGo(false);
  for (auto& hold : holds_)
  {
    hold.second.rest();
  }
  panel_.clear();
  show({});
  setStatus("");
}

// -- mouse ---------------------------------------------------------------------------------------

int PullTool::processMouseEvent(rviz::ViewportMouseEvent& event)
{
  panel_ = event.panel;
  buttons_ = event.buttons_down != Qt::NoButton;
  followFixedFrame();
  if (pressed_)
  {
    lead(event);
  }
  x_ = event.x;
  y_ = event.y;

  int flags = 0;
  if (pressed_ && !event.left())
  {
    pressed_ = false;
    letGo(event.control());
  }
  else if (leftPressed(event) && take(event))
  {
    flags = Render;
  }
  else if (event.wheel_delta != 0 && (pressed_ || underPointer()))
  {
    changeRadius(event.wheel_delta);
    flags = Render;
  }
  else
  {
    flags = moveCamera(event, pressed_);
  }
  tell();
  return flags;
}

/// @return false: there is no cloth
bool PullTool::take(const rviz::ViewportMouseEvent& event)
{
  const std::optional<PickedCloth> cloth = pickCloth(*context_, sightOf(event));
  if (!cloth)
  {
    return false;
  }
  ros::NodeHandle node;
  node.setCallbackQueue(context_->getUpdateQueue());
  hold_ = &holds_
               .emplace(std::piecewise_construct, std::forward_as_tuple(cloth->node),
                        std::forward_as_tuple(node, cloth->node))
               .first->second;
  note_.clear();
  hold_->take(context_->getFixedFrame().toStdString(), cloth->point, radius_->getFloat());
  drag_.begin(viewOf(*event.viewport), placeIn(*event.viewport, event.x, event.y), cloth->point);
  pressed_ = true;
  return true;
}

void PullTool::lead(const rviz::ViewportMouseEvent& event)
{
  const View view = viewOf(*event.viewport);
  const cloth::Vec2d place = placeIn(*event.viewport, event.x, event.y);
  if ((event.buttons_down & ~Qt::LeftButton) != Qt::NoButton)  // the pointer moves the camera
  {
    drag_.begin(view, place, drag_.point());
    return;
  }
  const cloth::Vec3d before = drag_.point();
  const bool shift = (event.modifiers & Qt::ShiftModifier) != 0;
  const ViewDrag::Way way = shift ? ViewDrag::Way::ALONG : ViewDrag::Way::ACROSS;
  const cloth::Vec3d& now = drag_.move(view, place, way);
  if (now != before)
  {
    hold_->lead(now);
  }
}

void PullTool::letGo(bool pin)
{
  if (hold_ != nullptr && hold_->busy())
  {
    hold_->letGo(pin);
  }
}

/// Where the pointer is says nothing any more of where the cloth is to be.
void PullTool::followFixedFrame()
{
  const QString fixed_frame = context_->getFixedFrame();
  if (hold_ != nullptr && hold_->busy() && hold_->frame() != fixed_frame.toStdString())
  {
    letGo(false);
    note_ = "Let go: the fixed frame has changed to " + fixed_frame;
  }
}

void PullTool::changeRadius(int wheel_delta)
{
  const double factor = std::pow(WHEEL_FACTOR, wheel_delta / NOTCH);
  const auto radius = static_cast<float>(std::max(radius_->getFloat(), LEAST_RADIUS) * factor);
  radius_->setFloat(std::clamp(radius, LEAST_RADIUS, MOST_RADIUS));
}

// -- what is shown -------------------------------------------------------------------------------

void PullTool::update(float /*wall_dt*/, float /*ros_dt*/)
{
  followFixedFrame();
  for (auto& hold : holds_)
  {
    hold.second.update();
  }
  show(ballNow());
  tell();
}

std::optional<PickedCloth> PullTool::underPointer() const
{
  if (!panel_ || !panel_->rect().contains(panel_->mapFromGlobal(QCursor::pos())))
  {
    return std::nullopt;
  }
  Ogre::Viewport& viewport = *panel_->getViewport();
  return pickCloth(*context_, viewOf(viewport).through(placeIn(viewport, x_, y_)));
}

bool PullTool::Ball::operator==(const Ball& other) const
{
  return middle == other.middle && radius == other.radius && holding == other.holding;
}

/// Where the cloth would be held, or where it is to be.
PullTool::Ball PullTool::ballNow() const
{
  Ball ball;
  ball.radius = std::max(radius_->getFloat(), LEAST_BALL);
  ball.holding = pressed_ && hold_->busy();
  if (ball.holding)
  {
    ball.middle = drag_.point();
  }
  else if (!buttons_)
  {
    if (const std::optional<PickedCloth> cloth = underPointer())
    {
      ball.middle = cloth->point;
    }
  }
  return ball;
}

void PullTool::show(const Ball& ball)
{
  if (ball == shown_)
  {
    return;
  }
  shown_ = ball;
  ball_->getRootNode()->setVisible(ball.middle.has_value());
  if (ball.middle)
  {
    ball_->setColor(ball.holding ? HOLDING : HOVERING);
    ball_->setPosition(toOgre(*ball.middle));
    ball_->setScale(Ogre::Vector3(2.0F * ball.radius));
  }
  context_->queueRender();
}

void PullTool::tell()
{
  setStatus(words());
}

QString PullTool::words() const
{
  if (enabledCloths(*context_).empty())
  {
    return "There is no cloth to pull: add a display cloth_tearing/Cloth.";
  }
  const bool holding = pressed_ && hold_->busy();
  const QString keys =
      holding ? QString(KEYS_HOLDING) : QString(KEYS_IDLE).arg(radius_->getFloat(), 0, 'g', 3);
  QString said = note_;
  if (said.isEmpty() && hold_ != nullptr)
  {
    said = QString::fromStdString(hold_->words());
  }
  said = said.toHtmlEscaped();
  return said.isEmpty() ? keys : said + ". " + keys;
}

}  // namespace cloth_tearing

PLUGINLIB_EXPORT_CLASS(cloth_tearing::PullTool, rviz::Tool)
