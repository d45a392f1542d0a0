// Sets and throws spheres, as requested.
#include "cloth_tearing/node/sphere_services.h"

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "cloth_tearing/core/refusal.h"

namespace cloth_tearing
{

SphereServices::SphereServices(const NodeContext& context) : context_(context)
{
  context_.requests.serve<ThrowSphere>(context_.node, "throw_sphere",
                                       [this](auto& q, auto& a) { throwSphere(q, a); });
  subscriber_ = context_.requests.listen<CollisionSpheres>(
      context_.node, "spheres", 1, [this](const CollisionSpheres& m) { setSpheres(m); });
}

void SphereServices::throwSphere(const ThrowSphere::Request& request,
                                 ThrowSphere::Response& response)
{
  cloth::refuseIf(problems(request));
  const cloth::ThrowRequest wish = toCore(request, context_.frames.toCloth(request.header));
  response.sphere_id = context_.loop.call([&wish](cloth::Simulation& simulation)
                                          { return simulation.throwSphere(wish); });
}

void SphereServices::setSpheres(const CollisionSpheres& message)
{
  cloth::refuseIf(problems(message));
  handOver(placed(message));
}

/// Puts a set where the loop takes it, in place of one that it has not taken yet. Nobody waits: a
/// stream that is faster than the steps would wake the waiting thread each time.
void SphereServices::handOver(std::vector<cloth::Sphere> spheres)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!next_)
  {
    context_.loop.post(
        [this](cloth::Simulation& simulation)
        { context_.requests.hear("spheres", [&] { simulation.setSpheres(*takeNext()); }); });
  }
  next_ = std::move(spheres);
}

std::optional<std::vector<cloth::Sphere>> SphereServices::takeNext()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(next_, std::nullopt);
}

/// All spheres where they are now: each in the frame of its own, or in that of the header.
std::vector<cloth::Sphere> SphereServices::placed(const CollisionSpheres& message) const
{
  std::optional<cloth::Pose> common;  // not asked for if all have frames of their own
  std::map<std::string, cloth::Pose> own;
  std::vector<cloth::Sphere> spheres;
  for (const CollisionSphere& sphere : message.spheres)
  {
    if (sphere.frame.empty())
    {
      common = common ? *common : context_.frames.toCloth(message.header);
      spheres.push_back(toCore(sphere, *common));
      continue;
    }
    if (own.count(sphere.frame) == 0)
    {
      own[sphere.frame] = context_.frames.toCloth(
          sphere.frame, ros::Time(0), "sphere " + std::to_string(sphere.id) + ": frame");
    }
    spheres.push_back(toCore(sphere, own[sphere.frame]));
  }
  return spheres;
}

}  // namespace cloth_tearing
