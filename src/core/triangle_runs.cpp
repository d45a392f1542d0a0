// Finds runs of triangles, and keeps them up with tears.
#include "cloth_tearing/core/triangle_runs.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace cloth
{
namespace
{

using kernels::LANES;

/// A run with fewer triangles than this takes longer than they do alone.
constexpr int SHORTEST_RUN = 4;

/// The fewest particles that make a stretch: a thread should have something to do.
constexpr int SHORTEST_STRETCH = 512;

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

std::array<int, 2> range(const Triangle& triangle)
{
  const auto& p = triangle.particles;
  const auto [low, high] = std::minmax({ p[0].index, p[1].index, p[2].index });
  return { low, high };
}

/// How far apart the particles of most triangles, and of runs of them, lie.
int reachOfMost(const Mesh& mesh)
{
  std::vector<int> reaches;
  reaches.reserve(mesh.triangleCount());
  for (int i = 0; i < mesh.triangleCount(); ++i)
  {
    const auto [low, high] = range(mesh.triangle({ i }));
    reaches.push_back(high - low);
  }
  const auto most = reaches.begin() + static_cast<std::ptrdiff_t>(reaches.size() * 9 / 10);
  std::nth_element(reaches.begin(), most, reaches.end());
  return *most + LANES;
}

}  // namespace

TriangleRuns::TriangleRuns(const Mesh& untorn)
{
  makeGroups(untorn);
  makeRuns(untorn);
  sortRuns();
}

void TriangleRuns::makeGroups(const Mesh& untorn)
{
  stretch_ = std::max(SHORTEST_STRETCH, 2 * reachOfMost(untorn));
  const int stretches = (untorn.particleCount() + stretch_ - 1) / stretch_;
  const int first_phase = (stretches + 1) / 2;
  phases_ = { 0, first_phase, stretches, stretches + 1 };
  groups_.resize(stretches + 1);
}

/// Stretches 0, 2, 4, ... are first, then 1, 3, 5, ...
int TriangleRuns::groupOf(int lowest, int highest) const
{
  const int stretch = lowest / stretch_;
  const bool reaches_further = highest >= (stretch + 2) * stretch_ || stretch >= phases_[2];
  return reaches_further ? phases_[2] : stretch / 2 + (stretch % 2 == 0 ? 0 : phases_[1]);
}

int TriangleRuns::groupOf(const Triangle& triangle) const
{
  const auto [low, high] = range(triangle);
  return groupOf(low, high);
}

std::array<int, 2> TriangleRuns::own(int group, int particles) const
{
  const bool last = group + 1 == phases_[1];
  return { 2 * group * stretch_, last ? particles : 2 * (group + 1) * stretch_ };
}

void TriangleRuns::makeRuns(const Mesh& untorn)
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

/// Group by group.
void TriangleRuns::sortRuns()
{
  const auto group_of = [this](int run)
  {
    const kernels::TriangleRun& r = runs_[run];
    return groupOf(std::min({ r.a, r.b, r.c }), std::max({ r.a, r.b, r.c }) + LANES - 1);
  };
  std::vector<int> order(runs_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return group_of(a) < group_of(b); });
  std::vector<kernels::TriangleRun> sorted;
  std::vector<int> place(runs_.size());
  for (int run : order)
  {
    TriangleGroup& group = groups_[group_of(run)];
    place[run] = static_cast<int>(sorted.size());
    group.first_run = group.end_run == 0 ? place[run] : group.first_run;
    group.end_run = place[run] + 1;
    sorted.push_back(runs_[run]);
  }
  runs_ = std::move(sorted);
  for (int& lane : lanes_)
  {
    lane = lane < 0 ? lane : LANES * place[lane / LANES] + lane % LANES;
  }
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
    loose_group_.resize(mesh.triangleCount(), -1);
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
  for (TriangleGroup& group : groups_)
  {
    group.loose.clear();
    group.stale = true;
  }
  lanes_.resize(mesh.triangleCount(), -1);
  loose_group_.assign(mesh.triangleCount(), -1);
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
  removeLoose(triangle);
  if (!in_run)
  {
    addLoose(mesh, triangle);
  }
}

void TriangleRuns::removeLoose(int triangle)
{
  const int group = loose_group_[triangle];
  if (group >= 0)
  {
    std::vector<int>& loose = groups_[group].loose;
    loose.erase(std::lower_bound(loose.begin(), loose.end(), triangle));
    groups_[group].stale = true;
    loose_group_[triangle] = -1;
  }
}

void TriangleRuns::addLoose(const Mesh& mesh, int triangle)
{
  const int group = groupOf(mesh.triangle({ triangle }));
  std::vector<int>& loose = groups_[group].loose;
  loose.insert(std::lower_bound(loose.begin(), loose.end(), triangle), triangle);
  groups_[group].stale = true;
  loose_group_[triangle] = group;
}

void TriangleRuns::arrange(int group, const Mesh& mesh, const RestShape& rest)
{
  TriangleGroup& g = groups_[group];
  if (!g.stale)
  {
    return;
  }
  g.stale = false;
  g.low = g.loose.empty() ? 0 : mesh.particleCount();
  for (int triangle : g.loose)
  {
    g.low = std::min(g.low, range(mesh.triangle({ triangle }))[0]);
  }
  const std::size_t blocks = (g.loose.size() + LANES - 1) / LANES;
  g.ends.assign(blocks, {});
  g.areas.assign(blocks, {});
  for (std::size_t i = 0; i < g.loose.size(); ++i)
  {
    const auto& p = mesh.triangle({ g.loose[i] }).particles;
    kernels::TriangleEnds& ends = g.ends[i / LANES];
    ends.a[i % LANES] = p[0].index - g.low;
    ends.b[i % LANES] = p[1].index - g.low;
    ends.c[i % LANES] = p[2].index - g.low;
    g.areas[i / LANES].area[i % LANES] = static_cast<float>(rest.area[g.loose[i]]);
  }
}

std::vector<int> TriangleRuns::loose() const
{
  std::vector<int> all;
  for (const TriangleGroup& group : groups_)
  {
    all.insert(all.end(), group.loose.begin(), group.loose.end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

bool TriangleRuns::fits(const Triangle& triangle, int lane) const
{
  const kernels::TriangleRun& run = runs_[lane / LANES];
  const int i = lane % LANES;
  const auto& p = triangle.particles;
  return p[0].index == run.a + i && p[1].index == run.b + i && p[2].index == run.c + i;
}

}  // namespace cloth
