// What limits may be, and the sentence in which too many are refused.
#include "cloth_tearing/core/limits.h"

#include "cloth_tearing/core/checks.h"

namespace cloth
{

std::vector<std::string> problems(const Limits& limits)
{
  std::vector<std::string> found;
  check(found, "limits/particles", limits.particles, Range::between(1, MAX_PARTICLES));
  check(found, "limits/triangles", limits.triangles, Range::between(1, MAX_TRIANGLES));
  check(found, "limits/spheres", limits.spheres, Range::between(1, MAX_SPHERES));
  check(found, "limits/grasps", limits.grasps, Range::between(1, MAX_GRASPS));
  return found;
}

void checkCount(std::vector<std::string>& found, const std::string& things, std::size_t count,
                const std::string& name, int limit)
{
  if (count > static_cast<std::size_t>(limit))
  {
    found.push_back("there would be " + std::to_string(count) + " " + things +
                    ", must be at most " + name + " = " + std::to_string(limit));
  }
}

}  // namespace cloth
