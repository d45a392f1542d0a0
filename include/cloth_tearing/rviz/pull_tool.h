// The rviz tool that takes the cloth in the hand.
#pragma once

#ifndef Q_MOC_RUN
#include <rviz/ogre_helpers/shape.h>
#include <rviz/render_panel.h>

#include <QPointer>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "cloth_tearing/rviz/cloth_finder.h"
#include "cloth_tearing/rviz/cloth_hold.h"
#include "cloth_tearing/rviz/cloth_tool.h"
#include "cloth_tearing/rviz/view_drag.h"
#endif

namespace rviz
{
class FloatProperty;
}

namespace cloth_tearing
{

/// Left button on a cloth: its node takes hold there, and what it holds follows the pointer in the
/// plane of the picture; with shift, away and towards. Releasing the button lets go, with Ctrl it
/// pins what was held; Escape or another tool let go as well. The wheel over the cloth sets how far
/// around it is held. All else moves the camera.
class PullTool : public ClothTool
{
  Q_OBJECT
public:
  PullTool();
  ~PullTool() override;

  void activate() override;
  void deactivate() override;
  void update(float wall_dt, float ros_dt) override;
  int processMouseEvent(rviz::ViewportMouseEvent& event) override;

protected:
  void onInitialize() override;

private:
  /// A ball around the pointer; none, if it has no middle.
  struct Ball
  {
    std::optional<cloth::Vec3d> middle;  ///< in the fixed frame [m]
    float radius = 0.0F;                 ///< [m]
    bool holding = false;

    bool operator==(const Ball& other) const;
  };

  bool take(const rviz::ViewportMouseEvent& event);
  void lead(const rviz::ViewportMouseEvent& event);
  void letGo(bool pin);
  void followFixedFrame();
  void changeRadius(int wheel_delta);
  std::optional<PickedCloth> underPointer() const;
  Ball ballNow() const;
  void show(const Ball& ball);
  void tell();
  QString words() const;

  rviz::FloatProperty* radius_;
  std::map<std::string, ClothHold>
      holds_;                  ///< by the node; one that does not answer hinders no other
  ClothHold* hold_ = nullptr;  ///< the last one
  QString note_;               ///< more important than what that one tells; empty = none
  ViewDrag drag_;
  bool pressed_ = false;  ///< the left button, on a cloth

  QPointer<rviz::RenderPanel> panel_;  ///< where the pointer was last
  int x_ = 0;
  int y_ = 0;
  bool buttons_ = false;  ///< any of them is down
  std::unique_ptr<rviz::Shape> ball_;
  Ball shown_;
};

}  // namespace cloth_tearing
