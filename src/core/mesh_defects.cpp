// Derives every invariant of a mesh again from its triangle list.
#include "cloth_tearing/core/mesh.h"
#include "cloth_tearing/core/mesh_sides.h"

namespace cloth
{
namespace
{

bool within(int index, int low, int count)
{
  return index >= low && index < count;
}

/// Whatever the mesh is, what follows may then look up what its springs name.
void checkSpringReferences(const Mesh& mesh, std::vector<std::string>& found)
{
  for (int i = 0; i < mesh.springCount() && found.empty(); ++i)
  {
    const Spring& spring = mesh.spring({ i });
    if (!within(spring.particles[0].index, 0, mesh.particleCount()) ||
        !within(spring.particles[1].index, 0, mesh.particleCount()) ||
        !within(spring.triangles[0].index, 0, mesh.triangleCount()) ||
        !within(spring.triangles[1].index, -1, mesh.triangleCount()))
    {
      found.push_back(name(SpringId{ i }) + " names an element that does not exist");
    }
  }
}

void checkCorners(const Mesh& mesh, std::vector<std::string>& found)
{
  for (int i = 0; i < mesh.triangleCount(); ++i)
  {
    const TriangleId t{ i };
    const Triangle& triangle = mesh.triangle(t);
    for (int k = 0; k < 3; ++k)
    {
      const ParticleId p = triangle.particles[k];
      const SpringId s = triangle.springs[k];
      if (p.index < 0 || p.index >= mesh.particleCount() || s.index < 0 ||
          s.index >= mesh.springCount())
      {
        found.push_back(name(t) + " names an element that does not exist");
        return;
      }
      if (p == triangle.particles[(k + 1) % 3])
      {
        found.push_back(name(t) + " repeats " + name(p));
      }
      const Spring& spring = mesh.spring(s);
      if (!spring.joins(p) || spring.other(p) != triangle.particles[(k + 1) % 3])
      {
        found.push_back(name(t) + " has " + name(s) + " on a side that it does not join");
      }
      if (spring.triangles[0] != t && spring.triangles[1] != t)
      {
        found.push_back(name(s) + " does not know " + name(t));
      }
      if (!triangle.uv[k].allFinite())
      {
        found.push_back(name(t) + " has a texture corner that is not finite");
      }
    }
  }
}

void checkSprings(const Mesh& mesh, const std::vector<Triangle>& triangles,
                  std::vector<std::string>& found)
{
  int edges = 0;
  forEachEdge(triangles,
              [&](const Side* first, const Side* last)
              {
                const std::string problem = edgeProblem(first, last);
                if (!problem.empty())
                {
                  found.push_back(problem);
                }
                const SpringId s = triangles[first->triangle].springs[first->side];
                for (const Side* side = first; side != last; ++side)
                {
                  if (triangles[side->triangle].springs[side->side] != s)
                  {
                    found.push_back("one edge has two springs, " + name(s) + " among them");
                  }
                }
                if (mesh.spring(s).border() != (last - first == 1))
                {
                  found.push_back(name(s) + " has " + std::to_string(last - first) +
                                  " triangles and says otherwise");
                }
                ++edges;
              });
  if (edges != mesh.springCount())
  {
    found.push_back("there are " + std::to_string(mesh.springCount()) + " springs for " +
                    std::to_string(edges) + " edges");
  }
}

}  // namespace

std::vector<std::string> defects(const Mesh& mesh)
{
  std::vector<std::string> found;
  const int corner_count = 3 * mesh.triangleCount();
  const auto beyond = [corner_count](int corner) { return !within(corner, -1, corner_count); };
  if (static_cast<int>(mesh.next_corner_.size()) != corner_count ||
      std::any_of(mesh.first_corner_.begin(), mesh.first_corner_.end(), beyond) ||
      std::any_of(mesh.next_corner_.begin(), mesh.next_corner_.end(), beyond))
  {
    found.push_back("the lists of corners name corners that do not exist");
  }
  checkSpringReferences(mesh, found);
  if (found.empty())
  {
    checkCorners(mesh, found);
  }
  if (!found.empty())
  {
    return found;  // what follows relies on sound references
  }
  checkSprings(mesh, mesh.triangles_, found);

  std::vector<int> corners(mesh.particleCount(), 0);
  for (const Triangle& t : mesh.triangles_)
  {
    for (ParticleId p : t.particles)
    {
      ++corners[p.index];
    }
  }
  for (int i = 0; i < mesh.particleCount(); ++i)
  {
    const ParticleId p{ i };
    int listed = 0;
    for (int c = mesh.first_corner_[i]; c >= 0 && listed <= corners[i]; c = mesh.next_corner_[c])
    {
      if (mesh.triangles_[c / 3].particles[c % 3] != p)
      {
        found.push_back(name(p) + " lists a corner of another particle");
        break;
      }
      ++listed;
    }
    if (corners[i] == 0)
    {
      found.push_back(name(p) + " belongs to no triangle");
    }
    if (listed != corners[i])
    {
      found.push_back(name(p) + " lists " + std::to_string(listed) + " triangles of " +
                      std::to_string(corners[i]));
    }
  }
  return found;
}

}  // namespace cloth
