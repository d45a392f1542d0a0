// Triangles by where in memory their particles lie.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "cloth_tearing/core/kernels.h"
#include "cloth_tearing/core/mesh.h"
#include "cloth_tearing/core/spring_table.h"

namespace cloth
{

/// Lists of triangles for those who look at a part of the cloth only: one list for each tile, which
/// is kernels::TILE particles that are neighbours in memory. A triangle is in that of its first
/// particle in memory.
///
/// What lies where depends on the mesh alone, not on the tears that made it.
class TriangleTiles
{
public:
  /// The tile that a particle lies in.
  static int tileOf(int particle) { return particle / kernels::TILE; }

  static int tilesFor(int particles) { return (particles + kernels::TILE - 1) / kernels::TILE; }

  bool made() const { return !home_.empty(); }

  /// Brings the lists up to the mesh of now. Costs what `springs` says was changed since the last
  /// time.
  void follow(const Mesh& mesh, const SpringTable& springs);

  int count() const { return static_cast<int>(first_.size()); }

  /// Tiles in which particles of its triangles lie, ascending.
  const std::vector<int>& reach(int tile) const { return reach_[tile]; }

  /// Calls visit(TriangleId) for those of a tile, ascending.
  template <class Visitor>
  void forEach(int tile, Visitor&& visit) const
  {
    for (int t = first_[tile]; t >= 0; t = next_[t])
    {
      visit(TriangleId{ t });
    }
  }

private:
  static constexpr std::uint64_t NEVER = std::numeric_limits<std::uint64_t>::max();

  void followAll(const Mesh& mesh);
  void followChanged(const Mesh& mesh);
  void grow(const Mesh& mesh);
  void take(int triangle);
  void put(int triangle, int tile);
  void findReach(const Mesh& mesh, int tile);

  std::vector<int> first_;               ///< triangle, by tile; -1: none
  std::vector<int> next_;                ///< in the list of the same tile, by triangle; -1 ends it
  std::vector<int> home_;                ///< tile, by triangle; -1: in no list yet
  std::vector<std::vector<int>> reach_;  ///< by tile
  std::uint64_t seen_ = NEVER;           ///< changes of the springs that were followed
  std::vector<int> changed_;             ///< springs, scratch
  std::vector<int> tiles_;               ///< scratch
};

}  // namespace cloth
