// Takes triangles of zero area out of a surface without opening holes in it.
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "cloth_tearing/core/triangle_soup.h"

namespace cloth
{
namespace
{

constexpr int NOTHING = -1;

// Each round removes what the one before made removable; what is left then leaves slits.
constexpr int MAX_ROUNDS = 50;

bool isFlat(const std::vector<Vec3d>& positions, const std::array<int, 3>& corners,
            double tolerance)
{
  const Vec3d& a = positions[corners[0]];
  const Vec3d& b = positions[corners[1]];
  const Vec3d& c = positions[corners[2]];
  const double longest = std::max({ (b - a).norm(), (c - b).norm(), (a - c).norm() });
  return !((b - a).cross(c - a).norm() > tolerance * longest);
}

void erase(const std::vector<bool>& removed, std::vector<SoupTriangle>& triangles)
{
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    if (!removed[t])
    {
      triangles[kept++] = triangles[t];
    }
  }
  triangles.resize(kept);
}

class Flattener
{
public:
  Flattener(const std::vector<Vec3d>& positions, double tolerance,
            std::vector<SoupTriangle>& triangles, ImportReport& report)
      : positions_(positions), tolerance_(tolerance), triangles_(triangles), report_(report)
  {
  }

  void run()
  {
    std::vector<int> flat;
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t)
    {
      if (isFlat(triangles_[t].vertices))
      {
        flat.push_back(t);
      }
    }
    if (flat.empty())
    {
      return;
    }
    findEdges();
    for (int round = 0; round < MAX_ROUNDS && !flat.empty(); ++round)
    {
      flat.erase(std::remove_if(flat.begin(), flat.end(), [this](int t) { return resolve(t); }),
                 flat.end());
    }
    for (const int t : flat)
    {
      leaveSlit(t);
    }
    erase(removed_, triangles_);
  }

private:
  struct Side
  {
    int triangle = NOTHING;
    int corner = 0;
  };

  double lengthOf(int a, int b) const { return (positions_[b] - positions_[a]).norm(); }

  bool isFlat(const std::array<int, 3>& corners) const
  {
    return cloth::isFlat(positions_, corners, tolerance_);
  }

  void findEdges()
  {
    across_.resize(triangles_.size());
    removed_.resize(triangles_.size(), false);
    const std::vector<EdgeUse> uses = edgeUses(triangles_);
    for (std::size_t i = 0; i < uses.size(); ++i)
    {
      edges_.emplace_hint(edges_.end(), uses[i].low, uses[i].high);
      if (i > 0 && uses[i].sameEdge(uses[i - 1]))
      {
        join({ uses[i].triangle, uses[i].side }, { uses[i - 1].triangle, uses[i - 1].side });
      }
    }
  }

  void join(const Side& a, const Side& b)
  {
    across_[a.triangle][a.corner] = b;
    if (b.triangle != NOTHING)
    {
      across_[b.triangle][b.corner] = a;
    }
  }

  int longestSide(int t) const
  {
    const std::array<int, 3>& v = triangles_[t].vertices;
    int longest = 0;
    for (int k = 1; k < 3; ++k)
    {
      if (lengthOf(v[k], v[(k + 1) % 3]) > lengthOf(v[longest], v[(longest + 1) % 3]))
      {
        longest = k;
      }
    }
    return longest;
  }

  std::string place(int t) const
  {
    const int k = longestSide(t);
    const std::array<int, 3>& v = triangles_[t].vertices;
    return "the face has no area, its vertex " + std::to_string(v[(k + 2) % 3] + 1) +
           " lies on the edge between " + vertexNames(v[k], v[(k + 1) % 3]);
  }

  // True if the triangle is gone, or no longer flat.
  bool resolve(int t)
  {
    const int k = longestSide(t);
    const Side beyond = across_[t][k];
    if (!isFlat(triangles_[t].vertices))
    {
      return true;  // a neighbour's cut has mended it
    }
    if (beyond.triangle == NOTHING)
    {
      reportFinding(report_, report_.dropped_faces, triangles_[t].line,
                    place(t) + " and no face lies beyond it; dropped");
      remove(t);
      return true;
    }
    return cutBeyond(t, k, beyond);
  }

  // (p, q, middle) and (q, p, far) become (middle, p, far) and (middle, far, q).
  bool cutBeyond(int t, int k, const Side& beyond)
  {
    const int u = beyond.triangle;
    const int j = beyond.corner;
    const SoupTriangle flat = triangles_[t];
    const SoupTriangle cut = triangles_[u];
    const int p = flat.vertices[k];
    const int q = flat.vertices[(k + 1) % 3];
    const int middle = flat.vertices[(k + 2) % 3];
    const int far = cut.vertices[(j + 2) % 3];
    if (isFlat({ middle, p, far }) || isFlat({ middle, far, q }) ||
        edges_.count(std::minmax(middle, far)) > 0)
    {
      return false;
    }
    reportFinding(report_, report_.dropped_faces, flat.line,
                  place(t) + "; dropped, the face beyond (line " + std::to_string(cut.line) +
                      ") is cut in two there");
    const Vec2d uv_p = cut.uv[(j + 1) % 3];
    const Vec2d uv_q = cut.uv[j];
    const Vec2d uv_far = cut.uv[(j + 2) % 3];
    const bool seam = flat.uv[k] != uv_p || flat.uv[(k + 1) % 3] != uv_q;
    const double fraction = lengthOf(p, middle) / (lengthOf(p, middle) + lengthOf(middle, q));
    const Vec2d uv_middle =
        seam ? Vec2d(uv_p + fraction * (uv_q - uv_p)) : Vec2d(flat.uv[(k + 2) % 3]);

    const Side beyond_q_middle = across_[t][(k + 1) % 3];
    const Side beyond_middle_p = across_[t][(k + 2) % 3];
    const Side beyond_p_far = across_[u][(j + 1) % 3];
    const Side beyond_far_q = across_[u][(j + 2) % 3];
    triangles_[t] = { { middle, p, far }, { uv_middle, uv_p, uv_far }, cut.line };
    triangles_[u] = { { middle, far, q }, { uv_middle, uv_far, uv_q }, cut.line };
    join({ t, 0 }, beyond_middle_p);
    join({ t, 1 }, beyond_p_far);
    join({ t, 2 }, { u, 0 });
    join({ u, 1 }, beyond_far_q);
    join({ u, 2 }, beyond_q_middle);
    edges_.erase(std::minmax(p, q));
    edges_.insert(std::minmax(middle, far));
    return true;
  }

  void leaveSlit(int t)
  {
    if (isFlat(triangles_[t].vertices))
    {
      reportFinding(report_, report_.dropped_faces, triangles_[t].line,
                    place(t) + "; dropped, its edges are now a slit");
      remove(t);
    }
  }

  void remove(int t)
  {
    removed_[t] = true;
    for (int k = 0; k < 3; ++k)
    {
      const Side beyond = across_[t][k];
      if (beyond.triangle != NOTHING)
      {
        across_[beyond.triangle][beyond.corner] = Side{};
      }
      else
      {
        edges_.erase(std::minmax(triangles_[t].vertices[k], triangles_[t].vertices[(k + 1) % 3]));
      }
    }
  }

  const std::vector<Vec3d>& positions_;
  const double tolerance_;
  std::vector<SoupTriangle>& triangles_;
  ImportReport& report_;
  std::vector<std::array<Side, 3>> across_;
  std::vector<bool> removed_;
  std::set<std::pair<int, int>> edges_;  // the lower vertex first
};

}  // namespace

void dropCrowdedFlatTriangles(const std::vector<Vec3d>& positions, double tolerance,
                              std::vector<SoupTriangle>& triangles, ImportReport& report)
{
  const std::vector<EdgeUse> uses = edgeUses(triangles);
  std::vector<bool> removed(triangles.size(), false);
  for (std::size_t first = 0, last = 0; first < uses.size(); first = last)
  {
    while (last < uses.size() && uses[last].sameEdge(uses[first]))
    {
      ++last;
    }
    for (std::size_t i = first; last - first > 2 && i < last; ++i)
    {
      const SoupTriangle& triangle = triangles[uses[i].triangle];
      if (!removed[uses[i].triangle] && isFlat(positions, triangle.vertices, tolerance))
      {
        removed[uses[i].triangle] = true;
        reportFinding(report, report.dropped_faces, triangle.line,
                      "the face has no area and is one of too many at the edge between " +
                          vertexNames(uses[i].low, uses[i].high) + "; dropped");
      }
    }
  }
  erase(removed, triangles);
}

void removeFlatTriangles(const std::vector<Vec3d>& positions, double tolerance,
                         std::vector<SoupTriangle>& triangles, ImportReport& report)
{
  Flattener(positions, tolerance, triangles, report).run();
}

}  // namespace cloth
