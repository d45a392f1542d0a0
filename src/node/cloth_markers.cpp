// Draws a snapshot of the cloth as rviz markers.
#include "cloth_tearing/node/cloth_markers.h"

#include <array>
#include <set>

namespace cloth_tearing
{

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

namespace
{

constexpr int DELETIONS = 30;        // times that a departed sphere is told
constexpr double GRASP_AXIS = 0.06;  // length of a drawn grasp frame's axes [m]

// Springs from slack to the end of the strain range: dark enough for a light background.
constexpr std::array<Color, 3> TENSION = {
  { { 0.40F, 0.53F, 0.80F }, { 0.95F, 0.55F, 0.00F }, { 0.80F, 0.00F, 0.05F } }
};
constexpr double SPRING_WIDTH = 0.5;  // of the width of a torn edge

constexpr Color WHITE = { 1.0F, 1.0F, 1.0F };
constexpr Color TORN_EDGE = { 0.85F, 0.05F, 0.35F };
constexpr Color WEAK_POINT = { 1.00F, 0.85F, 0.00F };
constexpr Color STREAMED_SPHERE = { 0.90F, 0.45F, 0.10F };
constexpr Color THROWN_SPHERE = { 0.35F, 0.45F, 0.60F };
constexpr Color HELD_PARTICLE = { 0.10F, 0.65F, 0.25F };

std_msgs::ColorRGBA rgba(const Color& color)
{
  std_msgs::ColorRGBA message;
  message.r = color[0];
  message.g = color[1];
  message.b = color[2];
  message.a = 1.0F;
  return message;
}

bool drawable(const cloth::Vec3& a, const cloth::Vec3& b)
{
  return a.allFinite() && b.allFinite() && a != b;
}

Color tensionColor(float place)
{
  return place < 0.5F ? between(TENSION[0], TENSION[1], 2.0F * place)
                      : between(TENSION[1], TENSION[2], 2.0F * place - 1.0F);
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

class ClothMarkers::Sheet
{
public:
  Sheet(std::vector<Marker>& markers, const std::string& frame_id)
      : markers_(markers), frame_id_(frame_id)
  {
  }
  ~Sheet() { markers_.resize(used_); }
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;

  /// Good until the next one. Its lists are empty.
  Marker& next(const char* ns, int id, int type)
  {
    Marker& marker = nextToOverwrite(ns, id, type);
    marker.points.clear();
    marker.colors.clear();
    return marker;
  }

  /// The same with lists of any length, to be written over.
  Marker& nextToOverwrite(const char* ns, int id, int type)
  {
    if (used_ == markers_.size())
    {
      markers_.emplace_back();
    }
    Marker& marker = markers_[used_++];
    marker.header.frame_id = frame_id_;
    marker.ns = ns;
    marker.id = id;
    marker.type = type;
    marker.action = Marker::ADD;
    marker.pose = geometry_msgs::Pose();
    marker.pose.orientation.w = 1.0;
    marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
    marker.color = rgba(WHITE);
    return marker;
  }

  void remove(const char* ns, int id, int type) { next(ns, id, type).action = Marker::DELETE; }

private:
  std::vector<Marker>& markers_;
  const std::string& frame_id_;
  std::size_t used_ = 0;
};

ClothMarkers::ClothMarkers(const MarkerStyle& style, const Placement& placement)
    : style_(style), placement_(placement), painter_(style, placement)
{
}

MarkerArray ClothMarkers::draw(const cloth::Snapshot& snapshot)
{
  MarkerArray drawn;
  draw(snapshot, drawn);
  return drawn;
}

void ClothMarkers::draw(const cloth::Snapshot& snapshot, MarkerArray& drawn)
{
  Sheet sheet(drawn.markers, placement_.frame_id);
  drawCloth(sheet, snapshot.surface);
  drawTornEdges(sheet, snapshot.surface);
  drawWeakPoints(sheet, snapshot.surface);
  drawSpheres(sheet, snapshot.spheres);
  drawHeld(sheet, snapshot);
  drawGraspFrames(sheet, snapshot.grasps);
}

// -- cloth ---------------------------------------------------------------------------------------

/// As triangles or as springs; the other list is always deleted.
void ClothMarkers::drawCloth(Sheet& sheet, const cloth::Surface& surface)
{
  if (style_.coloring == Coloring::WIREFRAME)
  {
    sheet.remove("cloth", 0, Marker::TRIANGLE_LIST);
    drawSprings(sheet, surface);
    return;
  }
  Marker& list = sheet.nextToOverwrite("cloth", 0, Marker::TRIANGLE_LIST);
  painter_.draw(surface, list);
  deleteIfEmpty(list);
  sheet.remove("cloth", 1, Marker::LINE_LIST);
}

void ClothMarkers::drawSprings(Sheet& sheet, const cloth::Surface& surface)
{
  Marker& list = sheet.nextToOverwrite("cloth", 1, Marker::LINE_LIST);
  list.scale.x = SPRING_WIDTH * style_.edge_width;
  const std::vector<cloth::SurfaceSpring>& springs = surface.topology->springs;
  findSpringStrains(surface, strains_);
  list.points.resize(2 * springs.size());
  list.colors.resize(2 * springs.size());
  std::size_t drawn = 0;
  for (std::size_t s = 0; s < springs.size(); ++s)
  {
    const cloth::Vec3& a = surface.position[springs[s].particles[0]];
    const cloth::Vec3& b = surface.position[springs[s].particles[1]];
    if (!drawable(a, b))
    {
      continue;
    }
    const std_msgs::ColorRGBA color = rgba(tensionColor(placeInRange(style_, strains_[s])));
    for (const cloth::Vec3* end : { &a, &b })
    {
      list.points[drawn] = toPoint(end->cast<double>(), placement_);
      list.colors[drawn] = color;
      ++drawn;
    }
  }
  list.points.resize(drawn);
  list.colors.resize(drawn);
  deleteIfEmpty(list);
}

// -- what the thesis' figures show ----------------------------------------------------------------

void ClothMarkers::drawTornEdges(Sheet& sheet, const cloth::Surface& surface) const
{
  Marker& list = sheet.next("torn_edges", 0, Marker::LINE_LIST);
  list.scale.x = style_.edge_width;
  list.color = rgba(TORN_EDGE);
  for (const std::array<int, 2>& edge : surface.topology->torn_edges)
  {
    for (const int particle : edge)
    {
      list.points.push_back(toPoint(surface.position[particle].cast<double>(), placement_));
    }
  }
  deleteIfEmpty(list);
}

void ClothMarkers::drawWeakPoints(Sheet& sheet, const cloth::Surface& surface) const
{
  Marker& list = sheet.next("weak_points", 0, Marker::SPHERE_LIST);
  list.scale.x = list.scale.y = list.scale.z = style_.point_size;
  list.color = rgba(WEAK_POINT);
  for (const int particle : surface.topology->weak_points)
  {
    list.points.push_back(toPoint(surface.position[particle].cast<double>(), placement_));
  }
  deleteIfEmpty(list);
}

// -- what touches the cloth -----------------------------------------------------------------------

void ClothMarkers::drawSpheres(Sheet& sheet, const std::vector<cloth::Sphere>& spheres)
{
  forgetSpheres(spheres);
  for (const cloth::Sphere& sphere : spheres)
  {
    Marker& m = sheet.next("spheres", sphereId({ sphere.source, sphere.id }), Marker::SPHERE);
    m.pose.position = toPoint(sphere.center, placement_);
    m.scale.x = m.scale.y = m.scale.z = 2.0 * sphere.radius;
    m.color =
        rgba(sphere.source == cloth::SphereSource::STREAMED ? STREAMED_SPHERE : THROWN_SPHERE);
  }
  for (auto gone = departed_.begin(); gone != departed_.end();)
  {
    sheet.remove("spheres", gone->first, Marker::SPHERE);
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

void ClothMarkers::drawHeld(Sheet& sheet, const cloth::Snapshot& snapshot) const
{
  Marker& list = sheet.next("grasps", 0, Marker::SPHERE_LIST);
  list.scale.x = list.scale.y = list.scale.z = style_.point_size;
  list.color = rgba(HELD_PARTICLE);
  for (const cloth::Grasp& grasp : snapshot.grasps)
  {
    for (const cloth::Grasp::Held& held : grasp.held)
    {
      const cloth::Vec3& at = snapshot.surface.position[held.particle.index];
      list.points.push_back(toPoint(at.cast<double>(), placement_));
    }
  }
  deleteIfEmpty(list);
}

void ClothMarkers::drawGraspFrames(Sheet& sheet, const std::vector<cloth::Grasp>& grasps) const
{
  Marker& list = sheet.next("grasps", 1, Marker::LINE_LIST);
  list.scale.x = style_.edge_width;
  for (const cloth::Grasp& grasp : grasps)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      Color color = { 0.0F, 0.0F, 0.0F };
      color[axis] = 1.0F;
      list.points.push_back(toPoint(grasp.pose.position, placement_));
      list.points.push_back(
          toPoint(grasp.pose.apply(GRASP_AXIS * cloth::Vec3d::Unit(axis)), placement_));
      list.colors.insert(list.colors.end(), 2, rgba(color));
    }
  }
  deleteIfEmpty(list);
}

}  // namespace cloth_tearing
