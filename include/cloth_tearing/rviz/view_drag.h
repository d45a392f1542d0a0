// Moves a point in space as a pointer moves in a picture of it.
#pragma once

#include "cloth_tearing/core/types.h"
#include "cloth_tearing/rviz/surface_picking.h"

namespace cloth_tearing
{

/// A camera, in perspective or without. It looks along the negative z axis of its own frame, and y
/// is up in the picture.
struct View
{
  using Matrix = Eigen::Matrix<double, 4, 4, Eigen::DontAlign>;

  cloth::Pose camera;                      ///< in the fixed frame
  Matrix projection = Matrix::Identity();  ///< from its frame to the picture, as OpenGL has it

  cloth::Vec3d forward() const { return camera.rotation * -cloth::Vec3d::UnitZ(); }
  cloth::Vec3d up() const { return camera.rotation * cloth::Vec3d::UnitY(); }
  bool inPerspective() const { return projection(3, 2) != 0.0; }

  /// The line of sight through a place in the picture, which is (-1, -1) at its lower left corner
  /// and (1, 1) at its upper right one. Begins at the camera, or in its plane without perspective.
  Ray through(const cloth::Vec2d& place) const;

  /// The line of sight to a point in space.
  Ray to(const cloth::Vec3d& point) const;
};

bool operator==(const View& a, const View& b);
inline bool operator!=(const View& a, const View& b)
{
  return !(a == b);
}

/// Drags a point with the pointer: across the line of sight, or along it. What has been reached
/// stays when the way of dragging changes, or the camera.
class ViewDrag
{
public:
  enum class Way
  {
    ACROSS,  ///< in the plane through the point that is parallel to the picture, under the pointer
    ALONG    ///< pointer up: away from the camera; it stays where it is in the picture
  };

  /// Begins at a point in space [m] with the pointer at a place in the picture, as in View.
  void begin(const View& view, const cloth::Vec2d& pointer, const cloth::Vec3d& point);

  /// Where the point has got to [m]. One that is not before the camera stays where it is.
  const cloth::Vec3d& move(const View& view, const cloth::Vec2d& pointer, Way way);

  const cloth::Vec3d& point() const { return point_; }

private:
  void anchor(const View& view, Way way);
  cloth::Vec3d inPlane(const cloth::Vec2d& pointer) const;

  View view_;
  Way way_ = Way::ACROSS;
  cloth::Vec2d pointer_ = cloth::Vec2d::Zero();  ///< at the last move
  cloth::Vec3d point_ = cloth::Vec3d::Zero();
  cloth::Vec3d anchor_ = cloth::Vec3d::Zero();  ///< where it was when view and way began
  cloth::Vec3d grip_ = cloth::Vec3d::Zero();    ///< where the pointer was then, in its plane
  bool before_camera_ = false;                  ///< the anchor
};

}  // namespace cloth_tearing
