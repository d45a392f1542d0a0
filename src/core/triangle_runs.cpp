// Finds runs of triangles, and keeps them up with tears.
#include "cloth_tearing/core/triangle_runs.h"

#include <algorithm>
#include <tuple>

namespace cloth
{
namespace
{

using kernels::LANES;

/// A run with fewer triangles than this takes longer than they do alone.
constexpr int SHORTEST_RUN = 4;

/// A triangle by where its second and third corner lie from its first.
struct Reach
{
  int b;
  int c;
  int a;
  int triangle;

  bool operator<(const Reach& other) const
  {
    return std::tie(b, c, a) < std::tie(other.b, other.c, other.a);
  }
};

std::vector<Reach> reachesOf(const Mesh& mesh)
{
  std::vector<Reach> reaches;
  reaches.reserve(mesh.triangleCount());
  for (int i = 0; i < mesh.triangleCount(); ++i)
  {
    const auto& p = mesh.triangle({ i }).particles;
    reaches.push_back({ p[1].index - p[0].index, p[2].index - p[0].index, p[0].index, i });
  }
  std::sort(reaches.begin(), reaches.end());
  return reaches;
}

}  // namespace

TriangleRuns::TriangleRuns(const Mesh& untorn)
{
  lanes_.assign(untorn.triangleCount(), -1);
  const std::vector<Reach> reaches = reachesOf(untorn);
  for (auto first = reaches.begin(); first != reaches.end();)
  {
    const int highest = std::max({ 0, first->b, first->c });
    const int lowest = std::min({ 0, first->b, first->c });
    const int a = std::min(first->a, untorn.particleCount() - LANES - highest);
    const auto in_run = [&](const Reach& r)
    { return r.b == first->b && r.c == first->c && r.a < a + LANES; };
    const auto end = std::find_if_not(first, reaches.end(), in_run);
    if (a + lowest < 0 || end - first < SHORTEST_RUN)
    {
      ++first;
      continue;
    }
    for (auto r = first; r != end; ++r)
    {
      lanes_[r->triangle] = LANES * static_cast<int>(runs_.size()) + r->a - a;
    }
    runs_.push_back({ a, a + first->b, a + first->c });
    first = end;
  }
  areas_.resize(runs_.size());
}

void TriangleRuns::follow(const Mesh& mesh, const RestShape& rest, const SpringTable& springs)
{
  if (seen_ == springs.changes.count())
  {
    return;
  }
  if (!springs.changes.since(seen_, changed_))
  {
    followAll(mesh, rest);
  }
  else
  {
    lanes_.resize(mesh.triangleCount(), -1);
    for (int spring : changed_)
    {
      for (TriangleId t : mesh.spring({ spring }).triangles)
      {
        if (t.valid())
        {
          follow(mesh, rest, t.index);
        }
      }
    }
  }
  seen_ = springs.changes.count();
}

void TriangleRuns::followAll(const Mesh& mesh, const RestShape& rest)
{
  areas_.assign(runs_.size(), {});
  loose_.clear();
  lanes_.resize(mesh.triangleCount(), -1);
  for (int i = 0; i < mesh.triangleCount(); ++i)
  {
    follow(mesh, rest, i);
  }
}

void TriangleRuns::follow(const Mesh& mesh, const RestShape& rest, int triangle)
{
  const int lane = lanes_[triangle];
  const bool in_run = lane >= 0 && fits(mesh.triangle({ triangle }), lane);
  if (lane >= 0)
  {
    areas_[lane / LANES].area[lane % LANES] = in_run ? static_cast<float>(rest.area[triangle]) : 0;
  }
  const auto place = std::lower_bound(loose_.begin(), loose_.end(), triangle);
  const bool is_loose = place != loose_.end() && *place == triangle;
  if (in_run && is_loose)
  {
    loose_.erase(place);
  }
  else if (!in_run && !is_loose)
  {
    loose_.insert(place, triangle);
  }
}

bool TriangleRuns::fits(const Triangle& triangle, int lane) const
{
  const kernels::TriangleRun& run = runs_[lane / LANES];
  const int i = lane % LANES;
  const auto& p = triangle.particles;
  return p[0].index == run.a + i && p[1].index == run.b + i && p[2].index == run.c + i;
}

}  // namespace cloth
