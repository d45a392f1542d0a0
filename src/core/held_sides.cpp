// Which side of a tear a gripper goes on holding.
#include "cloth_tearing/core/held_sides.h"

#include <algorithm>

namespace cloth
{
namespace
{

/// The particles of grasp `grasp` that springs join to `p`, ascending.
std::vector<ParticleId> heldNeighbours(const Cloth& cloth, ParticleId p, std::uint64_t grasp)
{
  std::vector<ParticleId> held;
  const auto add = [&](SpringId s)
  {
    const ParticleId q = cloth.mesh.spring(s).other(p);
    const Attachment& attachment = cloth.attachments[q.index];
    if (attachment.kind == Attachment::Kind::GRASP && attachment.grasp == grasp)
    {
      held.push_back(q);
    }
  };
  cloth.mesh.forEachTriangleAt(p,
                               [&](TriangleId t)
                               {
                                 const Triangle& triangle = cloth.mesh.triangle(t);
                                 const int k = triangle.cornerOf(p);
                                 const SpringId last = triangle.springs[(k + 2) % 3];
                                 add(triangle.springs[k]);
                                 if (cloth.mesh.spring(last).border())
                                 {
                                   add(last);  // no other triangle begins with it
                                 }
                               });
  std::sort(held.begin(), held.end());
  return held;
}

/// Whether `some` has one that `others` has not.
bool hasItsOwn(const std::vector<ParticleId>& some, const std::vector<ParticleId>& others)
{
  return !std::includes(others.begin(), others.end(), some.begin(), some.end());
}

/// The patch of a gripper was parted between its jaws: it goes on holding both sides.
void holdBoth(Cloth& cloth, std::vector<Grasp>& grasps, ParticleId p, ParticleId copy)
{
  const Vec3 velocity = cloth.state.velocity[copy.index];
  cloth.attach(copy, cloth.attachments[p.index]);
  cloth.state.velocity[copy.index] = velocity;
  for (Grasp& grasp : grasps)
  {
    const auto held = std::find_if(grasp.held.begin(), grasp.held.end(),
                                   [p](const Grasp::Held& h) { return h.particle == p; });
    if (held != grasp.held.end())
    {
      const Vec3d offset = held->offset;
      grasp.held.push_back({ copy, offset });
    }
  }
}

}  // namespace

void keepHeld(Cloth& cloth, std::vector<Grasp>& grasps, const Edit& edit, SpringId stretched)
{
  const ParticleId p = edit.particles.front().parents[0];
  const ParticleId copy = edit.particles.front().id;
  const Attachment attachment = cloth.attachments[p.index];
  if (attachment.kind != Attachment::Kind::GRASP)
  {
    return;
  }
  const std::vector<ParticleId> here = heldNeighbours(cloth, p, attachment.grasp);
  const std::vector<ParticleId> there = heldNeighbours(cloth, copy, attachment.grasp);
  const bool here_too = hasItsOwn(here, there);
  const bool there_too = hasItsOwn(there, here);
  if (here_too && there_too)
  {
    holdBoth(cloth, grasps, p, copy);
    return;
  }
  const bool pulled_here = cloth.mesh.spring(stretched).joins(p);
  if (here_too || (!there_too && !pulled_here))
  {
    return;
  }
  cloth.attach(p, {});
  cloth.attach(copy, attachment);
  for (Grasp& grasp : grasps)
  {
    for (Grasp::Held& held : grasp.held)
    {
      held.particle = held.particle == p ? copy : held.particle;
    }
  }
}

}  // namespace cloth
