// Strain of the cloth around a spring, the same on any mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/unfolding.h"

namespace cloth
{

/// Mean stretch over a material disc: what an intact spring tears on. A single edge's own strain
/// depends on how finely and how regularly the mesh is drawn; the mean over a fixed patch of cloth
/// does not (nonlocal averaging, Bazant and Jirasek 2002). One reads one cloth.
class PatchStrain
{
public:
  /// Mean of C = F^T F over the triangles that are connected with `s`, never across a border, and
  /// whose centre is closer than `radius` [m] to its middle in the unfolded material, weighted
  /// with area x (1 - r^2 / radius^2); then the stretch along the spring minus 1 [-].
  ///
  /// Never more than the spring's own strain, which it also is where the disc holds no centre.
  double read(const Cloth& cloth, SpringId s, double radius);

  /// The same for who reads many springs of cloth that stands still: discs that overlap have the
  /// stretch of their triangles in common. moved() is to be told before the first of them.
  double readStill(const Cloth& cloth, SpringId s, double radius);
  void moved();

  /// Follows an edit that the cloth has followed. Who does not tell gets the same readings, slower.
  void follow(const Cloth& cloth, const std::vector<TriangleId>& touched);

private:
  /// How the plane of a triangle lies in that of the disc, in which the spring runs along x.
  struct Laid
  {
    int index;
    Vec2d turn;
    Vec2d shift;  ///< [m]
  };

  /// C = F^T F of a triangle in its own plane [-].
  struct Stretch
  {
    double xx = 0.0;
    double xy = 0.0;
    double yy = 0.0;
    unsigned moment = 0;  ///< when it was read: between two calls of moved()
  };

  void lay(const Cloth& cloth, SpringId s);
  void add(const Cloth& cloth, const Laid& laid, double squared_radius);
  const Stretch& stretchOf(const Cloth& cloth, const FlatTriangle& flat, int index);
  void open(const Laid& laid);

  Unfolding unfolding_;
  std::uint64_t seen_ = 0;         ///< tears of the cloth that unfolding_ has followed
  std::vector<Laid> open_;         ///< reached so far
  std::vector<unsigned> reached_;  ///< by index: the reading that met it last
  std::vector<Stretch> stretch_;   ///< by index
  unsigned reading_ = 0;
  unsigned moment_ = 1;
  double weight_ = 0.0;
  double weighted_squared_stretch_ = 0.0;
};

}  // namespace cloth
