// Scenes and measures that the tests of moving cloth share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "cloth_tearing/core/mesh_builder.h"
#include "cloth_tearing/core/pins.h"
#include "cloth_tearing/core/simulation.h"
#include "float_traps.h"

namespace cloth
{

/// A sheet in the x-y plane, its upper edge along y = 0.
inline ClothModel sheet(double width, double height, int columns, int rows,
                        RectanglePattern pattern = RectanglePattern::ALTERNATING)
{
  RectangleParams params;
  params.width = width;
  params.height = height;
  params.columns = columns;
  params.rows = rows;
  params.pattern = pattern;
  return rectangle(params);
}

/// The same sheet upright: in the x-z plane, hanging down from z = 0, its front towards -y.
inline ClothModel upright(ClothModel model)
{
  for (Vec3d& x : model.positions)
  {
    x = Vec3d(x.x(), -x.z(), x.y());
  }
  return model;
}

inline ClothModel moved(ClothModel model, const Vec3d& by)
{
  for (Vec3d& x : model.positions)
  {
    x += by;
  }
  return model;
}

/// Particles of a sheet in the x-y plane along one of its edges.
inline std::vector<int> edgeOf(const ClothModel& flat, const std::string& edge)
{
  PinParams pins;
  pins.edges = { edge };
  return pinnedParticles(flat, pins);
}

inline std::vector<int> wholeBorder(const ClothModel& flat)
{
  PinParams pins;
  pins.edges = { "top", "bottom", "left", "right" };
  return pinnedParticles(flat, pins);
}

/// Written out, so that the claims of the tests do not move with the defaults of the product.
inline Material cotton()
{
  Material material;
  material.areal_density = 0.15;
  material.stiffness = 60.0;
  material.bend_shear_stiffness = 12.0;
  material.damping = 0.02;
  return material;
}

/// Nothing acts from outside, nothing is lost, nothing tears.
inline SimulationParams vacuum(SolverKind solver = SolverKind::XPBD)
{
  SimulationParams params;
  params.solver.kind = solver;
  params.material = cotton();
  params.material.damping = 0.0;
  params.environment.gravity = Vec3d::Zero();
  params.environment.air_friction = 0.0;
  params.environment.wind_drag = 0.0;
  params.tearing.enabled = false;
  return params;
}

/// Cotton in a room, without tearing.
inline SimulationParams untearable(SolverKind solver = SolverKind::XPBD)
{
  SimulationParams params;
  params.solver.kind = solver;
  params.solver.time_step = 0.001;
  params.material = cotton();
  params.environment.gravity = Vec3d(0.0, 0.0, -9.81);
  params.environment.air_friction = 0.2;
  params.environment.wind_drag = 0.5;
  params.tearing.enabled = false;
  return params;
}

/// Cotton in a room that tears where it is stretched by 20 %.
inline SimulationParams tearable(SolverKind solver = SolverKind::XPBD)
{
  SimulationParams params = untearable(solver);
  params.tearing.enabled = true;
  params.tearing.tear_strain = 0.20;
  params.tearing.weak_tear_strain = 0.16;
  params.tearing.one_point_tear_strain = 0.16;
  params.tearing.tear_radius = 0.04;
  params.tearing.crack_length = 0.03;
  params.tearing.hem_factor = 2.0;
  params.tearing.hem_width = 0.08;
  params.solver.max_strain = 0.3;
  return params;
}

/// Steps and expects that all goes well.
inline std::vector<TearEvent> run(Simulation& simulation, int steps)
{
  const FloatTraps traps;
  std::vector<TearEvent> tears;
  for (int i = 0; i < steps; ++i)
  {
    const StepReport report = simulation.step();
    tears.insert(tears.end(), report.tears.begin(), report.tears.end());
    if (!report.fault.empty())
    {
      ADD_FAILURE() << "step " << i << ": " << report.fault;
      break;
    }
  }
  return tears;
}

inline int stepsFor(const Simulation& simulation, double seconds)
{
  return static_cast<int>(std::lround(seconds / simulation.params().solver.time_step));
}

/// NaN if any speed is.
inline double fastest(const ParticleState& state)
{
  double most = 0.0;
  for (const Vec3& v : state.velocity)
  {
    const double speed = v.cast<double>().norm();
    most = speed <= most ? most : speed;
    if (std::isnan(most))
    {
      break;
    }
  }
  return most;
}

inline double meanSpeed(const ParticleState& state)
{
  double sum = 0.0;
  for (const Vec3& v : state.velocity)
  {
    sum += v.cast<double>().norm();
  }
  return sum / state.size();
}

inline bool allFinite(const ParticleState& state)
{
  const auto finite = [](const Vec3& v) { return v.allFinite(); };
  return std::all_of(state.position.begin(), state.position.end(), finite) &&
         std::all_of(state.velocity.begin(), state.velocity.end(), finite);
}

inline Vec3d momentum(const Cloth& cloth)
{
  Vec3d sum = Vec3d::Zero();
  for (int i = 0; i < cloth.state.size(); ++i)
  {
    sum += cloth.rest.mass[i] * cloth.state.velocity[i].cast<double>();
  }
  return sum;
}

inline double kineticEnergy(const Cloth& cloth)
{
  double sum = 0.0;
  for (int i = 0; i < cloth.state.size(); ++i)
  {
    sum += 0.5 * cloth.rest.mass[i] * cloth.state.velocity[i].cast<double>().squaredNorm();
  }
  return sum;
}

/// Energy of the stretched springs [J].
inline double elasticEnergy(const Cloth& cloth)
{
  double sum = 0.0;
  for (const auto* table : { &cloth.springs.structural, &cloth.springs.bend_shear })
  {
    for (const SpringLaw& law : *table)
    {
      if (law.active())
      {
        const Vec3d d = (cloth.state.position[law.b] - cloth.state.position[law.a]).cast<double>();
        const double stretch = d.norm() - law.rest;
        sum += 0.5 * law.stiffness * stretch * stretch;
      }
    }
  }
  return sum;
}

/// Sum of the texture areas of all triangles [-].
inline double textureArea(const Mesh& mesh)
{
  double sum = 0.0;
  for (int i = 0; i < mesh.triangleCount(); ++i)
  {
    const auto& uv = mesh.triangle({ i }).uv;
    const Vec2d a = uv[1] - uv[0];
    const Vec2d b = uv[2] - uv[0];
    sum += 0.5 * std::abs(a.x() * b.y() - a.y() * b.x());
  }
  return sum;
}

/// Prints every defect of the mesh.
inline ::testing::AssertionResult isSound(const Mesh& mesh)
{
  const std::vector<std::string> found = defects(mesh);
  if (found.empty())
  {
    return ::testing::AssertionSuccess();
  }
  ::testing::AssertionResult result = ::testing::AssertionFailure();
  for (const std::string& defect : found)
  {
    result << defect << "\n";
  }
  return result;
}

inline std::string nameOf(SolverKind kind)
{
  return kind == SolverKind::XPBD ? "Xpbd" : "ForceSprings";
}

/// For tests of what both solvers promise.
class WithBothSolvers : public ::testing::TestWithParam<SolverKind>
{
};

inline auto bothSolvers()
{
  return ::testing::Values(SolverKind::XPBD, SolverKind::FORCE_SPRINGS);
}

inline std::string solverName(const ::testing::TestParamInfo<SolverKind>& info)
{
  return nameOf(info.param);
}

/// Why a request was refused.
inline std::string refusalOf(const std::function<void()>& request)
{
  try
  {
    request();
  }
  catch (const Refusal& refusal)
  {
    return refusal.what();
  }
  return "it was granted";
}

}  // namespace cloth
