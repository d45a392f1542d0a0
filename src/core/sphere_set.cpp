// Sets, moves on and throws spheres.
#include "cloth_tearing/core/sphere_set.h"

#include <algorithm>
#include <string>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/refusal.h"

namespace cloth
{
namespace
{

/// Thrown spheres wait until there are fewer, streamed ones included.
constexpr std::size_t MOST_SPHERES = 1000;

/// A streamed sphere takes no longer than this to where it is placed [s].
constexpr double LONGEST_GLIDE = 0.1;

}  // namespace

void SphereSet::set(const std::vector<Sphere>& spheres, const ContactParams& params,
                    double time_step)
{
  std::vector<std::string> found;
  for (std::size_t i = 0; i < spheres.size(); ++i)
  {
    const std::vector<std::string> more = problems(spheres[i]);
    found.insert(found.end(), more.begin(), more.end());
    for (std::size_t j = 0; j < i; ++j)
    {
      if (spheres[j].id == spheres[i].id)
      {
        found.push_back("sphere " + std::to_string(spheres[i].id) + " is there twice");
      }
    }
  }
  refuseIf(found);

  std::vector<Sphere> next;
  for (const Sphere& sphere : spheres_)
  {
    if (sphere.source == SphereSource::THROWN)
    {
      next.push_back(sphere);
    }
  }
  for (const Sphere& set : spheres)
  {
    next.push_back(streamed(set, params, time_step));
  }
  spheres_ = std::move(next);
}

Sphere SphereSet::streamed(const Sphere& set, const ContactParams& params, double time_step) const
{
  Sphere sphere = set;
  sphere.source = SphereSource::STREAMED;
  sphere.time_left = params.sphere_timeout;
  sphere.jump = Vec3d::Zero();
  sphere.jump_time = 0.0;
  sphere.age = 0.0;
  sphere.fresh = true;
  sphere.out = Vec3d::Zero();
  const auto known = std::find_if(spheres_.begin(), spheres_.end(),
                                  [&](const Sphere& s)
                                  { return s.source == SphereSource::STREAMED && s.id == set.id; });
  if (known != spheres_.end())
  {
    // It goes there in the time since it was last heard of, unless that is no motion any more.
    const Vec3d jump = set.center - known->center;
    const double time = std::max(known->age, time_step);
    if (jump.norm() <= params.max_sphere_speed * time)
    {
      sphere.center = known->center;
      sphere.fresh = known->fresh;
      sphere.out = known->out;
      sphere.jump = jump;
      sphere.jump_time = std::min(time, LONGEST_GLIDE);
    }
  }
  return sphere;
}

std::uint64_t SphereSet::throwOne(const ThrowRequest& request)
{
  Sphere sphere;
  sphere.source = SphereSource::THROWN;
  sphere.id = next_thrown_;
  sphere.center = request.center;
  sphere.velocity = request.velocity;
  sphere.radius = request.radius;
  sphere.mass = request.mass;
  sphere.time_left = request.lifetime;
  std::vector<std::string> found = problems(sphere);
  check(found, "lifetime [s]", request.lifetime, Range::aboveUpTo(0.0, 1e6));
  if (spheres_.size() >= MOST_SPHERES)
  {
    found.push_back("there are " + std::to_string(spheres_.size()) +
                    " spheres, must be less than " + std::to_string(MOST_SPHERES) +
                    " for one to be thrown");
  }
  refuseIf(found);
  spheres_.push_back(sphere);
  return next_thrown_++;
}

}  // namespace cloth
