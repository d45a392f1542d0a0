// Sets and throws spheres, as requested.
#include "cloth_tearing/node/sphere_services.h"

#include <ros/console.h>

#include "cloth_tearing/core/refusal.h"

namespace cloth_tearing
{

namespace
{

constexpr double COMPLAIN_EVERY = 5.0;  // [s], about what comes on a topic

}  // namespace

SphereServices::SphereServices(const NodeContext& context) : context_(context)
{
  context_.requests.serve<ThrowSphere>(context_.node, "throw_sphere",
                                       [this](auto& q, auto& a) { onThrowSphere(q, a); });
  spheres_ = context_.node.subscribe("spheres", 1, &SphereServices::onSpheres, this);
}

void SphereServices::onThrowSphere(const ThrowSphere::Request& request,
                                   ThrowSphere::Response& response)
{
  cloth::refuseIf(problems(request));
  const cloth::ThrowRequest wish = toCore(request, context_.frames.toCloth(request.header));
  response.sphere_id = context_.loop.call([&wish](cloth::Simulation& simulation)
                                          { return simulation.throwSphere(wish); });
}

void SphereServices::onSpheres(const CollisionSpheres::ConstPtr& message)
{
  const std::string reason = context_.requests.refusal(
      "spheres",
      [&]
      {
        cloth::refuseIf(problems(*message));
        std::vector<cloth::Sphere> spheres;
        if (!message->spheres.empty())
        {
          spheres = toCore(*message, context_.frames.toCloth(message->header));
        }
        context_.loop.call([&spheres](cloth::Simulation& simulation)
                           { simulation.setSpheres(spheres); });
        context_.publisher.touch();
      });
  if (!reason.empty())
  {
    ROS_WARN_STREAM_THROTTLE(COMPLAIN_EVERY, "A message on spheres was refused: " << reason);
  }
}

}  // namespace cloth_tearing
