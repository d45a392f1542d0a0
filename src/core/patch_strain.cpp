// Unfolds the cloth round a spring and averages its stretch.
#include "cloth_tearing/core/patch_strain.h"

#include <algorithm>
#include <cmath>

namespace cloth
{
namespace
{

/// The flat place of the corner after side `from`-`to` of a triangle, which lies to its left.
Vec2d layApex(const RestShape& rest, const Triangle& t, int side, const Vec2d& from,
              const Vec2d& to)
{
  const double length = rest.length[t.springs[side].index];
  const Vec2d place = apexOnPlane(length, rest.length[t.springs[(side + 2) % 3].index],
                                  rest.length[t.springs[(side + 1) % 3].index]);
  const Vec2d along = (to - from) / length;
  const Vec2d left(-along.y(), along.x());
  return from + place.x() * along + place.y() * left;
}

}  // namespace

bool PatchStrain::visit(TriangleId t)
{
  const bool first = visited_[t.index] != reading_;
  visited_[t.index] = reading_;
  return first;
}

double PatchStrain::read(const Cloth& cloth, SpringId s, double radius)
{
  const double own = cloth.strain(s);
  if (!(radius > 0.0))
  {
    return own;
  }
  visited_.resize(cloth.mesh.triangleCount(), 0);
  if (++reading_ == 0)
  {
    std::fill(visited_.begin(), visited_.end(), 0);
    reading_ = 1;
  }
  weight_ = 0.0;
  weighted_squared_stretch_ = 0.0;
  open_.clear();

  const Spring& spring = cloth.mesh.spring(s);
  const Vec2d half(0.5 * cloth.rest.length[s.index], 0.0);
  for (TriangleId t : spring.triangles)
  {
    if (t.valid())
    {
      const Triangle& triangle = cloth.mesh.triangle(t);
      const int side = triangle.sideOf(s);
      const bool forward = triangle.particles[side] == spring.particles[0];
      visit(t);
      open_.push_back({ t, side, forward ? Vec2d(-half) : half, forward ? half : Vec2d(-half) });
    }
  }
  for (std::size_t i = 0; i < open_.size(); ++i)
  {
    const Laid laid = open_[i];
    add(cloth, laid, radius * radius);
  }
  return weight_ > 0.0 ? std::min(own, std::sqrt(weighted_squared_stretch_ / weight_) - 1.0) : own;
}

void PatchStrain::add(const Cloth& cloth, const Laid& laid, double squared_radius)
{
  const Triangle& t = cloth.mesh.triangle(laid.triangle);
  const int k = laid.side;
  std::array<Vec2d, 3> flat;
  flat[k] = laid.from;
  flat[(k + 1) % 3] = laid.to;
  flat[(k + 2) % 3] = layApex(cloth.rest, t, k, laid.from, laid.to);
  const double squared_distance = ((flat[0] + flat[1] + flat[2]) / 3.0).squaredNorm();
  if (squared_distance >= squared_radius)
  {
    return;
  }

  // F maps the flat sides to the sides in space; the spring runs along x, so C_xx = |F x|^2.
  const Vec2d u = flat[1] - flat[0];
  const Vec2d v = flat[2] - flat[0];
  const double determinant = u.x() * v.y() - u.y() * v.x();
  if (determinant > 0.0)
  {
    const auto& position = cloth.state.position;
    const Vec3d origin = position[t.particles[0].index].cast<double>();
    const Vec3d along_u = position[t.particles[1].index].cast<double>() - origin;
    const Vec3d along_v = position[t.particles[2].index].cast<double>() - origin;
    const Vec3d stretched = (v.y() * along_u - u.y() * along_v) / determinant;
    const double weight =
        cloth.rest.area[laid.triangle.index] * (1.0 - squared_distance / squared_radius);
    weight_ += weight;
    weighted_squared_stretch_ += weight * stretched.squaredNorm();
  }

  for (int side : { (k + 1) % 3, (k + 2) % 3 })
  {
    const Spring& spring = cloth.mesh.spring(t.springs[side]);
    const TriangleId across =
        spring.triangles[0] == laid.triangle ? spring.triangles[1] : spring.triangles[0];
    if (across.valid() && visit(across))
    {
      const int there = cloth.mesh.triangle(across).sideOf(t.springs[side]);
      open_.push_back({ across, there, flat[(side + 1) % 3], flat[side] });
    }
  }
}

}  // namespace cloth
