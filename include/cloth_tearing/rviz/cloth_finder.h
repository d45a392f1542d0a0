// Finds the cloths that rviz shows, and the one under the pointer.
#pragma once

#include <rviz/display_context.h>

#include <optional>
#include <string>
#include <vector>

#include "cloth_tearing/core/types.h"
#include "cloth_tearing/rviz/cloth_display.h"

namespace cloth_tearing
{

/// A place on a cloth that is shown.
struct PickedCloth
{
  std::string node;    ///< namespace of its node
  double distance;     ///< from the origin of the ray [m]
  cloth::Vec3d point;  ///< in the fixed frame [m]
};

/// The displays of cloths that are enabled, and so are the groups they stand in; in the order of
/// the Displays panel.
std::vector<const ClothDisplay*> enabledCloths(const rviz::DisplayContext& context);

/// What a ray of the fixed frame meets first; none if it misses every cloth.
std::optional<PickedCloth> pickCloth(const rviz::DisplayContext& context, const Ray& ray);

}  // namespace cloth_tearing
