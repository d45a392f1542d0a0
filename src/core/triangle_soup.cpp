// Edges, overlaps and winding of triangles read from a file.
#include "cloth_tearing/core/triangle_soup.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace cloth
{
namespace
{

constexpr std::size_t MAX_LINES_SHOWN = 6;

std::string lineList(const std::vector<SoupTriangle>& triangles, const EdgeUse* first,
                     const EdgeUse* last)
{
  std::string text;
  for (const EdgeUse* use = first; use != last; ++use)
  {
    if (static_cast<std::size_t>(use - first) == MAX_LINES_SHOWN)
    {
      return text + ", ...";
    }
    text += (text.empty() ? "" : ", ") + std::to_string(triangles[use->triangle].line);
  }
  return text;
}

// Triangle numbers sorted by their corners, so that equal ones stand together.
std::vector<int> byCorners(const std::vector<SoupTriangle>& triangles)
{
  std::vector<std::array<int, 3>> keys;
  keys.reserve(triangles.size());
  for (const SoupTriangle& triangle : triangles)
  {
    keys.push_back(triangle.vertices);
    std::sort(keys.back().begin(), keys.back().end());
  }
  std::vector<int> order(triangles.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return std::tie(keys[a], a) < std::tie(keys[b], b); });
  return order;
}

bool sameCorners(const SoupTriangle& a, const SoupTriangle& b)
{
  return std::is_permutation(a.vertices.begin(), a.vertices.end(), b.vertices.begin());
}

// Marks every triangle that repeats an earlier one.
std::vector<bool> findRepeated(const std::vector<SoupTriangle>& triangles, ImportProblems& problems)
{
  std::vector<bool> repeated(triangles.size(), false);
  const std::vector<int> order = byCorners(triangles);
  for (std::size_t i = 1, first = 0; i < order.size(); ++i)
  {
    const SoupTriangle& original = triangles[order[first]];
    const SoupTriangle& triangle = triangles[order[i]];
    if (!sameCorners(original, triangle))
    {
      first = i;
      continue;
    }
    repeated[order[i]] = true;
    problems.add(triangle.line, "the same face as in line " + std::to_string(original.line) +
                                    " again; cloth has one layer with two sides, keep one face");
  }
  return repeated;
}

// Goes over triangles that hang together and decides which of them to turn over.
class Winding
{
public:
  Winding(const std::vector<SoupTriangle>& triangles, ImportProblems& problems)
      : triangles_(triangles)
      , problems_(problems)
      , across_(triangles.size(), { -1, -1, -1 })
      , against_(triangles.size(), { false, false, false })
      , reached_(triangles.size(), false)
      , turned_(triangles.size(), false)
  {
    const std::vector<EdgeUse> uses = edgeUses(triangles);
    for (std::size_t i = 1; i < uses.size(); ++i)
    {
      if (uses[i].sameEdge(uses[i - 1]))
      {
        join(uses[i - 1], uses[i]);
      }
    }
  }

  std::vector<bool> run()
  {
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t)
    {
      if (!reached_[t])
      {
        flood(t);
      }
    }
    return turned_;
  }

private:
  void join(const EdgeUse& a, const EdgeUse& b)
  {
    const bool against = startOf(a) == startOf(b);
    across_[a.triangle][a.side] = b.triangle;
    across_[b.triangle][b.side] = a.triangle;
    against_[a.triangle][a.side] = against;
    against_[b.triangle][b.side] = against;
  }

  int startOf(const EdgeUse& use) const { return triangles_[use.triangle].vertices[use.side]; }

  void flood(int seed)
  {
    std::vector<int> piece = { seed };
    std::size_t turned = 0;
    bool one_sided = false;
    reached_[seed] = true;
    for (std::size_t i = 0; i < piece.size(); ++i)
    {
      const int t = piece[i];
      turned += turned_[t] ? 1 : 0;
      for (int side = 0; side < 3; ++side)
      {
        const int u = across_[t][side];
        if (u < 0)
        {
          continue;
        }
        const bool wanted = turned_[t] != against_[t][side];
        if (!reached_[u])
        {
          reached_[u] = true;
          turned_[u] = wanted;
          piece.push_back(u);
        }
        else if (turned_[u] != wanted && !one_sided)
        {
          one_sided = true;
          reportOneSided(t, u, side);
        }
      }
    }
    if (2 * turned > piece.size())
    {
      for (const int t : piece)
      {
        turned_[t] = !turned_[t];
      }
    }
  }

  void reportOneSided(int t, int u, int side)
  {
    const int a = triangles_[t].vertices[side];
    const int b = triangles_[t].vertices[(side + 1) % 3];
    const auto lines = std::minmax(triangles_[t].line, triangles_[u].line);
    problems_.add(lines.second,
                  "the surface has only one side, like a Moebius band: it meets itself turned over "
                  "at the edge between " +
                      vertexNames(a, b) + " (lines " + std::to_string(lines.first) + ", " +
                      std::to_string(lines.second) + ")");
  }

  const std::vector<SoupTriangle>& triangles_;
  ImportProblems& problems_;
  std::vector<std::array<int, 3>> across_;    // neighbour beyond each side, -1 = border
  std::vector<std::array<bool, 3>> against_;  // and whether it is wound the other way
  std::vector<bool> reached_;
  std::vector<bool> turned_;
};

}  // namespace

std::vector<EdgeUse> edgeUses(const std::vector<SoupTriangle>& triangles)
{
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
  {
    for (int side = 0; side < 3; ++side)
    {
      const auto ends =
          std::minmax(triangles[t].vertices[side], triangles[t].vertices[(side + 1) % 3]);
      uses.push_back({ ends.first, ends.second, t, side });
    }
  }
  std::sort(uses.begin(), uses.end(),
            [](const EdgeUse& a, const EdgeUse& b)
            {
              return std::tie(a.low, a.high, a.triangle, a.side) <
                     std::tie(b.low, b.high, b.triangle, b.side);
            });
  return uses;
}

void findOverlaps(const std::vector<SoupTriangle>& triangles, ImportProblems& problems)
{
  const std::vector<bool> repeated = findRepeated(triangles, problems);
  std::vector<EdgeUse> uses = edgeUses(triangles);
  uses.erase(std::remove_if(uses.begin(), uses.end(),
                            [&](const EdgeUse& use) { return repeated[use.triangle]; }),
             uses.end());
  const EdgeUse* const end = uses.data() + uses.size();
  for (const EdgeUse* first = uses.data(); first != end;)
  {
    const EdgeUse* last =
        std::find_if(first, end, [first](const EdgeUse& use) { return !use.sameEdge(*first); });
    if (last - first > 2)
    {
      problems.add(triangles[first[2].triangle].line,
                   "the edge between " + vertexNames(first->low, first->high) + " has " +
                       std::to_string(last - first) + " faces (lines " +
                       lineList(triangles, first, last) + "), cloth has at most two");
    }
    first = last;
  }
}

void windAlike(std::vector<SoupTriangle>& triangles, ImportReport& report, ImportProblems& problems)
{
  const std::vector<bool> turned = Winding(triangles, problems).run();
  int last_line = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    if (!turned[t])
    {
      continue;
    }
    SoupTriangle& triangle = triangles[t];
    std::swap(triangle.vertices[1], triangle.vertices[2]);
    std::swap(triangle.uv[1], triangle.uv[2]);
    if (triangle.line != last_line)  // the triangles of one polygon stand together
    {
      last_line = triangle.line;
      reportFinding(report, report.turned_faces, triangle.line,
                    "the face is wound against its neighbours, turned over");
    }
  }
}

void reportFinding(ImportReport& report, int& counter, int line, const std::string& text)
{
  if (++counter <= MAX_FINDINGS_KEPT)
  {
    report.findings.push_back({ line, text });
  }
}

std::string vertexNames(int a, int b)
{
  const auto ends = std::minmax(a, b);
  return "vertices " + std::to_string(ends.first + 1) + " and " + std::to_string(ends.second + 1);
}

}  // namespace cloth
