// How the rviz display draws a cloth.
#pragma once

#include <OgreColourValue.h>

#include <array>

namespace cloth_tearing
{

/// Lines or points that can be switched off.
struct StrokeStyle
{
  bool shown = true;
  float size = 0.0F;  ///< width of lines, diameter of points [m]
  Ogre::ColourValue color;
};

/// As the display's properties have it.
struct ClothStyle
{
  enum class Coloring
  {
    TEXTURE,
    STRAIN,
    PLAIN
  };

  Coloring coloring = Coloring::TEXTURE;
  bool smooth_image = true;  ///< from afar; costs time where no graphics card does it
  std::array<float, 2> strain_range = { { 0.0F, 0.2F } };  ///< from blue to red [-]
  Ogre::ColourValue plain_color;
  bool wireframe = false;
  Ogre::ColourValue wireframe_color;  ///< blended by its alpha
  StrokeStyle torn_edges;
  StrokeStyle weak_points;
  StrokeStyle held;                ///< of grasped particles
  Ogre::ColourValue pinned_color;  ///< of pinned ones
};

}  // namespace cloth_tearing
