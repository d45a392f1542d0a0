// Arrows for the forces that the cloth exerts on grippers.
#include "cloth_tearing/rviz/force_arrows.h"

#include <algorithm>

namespace cloth_tearing
{

namespace
{

constexpr float LEAST_LENGTH = 1e-4F;     // of a drawn arrow [m]
constexpr float MOST_LENGTH = 1e4F;       // likewise
constexpr float SHAFT_DIAMETER = 0.008F;  // [m]
constexpr float HEAD_DIAMETER = 0.022F;   // [m]
constexpr float HEAD_LENGTH = 0.035F;     // at most half of the arrow [m]

}  // namespace

ForceArrows::ForceArrows(Ogre::SceneManager* scene, Ogre::SceneNode* parent)
    : scene_(scene), parent_(parent)
{
}

void ForceArrows::draw(const std::vector<Force>& forces, float scale,
                       const Ogre::ColourValue& color)
{
  std::size_t drawn = 0;
  for (const Force& force : forces)
  {
    const float length = std::min(scale * force.force.length(), MOST_LENGTH);
    if (length < LEAST_LENGTH)
    {
      continue;
    }
    if (drawn == arrows_.size())
    {
      arrows_.push_back(std::make_unique<rviz::Arrow>(scene_, parent_));
    }
    rviz::Arrow& arrow = *arrows_[drawn++];
    const float head = std::min(HEAD_LENGTH, 0.5F * length);
    arrow.set(length - head, SHAFT_DIAMETER, head, HEAD_DIAMETER);
    arrow.setPosition(force.position);
    arrow.setDirection(force.force);
    arrow.setColor(color);
  }
  arrows_.resize(drawn);
}

}  // namespace cloth_tearing
