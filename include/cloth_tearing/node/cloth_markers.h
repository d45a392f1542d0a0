// Draws a snapshot of the cloth as rviz markers.
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "cloth_tearing/core/surface.h"
#include "cloth_tearing/node/cloth_painter.h"
#include "cloth_tearing/node/conversions.h"
#include "cloth_tearing/node/node_params.h"

namespace cloth_tearing
{

/// Namespaces cloth (0 its triangles, 1 its springs: one or the other), torn_edges, weak_points,
/// spheres and grasps; fixed ids. What is not there is deleted: there is never an empty list, a
/// triangle without area or a number that is not finite.
class ClothMarkers
{
public:
  ClothMarkers(const MarkerStyle& style, const Placement& placement);

  /// Writes over `drawn`, whose memory is used again. The markers carry no stamp yet. A sphere
  /// keeps its id while it is there; the deletion of one that is gone is repeated for a while,
  /// should a message be lost.
  void draw(const cloth::Snapshot& snapshot, visualization_msgs::MarkerArray& drawn);

  visualization_msgs::MarkerArray draw(const cloth::Snapshot& snapshot);

private:
  using SphereKey = std::pair<cloth::SphereSource, std::uint64_t>;
  using Marker = visualization_msgs::Marker;

  /// Markers that are written over those of before, one after the other.
  class Sheet;

  void drawCloth(Sheet& sheet, const cloth::Surface& surface);
  void drawSprings(Sheet& sheet, const cloth::Surface& surface);
  void drawTornEdges(Sheet& sheet, const cloth::Surface& surface) const;
  void drawWeakPoints(Sheet& sheet, const cloth::Surface& surface) const;
  void drawSpheres(Sheet& sheet, const std::vector<cloth::Sphere>& spheres);
  void drawHeld(Sheet& sheet, const cloth::Snapshot& snapshot) const;
  void drawGraspFrames(Sheet& sheet, const std::vector<cloth::Grasp>& grasps) const;
  void forgetSpheres(const std::vector<cloth::Sphere>& present);
  int sphereId(const SphereKey& key);

  MarkerStyle style_;
  Placement placement_;
  ClothPainter painter_;
  std::vector<cloth::Real> strains_;  ///< of the springs
  std::map<SphereKey, int> sphere_ids_;
  std::map<int, int> departed_;  ///< marker id -> how often its deletion is still to be told
};

}  // namespace cloth_tearing
