// Floods over particles that share triangles.
#include "cloth_tearing/core/pieces.h"

#include <algorithm>

namespace cloth
{

void Pieces::prepare(const Mesh& mesh)
{
  mark_.resize(mesh.particleCount(), 0);
  if (last_mark_ > 0xfffffff0u)
  {
    std::fill(mark_.begin(), mark_.end(), 0);
    last_mark_ = 0;
  }
}

bool Pieces::spread(const Mesh& mesh, std::vector<ParticleId>& flood, std::size_t& next,
                    unsigned mark, unsigned other)
{
  bool met = false;
  mesh.forEachTriangleAt(flood[next++],
                         [&](TriangleId t)
                         {
                           for (ParticleId q : mesh.triangle(t).particles)
                           {
                             met = met || mark_[q.index] == other;
                             if (mark_[q.index] != mark)
                             {
                               mark_[q.index] = mark;
                               flood.push_back(q);
                             }
                           }
                         });
  return met;
}

std::optional<std::vector<ParticleId>> Pieces::parted(const Mesh& mesh, ParticleId a, ParticleId b)
{
  prepare(mesh);
  const unsigned mark_a = ++last_mark_;
  const unsigned mark_b = ++last_mark_;
  std::vector<ParticleId> from_a = { a };
  std::vector<ParticleId> from_b = { b };
  std::size_t next_a = 0;
  std::size_t next_b = 0;
  mark_[a.index] = mark_a;
  mark_[b.index] = mark_b;
  while (true)
  {
    if (spread(mesh, from_a, next_a, mark_a, mark_b) ||
        spread(mesh, from_b, next_b, mark_b, mark_a))
    {
      return std::nullopt;
    }
    if (next_a == from_a.size())
    {
      return from_a;
    }
    if (next_b == from_b.size())
    {
      return from_b;
    }
  }
}

std::vector<ParticleId> Pieces::pieceOf(const Mesh& mesh, ParticleId p)
{
  prepare(mesh);
  const unsigned mark = ++last_mark_;
  std::vector<ParticleId> piece = { p };
  mark_[p.index] = mark;
  for (std::size_t next = 0; next < piece.size();)
  {
    spread(mesh, piece, next, mark, 0);
  }
  return piece;
}

int countPieces(const Mesh& mesh)
{
  Pieces pieces;
  std::vector<char> counted(mesh.particleCount(), 0);
  int count = 0;
  for (int i = 0; i < mesh.particleCount(); ++i)
  {
    if (!counted[i])
    {
      ++count;
      for (ParticleId p : pieces.pieceOf(mesh, { i }))
      {
        counted[p.index] = 1;
      }
    }
  }
  return count;
}

}  // namespace cloth
