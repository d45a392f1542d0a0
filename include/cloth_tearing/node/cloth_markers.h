// Draws a snapshot of the cloth as rviz markers.
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "cloth_tearing/core/surface.h"
#include "cloth_tearing/node/checker.h"
#include "cloth_tearing/node/conversions.h"
#include "cloth_tearing/node/node_params.h"

namespace cloth_tearing
{

/// Namespaces cloth (0 its triangles, 1 its springs: one or the other), torn_edges, weak_points,
/// spheres and grasps; fixed ids. What is not there is deleted: there is never an empty list, a
/// triangle without area or a number that is not finite. rviz draws lists with colours unlit, so
/// the light is in the colours, the same on both sides.
class ClothMarkers
{
public:
  ClothMarkers(const MarkerStyle& style, const Placement& placement);

  /// The markers carry no stamp yet. A sphere keeps its id while it is there; the deletion of one
  /// that is gone is repeated for a while, should a message be lost.
  visualization_msgs::MarkerArray draw(const cloth::Snapshot& snapshot);

private:
  using SphereKey = std::pair<cloth::SphereSource, std::uint64_t>;

  visualization_msgs::Marker marker(const char* ns, int id, int type) const;
  visualization_msgs::Marker drawCloth(const cloth::Surface& surface);
  visualization_msgs::Marker drawSprings(const cloth::Surface& surface) const;
  void addTexture(visualization_msgs::Marker& list, const cloth::Surface& surface);
  void paint(const std::vector<cloth::SurfaceTriangle>& triangles);
  void addTriangles(visualization_msgs::Marker& list, const cloth::Surface& surface) const;
  visualization_msgs::Marker drawTornEdges(const cloth::Surface& surface) const;
  visualization_msgs::Marker drawWeakPoints(const cloth::Surface& surface) const;
  void drawSpheres(visualization_msgs::MarkerArray& markers,
                   const std::vector<cloth::Sphere>& spheres);
  void drawGrasps(visualization_msgs::MarkerArray& markers, const cloth::Snapshot& snapshot) const;
  void forgetSpheres(const std::vector<cloth::Sphere>& present);
  int sphereId(const SphereKey& key);
  float placeInRange(cloth::Real strain) const;
  Color strainColor(cloth::Real strain) const;

  MarkerStyle style_;
  Placement placement_;
  std::map<SphereKey, int> sphere_ids_;
  std::map<int, int> departed_;  ///< marker id -> how often its deletion is still to be told

  // How the checker cuts each triangle; it stays while its texture corners do.
  std::vector<std::array<cloth::Vec2d, 3>> painted_uv_;
  std::vector<std::vector<PaintedCorner>> painted_;
};

}  // namespace cloth_tearing
