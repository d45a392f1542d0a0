// Finds the particles that a model is pinned by.
#include "cloth_tearing/core/pins.h"

#include <algorithm>
#include <limits>
#include <set>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/refusal.h"

namespace cloth
{
namespace
{

/// How near to the extreme coordinate counts as the edge, as a fraction of the extent.
constexpr double EDGE_FRACTION = 0.01;

void pinEdge(const ClothModel& model, const std::string& edge, std::set<int>& pinned)
{
  const int axis = edge == "left" || edge == "right" ? 0 : 1;
  const bool greatest = edge == "top" || edge == "right";
  double least = std::numeric_limits<double>::max();
  double most = std::numeric_limits<double>::lowest();
  for (const Vec3d& x : model.positions)
  {
    least = std::min(least, x[axis]);
    most = std::max(most, x[axis]);
  }
  const double margin = EDGE_FRACTION * (most - least);
  for (std::size_t i = 0; i < model.positions.size(); ++i)
  {
    const double x = model.positions[i][axis];
    if (greatest ? x >= most - margin : x <= least + margin)
    {
      pinned.insert(static_cast<int>(i));
    }
  }
}

/// @return whether there were any
bool pinRegion(const ClothModel& model, const PinParams::Region& region, std::set<int>& pinned)
{
  bool any = false;
  for (std::size_t i = 0; i < model.positions.size(); ++i)
  {
    if ((model.positions[i] - region.center).squaredNorm() <= region.radius * region.radius)
    {
      pinned.insert(static_cast<int>(i));
      any = true;
    }
  }
  return any;
}

std::vector<std::string> problems(const PinParams::Region& region)
{
  std::vector<std::string> found;
  check(found, "pin region center [m]", region.center, MAX_COORDINATE);
  check(found, "pin region radius [m]", region.radius, Range::aboveUpTo(0.0, MAX_COORDINATE));
  return found;
}

bool isEdge(const std::string& name)
{
  return name == "top" || name == "bottom" || name == "left" || name == "right";
}

}  // namespace

std::vector<std::string> problems(const PinParams& pins)
{
  std::vector<std::string> found;
  for (const std::string& edge : pins.edges)
  {
    if (!isEdge(edge))
    {
      found.push_back("pin edge \"" + edge + "\" is not one of top, bottom, left, right");
    }
  }
  for (const PinParams::Region& region : pins.regions)
  {
    const std::vector<std::string> wrong = problems(region);
    found.insert(found.end(), wrong.begin(), wrong.end());
  }
  for (int particle : pins.particles)
  {
    if (particle < 0)
    {
      found.push_back("pinned particle " + std::to_string(particle) + " must be at least 0");
    }
  }
  return found;
}

std::vector<int> pinnedParticles(const ClothModel& model, const PinParams& pins)
{
  std::vector<std::string> found = problems(pins);
  std::set<int> pinned;
  for (const std::string& edge : pins.edges)
  {
    if (isEdge(edge))
    {
      pinEdge(model, edge, pinned);
    }
  }
  for (const PinParams::Region& region : pins.regions)
  {
    if (problems(region).empty() && !pinRegion(model, region, pinned))
    {
      found.push_back("pin region at (" + text(region.center.x()) + ", " + text(region.center.y()) +
                      ", " + text(region.center.z()) + ") with radius " + text(region.radius) +
                      " m holds no particle of the model");
    }
  }
  for (int particle : pins.particles)
  {
    if (particle >= static_cast<int>(model.positions.size()))
    {
      found.push_back("pinned particle " + std::to_string(particle) +
                      " does not exist: the model has " + std::to_string(model.positions.size()));
      continue;
    }
    pinned.insert(particle);
  }
  refuseIf(found);
  return { pinned.begin(), pinned.end() };
}

}  // namespace cloth
