// Turns a surface message into what a graphics card draws, and refuses one that makes no sense.
#include "cloth_tearing/rviz/surface_mesh.h"

#include <cmath>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/refusal.h"

namespace cloth_tearing
{

namespace
{

using Problems = std::vector<std::string>;

// What float and a graphics card can still show.
constexpr double MAX_POSITION = 1e6;  // [m]
constexpr double MAX_ORIGIN = 1e9;    // [m]
constexpr double MAX_UV = 1e6;        // [-]
constexpr double MAX_STRAIN = 1e6;    // [-]

constexpr std::size_t MAX_ELEMENTS =
    50000000;  // of one array: indices and sizes stay well in 32 bits

constexpr int MOST_PLACES = 16;  // in the texture at one particle that are searched

std::string element(const char* field, std::size_t index)
{
  return std::string(field) + "[" + std::to_string(index) + "]";
}

void checkSize(Problems& found, const char* field, std::size_t size, std::size_t expected,
               const char* reason)
{
  if (size != expected)
  {
    found.push_back(std::string(field) + " has " + std::to_string(size) + " elements, must have " +
                    std::to_string(expected) + ": " + reason);
  }
}

void checkMultiple(Problems& found, const char* field, std::size_t size, std::size_t divisor)
{
  if (size % divisor != 0)
  {
    found.push_back(std::string(field) + " has " + std::to_string(size) +
                    " elements, must have a multiple of " + std::to_string(divisor));
  }
  if (size > MAX_ELEMENTS)
  {
    found.push_back(std::string(field) + " has " + std::to_string(size) +
                    " elements, must have at most " + std::to_string(MAX_ELEMENTS));
  }
}

/// Names the first value that is not finite or beyond the limit.
void checkValues(Problems& found, const char* field, const std::vector<float>& values, double limit)
{
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    if (!(std::abs(values[i]) <= limit))
    {
      cloth::check(found, element(field, i), values[i], cloth::Range::between(-limit, limit));
      return;
    }
  }
}

void checkIndex(Problems& found, const std::string& field, std::uint32_t value,
                std::size_t particles)
{
  if (value >= particles)
  {
    found.push_back(field + " is " + std::to_string(value) + ", must be below " +
                    std::to_string(particles) + ", the number of particles");
  }
}

/// Names the first index that has no particle.
void checkIndices(Problems& found, const char* field, const std::vector<std::uint32_t>& indices,
                  std::size_t particles)
{
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    if (indices[i] >= particles)
    {
      checkIndex(found, element(field, i), indices[i], particles);
      return;
    }
  }
}

void checkHeld(Problems& found, const std::vector<HeldParticle>& held, std::size_t particles)
{
  for (std::size_t i = 0; i < held.size(); ++i)
  {
    if (held[i].particle >= particles)
    {
      checkIndex(found, element("held", i) + ".particle", held[i].particle, particles);
      return;
    }
  }
}

/// Gives the corners of triangles their vertices.
class VertexFinder
{
public:
  VertexFinder(std::size_t particles, std::vector<MeshVertex>& vertices)
      : latest_(particles, NONE), vertices_(vertices)
  {
  }

  /// The vertex of that particle at that place, a new one if there is none. Of very many places at
  /// one particle only the latest are searched: drawn the same, in bounded time.
  std::uint32_t find(const MeshVertex& wanted)
  {
    std::uint32_t& latest = latest_[wanted.particle];
    std::uint32_t vertex = latest;
    for (int searched = 0; vertex != NONE && searched < MOST_PLACES; ++searched)
    {
      if (vertices_[vertex].u == wanted.u && vertices_[vertex].v == wanted.v)
      {
        return vertex;
      }
      vertex = earlier_[vertex];
    }
    earlier_.push_back(latest);
    latest = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back(wanted);
    return latest;
  }

private:
  static constexpr std::uint32_t NONE = 0xFFFFFFFF;

  std::vector<std::uint32_t> latest_;   ///< vertex of each particle
  std::vector<std::uint32_t> earlier_;  ///< of each vertex: the one before at the same particle
  std::vector<MeshVertex>& vertices_;
};

}  // namespace

std::vector<std::string> surfaceProblems(const ClothSurface& message)
{
  Problems found;
  if (message.header.frame_id.empty())
  {
    found.push_back("header.frame_id is empty, must name a frame");
  }
  const std::size_t particles = message.positions.size() / 3;
  checkMultiple(found, "positions", message.positions.size(), 3);
  checkMultiple(found, "triangles", message.triangles.size(), 3);
  checkMultiple(found, "torn_edges", message.torn_edges.size(), 2);
  checkSize(found, "strain", message.strain.size(), particles, "one of each particle");
  checkSize(found, "parents", message.parents.size(), 2 * particles, "two of each particle");
  checkSize(found, "uv", message.uv.size(), 2 * message.triangles.size(),
            "two of each corner of a triangle");

  const geometry_msgs::Point& origin = message.origin;
  cloth::check(found, "origin", cloth::Vec3d(origin.x, origin.y, origin.z), MAX_ORIGIN);
  checkValues(found, "positions", message.positions, MAX_POSITION);
  checkValues(found, "strain", message.strain, MAX_STRAIN);
  checkValues(found, "uv", message.uv, MAX_UV);

  checkIndices(found, "triangles", message.triangles, particles);
  checkIndices(found, "parents", message.parents, particles);
  checkIndices(found, "torn_edges", message.torn_edges, particles);
  checkIndices(found, "weak_points", message.weak_points, particles);
  checkHeld(found, message.held, particles);
  return found;
}

bool SurfaceMesh::take(const ClothSurface& message)
{
  cloth::refuseIf(surfaceProblems(message));
  const bool changed = !sameTopology(message);
  positions_.resize(message.positions.size() / 3);
  for (std::size_t p = 0; p < positions_.size(); ++p)
  {
    positions_[p] = cloth::Vec3(&message.positions[3 * p]);
  }
  if (changed)
  {
    makeVertices(message);
  }
  makeNormals();
  return changed;
}

/// The arrays tell more than revision and epoch: of two nodes in turn, or of one that starts again,
/// both may be the same.
bool SurfaceMesh::sameTopology(const ClothSurface& message) const
{
  return message.triangles == triangles_ && message.uv == uv_;
}

void SurfaceMesh::makeVertices(const ClothSurface& message)
{
  triangles_ = message.triangles;
  uv_ = message.uv;
  vertices_.clear();
  indices_.clear();
  indices_.reserve(triangles_.size());

  VertexFinder finder(positions_.size(), vertices_);
  for (std::size_t corner = 0; corner < triangles_.size(); ++corner)
  {
    indices_.push_back(finder.find({ triangles_[corner], uv_[2 * corner], uv_[2 * corner + 1] }));
  }
}

void SurfaceMesh::makeNormals()
{
  normals_.assign(positions_.size(), cloth::Vec3::Zero());
  for (std::size_t t = 0; t < triangles_.size(); t += 3)
  {
    const cloth::Vec3& a = positions_[triangles_[t]];
    const cloth::Vec3& b = positions_[triangles_[t + 1]];
    const cloth::Vec3& c = positions_[triangles_[t + 2]];
    const cloth::Vec3 normal = (b - a).cross(c - a);  // twice the area long
    for (std::size_t corner = t; corner < t + 3; ++corner)
    {
      normals_[triangles_[corner]] += normal;
    }
  }
  for (cloth::Vec3& normal : normals_)
  {
    const float length = normal.norm();
    normal = length > 0.0F ? cloth::Vec3(normal / length) : cloth::Vec3(cloth::Vec3::UnitZ());
  }
}

}  // namespace cloth_tearing
