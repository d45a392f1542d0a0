// The images that the cloth is covered with.
#pragma once

#include <OgreTexture.h>

#include <QColor>
#include <QImage>
#include <string>

namespace cloth_tearing
{

/// Reads an image file; a very large one is made smaller while it is read.
///
/// @param location package://PACKAGE/PATH or an absolute path, as rviz's other displays take them
/// @throws cloth::Refusal that names the place and what is wrong with it
QImage readImage(const std::string& location);

/// The colour at `place`, 0 to 1, of the strain range: blue, white, red.
QColor strainColor(double place);

/// All of them from left to right.
QImage strainImage();

/// Puts an image where the graphics card finds it, with smaller copies of it for the distance.
/// To be removed from the texture manager by who asked for it.
Ogre::TexturePtr makeTexture(const std::string& name, const QImage& image);

}  // namespace cloth_tearing
