// The cloths that all engines are measured with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cloth_tearing/core/cloth_model.h"
#include "cloth_tearing/core/material.h"

namespace cloth_bench
{

enum class SceneKind
{
  HUNG,   ///< hangs from its upper edge
  WINDY,  ///< the same in a wind of 2 m/s from the front
  BALL,   ///< the same with a ball that stands 0.08 m deep in it
};

enum class MeshKind
{
  GRID,       ///< one diagonal in each cell
  IRREGULAR,  ///< as many particles, Delaunay
  GARMENT,    ///< a file of the user's, 1 m at its longest, hung by its top 0.1 m
};

/// A ball that does not move.
struct Ball
{
  cloth::Vec3d center = cloth::Vec3d::Zero();  ///< [m]
  double radius = 0.1;                         ///< [m]
};

/// All that an engine is built from. The sheet hangs down in the x-z plane from z = 0.
struct Scene
{
  cloth::ClothModel model;          ///< at rest, unstretched
  std::vector<cloth::Vec3d> start;  ///< about where it hangs under its weight [m]
  std::vector<int> pinned;          ///< particles that stand still
  cloth::Material material;         ///< the weight of a 1 m sheet stretches its top by 5 %
  cloth::Environment environment;
  std::optional<Ball> ball;
};

/// @param side particles along either side of the sheet; a garment has its own number
/// @param garment OBJ file of a MeshKind::GARMENT
/// @throws what the builder or the importer throws
Scene makeScene(SceneKind scene, MeshKind mesh, int side, const std::string& garment = {});

std::string nameOf(SceneKind scene);
std::string nameOf(MeshKind mesh);

}  // namespace cloth_bench
