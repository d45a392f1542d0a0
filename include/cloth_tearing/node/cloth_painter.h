// Draws the triangles of the cloth: cuts them by colour once, then only moves and lights them.
#pragma once

#include <visualization_msgs/Marker.h>

#include <array>
#include <memory>
#include <vector>

#include "cloth_tearing/core/surface.h"
#include "cloth_tearing/node/checker.h"
#include "cloth_tearing/node/conversions.h"
#include "cloth_tearing/node/node_params.h"

namespace cloth_tearing
{

/// The colour at `place`, 0 to 1, between `from` and `to`.
Color between(const Color& from, const Color& to, float place);

/// Where a strain is in the strain range: 0 at its lower end and below, 1 at the upper and above.
float placeInRange(const MarkerStyle& style, cloth::Real strain);

/// Keeps what stays while the topology does. rviz draws lists with colours unlit, so the light is
/// in the colours, the same on both sides.
class ClothPainter
{
public:
  ClothPainter(const MarkerStyle& style, const Placement& placement);

  /// Writes the triangles of `surface` over the points and colours of `list`, three a triangle;
  /// none without area or with a number that is not finite.
  void draw(const cloth::Surface& surface, visualization_msgs::Marker& list);

private:
  /// A triangle of one colour; indices into vertices_.
  struct Part
  {
    std::array<int, 3> corners;
    Color color;
  };

  /// A vertex that is no particle: where a line of the checker crosses a triangle.
  struct Crossing
  {
    std::array<int, 3> particles;
    std::array<float, 3> weights;  ///< of these
  };

  struct Vertex
  {
    cloth::Vec3 position;  ///< [m], cloth frame
    Color light;           ///< what a part's colour is multiplied by
  };

  void cut(const cloth::Surface& surface);
  void cutByTexture(const std::vector<cloth::SurfaceTriangle>& triangles);
  int vertexAt(const cloth::SurfaceTriangle& triangle, const PaintedCorner& corner,
               std::size_t first);
  void placeVertices(const cloth::Surface& surface);
  Color strainColor(cloth::Real strain) const;

  MarkerStyle style_;
  Placement placement_;

  // How the checker cuts each triangle; it stays while its texture corners do.
  std::vector<std::array<cloth::Vec2d, 3>> painted_uv_;
  std::vector<std::vector<PaintedCorner>> painted_;

  std::shared_ptr<const cloth::SurfaceTopology> topology_;  ///< that the following belongs to
  std::size_t particles_ = 0;
  std::vector<Part> parts_;
  std::vector<Crossing> crossings_;

  std::vector<Vertex> vertices_;  ///< the particles, then the crossings
  std::vector<cloth::Vec3> normals_;
  std::vector<cloth::Real> strains_;
};

}  // namespace cloth_tearing
