// The spheres of one world: streamed sets of them, and thrown ones.
#pragma once

#include <cstdint>
#include <vector>

#include "cloth_tearing/core/obstacles.h"

namespace cloth
{

struct ThrowRequest
{
  Vec3d center = Vec3d::Zero();    ///< [m], cloth frame
  Vec3d velocity = Vec3d::Zero();  ///< [m/s]
  double radius = 0.1;             ///< [m], > 0
  double mass = 0.0;               ///< [kg]; 0 = kinematic
  double lifetime = 10.0;          ///< [s], > 0
};

/// Which spheres there are. Where they go in a step is moveSpheres()'s.
class SphereSet
{
public:
  /// The full set of streamed spheres: known ids move on from where they are, others are new,
  /// missing ones vanish.
  /// @param time_step [s]
  /// @throws Refusal naming everything wrong with them, twice the same id among it
  void set(const std::vector<Sphere>& spheres, const ContactParams& params, double time_step);

  /// Sends a streamed sphere to `center` [m] in `time` [s], as a set does that comes so long after
  /// the one before. Its velocity stays, and its sphere_timeout begins anew.
  /// @throws Refusal if there is no such sphere, or center or time are not usable
  void moveTo(std::uint64_t id, const Vec3d& center, double time, const ContactParams& params,
              double time_step);

  /// @return the id of the thrown sphere
  /// @throws Refusal naming everything wrong with it, or that there are too many spheres
  std::uint64_t throwOne(const ThrowRequest& request);

  std::vector<Sphere>& all() { return spheres_; }
  const std::vector<Sphere>& all() const { return spheres_; }

  void clear() { spheres_.clear(); }

private:
  template <class Archive>
  friend void transfer(Archive& archive, SphereSet& set);

  std::vector<Sphere>::const_iterator find(std::uint64_t id) const;
  Sphere streamed(const Sphere& set, const ContactParams& params, double time_step) const;

  std::vector<Sphere> spheres_;
  std::uint64_t next_thrown_ = 1;
};

}  // namespace cloth
