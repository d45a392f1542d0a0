// Writes a surface as an OBJ file.
#pragma once

#include <ostream>

#include "cloth_tearing/core/surface.h"

namespace cloth
{

/// Vertices in the order of particle ids, a texture position for each corner of each triangle, so
/// that what tears parted stays parted; numbers as short as they read back the same, whatever the
/// locale. What readObj() makes of it is the same mesh.
/// @param origin of the cloth frame, in the frame that the file is to be in [m]
void writeObj(std::ostream& out, const Surface& surface, const Vec3d& origin = Vec3d::Zero());

}  // namespace cloth
