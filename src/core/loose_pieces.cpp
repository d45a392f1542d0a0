// Puts pieces of cloth to rest that have left the world.
#include "cloth_tearing/core/loose_pieces.h"

#include <algorithm>

namespace cloth
{
namespace
{

void putToRest(Cloth& cloth, const std::vector<ParticleId>& piece)
{
  for (ParticleId p : piece)
  {
    cloth.damage.at_rest[p.index] = 1;
    cloth.state.velocity[p.index].setZero();
    cloth.refreshInverseMass(p);
    cloth.mesh.forEachTriangleAt(p,
                                 [&](TriangleId t)
                                 {
                                   for (SpringId s : cloth.mesh.triangle(t).springs)
                                   {
                                     cloth.springs.release(s);
                                     cloth.springs.releaseBendShear(s);
                                   }
                                 });
  }
  ++cloth.damage.pieces_at_rest;
}

}  // namespace

std::vector<std::string> LoosePieces::rest(Cloth& cloth, const ContactParams& params)
{
  std::vector<std::string> notes;
  const Vec3 low = params.bounds_min.cast<Real>();
  const Vec3 high = params.bounds_max.cast<Real>();
  const auto beyond = [&](ParticleId p)
  {
    const Vec3& x = cloth.state.position[p.index];
    return (x.array() < low.array()).any() || (x.array() > high.array()).any();
  };
  const auto attached = [&](ParticleId p) { return cloth.attachments[p.index].held(); };
  std::vector<char> hangs;  // by particle: its piece is held, and has been looked at
  for (int i = 0; i < cloth.mesh.particleCount(); ++i)
  {
    if (cloth.damage.at_rest[i] || !beyond({ i }) || (!hangs.empty() && hangs[i]))
    {
      continue;
    }
    const std::vector<ParticleId> piece = pieces_.pieceOf(cloth.mesh, { i });
    if (std::any_of(piece.begin(), piece.end(), attached))
    {
      hangs.resize(cloth.mesh.particleCount(), 0);
      for (ParticleId p : piece)
      {
        hangs[p.index] = 1;
      }
      continue;
    }
    putToRest(cloth, piece);
    notes.push_back("a loose piece of " + std::to_string(piece.size()) +
                    " particles left the bounds and was put to rest");
  }
  return notes;
}

}  // namespace cloth
