// Triangles on their way from a file to a sound model, each with the line it came from.
#pragma once

#include <array>
#include <vector>

#include "cloth_tearing/core/import_report.h"
#include "cloth_tearing/core/types.h"

namespace cloth
{

/// A triangle of a file, or of one of its polygons.
struct SoupTriangle
{
  std::array<int, 3>
      vertices;             ///< counted from 0 as in the file; joined ones bear the lowest number
  std::array<Vec2d, 3> uv;  ///< at each corner [-]
  int line = 0;             ///< of its face
};

/// A side of a triangle in a list sorted by edge.
struct EdgeUse
{
  int low, high;  ///< vertices at its ends, low < high
  int triangle;
  int side;  ///< from this corner to the next

  bool sameEdge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

/// All sides of all triangles; those of one edge stand together, in the order of the triangles.
std::vector<EdgeUse> edgeUses(const std::vector<SoupTriangle>& triangles);

/// Drops triangles whose least altitude is `tolerance` [m] or less from edges that have more than
/// two triangles, and reports each: without area they are no reason to refuse a model.
void dropCrowdedFlatTriangles(const std::vector<Vec3d>& positions, double tolerance,
                              std::vector<SoupTriangle>& triangles, ImportReport& report);

/// Judges a soup that must become one layer of cloth: notes in `problems` every triangle that
/// another one covers and every edge with more than two triangles, with lines and vertices
/// (counted from 1).
void findOverlaps(const std::vector<SoupTriangle>& triangles, ImportProblems& problems);

/// Winds all triangles that hang together through edges alike, the way most of them already are
/// (the way of the first one if it is even), and reports every face it turned over. A surface with
/// only one side, like a Moebius band, goes to `problems` with the line where it closes wrongly.
///
/// No edge may have more than two triangles.
void windAlike(std::vector<SoupTriangle>& triangles, ImportReport& report,
               ImportProblems& problems);

/// Removes triangles whose least altitude is `tolerance` [m] or less, so that no hole opens: where
/// such a triangle lies between an edge and a vertex on it, the triangle beyond the edge is cut at
/// this vertex; at a border it just goes. Only if neither can be done it leaves a closed slit.
/// Reports each.
///
/// The triangles are wound alike, no edge has more than two, none is shorter than `tolerance`.
void removeFlatTriangles(const std::vector<Vec3d>& positions, double tolerance,
                         std::vector<SoupTriangle>& triangles, ImportReport& report);

/// Adds to the report what was done at `line`, and counts it in `counter`.
void reportFinding(ImportReport& report, int& counter, int line, const std::string& text);

/// "vertices 12 and 13", counted from 1 as in the file.
std::string vertexNames(int a, int b);

}  // namespace cloth
