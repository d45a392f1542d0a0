// What a material and its surroundings may be.
#include "cloth_tearing/core/material.h"

#include "cloth_tearing/core/checks.h"

namespace cloth
{

std::vector<std::string> problems(const Material& material)
{
  std::vector<std::string> found;
  check(found, "areal_density [kg/m^2]", material.areal_density, Range::between(1e-3, 1e3));
  check(found, "stiffness [N/m]", material.stiffness, Range::between(1e-3, 1e7));
  check(found, "bend_shear_stiffness [N/m]", material.bend_shear_stiffness,
        Range::between(0.0, 1e7));
  check(found, "damping [N s/m]", material.damping, Range::between(0.0, 1e4));
  return found;
}

std::vector<std::string> problems(const Environment& environment)
{
  std::vector<std::string> found;
  check(found, "gravity [m/s^2]", environment.gravity, 1000.0);
  check(found, "air_friction [1/s]", environment.air_friction, Range::between(0.0, 50.0));
  check(found, "wind [m/s]", environment.wind, 100.0);
  check(found, "wind_drag [N s/m^3]", environment.wind_drag, Range::between(0.0, 100.0));
  return found;
}

}  // namespace cloth
