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
  /// @throws Refusal naming everything wrong with it
  std::uint64_t throwOne(const ThrowRequest& request);

  /// Catches a sphere and sends it to `center` [m], as a set does. It stands still there, whatever
  /// its velocity, its mass and the cloth, until it is let go; a thrown one does not grow older.
  /// @throws Refusal if there is no such sphere, it follows a frame, or center is not usable
  void hold(SphereSource source, std::uint64_t id, const Vec3d& center, const ContactParams& params,
            double time_step);

  /// It goes on with the velocity that it had; a streamed one as if just set. One that is not
  /// caught stays as it is. @throws Refusal if there is no such sphere
  void letGo(SphereSource source, std::uint64_t id, const ContactParams& params);

  /// Throws it from where it is, whatever it did before.
  /// @return its new id, among the thrown ones
  /// @throws Refusal if there is no such sphere or `velocity` [m/s] is not usable
  std::uint64_t throwAgain(SphereSource source, std::uint64_t id, const Vec3d& velocity);

  /// @throws Refusal if there is no such sphere
  void remove(SphereSource source, std::uint64_t id);

  /// @throws Refusal if there is no such sphere
  const Sphere& find(SphereSource source, std::uint64_t id) const;

  std::vector<Sphere>& all() { return spheres_; }
  const std::vector<Sphere>& all() const { return spheres_; }

  std::size_t count(SphereSource source) const;

  void clear() { spheres_.clear(); }

private:
  template <class Archive>
  friend void transfer(Archive& archive, SphereSet& set);

  std::vector<Sphere>::const_iterator seek(SphereSource source, std::uint64_t id) const;
  Sphere& known(SphereSource source, std::uint64_t id);
  Sphere streamed(const Sphere& set, const ContactParams& params, double time_step) const;

  std::vector<Sphere> spheres_;
  std::uint64_t next_thrown_ = 1;
};

}  // namespace cloth
