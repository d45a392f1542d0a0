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

bool isDrawn(const Cloth& cloth, const Triangle& t)
{
  return !cloth.damage.at_rest[t.particles[0].index] && !isRag(cloth, t);
}

void addTriangles(const Cloth& cloth, Surface& surface)
{
  surface.normal.assign(cloth.mesh.particleCount(), Vec3::Zero());
  surface.triangles.reserve(cloth.mesh.triangleCount());
  for (int i = 0; i < cloth.mesh.triangleCount(); ++i)
  {
    const Triangle& t = cloth.mesh.triangle({ i });
    const std::array<int, 3> p = { t.particles[0].index, t.particles[1].index,
                                   t.particles[2].index };
    if (!isDrawn(cloth, t))
    {
      continue;
    }
    surface.triangles.push_back({ p, t.uv });
    const auto& x = cloth.state.position;
    const Vec3 normal = (x[p[1]] - x[p[0]]).cross(x[p[2]] - x[p[0]]);  // twice the area long
    for (int corner : p)
    {
      surface.normal[corner] += normal;
    }
  }
  for (Vec3& normal : surface.normal)
  {
    const Real length = std::sqrt(normal.squaredNorm());
    normal = length > 0 ? Vec3(normal / length) : Vec3(Vec3::UnitZ());
  }
}

/// Whether cloth ends at a spring that is no part of its outline.
bool isTornEdge(const Cloth& cloth, SpringId s)
{
  const auto& triangles = cloth.mesh.spring(s).triangles;
  const auto drawn = [&cloth](TriangleId t)
  { return t.valid() && isDrawn(cloth, cloth.mesh.triangle(t)); };
  return !cloth.damage.outer[s.index] &&
         std::count_if(triangles.begin(), triangles.end(), drawn) == 1;
}

void addSprings(const Cloth& cloth, Surface& surface)
{
  surface.strain.assign(cloth.mesh.particleCount(), Real(0));
  surface.springs.reserve(cloth.mesh.springCount());
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    const SpringId s{ i };
    const Spring& spring = cloth.mesh.spring(s);
    const std::array<int, 2> ends = { spring.particles[0].index, spring.particles[1].index };
    if (cloth.damage.at_rest[ends[0]])
    {
      continue;
    }
    if (cloth.springs.structural[i].active())
    {
      const auto strain = static_cast<Real>(cloth.strain(s));
      surface.springs.push_back({ ends, strain });
      surface.strain[ends[0]] = std::max(surface.strain[ends[0]], strain);
      surface.strain[ends[1]] = std::max(surface.strain[ends[1]], strain);
    }
    if (isTornEdge(cloth, s))
    {
      surface.torn_edges.push_back(ends);
    }
  }
}

void addParticles(const Cloth& cloth, Surface& surface)
{
  surface.position = cloth.state.position.toVectors();
  surface.parents = cloth.damage.parents;
  for (int i = 0; i < cloth.mesh.particleCount(); ++i)
  {
    if (cloth.damage.weak[i] && !cloth.damage.at_rest[i])
    {
      surface.weak_points.push_back(i);
    }
    if (cloth.attachments[i].held())
    {
      surface.held.push_back({ i, cloth.attachments[i].grasp });
    }
  }
}

}  // namespace

Surface makeSurface(const Cloth& cloth)
{
  Surface surface;
  surface.revision = cloth.damage.tears;
  addParticles(cloth, surface);
  addTriangles(cloth, surface);
  addSprings(cloth, surface);
  return surface;
}

}  // namespace cloth
