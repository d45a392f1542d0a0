// Builds the cloths of the benchmark, with the same material at every resolution.
#include "scene.h"

#include <algorithm>
#include <cmath>

#include "cloth_tearing/core/mesh_builder.h"
#include "cloth_tearing/core/obj_reader.h"

namespace cloth_bench
{
namespace
{

using cloth::ClothModel;
using cloth::Vec3d;

constexpr double AREAL_DENSITY = 0.2;  ///< [kg/m^2]
constexpr double GRAVITY = 9.81;       ///< [m/s^2]
constexpr double TOP_STRAIN = 0.05;    ///< of a sheet of 1 m where it is pinned [-]
constexpr double AIR_FRICTION = 1.5;   ///< [1/s]
constexpr double WIND = 2.0;           ///< [m/s]
constexpr double BALL_DEPTH = 0.08;    ///< [m]
constexpr double PINNED_TOP = 0.1;     ///< a garment is pinned so far below its highest point [m]

ClothModel sheet(MeshKind mesh, int side)
{
  cloth::RectangleParams params;
  params.columns = side;
  params.rows = side;
  params.pattern = mesh == MeshKind::GRID ? cloth::RectanglePattern::ONE_DIAGONAL
                                          : cloth::RectanglePattern::IRREGULAR;
  ClothModel model = cloth::rectangle(params);
  for (Vec3d& x : model.positions)
  {
    x = Vec3d(x.x(), -x.z(), x.y());
  }
  return model;
}

/// A garment whose longest side is a metre, y of the file upwards, its top at z = 0.
ClothModel garmentFrom(const std::string& file)
{
  const cloth::ObjImport drawn = cloth::readObjFile(file);
  cloth::ImportOptions options;  // a file has units of its own
  options.scale = 1.0 / (drawn.report.highest - drawn.report.lowest).maxCoeff();
  cloth::ObjImport import = cloth::readObjFile(file, options);
  for (Vec3d& x : import.model.positions)
  {
    x = Vec3d(x.x(), -x.z(), x.y() - import.report.highest.y());
  }
  return import.model;
}

/// Where a hanging strip of cloth comes to rest: its tension is the weight below.
double stretched(double z)
{
  return z - TOP_STRAIN * (-z - 0.5 * z * z);
}

}  // namespace

Scene makeScene(SceneKind kind, MeshKind mesh, int side, const std::string& garment)
{
  Scene scene;
  scene.model = mesh == MeshKind::GARMENT ? garmentFrom(garment) : sheet(mesh, side);
  const double pinned_above = mesh == MeshKind::GARMENT ? -PINNED_TOP : -1e-9;
  for (std::size_t i = 0; i < scene.model.positions.size(); ++i)
  {
    const Vec3d& x = scene.model.positions[i];
    if (x.z() > pinned_above)
    {
      scene.pinned.push_back(static_cast<int>(i));
      scene.start.push_back(x);
    }
    else
    {
      scene.start.emplace_back(x.x(), x.y(), stretched(x.z()));
    }
  }

  const double stiffness = AREAL_DENSITY * GRAVITY / TOP_STRAIN;
  const double particle_mass = AREAL_DENSITY / static_cast<double>(scene.start.size());
  scene.material.areal_density = AREAL_DENSITY;
  scene.material.stiffness = stiffness;
  scene.material.bend_shear_stiffness = 0.2 * stiffness;
  scene.material.damping = 0.3 * std::sqrt(stiffness * particle_mass);
  scene.environment.gravity = Vec3d(0.0, 0.0, -GRAVITY);
  scene.environment.air_friction = AIR_FRICTION;
  scene.environment.wind_drag = kind == SceneKind::WINDY ? 0.5 : 0.0;
  scene.environment.wind = Vec3d(0.0, kind == SceneKind::WINDY ? WIND : 0.0, 0.0);
  if (kind == SceneKind::BALL)
  {
    scene.ball.emplace();
    scene.ball->center = Vec3d(0.0, BALL_DEPTH - scene.ball->radius, -0.5);
  }
  return scene;
}

std::string nameOf(SceneKind scene)
{
  return scene == SceneKind::HUNG ? "hung" : scene == SceneKind::WINDY ? "windy" : "ball";
}

std::string nameOf(MeshKind mesh)
{
  return mesh == MeshKind::GRID ? "grid" : mesh == MeshKind::IRREGULAR ? "irregular" : "garment";
}

}  // namespace cloth_bench
