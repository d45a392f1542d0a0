// Moves a point in space as a pointer moves in a picture of it.
#include "cloth_tearing/rviz/view_drag.h"

#include <cmath>

namespace cloth_tearing
{

using cloth::Vec2d;
using cloth::Vec3d;

namespace
{

constexpr double LEAST_DEPTH = 1e-3;  // before the camera, of what can be dragged [m]

}  // namespace

// -- view ----------------------------------------------------------------------------------------

/// The place in the picture of a point (x, y, -1) of the camera's frame is, for each of its
/// coordinates, linear in x or y and divided by 1 with perspective and without.
Ray View::through(const Vec2d& place) const
{
  Vec3d point(0.0, 0.0, -1.0);
  for (int axis = 0; axis < 2; ++axis)
  {
    const double middle = projection(axis, 3) - projection(axis, 2);
    point[axis] = (place[axis] - middle) / projection(axis, axis);
  }
  if (inPerspective())
  {
    return { camera.position, camera.rotation * point.normalized() };
  }
  return { camera.apply(Vec3d(point.x(), point.y(), 0.0)), forward() };
}

Ray View::to(const Vec3d& point) const
{
  if (inPerspective())
  {
    return { camera.position, (point - camera.position).normalized() };
  }
  const double depth = (point - camera.position).dot(forward());
  return { point - depth * forward(), forward() };
}

bool operator==(const View& a, const View& b)
{
  return a.camera.position == b.camera.position &&
         a.camera.rotation.coeffs() == b.camera.rotation.coeffs() && a.projection == b.projection;
}

// -- drag ----------------------------------------------------------------------------------------

void ViewDrag::begin(const View& view, const Vec2d& pointer, const Vec3d& point)
{
  pointer_ = pointer;
  point_ = point;
  anchor(view, Way::ACROSS);
}

void ViewDrag::anchor(const View& view, Way way)
{
  view_ = view;
  way_ = way;
  anchor_ = point_;
  before_camera_ = (anchor_ - view_.camera.position).dot(view_.forward()) > LEAST_DEPTH;
  grip_ = inPlane(pointer_);
}

const Vec3d& ViewDrag::move(const View& view, const Vec2d& pointer, Way way)
{
  if (view != view_ || way != way_)
  {
    anchor(view, way);
  }
  pointer_ = pointer;
  if (!before_camera_)
  {
    return point_;
  }
  const Vec3d moved = inPlane(pointer) - grip_;
  if (way == Way::ACROSS)
  {
    point_ = anchor_ + moved;
    return point_;
  }
  const Ray sight = view_.to(anchor_);
  const double distance = (anchor_ - sight.origin).norm();
  const double away = moved.dot(view_.up());
  // With perspective it never gets to the camera, however far the pointer goes.
  point_ = sight.at(view_.inPerspective() ? distance * std::exp(away / distance) : distance + away);
  return point_;
}

/// What the pointer shows of the plane through the anchor that is parallel to the picture.
Vec3d ViewDrag::inPlane(const Vec2d& pointer) const
{
  const Ray ray = view_.through(pointer);
  const Vec3d normal = view_.forward();
  return ray.at((anchor_ - ray.origin).dot(normal) / ray.direction.dot(normal));
}

}  // namespace cloth_tearing
