// Connectivity and its edits.
#include "cloth_tearing/core/mesh.h"

#include <algorithm>
#include <utility>

#include "cloth_tearing/core/mesh_sides.h"

namespace cloth
{
namespace
{

int next(int k)
{
  return (k + 1) % 3;
}
int previous(int k)
{
  return (k + 2) % 3;
}

void checkTriangles(int particle_count, const std::vector<ModelTriangle>& triangles)
{
  std::vector<bool> used(particle_count, false);
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    const auto& v = triangles[t].vertices;
    for (int index : v)
    {
      if (index < 0 || index >= particle_count)
      {
        throw TopologyError("triangle " + std::to_string(t) + " names particle " +
                            std::to_string(index) + " of " + std::to_string(particle_count));
      }
      used[index] = true;
    }
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
    {
      throw TopologyError("triangle " + std::to_string(t) + " repeats a particle");
    }
  }
  const auto orphan = std::find(used.begin(), used.end(), false);
  if (orphan != used.end())
  {
    throw TopologyError("particle " + std::to_string(orphan - used.begin()) +
                        " belongs to no triangle");
  }
}

}  // namespace

int Triangle::cornerOf(ParticleId p) const
{
  const auto found = std::find(particles.begin(), particles.end(), p);
  return found == particles.end() ? -1 : static_cast<int>(found - particles.begin());
}

int Triangle::sideOf(SpringId s) const
{
  const auto found = std::find(springs.begin(), springs.end(), s);
  return found == springs.end() ? -1 : static_cast<int>(found - springs.begin());
}

int Fan::indexOf(SpringId s) const
{
  const auto found = std::find(springs.begin(), springs.end(), s);
  return found == springs.end() ? -1 : static_cast<int>(found - springs.begin());
}

SpringId Edit::outerSide(const Triangle& half) const
{
  const auto made = [this](SpringId s)
  {
    return s == springs.front().parent ||
           std::any_of(springs.begin(), springs.end(), [&](const auto& a) { return a.id == s; });
  };
  return *std::find_if_not(half.springs.begin(), half.springs.end(), made);
}

Mesh::Mesh(int particle_count, const std::vector<ModelTriangle>& triangles)
{
  checkTriangles(particle_count, triangles);
  first_corner_.assign(particle_count, -1);
  for (const ModelTriangle& face : triangles)
  {
    Triangle triangle;
    for (int k = 0; k < 3; ++k)
    {
      triangle.particles[k] = ParticleId{ face.vertices[k] };
      triangle.uv[k] = face.uv[k];
    }
    addTriangle(triangle);
  }
  buildSprings();
}

void Mesh::buildSprings()
{
  std::vector<int> twin(3 * triangles_.size(), -1);  // by corner: the other side of the same edge
  forEachEdge(triangles_,
              [&](const Side* first, const Side* last)
              {
                const std::string problem = edgeProblem(first, last);
                if (!problem.empty())
                {
                  throw TopologyError(problem);
                }
                if (last - first == 2)
                {
                  twin[first[0].corner()] = first[1].corner();
                  twin[first[1].corner()] = first[0].corner();
                }
              });

  for (int c = 0; c < 3 * triangleCount(); ++c)
  {
    Triangle& triangle = triangles_[c / 3];
    const int k = c % 3;
    if (triangle.springs[k].valid())
    {
      continue;
    }
    const SpringId s = addSpring(triangle.particles[k], triangle.particles[next(k)]);
    triangle.springs[k] = s;
    springs_[s.index].triangles[0] = TriangleId{ c / 3 };
    if (twin[c] >= 0)
    {
      triangles_[twin[c] / 3].springs[twin[c] % 3] = s;
      springs_[s.index].triangles[1] = TriangleId{ twin[c] / 3 };
    }
  }
  for (const Triangle& t : triangles_)
  {
    const auto sharedWith = [&](int k)
    {
      const Spring& s = springs_[t.springs[k].index];
      return &triangles_[s.triangles[0].index] == &t ? s.triangles[1] : s.triangles[0];
    };
    if (sharedWith(0).valid() && sharedWith(0) == sharedWith(1))
    {
      throw TopologyError("triangles " + std::to_string(&t - triangles_.data()) + " and " +
                          std::to_string(sharedWith(0).index) + " have the same corners");
    }
  }
}

ParticleId Mesh::opposite(SpringId s, int side) const
{
  const TriangleId t = spring(s).triangles[side];
  if (!t.valid())
  {
    return {};
  }
  const Triangle& around = triangle(t);
  return around.particles[previous(around.sideOf(s))];
}

std::vector<TriangleId> Mesh::trianglesAt(ParticleId p) const
{
  std::vector<TriangleId> found;
  forEachTriangleAt(p, [&](TriangleId t) { found.push_back(t); });
  return found;
}

Fan Mesh::fanAt(ParticleId p, TriangleId t) const
{
  // The side of `at` that leaves p counter-clockwise is its side before corner p.
  const auto cross = [this](TriangleId at, SpringId s)
  {
    const Spring& edge = spring(s);
    return edge.triangles[0] == at ? edge.triangles[1] : edge.triangles[0];
  };
  const auto clockwiseSide = [&](TriangleId at)
  { return triangle(at).springs[triangle(at).cornerOf(p)]; };
  const auto counterClockwiseSide = [&](TriangleId at)
  { return triangle(at).springs[previous(triangle(at).cornerOf(p))]; };

  Fan fan;
  TriangleId first = t;
  for (TriangleId back = cross(t, clockwiseSide(t)); back.valid();
       back = cross(back, clockwiseSide(back)))
  {
    if (back == t)
    {
      fan.closed = true;
      break;
    }
    first = back;
  }
  if (fan.closed)
  {
    first = t;
  }

  TriangleId at = first;
  do
  {
    fan.triangles.push_back(at);
    fan.springs.push_back(clockwiseSide(at));
    const SpringId ahead = counterClockwiseSide(at);
    const TriangleId following = cross(at, ahead);
    if (!following.valid())
    {
      fan.springs.push_back(ahead);
    }
    at = following;
  } while (at.valid() && at != first);
  return fan;
}

std::vector<Fan> Mesh::fans(ParticleId p) const
{
  std::vector<TriangleId> all = trianglesAt(p);
  std::sort(all.begin(), all.end());
  std::vector<bool> taken(all.size(), false);
  std::vector<Fan> found;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (taken[i])
    {
      continue;
    }
    found.push_back(fanAt(p, all[i]));
    for (TriangleId t : found.back().triangles)
    {
      taken[std::lower_bound(all.begin(), all.end(), t) - all.begin()] = true;
    }
  }
  return found;
}

int Mesh::fanCount(ParticleId p) const
{
  const TriangleId first{ first_corner_[p.index] / 3 };
  std::size_t triangles = 0;
  forEachTriangleAt(p, [&](TriangleId) { ++triangles; });
  return fanAt(p, first).triangles.size() == triangles ? 1 : static_cast<int>(fans(p).size());
}

bool Mesh::onBorder(ParticleId p) const
{
  bool found = false;
  forEachTriangleAt(
      p, [&](TriangleId t)
      { found = found || spring(triangle(t).springs[triangle(t).cornerOf(p)]).border(); });
  return found;
}

/// Some dozen elements: looking through them all is the quickest way to have each once.
template <class Id>
void addOnce(std::vector<Id>& ids, Id id)
{
  if (std::find(ids.begin(), ids.end(), id) == ids.end())
  {
    ids.push_back(id);
  }
}

Edit Mesh::withNeighbourhood(Edit edit) const
{
  for (TriangleId t : edit.touched)
  {
    for (int k = 0; k < 3; ++k)
    {
      addOnce(edit.near_particles, triangle(t).particles[k]);
      addOnce(edit.near_springs, triangle(t).springs[k]);
    }
  }
  for (const auto& added : edit.particles)  // an original may have lost all touched triangles
  {
    addOnce(edit.near_particles, added.parents[0]);
  }
  return edit;
}

Edit Mesh::splitSpring(SpringId s)
{
  const std::array<ParticleId, 2> ends = spring(s).particles;
  const std::array<TriangleId, 2> sides = spring(s).triangles;

  Edit edit;
  const std::array<ParticleId, 2> split = { addParticle(), addParticle() };
  edit.particles = { { split[0], { ends[0], ends[1] } }, { split[1], { ends[1], ends[0] } } };
  const SpringId half = addSpring(split[1], ends[1]);
  edit.springs.push_back({ half, s });
  springs_[s.index].particles = { ends[0], split[0] };

  for (TriangleId t : sides)
  {
    if (!t.valid())
    {
      continue;
    }
    // t keeps the half at ends[0]; a new triangle takes the half at ends[1].
    const Triangle old = triangle(t);
    const int k = old.sideOf(s);
    const int near = old.particles[k] == ends[0] ? k : next(k);
    const int far = near == k ? next(k) : k;
    const int apex = previous(k);
    const Vec2d middle = 0.5 * (old.uv[near] + old.uv[far]);
    const SpringId near_middle = addSpring(split[0], old.particles[apex]);
    const SpringId far_middle = addSpring(split[1], old.particles[apex]);
    const int far_outer = far == next(k) ? far : previous(far);  // side between far and apex

    Triangle added = old;
    added.particles[near] = split[1];
    added.uv[near] = middle;
    added.springs[k] = half;
    added.springs[near == k ? previous(k) : near] = far_middle;

    unlink(t, far);
    Triangle& kept = triangles_[t.index];
    kept.particles[far] = split[0];
    kept.uv[far] = middle;
    kept.springs[far_outer] = near_middle;
    link(t, far);

    const TriangleId a = addTriangle(added);
    replaceTriangle(old.springs[far_outer], t, a);
    springs_[near_middle.index].triangles[0] = t;
    springs_[far_middle.index].triangles[0] = a;
    (springs_[half.index].triangles[0].valid() ? springs_[half.index].triangles[1]
                                               : springs_[half.index].triangles[0]) = a;
    edit.springs.push_back({ near_middle, {} });
    edit.springs.push_back({ far_middle, {} });
    edit.triangles.push_back({ a, t });
    edit.touched.push_back(t);
    edit.touched.push_back(a);
  }
  return withNeighbourhood(std::move(edit));
}

Edit Mesh::detachAlong(ParticleId p, SpringId s)
{
  if (!spring(s).joins(p))
  {
    throw TopologyError("detachAlong: " + name(s) + " does not end at " + name(p));
  }
  if (spring(s).border())
  {
    throw TopologyError("detachAlong: " + name(s) + " is a border");
  }
  const Fan fan = fanAt(p, spring(s).triangles[0]);
  if (fan.closed)
  {
    throw TopologyError("detachAlong: the triangles around " + name(p) + " close round it");
  }

  const int cut = fan.indexOf(s);
  return detach(p, { fan.triangles.begin() + cut, fan.triangles.end() }, { s });
}

Edit Mesh::openAlong(ParticleId p, SpringId from, SpringId to)
{
  for (SpringId s : { from, to })
  {
    if (!spring(s).joins(p))
    {
      throw TopologyError("openAlong: " + name(s) + " does not end at " + name(p));
    }
  }
  const Fan fan = fanAt(p, spring(from).triangles[0]);
  if (!fan.closed || from == to || fan.indexOf(to) < 0)
  {
    throw TopologyError("openAlong: " + name(from) + " and " + name(to) +
                        " are not two springs of a closed fan around " + name(p));
  }
  const int count = static_cast<int>(fan.triangles.size());
  std::vector<TriangleId> moved;
  for (int i = fan.indexOf(from); i != fan.indexOf(to); i = (i + 1) % count)
  {
    moved.push_back(fan.triangles[i]);
  }
  return detach(p, moved, { from, to });
}

Edit Mesh::detachFan(ParticleId p, TriangleId t)
{
  if (triangle(t).cornerOf(p) < 0)
  {
    throw TopologyError("detachFan: " + name(t) + " is not at " + name(p));
  }
  if (fanCount(p) < 2)
  {
    throw TopologyError("detachFan: " + name(p) + " joins only one fan");
  }
  Edit edit;
  const Fan fan = fanAt(p, t);
  const ParticleId copy = addParticle();
  edit.particles = { { copy, { p, p } } };
  moveTriangles(fan.triangles, p, copy);
  edit.touched = fan.triangles;
  return withNeighbourhood(std::move(edit));
}

Edit Mesh::separateFans(ParticleId p)
{
  const std::vector<Fan> around = fans(p);
  if (around.size() < 2)
  {
    throw TopologyError("separateFans: " + name(p) + " joins only one fan");
  }
  Edit edit;
  for (std::size_t i = 1; i < around.size(); ++i)
  {
    const Edit one = detachFan(p, around[i].triangles.front());
    edit.particles.push_back(one.particles.front());
    edit.touched.insert(edit.touched.end(), one.touched.begin(), one.touched.end());
  }
  return withNeighbourhood(std::move(edit));
}

Edit Mesh::detach(ParticleId p, const std::vector<TriangleId>& moved,
                  const std::vector<SpringId>& cuts)
{
  Edit edit;
  const ParticleId copy = addParticle();
  edit.particles = { { copy, { p, p } } };
  edit.touched = moved;
  for (SpringId s : cuts)
  {
    const auto sides = spring(s).triangles;
    const bool first_moves = std::find(moved.begin(), moved.end(), sides[0]) != moved.end();
    const TriangleId moves = sides[first_moves ? 0 : 1];
    const TriangleId stays = sides[first_moves ? 1 : 0];
    const SpringId twin = addSpring(copy, spring(s).other(p));
    edit.springs.push_back({ twin, s });
    springs_[s.index].triangles = { stays, TriangleId{} };
    springs_[twin.index].triangles[0] = moves;
    auto& around = triangles_[moves.index].springs;
    std::replace(around.begin(), around.end(), s, twin);
    if (edit.touched.back() != stays)  // one triangle may stay between two cuts
    {
      edit.touched.push_back(stays);
    }
  }
  moveTriangles(moved, p, copy);
  return withNeighbourhood(std::move(edit));
}

ParticleId Mesh::addParticle()
{
  first_corner_.push_back(-1);
  return { particleCount() - 1 };
}

SpringId Mesh::addSpring(ParticleId a, ParticleId b)
{
  springs_.push_back({ { a, b }, {} });
  return { springCount() - 1 };
}

TriangleId Mesh::addTriangle(const Triangle& triangle)
{
  triangles_.push_back(triangle);
  next_corner_.insert(next_corner_.end(), 3, -1);
  const TriangleId t{ triangleCount() - 1 };
  for (int k = 0; k < 3; ++k)
  {
    link(t, k);
  }
  return t;
}

void Mesh::link(TriangleId t, int corner)
{
  const ParticleId p = triangle(t).particles[corner];
  next_corner_[3 * t.index + corner] = first_corner_[p.index];
  first_corner_[p.index] = 3 * t.index + corner;
}

void Mesh::unlink(TriangleId t, int corner)
{
  int* at = &first_corner_[triangle(t).particles[corner].index];
  while (*at != 3 * t.index + corner)
  {
    at = &next_corner_[*at];
  }
  *at = next_corner_[*at];
}

void Mesh::replaceTriangle(SpringId s, TriangleId from, TriangleId to)
{
  auto& triangles = springs_[s.index].triangles;
  *std::find(triangles.begin(), triangles.end(), from) = to;
}

void Mesh::moveTriangles(const std::vector<TriangleId>& moved, ParticleId from, ParticleId to)
{
  for (TriangleId t : moved)
  {
    const int k = triangle(t).cornerOf(from);
    triangles_[t.index].particles[k] = to;
    for (SpringId s : { triangle(t).springs[k], triangle(t).springs[previous(k)] })
    {
      auto& ends = springs_[s.index].particles;
      std::replace(ends.begin(), ends.end(), from, to);
    }
  }

  int* from_end = &first_corner_[from.index];
  int* to_end = &first_corner_[to.index];
  for (int c = *from_end; c >= 0; c = next_corner_[c])
  {
    int*& end = triangles_[c / 3].particles[c % 3] == from ? from_end : to_end;
    *end = c;
    end = &next_corner_[c];
  }
  *from_end = -1;
  *to_end = -1;
}

}  // namespace cloth
