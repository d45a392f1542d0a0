// Finds the particles that are named, judges them, then pins or frees them.
#include "cloth_tearing/core/pin_commands.h"

#include <algorithm>
#include <limits>
#include <string>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/refusal.h"

namespace cloth
{
namespace
{

/// The particles within the ball, but those at rest.
/// @throws Refusal if there are none
std::vector<int> withinBall(const Cloth& cloth, const PinRequest& request)
{
  std::vector<int> inside;
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < cloth.state.size(); ++i)
  {
    if (!cloth.damage.at_rest[i])
    {
      const double distance = (cloth.state.position[i].cast<double>() - request.point).norm();
      nearest = std::min(nearest, distance);
      if (distance <= request.radius)
      {
        inside.push_back(i);
      }
    }
  }
  if (inside.empty())
  {
    throw Refusal("there is no particle within " + text(request.radius) +
                  " m (radius) of the point; the nearest is " + text(nearest) + " m away");
  }
  return inside;
}

/// What `request` names, ascending, each once.
std::vector<int> named(const Cloth& cloth, const PinRequest& request)
{
  std::vector<std::string> found;
  check(found, "point [m]", request.point, MAX_COORDINATE);
  check(found, "radius [m]", request.radius, Range::between(0.0, MAX_COORDINATE));
  if (request.particles.size() > MAX_NAMED_PARTICLES)
  {
    found.push_back("there are " + std::to_string(request.particles.size()) +
                    " particles, must be at most " + std::to_string(MAX_NAMED_PARTICLES));
  }
  refuseIf(found);
  if (request.radius == 0.0 && request.particles.empty())
  {
    throw Refusal("radius [m] is 0 and particles is empty: name a ball or particles");
  }
  std::vector<int> particles = request.particles;
  std::sort(particles.begin(), particles.end());
  for (int p : particles)
  {
    if (p < 0 || p >= cloth.state.size())
    {
      throw Refusal("there is no particle " + std::to_string(p) + ": their ids are 0 to " +
                    std::to_string(cloth.state.size() - 1));
    }
    if (cloth.damage.at_rest[p])
    {
      throw Refusal("particle " + std::to_string(p) +
                    " is at rest: its piece of cloth has left the bounds");
    }
  }
  if (request.radius > 0.0)
  {
    const std::vector<int> inside = withinBall(cloth, request);
    particles.insert(particles.end(), inside.begin(), inside.end());
    std::sort(particles.begin(), particles.end());
  }
  particles.erase(std::unique(particles.begin(), particles.end()), particles.end());
  return particles;
}

}  // namespace

int pin(Cloth& cloth, const PinRequest& request)
{
  const std::vector<int> particles = named(cloth, request);
  for (int p : particles)
  {
    const Attachment& attachment = cloth.attachments[p];
    if (attachment.kind == Attachment::Kind::GRASP)
    {
      throw Refusal("particle " + std::to_string(p) + " is held by grasp " +
                    std::to_string(attachment.grasp) + ": release that first");
    }
  }
  int changed = 0;
  for (int p : particles)
  {
    if (!cloth.attachments[p].pinned())
    {
      cloth.attach({ p }, { Attachment::Kind::PIN, 0 });
      ++changed;
    }
  }
  return changed;
}

int unpin(Cloth& cloth, const PinRequest& request)
{
  int changed = 0;
  for (int p : named(cloth, request))
  {
    if (cloth.attachments[p].pinned())
    {
      cloth.attach({ p }, {});
      ++changed;
    }
  }
  return changed;
}

}  // namespace cloth
