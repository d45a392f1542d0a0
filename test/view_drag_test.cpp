// Claims of dragging in a picture: where a pointer shows to, and where what it drags gets to.
#include "cloth_tearing/rviz/view_drag.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cloth_tearing
{
namespace
{

using cloth::Vec2d;
using cloth::Vec3d;
using Way = ViewDrag::Way;

constexpr double EXACT = 1e-9;

/// Looks from `eye` along y, with z up; 90 degrees across and down.
View perspective(const Vec3d& eye)
{
  View view;
  view.camera.position = eye;
  view.camera.rotation = cloth::Quatd(Eigen::AngleAxisd(std::acos(0.0), Vec3d::UnitX()));
  view.projection.setZero();
  view.projection(0, 0) = 1.0;
  view.projection(1, 1) = 1.0;
  view.projection(2, 2) = -1.0;
  view.projection(2, 3) = -0.02;
  view.projection(3, 2) = -1.0;
  return view;
}

/// The same without perspective: a picture of 4 m by 4 m.
View flat(const Vec3d& eye)
{
  View view = perspective(eye);
  view.projection.setIdentity();
  view.projection(0, 0) = 0.5;
  view.projection(1, 1) = 0.5;
  return view;
}

/// Where a point is in the picture.
Vec2d shown(const View& view, const Vec3d& point)
{
  const Vec3d local = view.camera.applyInverse(point);
  const Eigen::Vector4d clip =
      view.projection * Eigen::Vector4d(local.x(), local.y(), local.z(), 1);
  return clip.head<2>() / clip.w();
}

void expectAt(const Vec3d& actual, const Vec3d& expected)
{
  EXPECT_LT((actual - expected).norm(), EXACT)
      << actual.transpose() << " instead of " << expected.transpose();
}

class BothViews : public testing::TestWithParam<View (*)(const Vec3d&)>
{
protected:
  View view_ = GetParam()({ 0.5, -2.0, 1.0 });
};

INSTANTIATE_TEST_SUITE_P(Perspective, BothViews, testing::Values(&perspective));
INSTANTIATE_TEST_SUITE_P(Flat, BothViews, testing::Values(&flat));

TEST_P(BothViews, SeeEverythingOnALineOfSightInTheSamePlace)
{
  view_.projection(0, 2) = view_.inPerspective() ? 0.1 : 0.0;  // a picture beside the middle
  view_.projection(1, 3) = view_.inPerspective() ? 0.0 : -0.2;
  const Vec2d place(0.25, -0.5);
  const Ray ray = view_.through(place);
  EXPECT_NEAR(ray.direction.norm(), 1.0, EXACT);
  for (const double distance : { 0.5, 3.0 })
  {
    const Vec3d point = ray.at(distance);
    EXPECT_LT((shown(view_, point) - place).norm(), EXACT);
    const Ray back = view_.to(point);
    expectAt(back.origin, ray.origin);
    expectAt(back.direction, ray.direction);
  }
}

TEST_P(BothViews, DragAcrossUnderThePointerInThePlaneOfThePicture)
{
  const Vec3d point(0.2, 1.0, 0.7);
  ViewDrag drag;
  drag.begin(view_, shown(view_, point), point);

  const Vec2d place(0.3, 0.4);
  const Vec3d moved = drag.move(view_, place, Way::ACROSS);

  EXPECT_LT((shown(view_, moved) - place).norm(), EXACT);
  EXPECT_NEAR(moved.y(), point.y(), EXACT);
  expectAt(drag.move(view_, shown(view_, point), Way::ACROSS), point);
}

TEST_P(BothViews, DragAlongTheLineOfSightUpForAway)
{
  const Vec3d point(0.2, 1.0, 0.7);
  const Vec2d place = shown(view_, point);
  ViewDrag drag;
  drag.begin(view_, place, point);

  const Vec3d away = drag.move(view_, place + Vec2d(0.0, 0.1), Way::ALONG);
  EXPECT_GT(away.y(), point.y() + 0.1);
  EXPECT_LT((shown(view_, away) - place).norm(), EXACT);

  const Vec3d near = drag.move(view_, place - Vec2d(0.0, 0.1), Way::ALONG);
  EXPECT_LT(near.y(), point.y() - 0.1);
  EXPECT_LT((shown(view_, near) - place).norm(), EXACT);

  expectAt(drag.move(view_, place, Way::ALONG), point);
}

TEST_P(BothViews, JumpNowhereWhenTheWayOfDraggingChanges)
{
  const Vec3d point(0.2, 1.0, 0.7);
  ViewDrag drag;
  Vec2d place = shown(view_, point);
  drag.begin(view_, place, point);
  for (const Way way : { Way::ALONG, Way::ACROSS, Way::ALONG })
  {
    place += Vec2d(0.05, 0.2);
    const Vec3d before = drag.move(view_, place, way);
    const Way other = way == Way::ALONG ? Way::ACROSS : Way::ALONG;
    expectAt(drag.move(view_, place, other), before);
  }
}

TEST_P(BothViews, JumpNowhereWhenTheCameraMoves)
{
  const Vec3d point(0.2, 1.0, 0.7);
  ViewDrag drag;
  Vec2d place = shown(view_, point);
  drag.begin(view_, place, point);
  place += Vec2d(0.2, 0.1);
  const Vec3d before = drag.move(view_, place, Way::ACROSS);

  View other = view_;
  other.camera.position += Vec3d(0.3, -0.5, 0.2);
  other.camera.rotation =
      cloth::Quatd(Eigen::AngleAxisd(0.3, Vec3d::UnitZ())) * other.camera.rotation;
  expectAt(drag.move(other, place, Way::ACROSS), before);

  // From there on in the plane of the new picture.
  const Vec3d moved = drag.move(other, place + Vec2d(0.1, 0.0), Way::ACROSS);
  EXPECT_GT((moved - before).norm(), 0.05);
  EXPECT_NEAR((moved - before).dot(other.forward()), 0.0, EXACT);
}

TEST(ViewDrag, NeverGetsToTheCameraInPerspective)
{
  const View view = perspective({ 0, -2, 0 });
  const Vec3d point(0.1, 0.0, 0.2);
  ViewDrag drag;
  drag.begin(view, shown(view, point), point);

  const Vec3d near = drag.move(view, { 0.0, -5.0 }, Way::ALONG);

  EXPECT_GT((near - view.camera.position).dot(view.forward()), 0.0);
}

TEST_P(BothViews, LeaveAPointBehindTheCameraWhereItIs)
{
  const Vec3d point(0.2, 1.0, 0.7);
  ViewDrag drag;
  drag.begin(view_, shown(view_, point), point);
  View beyond = view_;
  beyond.camera.position.y() = 5.0;

  for (const Way way : { Way::ACROSS, Way::ALONG })
  {
    expectAt(drag.move(beyond, { 0.3, -0.8 }, way), point);
    expectAt(drag.move(beyond, { -0.9, 0.8 }, way), point);
  }
}

}  // namespace
}  // namespace cloth_tearing
