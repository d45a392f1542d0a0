// What tools that work on cloth have in common.
#pragma once

#ifndef Q_MOC_RUN
#include <OgreSceneNode.h>
#include <rviz/default_plugin/tools/move_tool.h>
#include <rviz/tool.h>
#include <rviz/viewport_mouse_event.h>

#include <QString>

#include "cloth_tearing/rviz/view_drag.h"
#endif

namespace cloth_tearing
{

/// How the camera of a viewport looks at the scene.
View viewOf(Ogre::Viewport& viewport);

/// Where a pixel of a viewport is in its picture, as View has it.
cloth::Vec2d placeIn(const Ogre::Viewport& viewport, int x, int y);

inline Ogre::Vector3 toOgre(const cloth::Vec3d& x)
{
  return Ogre::Vector3(static_cast<float>(x.x()), static_cast<float>(x.y()),
                       static_cast<float>(x.z()));
}

/// A tool for which the left button acts on the cloth; everything else moves the camera.
class ClothTool : public rviz::Tool
{
protected:
  void onInitialize() override;
  int processKeyEvent(QKeyEvent* event, rviz::RenderPanel* panel) override;

  /// @param without_left as if the left button were up
  int moveCamera(const rviz::ViewportMouseEvent& event, bool without_left);

  static Ray sightOf(const rviz::ViewportMouseEvent& event);

  /// The left button goes down, the second time in short order too.
  static bool leftPressed(const rviz::ViewportMouseEvent& event);

private:
  rviz::MoveTool camera_;
};

}  // namespace cloth_tearing
