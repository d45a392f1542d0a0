// The cloth at rest: lengths, areas and masses, which follow every tear.
#pragma once

#include <vector>

#include "cloth_tearing/core/mesh.h"
#include "cloth_tearing/core/types.h"

namespace cloth
{

enum class RestShapeSource
{
  IMPORTED,  ///< lengths as modelled: garments are not flat
  UV,        ///< lengths of the texture layout, scaled so that the whole area stays as modelled
};

/// What the cloth is when nothing pulls at it. Everything here is double: a tear decides on it.
struct RestShape
{
  double areal_density = 0.0;       ///< [kg/m^2]
  std::vector<double> length;       ///< of each spring [m], > 0
  std::vector<double> bend_length;  ///< of each spring's bend-shear spring [m]; 0 = it has none
  std::vector<double> area;         ///< of each triangle [m^2], > 0
  std::vector<double> spacing;      ///< mean edge length of the untorn triangle each came from [m]
  std::vector<double> mass;         ///< of each particle: a third of its triangles' [kg]

  /// Follows an edit: halves and copies take their parent's length, middle springs the median of
  /// their triangle; the two halves of a triangle have half its area each; masses and bend-shear
  /// lengths are computed anew around it. Total area and mass stay.
  void follow(const Mesh& mesh, const Edit& edit);

  /// Makes all masses anew, of cloth of `density` [kg/m^2].
  void weigh(const Mesh& mesh, double density);
};

/// @param positions of the particles [m]
/// @throws Refusal naming a spring without length or a triangle without area
RestShape makeRestShape(const Mesh& mesh, const std::vector<Vec3d>& positions,
                        RestShapeSource source, double areal_density);

/// Area of a triangle from its side lengths [m^2] (Heron, in Kahan's stable order); 0 if they do
/// not close.
double triangleArea(double a, double b, double c);

/// Length of the median onto side `c` [m].
double medianLength(double a, double b, double c);

/// Distance between the tips of two triangles that share side `e` and lie in one plane, on
/// opposite sides of it: sides (e, b, a) and (e, d, c), where b and d meet at the same end of `e`
/// (thesis 3.1.2, equations 1 to 4, without the angle).
double bendShearLength(double e, double a, double b, double c, double d);

/// Place of a triangle's third corner when side `e` runs from (0, 0) to (e, 0), `from_start` leaves
/// its start and `from_end` its end; y >= 0 [m].
Vec2d apexOnPlane(double e, double from_start, double from_end);

}  // namespace cloth
