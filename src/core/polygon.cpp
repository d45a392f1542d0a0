// Ear clipping in the best-fit plane, then edge flips.
#include "cloth_tearing/core/polygon.h"

#include <algorithm>
#include <cmath>

namespace cloth
{
namespace
{

// Twice the area vector; points to where the polygon turns counter-clockwise.
Vec3d newellNormal(const std::vector<Vec3d>& corners)
{
  Vec3d normal = Vec3d::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const Vec3d a = corners[i] - corners[0];
    const Vec3d b = corners[(i + 1) % corners.size()] - corners[0];
    normal += a.cross(b);
  }
  return normal;
}

bool liesOnALine(const std::vector<Vec3d>& corners, double tolerance)
{
  Vec3d longest = Vec3d::Zero();
  for (const Vec3d& corner : corners)
  {
    const Vec3d arm = corner - corners[0];
    longest = arm.squaredNorm() > longest.squaredNorm() ? arm : longest;
  }
  const double length = longest.norm();
  return std::all_of(corners.begin(), corners.end(),
                     [&](const Vec3d& corner)
                     { return longest.cross(corner - corners[0]).norm() <= tolerance * length; });
}

std::vector<Vec2d> projected(const std::vector<Vec3d>& corners, const Vec3d& normal)
{
  // Two directions across the normal; dropping its largest axis alone would distort the angles.
  const Vec3d n = normal.normalized();
  Vec3d helper = Vec3d::Zero();
  int smallest = 0;
  n.cwiseAbs().minCoeff(&smallest);
  helper[smallest] = 1;
  const Vec3d right = helper.cross(n).normalized();
  const Vec3d up = n.cross(right);
  std::vector<Vec2d> flat;
  flat.reserve(corners.size());
  for (const Vec3d& corner : corners)
  {
    flat.emplace_back(right.dot(corner - corners[0]), up.dot(corner - corners[0]));
  }
  return flat;
}

// Distance of c from the line through a and b, positive on its left [m].
double leftOf(const Vec2d& a, const Vec2d& b, const Vec2d& c)
{
  const double length = (b - a).norm();
  return length > 0 ? signedArea2(a, b, c) / length : 0;
}

bool liesOnSegment(const Vec2d& a, const Vec2d& b, const Vec2d& c, double tolerance)
{
  const Vec2d along = b - a;
  const double place = (c - a).dot(along);
  return std::abs(leftOf(a, b, c)) <= tolerance && place >= 0 && place <= along.squaredNorm();
}

bool meet(const Vec2d& a, const Vec2d& b, const Vec2d& c, const Vec2d& d, double tolerance)
{
  const double c_side = leftOf(a, b, c);
  const double d_side = leftOf(a, b, d);
  const double a_side = leftOf(c, d, a);
  const double b_side = leftOf(c, d, b);
  const bool crosses =
      ((c_side > tolerance && d_side < -tolerance) ||
       (c_side < -tolerance && d_side > tolerance)) &&
      ((a_side > tolerance && b_side < -tolerance) || (a_side < -tolerance && b_side > tolerance));
  return crosses || liesOnSegment(a, b, c, tolerance) || liesOnSegment(a, b, d, tolerance) ||
         liesOnSegment(c, d, a, tolerance) || liesOnSegment(c, d, b, tolerance);
}

// Whether sides that are no neighbours meet. Neighbours that fold back on one another make the next
// side meet one of them.
bool crossesItself(const std::vector<Vec2d>& polygon, double tolerance)
{
  const int n = static_cast<int>(polygon.size());
  const auto low = [&](int i) { return std::min(polygon[i].x(), polygon[(i + 1) % n].x()); };
  const auto high = [&](int i) { return std::max(polygon[i].x(), polygon[(i + 1) % n].x()); };
  std::vector<int> order(n);
  for (int i = 0; i < n; ++i)
  {
    order[i] = i;
  }
  std::sort(order.begin(), order.end(), [&](int i, int j) { return low(i) < low(j); });
  for (int p = 0; p < n; ++p)
  {
    const int i = order[p];
    for (int q = p + 1; q < n && low(order[q]) <= high(i) + tolerance; ++q)
    {
      const int j = order[q];
      const bool neighbours = (i + 1) % n == j || (j + 1) % n == i;
      if (!neighbours &&
          meet(polygon[i], polygon[(i + 1) % n], polygon[j], polygon[(j + 1) % n], tolerance))
      {
        return true;
      }
    }
  }
  return false;
}

// Clips ears of a simple polygon that turns counter-clockwise.
class EarClipper
{
public:
  EarClipper(const std::vector<Vec2d>& polygon, double tolerance)
      : polygon_(polygon), tolerance_(tolerance)
  {
    for (int i = 0; i < static_cast<int>(polygon.size()); ++i)
    {
      left_.push_back(i);
    }
  }

  // False where rounding leaves no ear to clip.
  bool run(std::vector<FlatTriangle>& triangles)
  {
    std::size_t i = 1;  // a quad is cut from its first corner, as most tools do
    std::size_t refused = 0;
    while (left_.size() > 3 && refused < left_.size())
    {
      i %= left_.size();
      if (isEar(i))
      {
        triangles.push_back(triangleAt(i));
        left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i));
        refused = 0;
      }
      else
      {
        ++refused;
      }
      ++i;  // the next but one: a fan of slivers round one corner is avoided
    }
    triangles.push_back(triangleAt(1));
    return left_.size() == 3 && altitude(triangles.back()) > tolerance_;
  }

private:
  FlatTriangle triangleAt(std::size_t i) const
  {
    return { left_[(i + left_.size() - 1) % left_.size()], left_[i],
             left_[(i + 1) % left_.size()] };
  }

  // The least one, negative if the triangle is turned over.
  double altitude(const FlatTriangle& ear) const
  {
    const Vec2d& a = polygon_[ear[0]];
    const Vec2d& b = polygon_[ear[1]];
    const Vec2d& c = polygon_[ear[2]];
    const double longest = std::sqrt(
        std::max({ (b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm() }));
    return signedArea2(a, b, c) / longest;
  }

  bool isEar(std::size_t i) const
  {
    const FlatTriangle ear = triangleAt(i);
    if (altitude(ear) <= tolerance_)
    {
      return false;
    }
    const Vec2d& a = polygon_[ear[0]];
    const Vec2d& b = polygon_[ear[1]];
    const Vec2d& c = polygon_[ear[2]];
    return std::none_of(left_.begin(), left_.end(),
                        [&](int k)
                        {
                          const Vec2d& p = polygon_[k];
                          return k != ear[0] && k != ear[1] && k != ear[2] &&
                                 leftOf(a, b, p) >= -tolerance_ && leftOf(b, c, p) >= -tolerance_ &&
                                 leftOf(c, a, p) >= -tolerance_;
                        });
  }

  const std::vector<Vec2d>& polygon_;
  double tolerance_;
  std::vector<int> left_;
};

}  // namespace

PolygonCut cutPolygon(const std::vector<Vec3d>& corners, double tolerance)
{
  PolygonCut cut;
  if (liesOnALine(corners, tolerance))
  {
    cut.verdict = PolygonVerdict::NO_AREA;
    return cut;
  }
  if (corners.size() == 3)
  {
    cut.triangles = { { 0, 1, 2 } };
    return cut;
  }
  const Vec3d normal = newellNormal(corners);
  const bool has_normal = normal.norm() > tolerance * tolerance;
  const std::vector<Vec2d> flat = has_normal ? projected(corners, normal) : std::vector<Vec2d>();
  if (!has_normal || crossesItself(flat, tolerance) ||
      !EarClipper(flat, tolerance).run(cut.triangles))
  {
    cut.verdict = PolygonVerdict::CROSSES_ITSELF;
    cut.triangles.clear();
    return cut;
  }
  flipToDelaunay(flat, cut.triangles);
  return cut;
}

}  // namespace cloth
