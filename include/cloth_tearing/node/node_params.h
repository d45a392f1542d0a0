// Everything that the node is told at its start.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "cloth_tearing/core/import_report.h"
#include "cloth_tearing/core/mesh_builder.h"
#include "cloth_tearing/core/pins.h"
#include "cloth_tearing/core/simulation.h"
#include "cloth_tearing/core/simulation_loop.h"
#include "cloth_tearing/node/recording.h"
#include "cloth_tearing/node/state_store.h"

namespace cloth_tearing
{

/// What the cloth's colour shows.
enum class Coloring
{
  TEXTURE,    ///< a woven checker, laid on by the texture position
  STRAIN,     ///< blue - white - red
  PLAIN,      ///< one colour
  WIREFRAME,  ///< the springs alone, from pale to red by their strain
};

/// What a grasp does whose frame is lost.
enum class LostFrame
{
  HOLD,     ///< stays where the frame was last
  RELEASE,  ///< lets go
};

/// How ~markers look.
struct MarkerStyle
{
  Coloring coloring = Coloring::TEXTURE;
  int checks = 16;                                    ///< along one unit of u and of v, 1 to 200
  std::array<double, 2> strain_range = { 0.0, 0.2 };  ///< from end to end of the colours [-]
  cloth::Vec3d plain_color = cloth::Vec3d(0.85, 0.80, 0.70);  ///< red, green, blue [-], 0 to 1
  double edge_width = 0.004;                                  ///< of torn edges [m], > 0
  double point_size = 0.016;  ///< weak points and held particles [m], > 0
};

/// Handles by which users of interactive markers take hold of cloth and spheres.
struct HandleParams
{
  bool enabled = false;
  double rate = 20.0;         ///< they follow what they are on so often [Hz], 0.1 to 1000
  double radius = 0.05;       ///< the hand holds and pins what is within [m], 0.0001 to 1000
  double throw_speed = 10.0;  ///< of balls that are thrown by them [m/s], > 0, at most 1000
  double ball_radius = 0.06;  ///< of those that the hand throws [m], 0.0001 to 100
};

/// The defaults make a usable node. `simulation` holds the height of the floor in frame_id and the
/// strength map in model coordinates here; see inClothFrame().
struct NodeParams
{
  std::string frame_id = "world";  ///< everything is published in it and transformed into it

  /// Where the model's origin and axes are, in frame_id. Models lie in x-y with y up; the default
  /// hangs them upright, their front towards -y.
  cloth::Pose cloth_pose = { cloth::Vec3d(0.0, 0.0, 1.5),
                             cloth::Quatd(std::sqrt(0.5), std::sqrt(0.5), 0.0, 0.0) };

  cloth::Pace pace = cloth::Pace::WALL;
  double speed = 1.0;          ///< of Pace::WALL: simulated over real time [-], 0.001 to 1000
  bool paused = false;         ///< start paused
  bool publish_clock = false;  ///< /clock shows the simulation's time; not with Pace::CLOCK
  double clock_rate = 100.0;   ///< so often, in simulated time [Hz], 0.1 to 100000

  std::string model_file;  ///< an OBJ file, a path or package://PACKAGE/PATH; empty = the rectangle
  std::string export_folder;  ///< of ~export; empty = nothing is exported
  /// ~load_model takes files below these.
  std::vector<std::string> model_folders = { "package://cloth_tearing/models" };
  cloth::ImportOptions import;
  cloth::RectangleParams rectangle;
  cloth::PinParams pins = { { "top" }, {}, {} };
  cloth::SimulationParams simulation;
  StateStoreParams states;
  RecordingParams recording;

  double max_model_file = 100.0;  ///< length of an OBJ file [MB], 0.001 to MAX_MODEL_FILE
  int max_commands = 1000;        ///< that wait for the simulation, 1 to MAX_COMMANDS

  double tf_patience = 0.2;       ///< how long a request may wait for its transform [s], 0 to 10
  double command_patience = 1.0;  ///< how long it may wait for the simulation [s], 0.01 to 60
  double frame_timeout = 0.5;     ///< a frame without news for so long is lost [s], 0.01 to 60
  LostFrame lost_frame = LostFrame::HOLD;
  double grasp_state_rate = 50.0;  ///< ~grasp_states, wrenches at most so often [Hz], 0.1 to 1000
  double marker_rate = 30.0;       ///< ~markers at most so often [Hz], 0.1 to 1000
  double surface_rate = 30.0;      ///< ~surface at most so often [Hz], 0.1 to 1000
  double status_rate = 10.0;       ///< ~status so often [Hz], 0.1 to 1000
  double master_period = 2.0;  ///< asks the master so often whether it knows it [s], 0.1 to 3600
  MarkerStyle markers;
  HandleParams handles;
};

/// Everything wrong with `params`, one sentence each, naming the parameter; empty if they can be
/// used.
std::vector<std::string> problems(const NodeParams& params);
std::vector<std::string> problems(const MarkerStyle& style);
std::vector<std::string> problems(const HandleParams& handles);

/// Everything wrong with where the cloth is: frame_id and cloth_pose/position [m] in it.
std::vector<std::string> placeProblems(const std::string& frame_id, const cloth::Vec3d& position);

/// A height in frame_id [m] over the cloth frame's origin. Where there is no floor its height may
/// be anything, and stays.
double floorInClothFrame(bool floor, double height, double origin);

/// The simulation's parameters with the floor's height and the strength map in the cloth frame,
/// whose axes are those of frame_id and whose origin is cloth_pose.position.
cloth::SimulationParams inClothFrame(const NodeParams& params);

/// The file or folder that `path` names: package:// leads into an installed package.
/// @param parameter that says it, for messages
/// @throws std::runtime_error if there is no such package
std::string resolvedPath(const std::string& parameter, const std::string& path);

/// The model that `params` name, its axes those of frame_id, its origin at cloth_pose.position,
/// and the particles that are pinned.
struct PlacedModel
{
  cloth::ClothModel model;
  std::vector<int> pinned;
  std::vector<std::string> findings;  ///< what the import mended, dropped or made up
};

/// @throws std::runtime_error or std::invalid_argument saying why there is no such model
PlacedModel placedModel(const NodeParams& params);

}  // namespace cloth_tearing
