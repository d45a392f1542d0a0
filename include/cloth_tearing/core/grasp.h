// Grippers: particles that follow a moving frame.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cloth_tearing/core/mesh.h"
#include "cloth_tearing/core/particle_state.h"
#include "cloth_tearing/core/pull.h"
#include "cloth_tearing/core/types.h"

namespace cloth
{

/// Who holds a particle. One owner at most.
struct Attachment
{
  enum class Kind
  {
    NONE,
    PIN,    ///< stands still; never duplicated or weakened by a tear
    GRASP,  ///< follows a gripper; survives tearing, the copy on the held side stays held
  };
  Kind kind = Kind::NONE;
  std::uint64_t grasp = 0;  ///< grasp id

  bool held() const { return kind != Kind::NONE; }
  bool pinned() const { return kind == Kind::PIN; }
};

/// Where a grasp is to be and how fast it may go there.
struct DragTarget
{
  Pose pose;                   ///< of the grasp frame, cloth frame
  double linear_speed = 0.1;   ///< [m/s], > 0
  double angular_speed = 0.5;  ///< [rad/s], > 0
};

/// A way to be gone in a given time, however far.
struct Glide
{
  Pose goal;               ///< of the grasp frame, cloth frame
  double time_left = 0.0;  ///< [s]; later if that is too fast for a gripper
};

/// However rare the places of a stream, what follows it, a gripper or a sphere, is no longer under
/// way to one [s].
constexpr double LONGEST_GLIDE = 0.1;

/// How fast a gripper glides at most.
struct GripperLimits
{
  double speed = 5.0;  ///< [m/s], > 0
  double turn = 20.0;  ///< [rad/s], > 0
};

/// What the cloth exerts on a gripper, at the origin of the grasp frame, along the axes of the
/// cloth frame.
struct Wrench
{
  Vec3d force = Vec3d::Zero();   ///< [N]
  Vec3d torque = Vec3d::Zero();  ///< [N m]
};

/// Particles that keep their place in the grasp frame.
struct Grasp
{
  struct Held
  {
    ParticleId particle;
    Vec3d offset;  ///< in the grasp frame [m]
  };

  std::uint64_t id = 0;
  Pose pose;  ///< of the grasp frame, cloth frame
  std::vector<Held> held;
  std::optional<DragTarget> target;  ///< none once it has arrived
  std::optional<Glide> glide;        ///< instead of a target; none once it has arrived
  std::optional<PullUnderWay> pull;  ///< a drag that is watched
  double force_limit = 0.0;          ///< above this smoothed force it lets go [N]; 0 = never
  std::string followed;  ///< name of the frame that it follows: others may not move it; or empty
  std::string frame_problem;  ///< why it does not follow it now; empty = all is well
  Wrench wrench;              ///< in the last step
  Wrench smoothed;            ///< the same, low-passed
  double peak_force = 0.0;    ///< largest force of a single step since it was taken [N]
  int loose_pieces = 0;       ///< pieces that it holds and that hang on nothing else

  /// The smoothed force that counts for limits [N].
  double force() const { return std::sqrt(smoothed.force.squaredNorm()); }
  bool moving() const { return target || glide; }
};

/// Moves `grasp` on its way for `dt` [s], and its particles with it.
void carry(Grasp& grasp, ParticleState& state, double dt, const GripperLimits& limits);

/// Everything wrong with a target.
std::vector<std::string> problems(const DragTarget& target);

/// How far it is from one pose to another.
double distanceBetween(const Pose& a, const Pose& b);  ///< [m]
double turnBetween(const Pose& a, const Pose& b);      ///< twice the sine of half the angle [-]

}  // namespace cloth
