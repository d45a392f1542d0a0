// What the cloth's triangles look like to OGRE.
#pragma once

#include <OgreMaterial.h>
#include <OgrePass.h>
#include <OgreTexture.h>

#include <QImage>
#include <string>

#include "cloth_tearing/rviz/cloth_style.h"

namespace cloth_tearing
{

/// A lit material with an image, the colours of strain or one colour, and a wireframe over it.
class ClothMaterial
{
public:
  ClothMaterial();
  ~ClothMaterial();
  ClothMaterial(const ClothMaterial&) = delete;
  ClothMaterial& operator=(const ClothMaterial&) = delete;

  const Ogre::MaterialPtr& get() const { return material_; }

  /// The image for Coloring::TEXTURE; an empty one stands for the plain colour.
  void setImage(const QImage& image);

  void setStyle(const ClothStyle& style);

private:
  void paint(const ClothStyle& style);
  void drawWires(const ClothStyle& style);
  void forgetImage();

  std::string name_;
  Ogre::MaterialPtr material_;
  Ogre::Pass* surface_;
  Ogre::TexturePtr strain_;
  Ogre::TexturePtr image_;
  bool has_image_ = false;
  int images_ = 0;  ///< so far: each gets a name of its own
  ClothStyle style_;
};

}  // namespace cloth_tearing
