// The rviz display that draws ~surface.
#pragma once

#ifndef Q_MOC_RUN
#include <ros/subscriber.h>
#include <rviz/display.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "cloth_tearing/ClothSurface.h"
#include "cloth_tearing/GraspStates.h"
#include "cloth_tearing/SimulationStatus.h"
#include "cloth_tearing/rviz/cloth_visual.h"
#include "cloth_tearing/rviz/force_arrows.h"
#include "cloth_tearing/rviz/strain_legend.h"
#include "cloth_tearing/rviz/surface_mesh.h"
#include "cloth_tearing/rviz/surface_picking.h"
#endif

namespace rviz
{
class BoolProperty;
class ColorProperty;
class EnumProperty;
class FloatProperty;
class RosTopicProperty;
class StringProperty;
}  // namespace rviz

namespace cloth_tearing
{

/// Draws a cloth with its texture or the colours of its strain, what is torn, weak and held, and
/// the forces on grippers, which it reads from grasp_states beside the surface's topic. A message
/// that makes no sense turns the status red and changes nothing.
///
/// The cloth is where its frame is now, also when that moves, or becomes known, after the last
/// message: a cloth at rest sends none. (So no rviz::MessageFilterDisplay, which drops a message
/// whose frame is not known yet.)
class ClothDisplay : public rviz::Display
{
  Q_OBJECT
public:
  ClothDisplay();
  ~ClothDisplay() override;

  void reset() override;
  void setTopic(const QString& topic, const QString& datatype) override;
  void update(float wall_dt, float ros_dt) override;

  /// The namespace of what sends, after remappings: that of its services. Empty without a topic.
  std::string clothNode() const;

  /// How far from its origin a ray of the fixed frame first meets the cloth as it is shown [m];
  /// none if it misses it or there is none.
  std::optional<double> pick(const Ray& ray) const;

  /// From a point of the fixed frame to the cloth as it is shown [m]; infinite if there is none.
  double distanceFrom(const cloth::Vec3d& point) const;

protected:
  void onInitialize() override;
  void onEnable() override;
  void onDisable() override;
  void fixedFrameChanged() override;

private Q_SLOTS:
  void updateTopic();
  void updateStyle();
  void updateImage();
  void updateForces();

private:
  /// A part that can be switched off, with its colour and size.
  struct StrokeProperties
  {
    rviz::BoolProperty* shown;
    rviz::ColorProperty* color;
    rviz::FloatProperty* size;

    StrokeStyle style() const;
  };

  using Clock = std::chrono::steady_clock;

  /// What is known of who sends.
  enum class Source
  {
    SUBSCRIBED,
    SILENT,
    SENDING,
    GONE,
    HANGING  ///< it was heard of before by its status
  };

  void tellImage();
  void addColoring();
  void addParts();
  void addForces();
  StrokeProperties addStroke(const QString& name, const QColor& color, const QString& size_name,
                             float size, const QString& description);
  ClothStyle style() const;

  void subscribe();
  void unsubscribe();
  void takeSurface(const ClothSurface::ConstPtr& message);
  void place();
  std::string placeProblem(const std::string& frame) const;
  void tellPlace(const std::string& problem);
  bool shown() const { return isEnabled() && surface_ && placed_; }
  void refuse(const std::string& reason);
  void watchSource();
  void takeGrasps(const GraspStates::ConstPtr& message);
  void forgetGrasps();
  void takeStatus(const SimulationStatus::ConstPtr& message);
  std::vector<ForceArrows::Force> forcesInFixedFrame() const;

  rviz::RosTopicProperty* topic_;
  rviz::EnumProperty* coloring_;
  rviz::StringProperty* image_;
  rviz::BoolProperty* smooth_image_;
  rviz::FloatProperty* low_strain_;
  rviz::FloatProperty* high_strain_;
  StrainLegend* legend_;
  rviz::ColorProperty* plain_color_;
  rviz::BoolProperty* wireframe_;
  rviz::ColorProperty* wireframe_color_;
  rviz::FloatProperty* wireframe_alpha_;
  StrokeProperties torn_edges_;
  StrokeProperties weak_points_;
  StrokeProperties held_;
  rviz::ColorProperty* pinned_color_;
  rviz::BoolProperty* forces_;
  rviz::ColorProperty* force_color_;
  rviz::FloatProperty* force_scale_;

  std::unique_ptr<ClothVisual> visual_;
  std::unique_ptr<ForceArrows> arrows_;
  SurfaceMesh mesh_;
  ClothSurface::ConstPtr surface_;  ///< that mesh_ has taken; none = nothing is shown
  bool new_triangles_ = true;       ///< since the last drawing
  bool placed_ = false;             ///< its frame is known
  cloth::Pose pose_;                ///< of the message's origin, in the fixed frame
  bool place_told_ = false;         ///< by the status
  bool drawn_ = true;
  std::string image_problem_;  ///< of the texture's image; empty = none
  std::string problem_;        ///< of the last message; empty = none

  ros::Subscriber surface_subscriber_;
  std::uint64_t messages_ = 0;  ///< received since subscribing
  ros::Subscriber grasp_subscriber_;
  GraspStates::ConstPtr grasps_;
  ros::Subscriber status_subscriber_;
  std::optional<Clock::time_point> heard_;  ///< last status; none from sources without one
  Source source_ = Source::SUBSCRIBED;
};

}  // namespace cloth_tearing
