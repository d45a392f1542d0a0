// What tools that work on cloth have in common.
#include "cloth_tearing/rviz/cloth_tool.h"

#include <OgreCamera.h>
#include <OgreViewport.h>

namespace cloth_tearing
{

View viewOf(Ogre::Viewport& viewport)
{
  const Ogre::Camera& camera = *viewport.getCamera();
  const Ogre::Vector3 position = camera.getDerivedPosition();
  const Ogre::Quaternion rotation = camera.getDerivedOrientation();
  const Ogre::Matrix4& projection = camera.getProjectionMatrix();
  View view;
  view.camera.position = cloth::Vec3d(position.x, position.y, position.z);
  view.camera.rotation = cloth::Quatd(rotation.w, rotation.x, rotation.y, rotation.z).normalized();
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      view.projection(row, column) = projection[row][column];
    }
  }
  return view;
}

cloth::Vec2d placeIn(const Ogre::Viewport& viewport, int x, int y)
{
  return { 2.0 * (x + 0.5) / viewport.getActualWidth() - 1.0,
           1.0 - 2.0 * (y + 0.5) / viewport.getActualHeight() };
}

void ClothTool::onInitialize()
{
  camera_.initialize(context_);
}

int ClothTool::processKeyEvent(QKeyEvent* event, rviz::RenderPanel* panel)
{
  return camera_.processKeyEvent(event, panel);
}

int ClothTool::moveCamera(const rviz::ViewportMouseEvent& event, bool without_left)
{
  rviz::ViewportMouseEvent passed = event;
  if (without_left)
  {
    passed.buttons_down &= ~Qt::LeftButton;
  }
  const int flags = camera_.processMouseEvent(passed);
  setCursor(camera_.getCursor());
  return flags;
}

Ray ClothTool::sightOf(const rviz::ViewportMouseEvent& event)
{
  return viewOf(*event.viewport).through(placeIn(*event.viewport, event.x, event.y));
}

bool ClothTool::leftPressed(const rviz::ViewportMouseEvent& event)
{
  return event.acting_button == Qt::LeftButton &&
         (event.type == QEvent::MouseButtonPress || event.type == QEvent::MouseButtonDblClick);
}

}  // namespace cloth_tearing
