// Sets, moves on and throws spheres.
#include "cloth_tearing/core/sphere_set.h"

#include <algorithm>
#include <string>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/grasp.h"
#include "cloth_tearing/core/refusal.h"

namespace cloth
{
namespace
{

/// Lets a sphere go to `center` [m] in `time` [s], unless that is no motion any more: then it is
/// placed there anew.
void send(Sphere& sphere, const Vec3d& center, double time, const ContactParams& params)
{
  const Vec3d jump = center - sphere.center;
  const bool motion = jump.norm() <= params.max_sphere_speed * time;
  sphere.jump = motion ? jump : Vec3d(Vec3d::Zero());
  sphere.jump_time = motion ? std::min(time, LONGEST_GLIDE) : 0.0;
  if (!motion)
  {
    sphere.center = center;
    sphere.fresh = true;
    sphere.out = Vec3d::Zero();
  }
}

std::string nameOf(SphereSource source, std::uint64_t id)
{
  return (source == SphereSource::THROWN ? "thrown sphere " : "sphere ") + std::to_string(id);
}

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
  const auto known = seek(SphereSource::STREAMED, set.id);
  if (known != spheres_.end())
  {
    sphere.center = known->center;
    sphere.fresh = known->fresh;
    sphere.out = known->out;
    send(sphere, set.center, std::max(known->age, time_step), params);
  }
  return sphere;
}

std::vector<Sphere>::const_iterator SphereSet::seek(SphereSource source, std::uint64_t id) const
{
  return std::find_if(spheres_.begin(), spheres_.end(),
                      [source, id](const Sphere& s) { return s.source == source && s.id == id; });
}

std::size_t SphereSet::count(SphereSource source) const
{
  return static_cast<std::size_t>(std::count_if(spheres_.begin(), spheres_.end(),
                                                [source](const Sphere& sphere)
                                                { return sphere.source == source; }));
}

const Sphere& SphereSet::find(SphereSource source, std::uint64_t id) const
{
  const auto found = seek(source, id);
  if (found == spheres_.end())
  {
    throw Refusal("there is no " + nameOf(source, id));
  }
  return *found;
}

Sphere& SphereSet::known(SphereSource source, std::uint64_t id)
{
  return const_cast<Sphere&>(find(source, id));
}

void SphereSet::moveTo(std::uint64_t id, const Vec3d& center, double time,
                       const ContactParams& params, double time_step)
{
  Sphere& sphere = known(SphereSource::STREAMED, id);
  std::vector<std::string> found;
  check(found, "sphere " + std::to_string(id) + ": center [m]", center, MAX_COORDINATE);
  check(found, "time [s]", time, Range::between(0.0, 1e6));
  refuseIf(found);
  sphere.age = 0.0;
  sphere.time_left = params.sphere_timeout;
  send(sphere, center, std::max(time, time_step), params);
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
  check(found, "lifetime [s]", request.lifetime, Range::aboveUpTo(0.0, MAX_LIFETIME));
  refuseIf(found);
  spheres_.push_back(sphere);
  return next_thrown_++;
}

void SphereSet::hold(SphereSource source, std::uint64_t id, const Vec3d& center,
                     const ContactParams& params, double time_step)
{
  Sphere& sphere = known(source, id);
  std::vector<std::string> found;
  check(found, nameOf(source, id) + ": center [m]", center, MAX_COORDINATE);
  if (!sphere.frame.empty())
  {
    found.push_back(nameOf(source, id) + " follows the frame \"" + sphere.frame +
                    "\": nothing else can move it");
  }
  refuseIf(found);
  send(sphere, center, std::max(sphere.age, time_step), params);
  sphere.age = 0.0;
  sphere.caught = true;
}

void SphereSet::letGo(SphereSource source, std::uint64_t id, const ContactParams& params)
{
  Sphere& sphere = known(source, id);
  if (sphere.caught)
  {
    sphere.caught = false;
    sphere.time_left = source == SphereSource::STREAMED ? params.sphere_timeout : sphere.time_left;
  }
}

std::uint64_t SphereSet::throwAgain(SphereSource source, std::uint64_t id, const Vec3d& velocity)
{
  const Sphere& sphere = find(source, id);
  ThrowRequest request;
  request.center = sphere.center;
  request.velocity = velocity;
  request.radius = sphere.radius;
  request.mass = sphere.mass;
  SphereSet after = *this;  // to be refused as a whole
  after.remove(source, id);
  const std::uint64_t thrown = after.throwOne(request);
  *this = std::move(after);
  return thrown;
}

void SphereSet::remove(SphereSource source, std::uint64_t id)
{
  spheres_.erase(spheres_.begin() + (&find(source, id) - spheres_.data()));
}

}  // namespace cloth
