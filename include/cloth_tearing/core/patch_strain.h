// Strain of the cloth around a spring, the same on any mesh.
#pragma once

#include <vector>

#include "cloth_tearing/core/cloth.h"

namespace cloth
{

/// Mean stretch over a material disc: what an intact spring tears on. A single edge's own strain
/// depends on how finely and how regularly the mesh is drawn; the mean over a fixed patch of cloth
/// does not (nonlocal averaging, Bazant and Jirasek 2002).
class PatchStrain
{
public:
  /// Mean of C = F^T F over the triangles that are connected with `s`, never across a border, and
  /// whose centre is closer than `radius` [m] to its middle in the unfolded material, weighted
  /// with area x (1 - r^2 / radius^2); then the stretch along the spring minus 1 [-].
  ///
  /// Never more than the spring's own strain, which it also is where the disc holds no centre.
  double read(const Cloth& cloth, SpringId s, double radius);

private:
  /// A triangle laid flat: where its side `side` runs in the plane of the disc [m].
  struct Laid
  {
    TriangleId triangle;
    int side;
    Vec2d from;
    Vec2d to;
  };

  void add(const Cloth& cloth, const Laid& laid, double squared_radius);
  bool visit(TriangleId t);

  std::vector<Laid> open_;
  std::vector<unsigned> visited_;  ///< by triangle: the number of the reading that met it last
  unsigned reading_ = 0;
  double weight_ = 0.0;
  double weighted_squared_stretch_ = 0.0;
};

}  // namespace cloth
