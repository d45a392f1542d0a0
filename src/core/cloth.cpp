// Builds a cloth, and keeps its arrays in step with its mesh.
#include "cloth_tearing/core/cloth.h"

#include <algorithm>
#include <array>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/pieces.h"
#include "cloth_tearing/core/point_grid.h"
#include "cloth_tearing/core/refusal.h"

namespace cloth
{
namespace
{

void refuseFarAway(const std::vector<Vec3d>& positions)
{
  double farthest = 0.0;
  for (const Vec3d& x : positions)
  {
    farthest = std::max(farthest, x.cwiseAbs().maxCoeff());
  }
  if (farthest > MAX_COORDINATE)
  {
    throw Refusal("the model reaches " + text(farthest) + " m from its origin, must be at most " +
                  text(MAX_COORDINATE) + ": scale it down or move it there");
  }
}

Damage undamaged(const Mesh& mesh)
{
  Damage damage;
  damage.weak.assign(mesh.particleCount(), 0);
  damage.at_rest.assign(mesh.particleCount(), 0);
  damage.hinge.resize(mesh.particleCount());
  damage.parents.resize(mesh.particleCount());
  for (int i = 0; i < mesh.particleCount(); ++i)
  {
    damage.hinge[i] = mesh.fanCount({ i }) > 1 ? 1 : 0;
    damage.parents[i] = { i, i };
  }
  damage.released.assign(mesh.springCount(), 0);
  damage.outer.resize(mesh.springCount());
  for (int i = 0; i < mesh.springCount(); ++i)
  {
    damage.outer[i] = mesh.spring({ i }).border() ? 1 : 0;
  }
  damage.pieces = countPieces(mesh);
  return damage;
}

/// Whether the ends of the bend-shear spring that crosses `s` hang together through load-bearing
/// sides of its two triangles.
bool isTied(const Mesh& mesh, const std::vector<char>& released, SpringId s)
{
  const Spring& spring = mesh.spring(s);
  std::array<std::array<bool, 2>, 2> holds{};  // each end of `s` to the corner on each side of it
  for (int side = 0; side < 2; ++side)
  {
    for (const SpringId u : mesh.triangle(spring.triangles[side]).springs)
    {
      if (u != s)
      {
        const int end = mesh.spring(u).joins(spring.particles[1]) ? 1 : 0;
        holds[side][end] = !released[u.index];
      }
    }
  }
  const bool by_one_end = (holds[0][0] && holds[1][0]) || (holds[0][1] && holds[1][1]);
  const bool along = (holds[0][0] || holds[0][1]) && (holds[1][0] || holds[1][1]);
  return by_one_end || (along && !released[s.index]);
}

void releaseUntied(Cloth& cloth, const std::vector<SpringId>& some)
{
  for (const SpringId s : some)
  {
    if (cloth.springs.bend_shear[s.index].active() && !isTied(cloth.mesh, cloth.damage.released, s))
    {
      cloth.springs.releaseBendShear(s);
    }
  }
}

}  // namespace

void Cloth::follow(const Edit& edit)
{
  for (const auto& added : edit.particles)
  {
    const int a = added.parents[0].index;
    const int b = added.parents[1].index;
    state.position.push_back(state.position[a]);
    state.velocity.push_back(state.velocity[a]);
    state.previous.push_back(state.previous[a]);
    state.inverse_mass.push_back(0);
    attachments.push_back({});
    damage.weak.push_back(0);
    damage.hinge.push_back(0);
    damage.at_rest.push_back(damage.at_rest[a]);
    damage.hem.push_back(damage.hem[a] && damage.hem[b]);
    damage.parents.push_back({ a, b });
  }
  for (const auto& added : edit.springs)
  {
    const int parent = added.parent.index;
    damage.released.push_back(added.parent.valid() ? damage.released[parent] : 0);
    damage.outer.push_back(added.parent.valid() ? damage.outer[parent] : 0);
  }
  followStrengths(damage.strength, mesh, edit);
  rest.follow(mesh, edit);
  springs.refresh(mesh, rest, material, edit.near_springs);
  for (const auto& added : edit.springs)
  {
    if (damage.released[added.id.index])
    {
      springs.release(added.id);
    }
  }
  releaseUntied(*this, edit.near_springs);

  for (ParticleId p : edit.near_particles)
  {
    refreshInverseMass(p);
    damage.hinge[p.index] = mesh.fanCount(p) > 1 ? 1 : 0;
  }
  ++damage.tears;
}

void Cloth::release(SpringId s)
{
  springs.release(s);
  damage.released[s.index] = 1;
  for (const TriangleId t : mesh.spring(s).triangles)
  {
    if (t.valid())
    {
      const auto& sides = mesh.triangle(t).springs;
      releaseUntied(*this, { sides.begin(), sides.end() });
    }
  }
}

void Cloth::setMaterial(const Material& other)
{
  material = other;
  rest.weigh(mesh, material.areal_density);
  std::vector<SpringId> all(mesh.springCount());
  for (int i = 0; i < mesh.springCount(); ++i)
  {
    all[i] = { i };
  }
  springs.refresh(mesh, rest, material, all);
  releaseUntied(*this, all);
  for (int i = 0; i < mesh.springCount(); ++i)
  {
    if (damage.at_rest[mesh.spring({ i }).particles[0].index])
    {
      springs.releaseBendShear({ i });
    }
  }
  for (int i = 0; i < mesh.particleCount(); ++i)
  {
    refreshInverseMass({ i });
  }
}

void Cloth::markHem(double width)
{
  // A garment folds in space, so distance is measured between particles as the model hangs; a hem
  // is small beside the folds.
  std::vector<Vec3d> positions;
  std::vector<int> pinned;
  for (int i = 0; i < state.size(); ++i)
  {
    positions.push_back(state.position[i].cast<double>());
    if (attachments[i].kind == Attachment::Kind::PIN)
    {
      pinned.push_back(i);
    }
  }
  damage.hem = positionsNear(positions, pinned, width);
}

void Cloth::takeHem(const Cloth& untorn)
{
  std::copy(untorn.damage.hem.begin(), untorn.damage.hem.end(), damage.hem.begin());
  for (std::size_t i = untorn.damage.hem.size(); i < damage.hem.size(); ++i)
  {
    const auto& parents = damage.parents[i];  // which are older
    damage.hem[i] = damage.hem[parents[0]] && damage.hem[parents[1]];
  }
}

void Cloth::attach(ParticleId p, const Attachment& attachment)
{
  attachments[p.index] = attachment;
  if (attachment.held())
  {
    state.velocity[p.index].setZero();
  }
  refreshInverseMass(p);
}

void Cloth::refreshInverseMass(ParticleId p)
{
  const bool moves = !attachments[p.index].held() && !damage.at_rest[p.index];
  state.inverse_mass[p.index] = moves ? static_cast<Real>(1.0 / rest.mass[p.index]) : Real(0);
}

double Cloth::strain(SpringId s) const
{
  const auto& ends = mesh.spring(s).particles;
  const Vec3d a = state.position[ends[0].index].cast<double>();
  const Vec3d b = state.position[ends[1].index].cast<double>();
  return (b - a).norm() / rest.length[s.index] - 1.0;
}

Vec3d Cloth::center() const
{
  Vec3d moment = Vec3d::Zero();
  double mass = 0.0;
  for (int i = 0; i < state.size(); ++i)
  {
    if (!damage.at_rest[i])
    {
      moment += rest.mass[i] * state.position[i].cast<double>();
      mass += rest.mass[i];
    }
  }
  if (!(mass > 0.0))
  {
    throw Refusal("all of the cloth is at rest: it has left the bounds");
  }
  return moment / mass;
}

Vec3 Cloth::direction(SpringId s, ParticleId from) const
{
  return state.position[mesh.spring(s).other(from).index] - state.position[from.index];
}

Cloth makeCloth(const ClothModel& model, const std::vector<int>& pinned, const Material& material,
                RestShapeSource rest_shape, double hem_width, const StrengthParams& strength)
{
  refuseFarAway(model.positions);
  Cloth cloth;
  cloth.material = material;
  cloth.mesh = Mesh(static_cast<int>(model.positions.size()), model.triangles);
  cloth.rest = makeRestShape(cloth.mesh, model.positions, rest_shape, material.areal_density);
  cloth.springs = makeSpringTable(cloth.mesh, cloth.rest, material);
  cloth.damage = undamaged(cloth.mesh);
  cloth.damage.strength = springStrengths(cloth.mesh, model.positions, strength);
  for (double factor : cloth.damage.strength)
  {
    cloth.damage.least_strength = std::min(cloth.damage.least_strength, factor);
  }
  cloth.state.resize(cloth.mesh.particleCount());
  cloth.attachments.resize(cloth.mesh.particleCount());
  for (int i = 0; i < cloth.mesh.particleCount(); ++i)
  {
    cloth.state.position[i] = model.positions[i].cast<Real>();
    cloth.state.previous[i] = cloth.state.position[i];
    cloth.refreshInverseMass({ i });
  }
  for (int p : pinned)
  {
    cloth.attach({ p }, { Attachment::Kind::PIN, 0 });
  }
  cloth.markHem(hem_width);
  return cloth;
}

}  // namespace cloth
