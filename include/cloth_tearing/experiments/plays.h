// The experiments that can be watched, by name.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cloth_tearing/experiments/thesis_world.h"

namespace cloth
{

/// Where an experiment is best seen from: on a sphere around what it looks at. The defaults show
/// all of the thesis' cloth and the balls that come, a little from the side.
struct Camera
{
  double yaw = -2.05;                    ///< of the camera seen from `focus`, about z from x [rad]
  double pitch = 0.1;                    ///< above the horizon [rad]
  double distance = 12.8;                ///< [m]
  Vec3d focus = Vec3d(0.0, -0.5, -4.2);  ///< [m], cloth frame
};

/// One run of an experiment, for players and pictures.
struct Play
{
  /// A time worth a picture.
  struct Moment
  {
    const char* name;
    double time;  ///< since the cloth hung still [s]
  };

  std::string name;
  std::string title;
  std::vector<Moment> moments;  ///< in order of time
  Camera camera = {};

  /// Plays it from beginning to end, with the tables' parameters.
  /// @throws what hungCloth() throws, and whatever `watch` throws to end it before
  std::function<void(const Setting& setting, const Watch& watch)> run;
};

/// All of them, in the order of the thesis.
const std::vector<Play>& plays();

/// @throws std::invalid_argument for an unknown name, listing the known ones
const Play& findPlay(const std::string& name);

}  // namespace cloth
