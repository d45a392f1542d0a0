// Finds the particle to take hold of, and drags it.
#include "cloth_tearing/experiments/pull.h"

#include <stdexcept>
#include <vector>

#include "cloth_tearing/core/pieces.h"

namespace cloth
{
namespace
{

/// Farther than any place on the texture is from another.
constexpr double HEM_PENALTY = 10.0;

/// By particle: hangs from a pin, so that a pull can tear it.
std::vector<char> hanging(const Cloth& cloth)
{
  std::vector<char> hangs(cloth.mesh.particleCount(), 0);
  Pieces pieces;
  for (int i = 0; i < cloth.mesh.particleCount(); ++i)
  {
    if (cloth.attachments[i].pinned() && !hangs[i])
    {
      for (ParticleId p : pieces.pieceOf(cloth.mesh, { i }))
      {
        hangs[p.index] = 1;
      }
    }
  }
  return hangs;
}

ParticleId nearestHanging(const Cloth& cloth, const Vec2d& place)
{
  const std::vector<char> hangs = hanging(cloth);
  ParticleId nearest;
  double least = 0.0;
  for (int i = 0; i < cloth.mesh.triangleCount(); ++i)
  {
    const Triangle& t = cloth.mesh.triangle({ i });
    for (int k = 0; k < 3; ++k)
    {
      const ParticleId p = t.particles[k];
      const double distance =
          (t.uv[k] - place).squaredNorm() + (cloth.damage.hem[p.index] ? HEM_PENALTY : 0.0);
      const bool can = hangs[p.index] && !cloth.attachments[p.index].pinned();
      if (can && (!nearest.valid() || distance < least))
      {
        nearest = p;
        least = distance;
      }
    }
  }
  if (!nearest.valid())
  {
    throw std::runtime_error("nothing is left of the cloth to pull at");
  }
  return nearest;
}

}  // namespace

std::uint64_t beginPull(Simulation& simulation, const Pull& pull)
{
  const ParticleId p = nearestHanging(simulation.cloth(), pull.place);
  GraspRequest request;
  request.point = simulation.cloth().state.position[p.index].cast<double>();
  request.radius = pull.radius;
  request.frame.position = request.point;
  DragTarget target;
  target.pose.position = request.point + pull.way;
  target.linear_speed = pull.speed;
  const std::uint64_t grasp = simulation.grasp(request).id;
  simulation.drag(grasp, target);
  return grasp;
}

}  // namespace cloth
