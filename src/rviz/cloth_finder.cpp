// Finds the cloths that rviz shows, and the one under the pointer.
#include "cloth_tearing/rviz/cloth_finder.h"

#include <rviz/display_group.h>

namespace cloth_tearing
{

namespace
{

void collect(const rviz::DisplayGroup& group, std::vector<const ClothDisplay*>& found)
{
  for (int i = 0; i < group.numDisplays(); ++i)
  {
    const rviz::Display* display = group.getDisplayAt(i);
    if (!display->isEnabled())
    {
      continue;
    }
    if (const auto* below = dynamic_cast<const rviz::DisplayGroup*>(display))
    {
      collect(*below, found);
    }
    else if (const auto* cloth = dynamic_cast<const ClothDisplay*>(display))
    {
      found.push_back(cloth);
    }
  }
}

}  // namespace

std::vector<const ClothDisplay*> enabledCloths(const rviz::DisplayContext& context)
{
  std::vector<const ClothDisplay*> found;
  collect(*context.getRootDisplayGroup(), found);
  return found;
}

std::optional<PickedCloth> pickCloth(const rviz::DisplayContext& context, const Ray& ray)
{
  std::optional<PickedCloth> nearest;
  for (const ClothDisplay* cloth : enabledCloths(context))
  {
    const std::optional<double> distance = cloth->pick(ray);
    if (distance && (!nearest || *distance < nearest->distance))
    {
      nearest = PickedCloth{ cloth->clothNode(), *distance, ray.at(*distance) };
    }
  }
  return nearest;
}

}  // namespace cloth_tearing
