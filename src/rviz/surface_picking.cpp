// Finds where a ray meets a cloth, and how near the cloth comes to a point.
#include "cloth_tearing/rviz/surface_picking.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cloth_tearing
{

namespace
{

using cloth::Vec3d;

/// Particles in the frame of a ray: x and y across it, z along it. Each is moved there once, so
/// that triangles agree on the edge that they share.
std::vector<Vec3d> seenAlong(const Ray& ray, const std::vector<cloth::Vec3>& positions)
{
  const Vec3d across = ray.direction.unitOrthogonal();
  const Vec3d above = ray.direction.cross(across);
  std::vector<Vec3d> seen;
  seen.reserve(positions.size());
  for (const cloth::Vec3& position : positions)
  {
    const Vec3d x = position.cast<double>() - ray.origin;
    seen.emplace_back(x.dot(across), x.dot(above), x.dot(ray.direction));
  }
  return seen;
}

/// On which side of the line from a to b the ray passes, times twice the area of the triangle that
/// they make. Exactly the opposite for the line from b to a.
double sideOf(const Vec3d& a, const Vec3d& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

Vec3d nearestOnSegment(const Vec3d& point, const Vec3d& a, const Vec3d& b)
{
  const Vec3d along = b - a;
  const double length2 = along.squaredNorm();
  const double part = length2 > 0.0 ? (point - a).dot(along) / length2 : 0.0;
  return a + std::clamp(part, 0.0, 1.0) * along;
}

double squaredDistance(const Vec3d& point, const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
  const Vec3d normal = (b - a).cross(c - a);
  const bool above = normal.dot((b - a).cross(point - a)) >= 0.0 &&
                     normal.dot((c - b).cross(point - b)) >= 0.0 &&
                     normal.dot((a - c).cross(point - c)) >= 0.0;
  if (above && normal.squaredNorm() > 0.0)
  {
    const double height = normal.dot(point - a);
    return height * height / normal.squaredNorm();
  }
  return std::min({ (point - nearestOnSegment(point, a, b)).squaredNorm(),
                    (point - nearestOnSegment(point, b, c)).squaredNorm(),
                    (point - nearestOnSegment(point, c, a)).squaredNorm() });
}

}  // namespace

std::optional<double> firstHit(const Ray& ray, const std::vector<cloth::Vec3>& positions,
                               const std::vector<std::uint32_t>& triangles)
{
  const std::vector<Vec3d> seen = seenAlong(ray, positions);
  std::optional<double> nearest;
  for (std::size_t t = 0; t + 3 <= triangles.size(); t += 3)
  {
    const Vec3d& a = seen[triangles[t]];
    const Vec3d& b = seen[triangles[t + 1]];
    const Vec3d& c = seen[triangles[t + 2]];
    const double at_a = sideOf(b, c);
    const double at_b = sideOf(c, a);
    const double at_c = sideOf(a, b);
    const bool inside =
        (at_a >= 0.0 && at_b >= 0.0 && at_c >= 0.0) || (at_a <= 0.0 && at_b <= 0.0 && at_c <= 0.0);
    const double area = at_a + at_b + at_c;
    if (!inside || area == 0.0)
    {
      continue;
    }
    const double distance = (at_a * a.z() + at_b * b.z() + at_c * c.z()) / area;
    if (distance >= 0.0 && (!nearest || distance < *nearest))
    {
      nearest = distance;
    }
  }
  return nearest;
}

double distanceTo(const cloth::Vec3d& point, const std::vector<cloth::Vec3>& positions,
                  const std::vector<std::uint32_t>& triangles)
{
  double nearest2 = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t + 3 <= triangles.size(); t += 3)
  {
    const auto corner = [&](std::size_t k)
    { return Vec3d(positions[triangles[t + k]].cast<double>()); };
    nearest2 = std::min(nearest2, squaredDistance(point, corner(0), corner(1), corner(2)));
  }
  return std::sqrt(nearest2);
}

}  // namespace cloth_tearing
