// Grippers: particles that follow a moving frame.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cloth_tearing/core/mesh.h"
#include "cloth_tearing/core/particle_state.h"
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
};

/// Moves `grasp` towards its target for `dt` [s], and its particles with it.
void carry(Grasp& grasp, ParticleState& state, double dt);

/// Everything wrong with a target.
std::vector<std::string> problems(const DragTarget& target);

}  // namespace cloth
