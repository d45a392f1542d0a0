// Takes the snapshot.
#include "cloth_tearing/core/surface.h"

#include <algorithm>
#include <cmath>

namespace cloth
{
namespace
{

/// Two sides of a triangle that carry nothing any more may be of any length: what is left of it
/// hangs on the third.
bool isRag(const Cloth& cloth, const Triangle& t)
{
  const auto carries = [&cloth](SpringId s) { return cloth.springs.structural[s.index].active(); };
  return std::count_if(t.springs.begin(), t.springs.end(), carries) < 2;
}

/// Which triangles are drawn.
std::vector<char> findDrawn(const Cloth& cloth)
{
  std::vector<char> drawn(cloth.mesh.triangleCount());
  for (int i = 0; i < cloth.mesh.triangleCount(); ++i)
  {
    const Triangle& t = cloth.mesh.triangle({ i });
    drawn[i] = !cloth.damage.at_rest[t.particles[0].index] && !isRag(cloth, t);
  }
  return drawn;
}

void addTriangles(const Cloth& cloth, const std::vector<char>& drawn, SurfaceTopology& topology)
{
  topology.triangles.reserve(drawn.size());
  for (int i = 0; i < cloth.mesh.triangleCount(); ++i)
  {
    if (drawn[i])
    {
      const Triangle& t = cloth.mesh.triangle({ i });
      topology.triangles.push_back(
          { { t.particles[0].index, t.particles[1].index, t.particles[2].index }, t.uv });
    }
  }
}

void addSprings(const Cloth& cloth, const std::vector<char>& drawn, SurfaceTopology& topology)
{
  topology.springs.reserve(cloth.mesh.springCount());
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    const Spring& spring = cloth.mesh.spring({ i });
    const std::array<int, 2> ends = { spring.particles[0].index, spring.particles[1].index };
    if (cloth.damage.at_rest[ends[0]])
    {
      continue;
    }
    if (cloth.springs.structural[i].active())
    {
      topology.springs.push_back({ ends, cloth.rest.length[i] });
    }
    const auto is_drawn = [&drawn](TriangleId t) { return t.valid() && drawn[t.index]; };
    if (!cloth.damage.outer[i] && is_drawn(spring.triangles[0]) != is_drawn(spring.triangles[1]))
    {
      topology.torn_edges.push_back(ends);  // cloth ends there, and it is no part of its outline
    }
  }
}

void addWeakPoints(const Cloth& cloth, SurfaceTopology& topology)
{
  for (int i = 0; i < cloth.mesh.particleCount(); ++i)
  {
    if (cloth.damage.weak[i] && !cloth.damage.at_rest[i])
    {
      topology.weak_points.push_back(i);
    }
  }
}

Real strainOf(const Surface& surface, const SurfaceSpring& spring)
{
  const Vec3d a = surface.position[spring.particles[0]].cast<double>();
  const Vec3d b = surface.position[spring.particles[1]].cast<double>();
  return static_cast<Real>((b - a).norm() / spring.rest_length - 1.0);
}

}  // namespace

SurfaceTopology makeTopology(const Cloth& cloth)
{
  SurfaceTopology topology;
  topology.revision = cloth.damage.tears;
  topology.parents = cloth.damage.parents;
  const std::vector<char> drawn = findDrawn(cloth);
  addTriangles(cloth, drawn, topology);
  addSprings(cloth, drawn, topology);
  addWeakPoints(cloth, topology);
  return topology;
}

void takeMotion(const Cloth& cloth, Surface& surface)
{
  surface.position.resize(cloth.mesh.particleCount());
  surface.held.clear();
  for (int i = 0; i < cloth.mesh.particleCount(); ++i)
  {
    surface.position[i] = cloth.state.position[i];
    if (cloth.attachments[i].held())
    {
      surface.held.push_back({ i, cloth.attachments[i].grasp });
    }
  }
}

Surface makeSurface(const Cloth& cloth)
{
  Surface surface;
  takeMotion(cloth, surface);
  surface.topology = std::make_shared<const SurfaceTopology>(makeTopology(cloth));
  return surface;
}

void findNormals(const Surface& surface, std::vector<Vec3>& result)
{
  result.assign(surface.position.size(), Vec3::Zero());
  for (const SurfaceTriangle& t : surface.topology->triangles)
  {
    const Vec3& a = surface.position[t.particles[0]];
    const Vec3& b = surface.position[t.particles[1]];
    const Vec3& c = surface.position[t.particles[2]];
    const Vec3 normal = (b - a).cross(c - a);  // twice the area long
    for (int corner : t.particles)
    {
      result[corner] += normal;
    }
  }
  for (Vec3& normal : result)
  {
    const Real length = std::sqrt(normal.squaredNorm());
    normal = length > 0 ? Vec3(normal / length) : Vec3(Vec3::UnitZ());
  }
}

void findSpringStrains(const Surface& surface, std::vector<Real>& result)
{
  const std::vector<SurfaceSpring>& springs = surface.topology->springs;
  result.resize(springs.size());
  for (std::size_t i = 0; i < springs.size(); ++i)
  {
    result[i] = strainOf(surface, springs[i]);
  }
}

void findParticleStrains(const Surface& surface, std::vector<Real>& result)
{
  result.assign(surface.position.size(), Real(0));
  for (const SurfaceSpring& spring : surface.topology->springs)
  {
    const Real strain = strainOf(surface, spring);
    for (int end : spring.particles)
    {
      result[end] = std::max(result[end], strain);
    }
  }
}

}  // namespace cloth
