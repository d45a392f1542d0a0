// Arrows for the forces that the cloth exerts on grippers.
#pragma once

#include <OgreColourValue.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <rviz/ogre_helpers/arrow.h>

#include <memory>
#include <vector>

namespace cloth_tearing
{

class ForceArrows
{
public:
  struct Force
  {
    Ogre::Vector3 position;  ///< where it acts [m], fixed frame
    Ogre::Vector3 force;     ///< [N], fixed frame
  };

  ForceArrows(Ogre::SceneManager* scene, Ogre::SceneNode* parent);

  /// Shows an arrow for each force, none for one that is too small to have a direction.
  ///
  /// @param scale length of an arrow [m/N]
  void draw(const std::vector<Force>& forces, float scale, const Ogre::ColourValue& color);

private:
  Ogre::SceneManager* scene_;
  Ogre::SceneNode* parent_;
  std::vector<std::unique_ptr<rviz::Arrow>> arrows_;
};

}  // namespace cloth_tearing
