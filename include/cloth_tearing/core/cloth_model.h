// A sheet as it comes from a builder or a file, before it is a mesh: places, faces, texture.
#pragma once

#include <array>
#include <vector>

#include "cloth_tearing/core/types.h"

namespace cloth
{

/// One face of a model.
struct ModelTriangle
{
  std::array<int, 3>
      vertices;  ///< indices into ClothModel::positions, counter-clockwise from the front
  std::array<Vec2d, 3> uv;  ///< texture position at each corner [-]
};

/// Vertices and triangles; faces that name the same vertex index hang together there.
struct ClothModel
{
  std::vector<Vec3d> positions;          ///< [m], model frame
  std::vector<ModelTriangle> triangles;  ///< consistently wound
};

}  // namespace cloth
