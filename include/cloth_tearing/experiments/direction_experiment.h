// Thesis 4.2: how the crack runs when a gripper pulls the middle of the cloth one way.
#pragma once

#include <cstdint>
#include <optional>

#include "cloth_tearing/experiments/thesis_world.h"

namespace cloth
{

/// A gripper holds a disc of cloth and pulls it at a steady speed.
struct DirectionPull
{
  double angle = 0.0;           ///< of the pull in the sheet, 0 to the right, 90 up [degrees]
  double lift = 0.0;            ///< of the pull out of the sheet, towards its front [degrees]
  double radius = 0.5;          ///< of the disc [m]
  double speed = 1.0;           ///< [m/s]
  double way = 3.0;             ///< how far it pulls [m]
  Vec2d shift = Vec2d::Zero();  ///< of the disc from the middle of the sheet [m]
};

/// A pull for framedCloth(). It lifts the disc, as any hand does: pulled exactly in the plane, the
/// cloth before the disc cannot fold, but is crushed in its plane and breaks up.
DirectionPull framedPull(double angle, const Vec2d& shift);

/// A pull down for hungCloth(), hardly lifted: its lower part is free to give way. The disc is
/// larger, for it carries that part, 24 N, when the cloth above it has torn.
DirectionPull downwardPull(const Vec2d& shift);

/// One of a series of small shifts, all within 0.2 m either way: what varies from run to run on
/// meshes that have no seed of their own.
Vec2d shiftOf(std::uint64_t seed);

struct DirectionOutcome
{
  /// Angle between pull and crack in the material, see meanAngleTo(), when the crack is 1 m long
  /// (2 m of tornLength(), which counts both sides); none if it never was [degrees].
  std::optional<double> crack_angle;
  std::optional<double> later_crack_angle;  ///< the same at twice that length [degrees]
  double first_tear = 0.0;  ///< way of the gripper when it tore first [m]; 0 = never

  /// At the end of the pull, the angle in the world between the pull and the line from the gripper
  /// to the flap, 0 to 90. The flap is the cloth up to 1 m round the disc in the material that
  /// still hangs together with it there, taken at its centre of area. None if nothing tore, or no
  /// cloth is left round the disc [degrees].
  std::optional<double> flap_angle;
  int tears = 0;
  int released = 0;          ///< of them, springs that could only be released
  double torn_length = 0.0;  ///< tornLength() at the end [m]
  int pieces = 0;
};

/// The thesis' cloth with all four edges pinned, settled. Only then are the eight directions alike:
/// in a cloth that hangs from its upper edge, a pull upwards slackens the cloth that it would have
/// to tear, and a pull sideways swings it like a curtain.
/// @throws as hungCloth()
Simulation framedCloth(const Setting& setting);

/// Takes hold of the middle of a settled cloth and pulls.
/// @throws std::runtime_error if it runs away
DirectionOutcome pullDisc(Simulation& simulation, const DirectionPull& pull,
                          const Watch& watch = {});

}  // namespace cloth
