// All grasps of one cloth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/force_balance.h"
#include "cloth_tearing/core/grasp.h"
#include "cloth_tearing/core/grasp_event.h"
#include "cloth_tearing/core/tear_event.h"

namespace cloth
{

struct GraspRequest
{
  Vec3d point = Vec3d::Zero();  ///< [m], cloth frame
  double radius = 0.0;          ///< [m]; 0 = the single nearest particle within max_grasp_distance
  Pose frame;                   ///< the grasp frame, cloth frame
  double force_limit = 0.0;     ///< above this smoothed force it lets go [N], >= 0; 0 = never
  std::string followed;         ///< name of a frame that it follows from now on; empty = none
};

struct GraspTaken
{
  std::uint64_t id = 0;
  int held_particles = 0;
  double distance = 0.0;  ///< from the point to the nearest particle [m]
};

/// A drag that is watched.
struct PullRequest
{
  std::uint64_t grasp = 0;
  DragTarget target;
  double stop_force = 0.0;  ///< stop where the smoothed force exceeds this [N], >= 0; 0 = never
  int stop_tears = 0;       ///< stop after so many tears that the grasp caused, >= 0; 0 = never
  bool release = false;     ///< let go when it ends, unless another command moves the grasp on
};

/// What becomes of the particles that a grasp lets go.
enum class AfterGrasp
{
  FREE,    ///< they go on with the velocities that they have
  PINNED,  ///< they stand still where they are, as after pin()
};

/// Who holds which particles, what that takes, and how grasps move. Grasps are numbered 1, 2, ...
/// for its life, and so are pulls.
///
/// What happens to them collects in news() until somebody takes it.
class Grippers
{
public:
  /// Events and ends of pulls. They lack what a simulation knows: numbers, epoch, step and time,
  /// and of a pull's end the tears and pieces.
  struct News
  {
    std::vector<GraspEvent> events;
    std::vector<PullEnd> ends;
  };

  /// Takes hold of the cloth. Pinned particles are passed over.
  /// @param max_distance how far a grasp by nearest particle reaches [m]
  /// @throws Refusal if nothing is within reach, or a particle is held by another grasp
  GraspTaken take(Cloth& cloth, const GraspRequest& request, double max_distance);

  /// Sends a grasp on its way; a second drag replaces the first, and ends a pull.
  /// @throws Refusal if there is no such grasp, it follows a frame, or the target is not usable
  void drag(std::uint64_t grasp, const DragTarget& target);

  /// Lets a grasp glide to `pose` in `time` [s], if the limits of carry() allow it, and stand
  /// there; replaces a drag, and ends a pull.
  /// @throws Refusal if there is no such grasp, it follows a frame, or pose or time are not usable
  void steer(std::uint64_t grasp, const Pose& pose, double time);

  /// The same for a grasp that follows a frame, to where the frame is now.
  /// @throws Refusal if there is no such grasp, it follows none, or pose or time are not usable
  void follow(std::uint64_t grasp, const Pose& pose, double time);

  /// Notes that the frame of a grasp is missing: it stands where it was to be last.
  /// @throws Refusal if there is no such grasp or it follows none
  void frameLost(std::uint64_t grasp, const std::string& reason);

  /// Notes that it is back. @throws Refusal if there is no such grasp or it follows none
  void frameFound(std::uint64_t grasp);

  /// From now on commands move it; it stands where it was to be last.
  /// @throws Refusal if there is no such grasp or it follows none
  void stopFollowing(std::uint64_t grasp);

  /// Begins a pull; the one before on the same grasp is cancelled.
  /// @param next_tear number of the first tear that would count
  /// @return its id
  /// @throws Refusal if there is no such grasp, it follows a frame, or the request is not usable
  std::uint64_t pull(const PullRequest& request, std::uint64_t next_tear);

  /// The grasp stands still where it is. @return whether there was such a pull
  bool cancelPull(Cloth& cloth, std::uint64_t pull);

  /// Lets go. @throws Refusal if there is no such grasp
  void release(Cloth& cloth, std::uint64_t grasp, const std::string& reason,
               AfterGrasp after = AfterGrasp::FREE);

  /// Lets go of everything. @return how many grasps there were
  int releaseAll(Cloth& cloth, const std::string& reason, AfterGrasp after = AfterGrasp::FREE);

  /// Moves all grasps for `dt` [s], and their particles with them.
  void carry(ParticleState& state, double dt, const GripperLimits& limits);

  /// Reads what the cloth exerts on each grasp.
  /// @param filter time constant of the low pass [s]; 0 = none
  void feel(const StepForces& forces, double filter);

  /// After the tears of a step of `dt` [s]: tells what they did to grasps, lets go where the force
  /// exceeds a limit, and ends pulls.
  /// @param before the grasps before the tears
  void conclude(Cloth& cloth, const std::vector<Grasp>& before, const std::vector<TearEvent>& tears,
                double dt);

  /// Whether conclude() may let go of a grasp.
  bool mayLetGo() const;

  /// Looks again at what hangs on one grasp alone: to be asked when pins have come or gone.
  void findLoosePieces(const Cloth& cloth, const std::string& reason);

  /// Tells that all grasps, which came with a state, are there. Pulls go on under new numbers,
  /// since nobody waits for them.
  /// @param next_tear number of the first tear that would count
  void resume(std::uint64_t next_tear);

  /// What has happened since it was last asked.
  News takeNews();

  /// By ascending id. Tearing lets them follow its edits.
  std::vector<Grasp>& all() { return grasps_; }
  const std::vector<Grasp>& all() const { return grasps_; }

  bool has(std::uint64_t id) const;

  /// @throws Refusal if there is no such grasp
  const Grasp& find(std::uint64_t id) const;

private:
  template <class Archive>
  friend void transfer(Archive& archive, Grippers& grippers);

  Grasp& find(std::uint64_t id);
  Grasp& free(std::uint64_t id);
  Grasp& following(std::uint64_t id);
  void tell(const Grasp& grasp, GraspEventKind kind, const std::string& reason);
  void end(const Grasp& grasp, PullOutcome outcome, const std::string& message);
  void takeOver(Grasp& grasp);
  void letGo(Cloth& cloth, std::size_t place, GraspEventKind kind, const std::string& reason,
             AfterGrasp after = AfterGrasp::FREE);
  void glide(Grasp& grasp, const Pose& pose, double time);
  bool endPull(Cloth& cloth, std::size_t place, PullOutcome outcome, const std::string& message);
  bool concludePull(Cloth& cloth, std::size_t place, double dt);
  void noteTears(const Cloth& cloth, const std::vector<Grasp>& before,
                 const std::vector<TearEvent>& tears);

  std::vector<Grasp> grasps_;  ///< by ascending id
  std::uint64_t next_ = 1;
  std::uint64_t next_pull_ = 1;
  News news_;
};

}  // namespace cloth
