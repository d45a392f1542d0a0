// Thesis 3.3, figure 3.22: torn cloth that is put back together shows the texture it had.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cloth_tearing/experiments/thesis_world.h"

namespace cloth
{

/// A face of the cloth and what it shows.
struct TexturedTriangle
{
  std::array<Vec3d, 3> corners;  ///< [m]
  std::array<Vec2d, 3> uv;       ///< of each corner [-]
};

/// Every triangle of the cloth as it is.
std::vector<TexturedTriangle> texturedTriangles(const Cloth& cloth);

/// Where the particles of a torn cloth belong: its first ones where `untorn` has them, each that a
/// tear added where its original is, or in the middle between its two parents [m].
std::vector<Vec3d> homes(const Cloth& torn, const Cloth& untorn);

/// Every triangle of a torn cloth with its particles at their homes.
std::vector<TexturedTriangle> putBack(const Cloth& torn, const Cloth& untorn);

/// How a torn cloth that was put back covers what it was torn from.
struct TextureFit
{
  int points = 0;
  int uncovered = 0;         ///< points that no triangle covers
  int covered_twice = 0;     ///< points that more than one triangle covers
  double deviation = 0.0;    ///< largest distance on the texture from what is to be seen [-]
  double area_before = 0.0;  ///< of all triangles on the texture, with sign [-]
  double area_after = 0.0;

  /// What of the texture area was lost or won [-].
  double areaChange() const;

  /// Within 1e-6 at every point, each covered once; texture area as before within 1e-12.
  bool fits() const;
};

/// Looks at 10,000 random points of the untorn cloth.
TextureFit compareTexture(const std::vector<TexturedTriangle>& untorn,
                          const std::vector<TexturedTriangle>& torn, std::uint64_t seed = 1);

/// Swaps the texture of two corners of the largest triangle: what must not fit.
std::vector<TexturedTriangle> withSwappedCorners(std::vector<TexturedTriangle> triangles);

/// Tears a hung cloth badly: eight pulls, from the lower part up, each for 0.35 s.
/// @param watch called after every step; may be empty
void tearBadly(Simulation& simulation, const Watch& watch = {});

/// Lets every particle go home in a straight line, and stay: figure 3.22, to look at.
/// @param untorn the cloth that `simulation` was torn from
/// @param watch called as if after every step; the cloth does not move by itself meanwhile
void putBackSlowly(Simulation& simulation, const Cloth& untorn, const Watch& watch);

}  // namespace cloth
