// Floods from held particles, and asks who else holds what it finds.
#include "cloth_tearing/core/held_pieces.h"

#include <algorithm>

#include "cloth_tearing/core/pieces.h"

namespace cloth
{
namespace
{

/// Whether nobody but grasp `id` holds a particle of the piece.
bool hangsOn(const Cloth& cloth, const std::vector<ParticleId>& piece, std::uint64_t id)
{
  return std::none_of(piece.begin(), piece.end(),
                      [&](ParticleId p)
                      {
                        const Attachment& attachment = cloth.attachments[p.index];
                        return attachment.held() && (attachment.pinned() || attachment.grasp != id);
                      });
}

double massOf(const Cloth& cloth, const std::vector<ParticleId>& piece)
{
  double mass = 0.0;
  for (ParticleId p : piece)
  {
    mass += cloth.rest.mass[p.index];
  }
  return mass;
}

}  // namespace

std::vector<LooseHold> looseHolds(const Cloth& cloth, const std::vector<Grasp>& grasps)
{
  std::vector<LooseHold> holds(grasps.size());
  std::vector<char> seen(cloth.mesh.particleCount(), 0);
  Pieces pieces;
  for (std::size_t i = 0; i < grasps.size(); ++i)
  {
    for (const Grasp::Held& held : grasps[i].held)
    {
      if (seen[held.particle.index])
      {
        continue;
      }
      const std::vector<ParticleId> piece = pieces.pieceOf(cloth.mesh, held.particle);
      for (ParticleId p : piece)
      {
        seen[p.index] = 1;
      }
      if (hangsOn(cloth, piece, grasps[i].id))
      {
        const double mass = massOf(cloth, piece);
        ++holds[i].pieces;
        holds[i].mass += mass;
        holds[i].area += mass / cloth.rest.areal_density;
      }
    }
  }
  return holds;
}

}  // namespace cloth
