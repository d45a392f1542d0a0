// Decides which vertices of a file are one and the same.
#pragma once

#include <vector>

#include "cloth_tearing/core/obj_parser.h"
#include "cloth_tearing/core/types.h"

namespace cloth
{

/// Sets of joined vertices; each is known by the lowest number in it.
class VertexSets
{
public:
  explicit VertexSets(std::size_t count);

  int lowest(int vertex) const;

  /// False if they were one already.
  bool join(int a, int b);

private:
  mutable std::vector<int> parent_;
};

/// Joins every vertex to the nearest one before it that is no further than `distance` [m] away and
/// was not joined itself (the lower number of two equally near); reports each. Does not depend on
/// anything but the order in the file.
void weld(const std::vector<Vec3d>& positions, const std::vector<int>& lines, double distance,
          VertexSets& sets, ImportReport& report);

/// Joins the two ends of every side of a face that is `tolerance` [m] long or shorter; reports
/// each edge.
///
/// @return false if joining goes on and on, each step making another edge too short
bool collapseShortEdges(const std::vector<Vec3d>& positions, const ObjContent& content,
                        double tolerance, VertexSets& sets, ImportReport& report);

}  // namespace cloth
