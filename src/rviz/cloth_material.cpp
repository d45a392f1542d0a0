// What the cloth's triangles look like to OGRE.
#include "cloth_tearing/rviz/cloth_material.h"

#include <OgreMaterialManager.h>
#include <OgreResourceGroupManager.h>
#include <OgreTechnique.h>
#include <OgreTextureManager.h>
#include <OgreTextureUnitState.h>

#include "cloth_tearing/rviz/cloth_texture.h"

namespace cloth_tearing
{

namespace
{

// rviz lights the scene with a lamp at the camera alone: some light of its own keeps what the
// camera sees at a low angle from being black.
constexpr float FROM_EVERYWHERE = 0.35F;
constexpr float FROM_CAMERA = 0.70F;

std::string newName()
{
  static int count = 0;
  return "cloth_tearing/Cloth" + std::to_string(count++);
}

Ogre::ColourValue dimmed(const Ogre::ColourValue& color, float light)
{
  return Ogre::ColourValue(color.r * light, color.g * light, color.b * light, color.a);
}

}  // namespace

ClothMaterial::ClothMaterial() : name_(newName())
{
  material_ = Ogre::MaterialManager::getSingleton().create(
      name_, Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
  material_->setReceiveShadows(false);
  surface_ = material_->getTechnique(0)->getPass(0);
  surface_->setCullingMode(Ogre::CULL_CLOCKWISE);  // the back has triangles of its own
  strain_ = makeTexture(name_ + "/strain", strainImage());
  setStyle(style_);
}

ClothMaterial::~ClothMaterial()
{
  forgetImage();
  Ogre::TextureManager::getSingleton().remove(strain_->getHandle());
  Ogre::MaterialManager::getSingleton().remove(material_->getHandle());
}

void ClothMaterial::forgetImage()
{
  if (has_image_)
  {
    Ogre::TextureManager::getSingleton().remove(image_->getHandle());
    has_image_ = false;
  }
}

void ClothMaterial::setImage(const QImage& image)
{
  surface_->removeAllTextureUnitStates();
  forgetImage();
  if (!image.isNull())
  {
    image_ = makeTexture(name_ + "/image" + std::to_string(images_++), image);
    has_image_ = true;
  }
  setStyle(style_);
}

void ClothMaterial::setStyle(const ClothStyle& style)
{
  style_ = style;
  paint(style);
  drawWires(style);
}

void ClothMaterial::paint(const ClothStyle& style)
{
  surface_->removeAllTextureUnitStates();
  const bool strain = style.coloring == ClothStyle::Coloring::STRAIN;
  const bool image = style.coloring == ClothStyle::Coloring::TEXTURE && has_image_;
  Ogre::ColourValue color = style.plain_color;
  if (strain || image)
  {
    color = Ogre::ColourValue::White;
    Ogre::TextureUnitState* unit =
        surface_->createTextureUnitState((strain ? strain_ : image_)->getName());
    unit->setTextureAddressingMode(strain ? Ogre::TextureUnitState::TAM_CLAMP
                                          : Ogre::TextureUnitState::TAM_WRAP);
    unit->setTextureFiltering(Ogre::FO_LINEAR, Ogre::FO_LINEAR,
                              image && style.smooth_image ? Ogre::FO_LINEAR : Ogre::FO_NONE);
  }
  surface_->setAmbient(Ogre::ColourValue::Black);
  surface_->setSelfIllumination(dimmed(color, FROM_EVERYWHERE));
  surface_->setDiffuse(dimmed(color, FROM_CAMERA));
}

void ClothMaterial::drawWires(const ClothStyle& style)
{
  Ogre::Technique* technique = material_->getTechnique(0);
  if (technique->getNumPasses() > 1)
  {
    technique->removePass(1);
  }
  if (!style.wireframe)
  {
    return;
  }
  Ogre::Pass* wires = technique->createPass();
  wires->setPolygonMode(Ogre::PM_WIREFRAME);
  wires->setCullingMode(Ogre::CULL_CLOCKWISE);
  wires->setDepthBias(1.0F, 1.0F);  // before the triangles that they bound
  wires->setAmbient(Ogre::ColourValue::Black);
  wires->setDiffuse(0.0F, 0.0F, 0.0F, style.wireframe_color.a);
  wires->setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
  wires->setDepthWriteEnabled(false);
  wires->setSelfIllumination(style.wireframe_color);  // the same in any light
}

}  // namespace cloth_tearing
