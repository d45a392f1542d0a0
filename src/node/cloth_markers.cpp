// Draws a snapshot of the cloth as rviz markers.
#include "cloth_tearing/node/cloth_markers.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace cloth_tearing
{

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

namespace
{

// Fixed light from the upper left in front of the cloth, and as much from everywhere.
const cloth::Vec3 LIGHT = cloth::Vec3(-0.50F, -0.70F, 0.50F).normalized();
constexpr float AMBIENT = 0.42F;

constexpr float LEAST_AREA = 1e-12F;  // of a drawn triangle [m^2]
constexpr int DELETIONS = 30;         // times that a departed sphere is told
constexpr double GRASP_AXIS = 0.06;   // length of a drawn grasp frame's axes [m]

// Springs from slack to the end of the strain range: dark enough for a light background.
constexpr std::array<Color, 3> TENSION = {
  { { 0.40F, 0.53F, 0.80F }, { 0.95F, 0.55F, 0.00F }, { 0.80F, 0.00F, 0.05F } }
};
constexpr double SPRING_WIDTH = 0.5;  // of the width of a torn edge

constexpr Color TORN_EDGE = { 0.85F, 0.05F, 0.35F };
constexpr Color WEAK_POINT = { 1.00F, 0.85F, 0.00F };
constexpr Color STREAMED_SPHERE = { 0.90F, 0.45F, 0.10F };
constexpr Color THROWN_SPHERE = { 0.35F, 0.45F, 0.60F };
constexpr Color HELD_PARTICLE = { 0.10F, 0.65F, 0.25F };

std_msgs::ColorRGBA rgba(const Color& color, float light = 1.0F)
{
  std_msgs::ColorRGBA message;
  message.r = color[0] * light;
  message.g = color[1] * light;
  message.b = color[2] * light;
  message.a = 1.0F;
  return message;
}

/// Lambert's law on both sides.
float lightOn(const cloth::Vec3& normal)
{
  return AMBIENT + (1.0F - AMBIENT) * std::min(1.0F, std::abs(normal.dot(LIGHT)));
}

bool drawable(const cloth::Vec3& a, const cloth::Vec3& b, const cloth::Vec3& c)
{
  const float area = 0.5F * (b - a).cross(c - a).norm();
  return std::isfinite(area) && area > LEAST_AREA;
}

bool drawable(const cloth::Vec3& a, const cloth::Vec3& b)
{
  return a.allFinite() && b.allFinite() && a != b;
}

/// The colour at `place`, 0 to 1, between `from` and `to`.
Color between(const Color& from, const Color& to, float place)
{
  return { from[0] + place * (to[0] - from[0]), from[1] + place * (to[1] - from[1]),
           from[2] + place * (to[2] - from[2]) };
}

bool sameTexture(const std::array<cloth::Vec2d, 3>& a, const std::array<cloth::Vec2d, 3>& b)
{
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

cloth::Vec3 weighted(const std::array<cloth::Vec3, 3>& values, const PaintedCorner& corner)
{
  return corner.weights[0] * values[0] + corner.weights[1] * values[1] +
         corner.weights[2] * values[2];
}

/// A list with nothing in it is a deletion.
void deleteIfEmpty(Marker& list)
{
  if (list.points.empty())
  {
    list.action = Marker::DELETE;
  }
}

}  // namespace

ClothMarkers::ClothMarkers(const MarkerStyle& style, const Placement& placement)
    : style_(style), placement_(placement)
{
}

Marker ClothMarkers::marker(const char* ns, int id, int type) const
{
  Marker m;
  m.header.frame_id = placement_.frame_id;
  m.ns = ns;
  m.id = id;
  m.type = type;
  m.action = Marker::ADD;
  m.pose.orientation.w = 1.0;
  m.scale.x = m.scale.y = m.scale.z = 1.0;
  m.color = rgba({ 1.0F, 1.0F, 1.0F });
  return m;
}

MarkerArray ClothMarkers::draw(const cloth::Snapshot& snapshot)
{
  MarkerArray markers;
  markers.markers.push_back(drawCloth(snapshot.surface));
  markers.markers.push_back(drawSprings(snapshot.surface));
  markers.markers.push_back(drawTornEdges(snapshot.surface));
  markers.markers.push_back(drawWeakPoints(snapshot.surface));
  drawSpheres(markers, snapshot.spheres);
  drawGrasps(markers, snapshot);
  return markers;
}

// -- cloth ---------------------------------------------------------------------------------------

Marker ClothMarkers::drawCloth(const cloth::Surface& surface)
{
  Marker list = marker("cloth", 0, Marker::TRIANGLE_LIST);
  if (style_.coloring == Coloring::TEXTURE)
  {
    addTexture(list, surface);
  }
  else if (style_.coloring != Coloring::WIREFRAME)
  {
    addTriangles(list, surface);
  }
  deleteIfEmpty(list);
  return list;
}

/// The other way to draw the cloth: one of the two lists is always deleted.
Marker ClothMarkers::drawSprings(const cloth::Surface& surface) const
{
  Marker list = marker("cloth", 1, Marker::LINE_LIST);
  list.scale.x = SPRING_WIDTH * style_.edge_width;
  if (style_.coloring == Coloring::WIREFRAME)
  {
    for (const cloth::SurfaceSpring& spring : surface.springs)
    {
      const cloth::Vec3& a = surface.position[spring.particles[0]];
      const cloth::Vec3& b = surface.position[spring.particles[1]];
      if (!drawable(a, b))
      {
        continue;
      }
      const float place = 2.0F * placeInRange(spring.strain);
      const Color color = place < 1.0F ? between(TENSION[0], TENSION[1], place)
                                       : between(TENSION[1], TENSION[2], place - 1.0F);
      list.points.push_back(toPoint(a.cast<double>(), placement_));
      list.points.push_back(toPoint(b.cast<double>(), placement_));
      list.colors.insert(list.colors.end(), 2, rgba(color));
    }
  }
  deleteIfEmpty(list);
  return list;
}

void ClothMarkers::addTexture(Marker& list, const cloth::Surface& surface)
{
  paint(surface.triangles);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const std::array<int, 3>& p = surface.triangles[t].particles;
    const std::array<cloth::Vec3, 3> x = { surface.position[p[0]], surface.position[p[1]],
                                           surface.position[p[2]] };
    const std::array<cloth::Vec3, 3> normal = { surface.normal[p[0]], surface.normal[p[1]],
                                                surface.normal[p[2]] };
    const std::vector<PaintedCorner>& corners = painted_[t];
    for (std::size_t c = 0; c + 3 <= corners.size(); c += 3)
    {
      if (!drawable(weighted(x, corners[c]), weighted(x, corners[c + 1]),
                    weighted(x, corners[c + 2])))
      {
        continue;
      }
      for (std::size_t k = c; k < c + 3; ++k)
      {
        list.points.push_back(toPoint(weighted(x, corners[k]).cast<double>(), placement_));
        list.colors.push_back(rgba(corners[k].color, lightOn(weighted(normal, corners[k]))));
      }
    }
  }
}

/// Cuts the triangles whose texture corners are new.
void ClothMarkers::paint(const std::vector<cloth::SurfaceTriangle>& triangles)
{
  painted_uv_.resize(triangles.size());
  painted_.resize(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    if (painted_[t].empty() || !sameTexture(painted_uv_[t], triangles[t].uv))
    {
      painted_uv_[t] = triangles[t].uv;
      painted_[t] = cutByChecks(triangles[t].uv, style_.checks);
    }
  }
}

void ClothMarkers::addTriangles(Marker& list, const cloth::Surface& surface) const
{
  const Color plain = { static_cast<float>(style_.plain_color[0]),
                        static_cast<float>(style_.plain_color[1]),
                        static_cast<float>(style_.plain_color[2]) };
  for (const cloth::SurfaceTriangle& triangle : surface.triangles)
  {
    const std::array<int, 3>& p = triangle.particles;
    if (!drawable(surface.position[p[0]], surface.position[p[1]], surface.position[p[2]]))
    {
      continue;
    }
    for (const int particle : p)
    {
      const Color color =
          style_.coloring == Coloring::STRAIN ? strainColor(surface.strain[particle]) : plain;
      list.points.push_back(toPoint(surface.position[particle].cast<double>(), placement_));
      list.colors.push_back(rgba(color, lightOn(surface.normal[particle])));
    }
  }
}

/// 0 at the lower end of the strain range and below, 1 at the upper end and above.
float ClothMarkers::placeInRange(cloth::Real strain) const
{
  const double low = style_.strain_range[0];
  const double high = style_.strain_range[1];
  return static_cast<float>(std::min(1.0, std::max(0.0, (strain - low) / (high - low))));
}

Color ClothMarkers::strainColor(cloth::Real strain) const
{
  const float place = placeInRange(strain);
  const Color end = place < 0.5F ? Color{ 0.10F, 0.25F, 0.85F } : Color{ 0.85F, 0.10F, 0.10F };
  return between({ 1.0F, 1.0F, 1.0F }, end, std::abs(2.0F * place - 1.0F));
}

// -- what the thesis' figures show ----------------------------------------------------------------

Marker ClothMarkers::drawTornEdges(const cloth::Surface& surface) const
{
  Marker list = marker("torn_edges", 0, Marker::LINE_LIST);
  list.scale.x = style_.edge_width;
  list.color = rgba(TORN_EDGE);
  for (const std::array<int, 2>& edge : surface.torn_edges)
  {
    for (const int particle : edge)
    {
      list.points.push_back(toPoint(surface.position[particle].cast<double>(), placement_));
    }
  }
  deleteIfEmpty(list);
  return list;
}

Marker ClothMarkers::drawWeakPoints(const cloth::Surface& surface) const
{
  Marker list = marker("weak_points", 0, Marker::SPHERE_LIST);
  list.scale.x = list.scale.y = list.scale.z = style_.point_size;
  list.color = rgba(WEAK_POINT);
  for (const int particle : surface.weak_points)
  {
    list.points.push_back(toPoint(surface.position[particle].cast<double>(), placement_));
  }
  deleteIfEmpty(list);
  return list;
}

// -- what touches the cloth -----------------------------------------------------------------------

void ClothMarkers::drawSpheres(MarkerArray& markers, const std::vector<cloth::Sphere>& spheres)
{
  forgetSpheres(spheres);
  for (const cloth::Sphere& sphere : spheres)
  {
    Marker m = marker("spheres", sphereId({ sphere.source, sphere.id }), Marker::SPHERE);
    m.pose.position = toPoint(sphere.center, placement_);
    m.scale.x = m.scale.y = m.scale.z = 2.0 * sphere.radius;
    m.color =
        rgba(sphere.source == cloth::SphereSource::STREAMED ? STREAMED_SPHERE : THROWN_SPHERE);
    markers.markers.push_back(m);
  }
  for (auto gone = departed_.begin(); gone != departed_.end();)
  {
    Marker m = marker("spheres", gone->first, Marker::SPHERE);
    m.action = Marker::DELETE;
    markers.markers.push_back(m);
    gone = --gone->second > 0 ? std::next(gone) : departed_.erase(gone);
  }
}

void ClothMarkers::forgetSpheres(const std::vector<cloth::Sphere>& present)
{
  std::set<SphereKey> keys;
  for (const cloth::Sphere& sphere : present)
  {
    keys.insert({ sphere.source, sphere.id });
  }
  for (auto known = sphere_ids_.begin(); known != sphere_ids_.end();)
  {
    if (keys.count(known->first) > 0)
    {
      ++known;
      continue;
    }
    departed_[known->second] = DELETIONS;
    known = sphere_ids_.erase(known);
  }
}

/// The least number that no present sphere has.
int ClothMarkers::sphereId(const SphereKey& key)
{
  const auto known = sphere_ids_.find(key);
  if (known != sphere_ids_.end())
  {
    return known->second;
  }
  std::set<int> taken;
  for (const auto& entry : sphere_ids_)
  {
    taken.insert(entry.second);
  }
  int id = 0;
  while (taken.count(id) > 0)
  {
    ++id;
  }
  departed_.erase(id);
  sphere_ids_[key] = id;
  return id;
}

void ClothMarkers::drawGrasps(MarkerArray& markers, const cloth::Snapshot& snapshot) const
{
  Marker held = marker("grasps", 0, Marker::SPHERE_LIST);
  held.scale.x = held.scale.y = held.scale.z = style_.point_size;
  held.color = rgba(HELD_PARTICLE);
  Marker frames = marker("grasps", 1, Marker::LINE_LIST);
  frames.scale.x = style_.edge_width;
  for (const cloth::Grasp& grasp : snapshot.grasps)
  {
    for (const cloth::Grasp::Held& particle : grasp.held)
    {
      held.points.push_back(
          toPoint(snapshot.surface.position[particle.particle.index].cast<double>(), placement_));
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      Color color = { 0.0F, 0.0F, 0.0F };
      color[axis] = 1.0F;
      frames.points.push_back(toPoint(grasp.pose.position, placement_));
      frames.points.push_back(
          toPoint(grasp.pose.apply(GRASP_AXIS * cloth::Vec3d::Unit(axis)), placement_));
      frames.colors.insert(frames.colors.end(), 2, rgba(color));
    }
  }
  deleteIfEmpty(held);
  deleteIfEmpty(frames);
  markers.markers.push_back(held);
  markers.markers.push_back(frames);
}

}  // namespace cloth_tearing
