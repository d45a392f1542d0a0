// Pieces of cloth: triangles joined through particles.
#pragma once

#include <optional>
#include <vector>

#include "cloth_tearing/core/mesh.h"

namespace cloth
{

/// Walks pieces without touching more of the mesh than it must.
class Pieces
{
public:
  /// Floods from `a` and `b` in turns until the floods meet or one of them ends.
  /// @return the particles of the one that ended, if they never met: a piece of its own
  std::optional<std::vector<ParticleId>> parted(const Mesh& mesh, ParticleId a, ParticleId b);

  /// All particles of the piece of `p`.
  std::vector<ParticleId> pieceOf(const Mesh& mesh, ParticleId p);

private:
  /// Takes the next particle of `flood` and marks its neighbours. @return true if it met `other`
  bool spread(const Mesh& mesh, std::vector<ParticleId>& flood, std::size_t& next, unsigned mark,
              unsigned other);
  void prepare(const Mesh& mesh);

  std::vector<unsigned> mark_;  ///< by particle
  unsigned last_mark_ = 0;
};

int countPieces(const Mesh& mesh);

}  // namespace cloth
