// Requests that put spheres where the cloth may strike them.
#pragma once

#include <mutex>
#include <optional>
#include <vector>

#include "cloth_tearing/node/request_server.h"

namespace cloth_tearing
{

/// ~spheres and ~throw_sphere.
class SphereServices
{
public:
  explicit SphereServices(const NodeContext& context);

  /// For others who ask for the same, from any thread but the loop's.
  /// @throws std::exception with the reason of a refusal
  void throwSphere(const ThrowSphere::Request& request, ThrowSphere::Response& response);

private:
  void setSpheres(const CollisionSpheres& message);
  std::vector<cloth::Sphere> placed(const CollisionSpheres& message) const;
  void handOver(std::vector<cloth::Sphere> spheres);
  std::optional<std::vector<cloth::Sphere>> takeNext();

  NodeContext context_;
  std::mutex mutex_;
  std::optional<std::vector<cloth::Sphere>> next_;  ///< the loop has not taken; guarded by mutex_
  ros::Subscriber subscriber_;
};

}  // namespace cloth_tearing
