// The rviz tool that throws balls at the cloth.
#pragma once

#ifndef Q_MOC_RUN
#include <QString>
#include <map>
#include <optional>
#include <string>

#include "cloth_tearing/rviz/cloth_finder.h"
#include "cloth_tearing/rviz/cloth_tool.h"
#include "cloth_tearing/rviz/service_caller.h"
#endif

namespace rviz
{
class FloatProperty;
}

namespace cloth_tearing
{

/// Left button: a ball is thrown from the camera through the pointer, at the cloth that is there or
/// else at the first one. All else moves the camera.
class ThrowTool : public ClothTool
{
  Q_OBJECT
public:
  ThrowTool();
  ~ThrowTool() override;

  void activate() override;
  void deactivate() override;
  void update(float wall_dt, float ros_dt) override;
  int processMouseEvent(rviz::ViewportMouseEvent& event) override;

private:
  void throwBall(const Ray& sight);
  std::optional<cloth::Vec3d> start(const Ray& sight, const std::optional<PickedCloth>& goal) const;
  double distanceToCloth(const cloth::Vec3d& point) const;
  void tell();

  rviz::FloatProperty* radius_;
  rviz::FloatProperty* speed_;
  rviz::FloatProperty* mass_;
  rviz::FloatProperty* lifetime_;
  std::map<std::string, ServiceCaller> callers_;  ///< by the node: one that hangs hinders no other
  std::string node_;                              ///< of the last ball
  QString note_;                                  ///< of the last ball
  bool pressed_ = false;                          ///< the left button
};

}  // namespace cloth_tearing
