// What building and checking a mesh share: sides gathered into edges, names of elements.
#pragma once

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "cloth_tearing/core/mesh.h"

namespace cloth
{

/// A side of a triangle as an undirected edge, ordered so that equal edges come together.
struct Side
{
  int low;
  int high;
  int triangle;
  int side;
  bool reversed;  ///< the triangle runs from high to low

  int corner() const { return 3 * triangle + side; }
  bool sameEdge(const Side& o) const { return low == o.low && high == o.high; }
  friend bool operator<(const Side& a, const Side& b)
  {
    return std::tie(a.low, a.high, a.triangle, a.side) <
           std::tie(b.low, b.high, b.triangle, b.side);
  }
};

/// How messages call an element.
std::string name(ParticleId p);
std::string name(SpringId s);
std::string name(TriangleId t);

std::vector<Side> sortedSides(const std::vector<Triangle>& triangles);

/// Why the sides from `first` to `last` of one edge cannot be one spring; empty if they can.
std::string edgeProblem(const Side* first, const Side* last);

/// Calls `visit(first, last)` for each edge with the range of its sides, by ascending particles.
template <class Visitor>
void forEachEdge(const std::vector<Triangle>& triangles, Visitor&& visit)
{
  const std::vector<Side> sides = sortedSides(triangles);
  const Side* const end = sides.data() + sides.size();
  for (const Side* first = sides.data(); first != end;)
  {
    const Side* const last =
        std::find_if(first, end, [first](const Side& s) { return !s.sameEdge(*first); });
    visit(first, last);
    first = last;
  }
}

}  // namespace cloth
