// What the cloth may strike: spheres, a floor, and the bounds of the world.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cloth_tearing/core/types.h"

namespace cloth
{

enum class SphereSource
{
  STREAMED,  ///< from a stream of sphere sets, under ids of the sender's choice
  THROWN,    ///< thrown once, under ids of our own
};

/// A ball (4.1). Kinematic with mass 0: it goes its way whatever it meets.
struct Sphere
{
  SphereSource source = SphereSource::STREAMED;
  std::uint64_t id = 0;          ///< unique within its source
  Vec3d center = Vec3d::Zero();  ///< [m], cloth frame
  Vec3d previous =
      Vec3d::Zero();  ///< centre at the start of the step [m]; contact is swept from here
  Vec3d velocity = Vec3d::Zero();  ///< [m/s]
  Vec3d jump = Vec3d::Zero();      ///< left of the way to where a stream has placed it [m]
  double jump_time = 0.0;          ///< in which it goes there [s]
  double radius = 0.1;             ///< [m], > 0
  double mass = 0.0;               ///< [kg]; 0 = kinematic
  bool fresh = true;               ///< has not been through a step yet
  Vec3d out =
      Vec3d::Zero();  ///< to where it parts cloth that it was placed into; zero: from its centre
  double age = 0.0;   ///< since it was set [s]
  Vec3d force = Vec3d::Zero();  ///< that the cloth exerted on it in the last step [N]
  double time_left = 0.0;  ///< [s]: STREAMED moves on so long and then stands, THROWN is gone then
  bool caught = false;     ///< stands still, or goes where it is sent, until it is let go
  std::string frame;       ///< that it follows, for whoever moves it; empty: none
  Vec3d center_in_frame = Vec3d::Zero();  ///< [m], in `frame`

  /// Whether what it meets can push it.
  bool yields() const { return mass > 0.0 && !caught; }
};

struct ContactParams
{
  double friction = 0.2;        ///< Coulomb, cloth on spheres [-], >= 0
  double thickness = 0.002;     ///< cloth stays this far off a surface [m], > 0
  double push_speed = 2.0;      ///< how fast cloth found inside a surface is pushed out [m/s], > 0
  bool floor = false;           ///< a horizontal plane that cloth and dynamic spheres rest on
  double floor_height = 0.0;    ///< [m], cloth frame, along +z
  double floor_friction = 0.5;  ///< Coulomb [-], >= 0
  Vec3d bounds_min = Vec3d::Constant(-50.0);  ///< [m]; a loose piece beyond is put to rest
  Vec3d bounds_max = Vec3d::Constant(50.0);   ///< [m]
  double max_sphere_speed = 50.0;  ///< [m/s]; a sphere faster than this is placed anew, untouched
  double sphere_timeout = 0.5;     ///< a streamed sphere moves on for so long [s]
};

std::vector<std::string> problems(const ContactParams& params);

/// Everything wrong with a sphere that is to be set or thrown.
std::vector<std::string> problems(const Sphere& sphere);

}  // namespace cloth
