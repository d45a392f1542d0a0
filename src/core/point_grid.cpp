// Points by the cubes of space they lie in.
#include "cloth_tearing/core/point_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace cloth
{
namespace
{

/// Points by the cubes of space they lie in: who is near is in the same cube or a next one.
class PointGrid
{
public:
  explicit PointGrid(double width) : width_(width) {}

  void add(const Vec3d& point) { cubes_[cubeOf(point)].push_back(point); }

  /// Whether a point lies within the width of `place`.
  bool isNear(const Vec3d& place) const
  {
    const Cube middle = cubeOf(place);
    for (double dx : { 0.0, -1.0, 1.0 })
    {
      for (double dy : { 0.0, -1.0, 1.0 })
      {
        for (double dz : { 0.0, -1.0, 1.0 })
        {
          if (isNear(place, { middle[0] + dx, middle[1] + dy, middle[2] + dz }))
          {
            return true;
          }
        }
      }
    }
    return false;
  }

private:
  using Cube = std::array<double, 3>;  ///< whole numbers, however large

  Cube cubeOf(const Vec3d& place) const
  {
    return { std::floor(place.x() / width_), std::floor(place.y() / width_),
             std::floor(place.z() / width_) };
  }

  bool isNear(const Vec3d& place, const Cube& cube) const
  {
    const auto found = cubes_.find(cube);
    return found != cubes_.end() &&
           std::any_of(found->second.begin(), found->second.end(),
                       [&](const Vec3d& point)
                       { return (point - place).squaredNorm() <= width_ * width_; });
  }

  double width_;
  std::map<Cube, std::vector<Vec3d>> cubes_;
};

}  // namespace

std::vector<char> positionsNear(const std::vector<Vec3d>& positions, const std::vector<int>& places,
                                double width)
{
  std::vector<char> near(positions.size(), 0);
  if (width <= 0.0)
  {
    return near;
  }
  PointGrid grid(width);
  for (int place : places)
  {
    grid.add(positions[place]);
  }
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    near[i] = grid.isNear(positions[i]) ? 1 : 0;
  }
  return near;
}

}  // namespace cloth
