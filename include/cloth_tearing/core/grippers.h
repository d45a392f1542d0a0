// All grasps of one cloth.
#pragma once

#include <cstdint>
#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/grasp.h"

namespace cloth
{

struct GraspRequest
{
  Vec3d point = Vec3d::Zero();  ///< [m], cloth frame
  double radius = 0.0;          ///< [m]; 0 = the single nearest particle within max_grasp_distance
  Pose frame;                   ///< the grasp frame, cloth frame
};

struct GraspTaken
{
  std::uint64_t id = 0;
  int held_particles = 0;
  double distance = 0.0;  ///< from the point to the nearest particle [m]
};

/// Who holds which particles. Grasps are numbered 1, 2, ... for its life.
class Grippers
{
public:
  /// Takes hold of the cloth. Pinned particles are passed over.
  /// @param max_distance how far a grasp by nearest particle reaches [m]
  /// @throws Refusal if nothing is within reach, or a particle is held by another grasp
  GraspTaken take(Cloth& cloth, const GraspRequest& request, double max_distance);

  /// Sends a grasp on its way; a second drag replaces the first.
  /// @throws Refusal if there is no such grasp or the target is not usable
  void drag(std::uint64_t grasp, const DragTarget& target);

  /// Lets go; the particles keep their velocities. @throws Refusal if there is no such grasp
  void release(Cloth& cloth, std::uint64_t grasp);

  /// Lets go of everything. @return how many grasps there were
  int releaseAll(Cloth& cloth);

  /// Moves all grasps for `dt` [s], and their particles with them.
  void carry(ParticleState& state, double dt);

  /// By ascending id. Tearing lets them follow its edits.
  std::vector<Grasp>& all() { return grasps_; }
  const std::vector<Grasp>& all() const { return grasps_; }

  /// Forgets them all, as if they had never been: for a cloth that is built anew.
  void clear() { grasps_.clear(); }

private:
  Grasp& find(std::uint64_t id);

  std::vector<Grasp> grasps_;  ///< by ascending id
  std::uint64_t next_ = 1;
};

}  // namespace cloth
