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

/// A pull for framedCloth() straight out of the sheet, the control: it has no direction in it.
DirectionPull outwardPull(const Vec2d& shift);

/// A pull down for hungCloth(), hardly lifted: its lower part is free to give way. The disc is
/// larger, for it carries that part, 24 N, when the cloth above it has torn.
DirectionPull downwardPull(const Vec2d& shift);

/// One of a series of small shifts, all within 0.2 m either way: what varies from run to run on
/// meshes that have no seed of their own.
Vec2d shiftOf(std::uint64_t seed);

/// A crack in the material against the direction of a pull, 0 along it, 90 across [degrees].
struct CrackAngles
{
  double line = 0.0;   ///< of the crack as a whole, lineAngleTo()
  double edges = 0.0;  ///< mean over its edges, teeth and all, meanAngleTo()
};

/// Where a tear went on after its first metre: from the middle of the edges that it opened until
/// then to the middle of all that it opened afterwards, in the material.
struct TearCourse
{
  double along = 0.0;   ///< in the direction of the pull; negative: against it [m]
  double across = 0.0;  ///< to the left of it [m]

  /// To the direction of the pull: 0 with it, 180 against it [degrees].
  double angle() const;
};

struct DirectionOutcome
{
  /// When the crack is 1 m long (2 m of tornLength(), which counts both sides); none if it never
  /// was.
  std::optional<CrackAngles> crack;
  std::optional<CrackAngles> later_crack;  ///< the same at twice that length
  std::optional<TearCourse> course;  ///< none if the crack never was 1 m long, or grew no more
  double first_tear = 0.0;           ///< way of the gripper when it tore first [m]; 0 = never

  /// Angle in the world between the pull and the line to the gripper from the flap: 0 if it trails
  /// straight behind the gripper, 180 if it lies straight ahead. The flap is the cloth up to 1 m
  /// round the disc in the material that still hangs together with it there, taken at its centre of
  /// area; untorn cloth has one too. None if no cloth is left round the disc [degrees].
  std::optional<double> flap_angle;       ///< half way
  std::optional<double> last_flap_angle;  ///< at the end of the pull
  bool loose = false;                     ///< in the end the disc hangs from no pin any more
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

/// The same cloth with tearing off, to be pulled for comparison.
Simulation withoutTearing(const Simulation& simulation);

/// Takes hold of the middle of a settled cloth and pulls.
/// @throws std::runtime_error if it runs away
DirectionOutcome pullDisc(Simulation& simulation, const DirectionPull& pull,
                          const Watch& watch = {});

}  // namespace cloth
