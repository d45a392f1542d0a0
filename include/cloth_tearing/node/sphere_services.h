// Requests that put spheres where the cloth may strike them.
#pragma once

#include <ros/subscriber.h>

#include <vector>

#include "cloth_tearing/node/request_server.h"

namespace cloth_tearing
{

/// ~spheres and ~throw_sphere.
class SphereServices
{
public:
  explicit SphereServices(const NodeContext& context);

private:
  void onThrowSphere(const ThrowSphere::Request& request, ThrowSphere::Response& response);
  void onSpheres(const CollisionSpheres::ConstPtr& message);
  std::vector<cloth::Sphere> placed(const CollisionSpheres& message) const;

  NodeContext context_;
  ros::Subscriber spheres_;
};

}  // namespace cloth_tearing
