// Mixes the state word by word.
#include "cloth_tearing/core/state_hash.h"

#include <algorithm>
#include <cstring>

#include "cloth_tearing/core/word_hash.h"

namespace cloth
{
namespace
{

class Hash
{
public:
  void add(std::uint64_t word) { words_.add(word); }
  void add(int word) { add(static_cast<std::uint64_t>(static_cast<std::int64_t>(word))); }
  void add(double word)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &word, sizeof bits);
    add(bits);
  }
  void add(const Vec3Array::ConstReference& element)
  {
    const Vec3 v = element;
    std::uint32_t bits[3];
    std::memcpy(bits, v.data(), sizeof bits);
    add(static_cast<std::uint64_t>(bits[0]) << 32 | bits[1]);
    add(static_cast<std::uint64_t>(bits[2]));
  }
  void add(const Vec3d& v)
  {
    add(v.x());
    add(v.y());
    add(v.z());
  }
  void add(const Quatd& q)
  {
    for (int i = 0; i < 4; ++i)
    {
      add(q.coeffs()[i]);
    }
  }
  std::uint64_t value() const { return words_.value(); }

private:
  WordHash words_;
};

/// The place of a grasp in the list, from 1; 0 for none. Ids are numbers of a life, not of a state.
int placeOf(const std::vector<Grasp>& grasps, std::uint64_t id)
{
  const auto found = std::lower_bound(grasps.begin(), grasps.end(), id,
                                      [](const Grasp& g, std::uint64_t i) { return g.id < i; });
  const bool there = found != grasps.end() && found->id == id;
  return there ? 1 + static_cast<int>(found - grasps.begin()) : 0;
}

void addParticles(Hash& hash, const Cloth& cloth, const std::vector<Grasp>& grasps)
{
  for (int i = 0; i < cloth.mesh.particleCount(); ++i)
  {
    hash.add(cloth.state.position[i]);
    hash.add(cloth.state.velocity[i]);
    hash.add(cloth.damage.weak[i] | cloth.damage.hinge[i] << 1 | cloth.damage.at_rest[i] << 2 |
             static_cast<int>(cloth.attachments[i].kind) << 3);
    hash.add(placeOf(grasps, cloth.attachments[i].grasp));
  }
}

void addTopology(Hash& hash, const Cloth& cloth)
{
  for (int i = 0; i < cloth.mesh.triangleCount(); ++i)
  {
    const Triangle& t = cloth.mesh.triangle({ i });
    for (int k = 0; k < 3; ++k)
    {
      hash.add(t.particles[k].index);
      hash.add(t.springs[k].index);
      hash.add(t.uv[k].x());
      hash.add(t.uv[k].y());
    }
  }
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    hash.add(cloth.rest.length[i]);
    hash.add(static_cast<int>(cloth.damage.released[i]));
    if (cloth.damage.strength[i] != 1.0)  // cloth of one strength has the hash that it always had
    {
      hash.add(cloth.damage.strength[i]);
      hash.add(i);
    }
  }
}

void addPose(Hash& hash, const Pose& pose)
{
  hash.add(pose.position);
  hash.add(pose.rotation);
}

void addGrasp(Hash& hash, const Grasp& grasp)
{
  addPose(hash, grasp.pose);
  for (const Grasp::Held& held : grasp.held)
  {
    hash.add(held.particle.index);
    hash.add(held.offset);
  }
  hash.add(grasp.target ? 1 : 0);
  if (grasp.target)
  {
    addPose(hash, grasp.target->pose);
    hash.add(grasp.target->linear_speed);
    hash.add(grasp.target->angular_speed);
  }
  hash.add(grasp.glide ? 1 : 0);
  if (grasp.glide)
  {
    addPose(hash, grasp.glide->goal);
    hash.add(grasp.glide->time_left);
  }
  hash.add(grasp.pull ? 1 : 0);
  if (grasp.pull)
  {
    hash.add(grasp.pull->stop_force);
    hash.add(grasp.pull->stop_tears);
    hash.add(grasp.pull->tears);
    hash.add(grasp.pull->release ? 1 : 0);
  }
  hash.add(grasp.force_limit);
  hash.add(grasp.smoothed.force);
  hash.add(grasp.smoothed.torque);
}

void addSphere(Hash& hash, const Sphere& sphere)
{
  hash.add(static_cast<int>(sphere.source));
  hash.add(sphere.center);
  hash.add(sphere.velocity);
  hash.add(sphere.jump);
  hash.add(sphere.jump_time);
  hash.add(sphere.age);
  hash.add(sphere.radius);
  hash.add(sphere.mass);
  hash.add(sphere.time_left);
  hash.add(sphere.caught ? 1 : 0);
  hash.add(sphere.fresh ? 1 : 0);
  hash.add(sphere.out);
}

}  // namespace

std::uint64_t stateHash(const Cloth& cloth, const std::vector<Grasp>& grasps,
                        const std::vector<Sphere>& spheres)
{
  Hash hash;
  addParticles(hash, cloth, grasps);
  addTopology(hash, cloth);
  for (const Grasp& grasp : grasps)
  {
    addGrasp(hash, grasp);
  }
  for (const Sphere& sphere : spheres)
  {
    addSphere(hash, sphere);
  }
  return hash.value();
}

}  // namespace cloth
