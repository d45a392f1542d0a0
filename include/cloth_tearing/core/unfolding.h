// The cloth at rest, unfolded into a plane triangle by triangle.
#pragma once

#include <array>
#include <vector>

#include "cloth_tearing/core/mesh.h"
#include "cloth_tearing/core/rest_shape.h"

namespace cloth
{

/// A triangle at rest in a plane of its own: its first side begins in (0, 0) and runs along x, the
/// third corner has y >= 0.
struct FlatTriangle
{
  /// How the plane of the triangle across a side lies in this one: a point x there is at
  /// shift + turnedBy(turn, x) here.
  struct Across
  {
    int index = -1;               ///< -1: the side is a border
    Vec2d turn = Vec2d::UnitX();  ///< cosine and sine
    Vec2d shift = Vec2d::Zero();  ///< [m]
  };

  std::array<int, 3> particles{};
  std::array<Vec2d, 3> corners;  ///< [m]
  Vec2d center = Vec2d::Zero();  ///< [m]
  double area = 0.0;             ///< [m^2]; 0 if it has no height
  std::array<Across, 3> across;  ///< by side
};

/// `x` turned by an angle of which `turn` is cosine and sine.
inline Vec2d turnedBy(const Vec2d& turn, const Vec2d& x)
{
  return { turn.x() * x.x() - turn.y() * x.y(), turn.y() * x.x() + turn.x() * x.y() };
}

/// Lays triangles flat when they are asked for, and keeps them until a tear changes them: who goes
/// through the same neighbourhood often needs neither roots nor the mesh.
class Unfolding
{
public:
  /// @return index of a triangle, the same for ever
  int indexOf(const Mesh& mesh, TriangleId t);

  /// The triangle of an index. Valid until the next call.
  const FlatTriangle& at(const Mesh& mesh, const RestShape& rest, int index);

  /// Indices so far; at() may add some.
  int size() const { return static_cast<int>(flat_.size()); }

  /// Follows an edit of the mesh that touched these.
  void follow(const Mesh& mesh, const std::vector<TriangleId>& touched);

  /// Lays all of them anew when they are asked for.
  void forget();

private:
  void lay(const Mesh& mesh, const RestShape& rest, int index);
  void forget(TriangleId t);

  std::vector<int> indices_;           ///< by triangle; -1: it has none
  std::vector<TriangleId> triangles_;  ///< of each index
  std::vector<FlatTriangle> flat_;     ///< by index
  std::vector<char> laid_;             ///< by index
};

}  // namespace cloth
