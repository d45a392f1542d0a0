// How the cloth and the air round it behave.
#pragma once

#include <string>
#include <vector>

#include "cloth_tearing/core/types.h"

namespace cloth
{

/// What the stiffness and damping of a Material belong to.
enum class StiffnessLaw
{
  PER_WIDTH,   ///< the cloth: a spring gets its share by adjacent rest area over squared rest
               ///< length, so that unequal triangles act as one cloth
  PER_SPRING,  ///< every single spring, whatever its length, as in the thesis: the mesh decides how
               ///< stiff the cloth is
};

/// Elastic behaviour, the same for both solvers. SI units; the defaults make a cotton-like sheet.
struct Material
{
  double areal_density = 0.12;  ///< [kg/m^2], > 0
  StiffnessLaw stiffness_law = StiffnessLaw::PER_WIDTH;
  double stiffness = 100.0;            ///< Y of structural springs [N/m], > 0
  double bend_shear_stiffness = 20.0;  ///< Yb of bend-shear springs [N/m], >= 0 (3.1.2)
  double damping = 0.02;               ///< spring damping [N s/m], >= 0 (2.1.1)
};

/// What acts on the cloth from outside (2.1.1).
struct Environment
{
  Vec3d gravity = Vec3d(0.0, 0.0, -9.81);  ///< [m/s^2]
  double air_friction = 0.2;               ///< deceleration per speed [1/s], >= 0
  Vec3d wind = Vec3d::Zero();              ///< velocity of the air [m/s]
  double wind_drag = 0.5;  ///< pressure per normal speed of the air [N s/m^3], >= 0; 0 = no wind
};

/// Everything wrong with them, one sentence each, naming the field; empty if they can be used.
std::vector<std::string> problems(const Material& material);
std::vector<std::string> problems(const Environment& environment);

}  // namespace cloth
