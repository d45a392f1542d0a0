// Goes through the unfolded cloth round a spring and averages its stretch.
#include "cloth_tearing/core/patch_strain.h"

#include <algorithm>
#include <cmath>

namespace cloth
{
namespace
{

/// The next number that marks nothing yet.
template <class Unmark>
void next(unsigned& number, const Unmark& unmark)
{
  if (++number == 0)
  {
    unmark();
    number = 1;
  }
}

}  // namespace

void PatchStrain::moved()
{
  next(moment_, [this] { stretch_.assign(stretch_.size(), {}); });
}

double PatchStrain::read(const Cloth& cloth, SpringId s, double radius)
{
  moved();
  return readStill(cloth, s, radius);
}

double PatchStrain::readStill(const Cloth& cloth, SpringId s, double radius)
{
  const double own = cloth.strain(s);
  if (!(radius > 0.0))
  {
    return own;
  }
  if (seen_ != cloth.damage.tears)
  {
    unfolding_.forget();
    seen_ = cloth.damage.tears;
  }
  next(reading_, [this] { reached_.assign(reached_.size(), 0); });
  weight_ = 0.0;
  weighted_squared_stretch_ = 0.0;
  open_.clear();
  lay(cloth, s);
  for (std::size_t i = 0; i < open_.size(); ++i)
  {
    const Laid laid = open_[i];
    add(cloth, laid, radius * radius);
  }
  return weight_ > 0.0 ? std::min(own, std::sqrt(weighted_squared_stretch_ / weight_) - 1.0) : own;
}

void PatchStrain::follow(const Cloth& cloth, const std::vector<TriangleId>& touched)
{
  if (seen_ + 1 == cloth.damage.tears)
  {
    unfolding_.follow(cloth.mesh, touched);
    seen_ = cloth.damage.tears;
  }
}

/// Begins with the triangles of the spring: its middle is the centre of the disc.
void PatchStrain::lay(const Cloth& cloth, SpringId s)
{
  const Spring& spring = cloth.mesh.spring(s);
  const double length = cloth.rest.length[s.index];
  for (TriangleId id : spring.triangles)
  {
    if (id.valid())
    {
      const Triangle& t = cloth.mesh.triangle(id);
      const int side = t.sideOf(s);
      const double way = t.particles[side] == spring.particles[0] ? 1.0 : -1.0;
      const int index = unfolding_.indexOf(cloth.mesh, id);
      const auto& corners = unfolding_.at(cloth.mesh, cloth.rest, index).corners;
      const Vec2d along = way / length * (corners[(side + 1) % 3] - corners[side]);
      const Vec2d turn(along.x(), -along.y());
      const Vec2d begin(-0.5 * way * length, 0.0);
      open({ index, turn, begin - turnedBy(turn, corners[side]) });
    }
  }
}

void PatchStrain::open(const Laid& laid)
{
  if (laid.index >= static_cast<int>(reached_.size()))
  {
    reached_.resize(unfolding_.size(), 0);
    stretch_.resize(unfolding_.size());
  }
  if (reached_[laid.index] != reading_)
  {
    reached_[laid.index] = reading_;
    open_.push_back(laid);
  }
}

void PatchStrain::add(const Cloth& cloth, const Laid& laid, double squared_radius)
{
  const FlatTriangle& flat = unfolding_.at(cloth.mesh, cloth.rest, laid.index);
  const Vec2d center = laid.shift + turnedBy(laid.turn, flat.center);
  const double squared_distance = center.squaredNorm();
  if (squared_distance >= squared_radius)
  {
    return;
  }
  const Stretch& c = stretchOf(cloth, flat, laid.index);
  const double x = laid.turn.x();  // the direction of the spring in the triangle's plane
  const double y = -laid.turn.y();
  const double weight = flat.area * (squared_radius - squared_distance);
  weight_ += weight;
  weighted_squared_stretch_ += weight * (c.xx * x * x + 2.0 * c.xy * x * y + c.yy * y * y);
  for (const FlatTriangle::Across& across : flat.across)
  {
    if (across.index >= 0)
    {
      open({ across.index, turnedBy(laid.turn, across.turn),
             laid.shift + turnedBy(laid.turn, across.shift) });
    }
  }
}

const PatchStrain::Stretch& PatchStrain::stretchOf(const Cloth& cloth, const FlatTriangle& flat,
                                                   int index)
{
  Stretch& stretch = stretch_[index];
  if (stretch.moment == moment_)
  {
    return stretch;
  }
  stretch = {};
  stretch.moment = moment_;
  if (flat.area > 0.0)
  {
    // F maps the flat sides to the sides in space.
    const auto& position = cloth.state.position;
    const Vec3d origin = position[flat.particles[0]].cast<double>();
    const Vec3d side = position[flat.particles[1]].cast<double>() - origin;
    const Vec3d other = position[flat.particles[2]].cast<double>() - origin;
    const Vec2d& apex = flat.corners[2];
    const Vec3d along_x = side / flat.corners[1].x();
    const Vec3d along_y = (other - apex.x() * along_x) / apex.y();
    stretch.xx = along_x.squaredNorm();
    stretch.xy = along_x.dot(along_y);
    stretch.yy = along_y.squaredNorm();
  }
  return stretch;
}

}  // namespace cloth
