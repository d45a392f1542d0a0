// Draws the triangles of the cloth: cuts them by colour once, then only moves and lights them.
#include "cloth_tearing/node/cloth_painter.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cloth_tearing
{

namespace
{

// Fixed light from the upper left in front of the cloth, and as much from everywhere.
const cloth::Vec3 LIGHT = cloth::Vec3(-0.50F, -0.70F, 0.50F).normalized();
constexpr float AMBIENT = 0.42F;

constexpr float LEAST_AREA = 1e-12F;  // of a drawn triangle [m^2]

constexpr Color WHITE = { 1.0F, 1.0F, 1.0F };

/// Lambert's law on both sides.
float lightOn(const cloth::Vec3& normal)
{
  return AMBIENT + (1.0F - AMBIENT) * std::min(1.0F, std::abs(normal.dot(LIGHT)));
}

Color scaled(const Color& color, float factor)
{
  return { color[0] * factor, color[1] * factor, color[2] * factor };
}

bool drawable(const cloth::Vec3& a, const cloth::Vec3& b, const cloth::Vec3& c)
{
  const float squared = (b - a).cross(c - a).squaredNorm();  // of twice the area
  return squared > 4.0F * LEAST_AREA * LEAST_AREA && squared <= std::numeric_limits<float>::max();
}

bool sameTexture(const std::array<cloth::Vec2d, 3>& a, const std::array<cloth::Vec2d, 3>& b)
{
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

cloth::Vec3 weighted(const std::vector<cloth::Vec3>& values, const std::array<int, 3>& particles,
                     const std::array<float, 3>& weights)
{
  return weights[0] * values[particles[0]] + weights[1] * values[particles[1]] +
         weights[2] * values[particles[2]];
}

}  // namespace

Color between(const Color& from, const Color& to, float place)
{
  return { from[0] + place * (to[0] - from[0]), from[1] + place * (to[1] - from[1]),
           from[2] + place * (to[2] - from[2]) };
}

float placeInRange(const MarkerStyle& style, cloth::Real strain)
{
  const double low = style.strain_range[0];
  const double high = style.strain_range[1];
  return static_cast<float>(std::min(1.0, std::max(0.0, (strain - low) / (high - low))));
}

ClothPainter::ClothPainter(const MarkerStyle& style, const Placement& placement)
    : style_(style), placement_(placement)
{
}

void ClothPainter::draw(const cloth::Surface& surface, visualization_msgs::Marker& list)
{
  if (surface.topology != topology_)
  {
    cut(surface);
  }
  placeVertices(surface);
  list.points.resize(3 * parts_.size());
  list.colors.resize(3 * parts_.size());
  std::size_t drawn = 0;
  for (const Part& part : parts_)
  {
    if (!drawable(vertices_[part.corners[0]].position, vertices_[part.corners[1]].position,
                  vertices_[part.corners[2]].position))
    {
      continue;
    }
    for (const int corner : part.corners)
    {
      const Vertex& vertex = vertices_[corner];
      list.points[drawn] = toPoint(vertex.position.cast<double>(), placement_);
      std_msgs::ColorRGBA& color = list.colors[drawn];
      color.r = part.color[0] * vertex.light[0];
      color.g = part.color[1] * vertex.light[1];
      color.b = part.color[2] * vertex.light[2];
      color.a = 1.0F;
      ++drawn;
    }
  }
  list.points.resize(drawn);
  list.colors.resize(drawn);
}

// -- while the topology stays --------------------------------------------------------------------

void ClothPainter::cut(const cloth::Surface& surface)
{
  topology_ = surface.topology;
  particles_ = surface.position.size();
  parts_.clear();
  crossings_.clear();
  if (style_.coloring == Coloring::TEXTURE)
  {
    cutByTexture(topology_->triangles);
    return;
  }
  const Color plain = { static_cast<float>(style_.plain_color[0]),
                        static_cast<float>(style_.plain_color[1]),
                        static_cast<float>(style_.plain_color[2]) };
  for (const cloth::SurfaceTriangle& triangle : topology_->triangles)
  {
    parts_.push_back({ triangle.particles, style_.coloring == Coloring::PLAIN ? plain : WHITE });
  }
}

void ClothPainter::cutByTexture(const std::vector<cloth::SurfaceTriangle>& triangles)
{
  painted_uv_.resize(triangles.size());
  painted_.resize(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    const cloth::SurfaceTriangle& triangle = triangles[t];
    std::vector<PaintedCorner>& corners = painted_[t];
    if (corners.empty() || !sameTexture(painted_uv_[t], triangle.uv))
    {
      painted_uv_[t] = triangle.uv;
      corners = cutByChecks(triangle.uv, style_.checks);
    }
    const std::size_t first = crossings_.size();
    for (std::size_t c = 0; c + 3 <= corners.size(); c += 3)
    {
      parts_.push_back(
          { { vertexAt(triangle, corners[c], first), vertexAt(triangle, corners[c + 1], first),
              vertexAt(triangle, corners[c + 2], first) },
            corners[c].color });
    }
  }
}

/// @param first crossing of this triangle: parts of it share their vertices
int ClothPainter::vertexAt(const cloth::SurfaceTriangle& triangle, const PaintedCorner& corner,
                           std::size_t first)
{
  const auto whole = std::find(corner.weights.begin(), corner.weights.end(), 1.0F);
  if (whole != corner.weights.end())
  {
    return triangle.particles[whole - corner.weights.begin()];
  }
  const auto known = std::find_if(
      crossings_.begin() + static_cast<std::ptrdiff_t>(first), crossings_.end(),
      [&corner](const Crossing& crossing) { return crossing.weights == corner.weights; });
  const std::ptrdiff_t index = known - crossings_.begin();
  if (known == crossings_.end())
  {
    crossings_.push_back({ triangle.particles, corner.weights });
  }
  return static_cast<int>(particles_) + static_cast<int>(index);
}

// -- in every frame ------------------------------------------------------------------------------

void ClothPainter::placeVertices(const cloth::Surface& surface)
{
  findNormals(surface, normals_);
  const bool by_strain = style_.coloring == Coloring::STRAIN;
  if (by_strain)
  {
    findParticleStrains(surface, strains_);
  }
  vertices_.resize(particles_ + crossings_.size());
  for (std::size_t p = 0; p < particles_; ++p)
  {
    const Color color = by_strain ? strainColor(strains_[p]) : WHITE;
    vertices_[p] = { surface.position[p], scaled(color, lightOn(normals_[p])) };
  }
  for (std::size_t c = 0; c < crossings_.size(); ++c)
  {
    const auto& [particles, weights] = crossings_[c];
    vertices_[particles_ + c] = { weighted(surface.position, particles, weights),
                                  scaled(WHITE, lightOn(weighted(normals_, particles, weights))) };
  }
}

Color ClothPainter::strainColor(cloth::Real strain) const
{
  const float place = placeInRange(style_, strain);
  const Color end = place < 0.5F ? Color{ 0.10F, 0.25F, 0.85F } : Color{ 0.85F, 0.10F, 0.10F };
  return between(WHITE, end, std::abs(2.0F * place - 1.0F));
}

}  // namespace cloth_tearing
