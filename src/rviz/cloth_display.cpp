// The rviz display that draws ~surface.
#include "cloth_tearing/rviz/cloth_display.h"

#include <ros/console.h>
#include <ros/exceptions.h>
#include <ros/names.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/ros_topic_property.h>
#include <rviz/properties/string_property.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <pluginlib/class_list_macros.hpp>
#include <utility>

#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/rviz/cloth_texture.h"

namespace cloth_tearing
{

using rviz::StatusProperty;

namespace
{

constexpr std::uint32_t QUEUE = 2;    // of messages, of which only the last is drawn
constexpr float LEAST_RANGE = 1e-4F;  // between the ends of the strain range [-]
constexpr float LEAST_SIZE = 1e-5F;   // of lines and points [m]
constexpr float MOST_LENGTH = 1e9F;   // of a vector from outside

// A node tells its status ten times a second, also while it is paused.
constexpr std::chrono::seconds SILENCE{ 2 };

const char* const DEFAULT_IMAGE = "package://cloth_tearing/media/woven_checker.png";

/// Neither too large nor NaN.
bool drawable(const Ogre::Vector3& vector)
{
  return vector.squaredLength() < MOST_LENGTH * MOST_LENGTH;
}

cloth::Pose toPose(const Ogre::Vector3& position, const Ogre::Quaternion& rotation)
{
  cloth::Pose pose;
  pose.position = cloth::Vec3d(position.x, position.y, position.z);
  pose.rotation = cloth::Quatd(rotation.w, rotation.x, rotation.y, rotation.z).normalized();
  return pose;
}

}  // namespace

// -- properties ----------------------------------------------------------------------------------

ClothDisplay::ClothDisplay()
{
  const QString datatype = QString::fromStdString(ros::message_traits::datatype<ClothSurface>());
  topic_ = new rviz::RosTopicProperty("Topic", "", datatype, datatype + " topic to subscribe to.",
                                      this, SLOT(updateTopic()));
  addColoring();
  addParts();
  addForces();
}

ClothDisplay::~ClothDisplay() = default;

void ClothDisplay::addColoring()
{
  coloring_ = new rviz::EnumProperty("Coloring", "Texture", "What the cloth is covered with.", this,
                                     SLOT(updateStyle()));
  coloring_->addOption("Texture", static_cast<int>(ClothStyle::Coloring::TEXTURE));
  coloring_->addOption("Strain", static_cast<int>(ClothStyle::Coloring::STRAIN));
  coloring_->addOption("Plain", static_cast<int>(ClothStyle::Coloring::PLAIN));
  image_ = new rviz::StringProperty("Texture Image", DEFAULT_IMAGE,
                                    "package://PACKAGE/PATH or /absolute/path of an image.",
                                    coloring_, SLOT(updateImage()), this);
  smooth_image_ = new rviz::BoolProperty("Smooth Image", true,
                                         "Average the image where it is seen from afar. Without a "
                                         "graphics card, very fine cloth is drawn "
                                         "about twice as fast without.",
                                         coloring_, SLOT(updateStyle()), this);
  low_strain_ = new rviz::FloatProperty("Lowest Strain", 0.0F, "Strain that is shown blue [-].",
                                        coloring_, SLOT(updateStyle()), this);
  high_strain_ = new rviz::FloatProperty("Highest Strain", 0.2F, "Strain that is shown red [-].",
                                         coloring_, SLOT(updateStyle()), this);
  legend_ = new StrainLegend(coloring_);
  plain_color_ =
      new rviz::ColorProperty("Plain Color", QColor(217, 204, 179), "Of the plain cloth.",
                              coloring_, SLOT(updateStyle()), this);
}

void ClothDisplay::addParts()
{
  wireframe_ = new rviz::BoolProperty("Wireframe", false,
                                      "The edges of the triangles. Without a graphics card, those "
                                      "of a fine cloth take much time to draw.",
                                      this, SLOT(updateStyle()));
  wireframe_->setDisableChildrenIfFalse(true);
  wireframe_color_ = new rviz::ColorProperty("Color", QColor(40, 42, 48), "Of the edges.",
                                             wireframe_, SLOT(updateStyle()), this);
  wireframe_alpha_ =
      new rviz::FloatProperty("Alpha", 0.35F,
                              "Of the edges: 0 is invisible, 1 hides what is behind. Little shows "
                              "the cloth between the edges of a fine mesh.",
                              wireframe_, SLOT(updateStyle()), this);
  wireframe_alpha_->setMin(0.0F);
  wireframe_alpha_->setMax(1.0F);
  torn_edges_ =
      addStroke("Torn Edges", QColor(217, 13, 89), "Width", 0.004F, "Edges that a tear opened.");
  weak_points_ = addStroke("Weak Points", QColor(255, 217, 0), "Size", 0.012F,
                           "Where a tear ends and may run on.");
  held_ = addStroke("Held Patches", QColor(26, 166, 64), "Size", 0.016F,
                    "Particles that a gripper holds, and pinned ones.");
  pinned_color_ =
      new rviz::ColorProperty("Pinned Color", QColor(60, 70, 90), "Of pinned particles.",
                              held_.shown, SLOT(updateStyle()), this);
}

void ClothDisplay::addForces()
{
  forces_ = new rviz::BoolProperty(
      "Forces", true, "Force of the cloth on each gripper, from grasp_states beside the topic.",
      this, SLOT(updateForces()));
  forces_->setDisableChildrenIfFalse(true);
  force_color_ = new rviz::ColorProperty("Color", QColor(225, 95, 20), "Of the arrows.", forces_,
                                         SLOT(updateForces()), this);
  force_scale_ = new rviz::FloatProperty("Scale", 0.1F, "Length of an arrow [m/N].", forces_,
                                         SLOT(updateForces()), this);
  force_scale_->setMin(0.0F);
}

ClothDisplay::StrokeProperties ClothDisplay::addStroke(const QString& name, const QColor& color,
                                                       const QString& size_name, float size,
                                                       const QString& description)
{
  StrokeProperties stroke;
  stroke.shown = new rviz::BoolProperty(name, true, description, this, SLOT(updateStyle()));
  stroke.shown->setDisableChildrenIfFalse(true);
  stroke.color =
      new rviz::ColorProperty("Color", color, "", stroke.shown, SLOT(updateStyle()), this);
  stroke.size = new rviz::FloatProperty(size_name, size, "Width or diameter [m].", stroke.shown,
                                        SLOT(updateStyle()), this);
  stroke.size->setMin(LEAST_SIZE);
  return stroke;
}

StrokeStyle ClothDisplay::StrokeProperties::style() const
{
  return { shown->getBool(), size->getFloat(), color->getOgreColor() };
}

ClothStyle ClothDisplay::style() const
{
  ClothStyle style;
  style.coloring = static_cast<ClothStyle::Coloring>(coloring_->getOptionInt());
  style.smooth_image = smooth_image_->getBool();
  const float low = low_strain_->getFloat();
  style.strain_range = { low, std::max(high_strain_->getFloat(), low + LEAST_RANGE) };
  style.plain_color = plain_color_->getOgreColor();
  style.wireframe = wireframe_->getBool();
  style.wireframe_color = wireframe_color_->getOgreColor();
  style.wireframe_color.a = wireframe_alpha_->getFloat();
  style.torn_edges = torn_edges_.style();
  style.weak_points = weak_points_.style();
  style.held = held_.style();
  style.pinned_color = pinned_color_->getOgreColor();
  return style;
}

void ClothDisplay::updateStyle()
{
  const ClothStyle wanted = style();
  image_->setHidden(wanted.coloring != ClothStyle::Coloring::TEXTURE);
  smooth_image_->setHidden(wanted.coloring != ClothStyle::Coloring::TEXTURE);
  for (rviz::Property* property :
       { static_cast<rviz::Property*>(low_strain_), static_cast<rviz::Property*>(high_strain_),
         static_cast<rviz::Property*>(legend_) })
  {
    property->setHidden(wanted.coloring != ClothStyle::Coloring::STRAIN);
  }
  plain_color_->setHidden(wanted.coloring != ClothStyle::Coloring::PLAIN);
  legend_->setRange(wanted.strain_range);
  if (visual_)
  {
    visual_->setStyle(wanted);
    drawn_ = false;
  }
}

void ClothDisplay::updateImage()
{
  if (!visual_)
  {
    return;
  }
  image_problem_.clear();
  QImage image;
  try
  {
    image = readImage(image_->getStdString());
  }
  catch (const cloth::Refusal& refusal)
  {
    image_problem_ = refusal.what();
  }
  visual_->setImage(image);
  tellImage();
  context_->queueRender();
}

void ClothDisplay::tellImage()
{
  const bool fine = image_problem_.empty();
  setStatusStd(fine ? StatusProperty::Ok : StatusProperty::Error, "Texture",
               fine ? "OK" : image_problem_);
}

void ClothDisplay::updateForces()
{
  drawn_ = false;
}

// -- messages ------------------------------------------------------------------------------------

void ClothDisplay::onInitialize()
{
  visual_ = std::make_unique<ClothVisual>(context_->getSceneManager(), scene_node_);
  arrows_ = std::make_unique<ForceArrows>(context_->getSceneManager(), scene_node_);
  updateStyle();
  updateImage();
}

void ClothDisplay::onEnable()
{
  subscribe();
}

void ClothDisplay::onDisable()
{
  reset();
}

void ClothDisplay::setTopic(const QString& topic, const QString& /*datatype*/)
{
  topic_->setString(topic);
}

void ClothDisplay::updateTopic()
{
  reset();
}

void ClothDisplay::subscribe()
{
  source_ = Source::SUBSCRIBED;
  messages_ = 0;
  const std::string topic = topic_->getTopicStd();
  if (!isEnabled() || topic.empty())
  {
    return;
  }
  try
  {
    surface_subscriber_ = update_nh_.subscribe(topic, QUEUE, &ClothDisplay::takeSurface, this);
    grasp_subscriber_ = update_nh_.subscribe(ros::names::append(clothNode(), "grasp_states"), QUEUE,
                                             &ClothDisplay::takeGrasps, this);
    status_subscriber_ = update_nh_.subscribe(ros::names::append(clothNode(), "status"), 1,
                                              &ClothDisplay::takeStatus, this);
  }
  catch (const ros::Exception& error)
  {
    setStatus(StatusProperty::Error, "Topic", QString("Error subscribing: ") + error.what());
  }
}

std::string ClothDisplay::clothNode() const
{
  const std::string topic = topic_->getTopicStd();
  try
  {
    return topic.empty() ? topic : ros::names::parentNamespace(update_nh_.resolveName(topic));
  }
  catch (const ros::InvalidNameException&)
  {
    return {};  // subscribe() tells so
  }
}

void ClothDisplay::unsubscribe()
{
  status_subscriber_.shutdown();
  heard_.reset();
  grasp_subscriber_.shutdown();
  surface_subscriber_.shutdown();
}

/// Subscribes anew: what is latched comes again, and a cloth at rest is not lost.
void ClothDisplay::reset()
{
  unsubscribe();
  rviz::Display::reset();
  surface_.reset();
  place_told_ = false;
  grasps_.reset();
  problem_.clear();
  if (visual_)
  {
    visual_->hide();
    arrows_->draw({}, 0.0F, Ogre::ColourValue::White);
    tellImage();  // its status was cleared as well
  }
  subscribe();
}

void ClothDisplay::fixedFrameChanged()
{
  place_told_ = false;
}

void ClothDisplay::takeSurface(const ClothSurface::ConstPtr& message)
{
  ++messages_;
  try
  {
    new_triangles_ |= mesh_.take(*message);
  }
  catch (const cloth::Refusal& refusal)
  {
    refuse(refusal.what());
    return;
  }
  problem_.clear();
  if (surface_ && surface_->header.frame_id != message->header.frame_id)
  {
    place_told_ = false;
  }
  surface_ = message;
  drawn_ = false;
  setStatus(StatusProperty::Ok, "Surface",
            QString("%1 triangles, %2 particles, %3 torn edges")
                .arg(message->triangles.size() / 3)
                .arg(message->positions.size() / 3)
                .arg(message->torn_edges.size() / 2));
}

void ClothDisplay::refuse(const std::string& reason)
{
  setStatusStd(StatusProperty::Error, "Surface", reason);
  if (reason != problem_)  // not thirty times a second
  {
    ROS_WARN_STREAM("display \"" << getNameStd() << "\" drops a message: " << reason);
    problem_ = reason;
  }
}

/// Puts the cloth where its frame is now. One whose place is not known is not shown at all.
void ClothDisplay::place()
{
  const std::string& frame = surface_->header.frame_id;
  Ogre::Vector3 position;
  Ogre::Quaternion orientation;
  const bool placed =
      context_->getFrameManager()->getTransform(frame, ros::Time(), position, orientation);
  if (placed)
  {
    const geometry_msgs::Point& origin = surface_->origin;
    position += orientation * Ogre::Vector3(origin.x, origin.y, origin.z);
    const cloth::Pose before = std::exchange(pose_, toPose(position, orientation));
    drawn_ &=
        pose_.position == before.position && pose_.rotation.coeffs() == before.rotation.coeffs();
    visual_->setPose(position, orientation);
  }
  if (placed != placed_ || !place_told_)
  {
    tellPlace(placed ? "" : placeProblem(frame));
  }
  drawn_ &= placed == placed_;
  placed_ = placed;
}

/// Not to be asked at each frame: tf may print something.
std::string ClothDisplay::placeProblem(const std::string& frame) const
{
  std::string problem;
  const bool known = context_->getFrameManager()->transformHasProblems(frame, ros::Time(), problem);
  return known ? problem : "no transform from frame [" + frame + "]";
}

void ClothDisplay::tellPlace(const std::string& problem)
{
  place_told_ = true;
  setStatusStd(problem.empty() ? StatusProperty::Ok : StatusProperty::Error, "Transform",
               problem.empty() ? "OK" : problem);
}

void ClothDisplay::takeGrasps(const GraspStates::ConstPtr& message)
{
  grasps_ = message;
  drawn_ = false;
}

void ClothDisplay::takeStatus(const SimulationStatus::ConstPtr& /*message*/)
{
  heard_ = Clock::now();
}

// -- picking -------------------------------------------------------------------------------------

std::optional<double> ClothDisplay::pick(const Ray& ray) const
{
  if (!shown())
  {
    return std::nullopt;
  }
  const Ray local{ pose_.applyInverse(ray.origin), pose_.rotation.conjugate() * ray.direction };
  return firstHit(local, mesh_.positions(), mesh_.triangles());
}

double ClothDisplay::distanceFrom(const cloth::Vec3d& point) const
{
  return shown() ? distanceTo(pose_.applyInverse(point), mesh_.positions(), mesh_.triangles())
                 : std::numeric_limits<double>::infinity();
}

// -- drawing -------------------------------------------------------------------------------------

void ClothDisplay::update(float /*wall_dt*/, float /*ros_dt*/)
{
  watchSource();
  if (surface_)
  {
    place();
  }
  if (drawn_)
  {
    return;
  }
  drawn_ = true;
  if (surface_ && placed_)
  {
    visual_->draw(*surface_, mesh_, std::exchange(new_triangles_, false));
  }
  else
  {
    visual_->hide();
  }
  arrows_->draw(forcesInFixedFrame(), force_scale_->getFloat(), force_color_->getOgreColor());
  context_->queueRender();
}

/// A node that is gone leaves its cloth as it was last.
void ClothDisplay::watchSource()
{
  Source source = Source::SENDING;
  if (messages_ == 0)
  {
    source = Source::SILENT;
  }
  else if (surface_subscriber_.getNumPublishers() == 0)
  {
    source = Source::GONE;
  }
  else if (heard_ && Clock::now() - *heard_ > SILENCE)
  {
    source = Source::HANGING;  // ROS goes on counting a publisher that was killed
  }
  if (source == source_)
  {
    return;
  }
  source_ = source;
  const QString count = QString::number(messages_);
  switch (source)
  {
    case Source::SILENT:
      setStatus(StatusProperty::Warn, "Topic", "No messages received");
      break;
    case Source::GONE:
      setStatus(StatusProperty::Warn, "Topic",
                "No messages any more: nobody publishes; shown is the last of " + count);
      forgetGrasps();
      break;
    case Source::HANGING:
      setStatus(
          StatusProperty::Warn, "Topic",
          "No status of the node any more: it was killed or hangs; shown is the last of " + count);
      forgetGrasps();
      break;
    default:
      setStatus(StatusProperty::Ok, "Topic", count + " messages received");
  }
}

void ClothDisplay::forgetGrasps()
{
  grasps_.reset();
  drawn_ = false;
}

std::vector<ForceArrows::Force> ClothDisplay::forcesInFixedFrame() const
{
  std::vector<ForceArrows::Force> forces;
  Ogre::Vector3 origin;
  Ogre::Quaternion axes;
  if (!forces_->getBool() || !grasps_ ||
      !context_->getFrameManager()->getTransform(grasps_->header.frame_id, ros::Time(), origin,
                                                 axes))
  {
    return forces;
  }
  for (const GraspState& grasp : grasps_->grasps)
  {
    const geometry_msgs::Point& x = grasp.pose.position;
    const geometry_msgs::Vector3& f = grasp.wrench.force;
    const Ogre::Vector3 position(x.x, x.y, x.z);
    const Ogre::Vector3 force(f.x, f.y, f.z);
    if (drawable(position) && drawable(force))
    {
      forces.push_back({ origin + axes * position, axes * force });
    }
  }
  return forces;
}

}  // namespace cloth_tearing

PLUGINLIB_EXPORT_CLASS(cloth_tearing::ClothDisplay, rviz::Display)
