// Carries the player's parameters from the parameter server and names everything wrong with them.
#include "cloth_tearing/node/player_params.h"

#include <stdexcept>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/experiments/plays.h"
#include "cloth_tearing/node/params_loader.h"

namespace cloth_tearing
{

using cloth::check;
using cloth::Range;

namespace
{

void readAll(ParamReader& reader, PlayerParams& params)
{
  reader.read("experiment", params.experiment);
  reader.read("resolution", params.setting.resolution);
  readPattern(reader, "mesh", params.setting.pattern);
  readSeed(reader, "seed", params.setting.seed);
  reader.read("grading", params.setting.grading);
  readSolver(reader, params.setting.solver);
  reader.read("time_step", params.setting.time_step);

  reader.readChoice<cloth::Pace>(
      "pace", { { "wall", cloth::Pace::WALL }, { "free", cloth::Pace::FREE } }, params.pace);
  reader.read("frame_id", params.placement.frame_id);
  reader.read("cloth_pose/position", params.placement.origin);
  reader.read("marker_rate", params.marker_rate);
  readMarkers(reader, params.markers);

  reader.read("viewer_patience", params.viewer_patience);
  reader.read("stop_at_moments", params.stop_at_moments);
  reader.read("picture_pause", params.picture_pause);
  reader.read("exit_when_done", params.exit_when_done);
}

void append(std::vector<std::string>& found, const std::string& group,
            const std::vector<std::string>& problems)
{
  for (const std::string& problem : problems)
  {
    found.push_back(group + problem);
  }
}

std::vector<std::string> problems(const PlayerParams& params)
{
  std::vector<std::string> found;
  try
  {
    cloth::findPlay(params.experiment);
  }
  catch (const std::invalid_argument& unknown)
  {
    found.push_back(unknown.what());
  }
  check(found, "resolution", params.setting.resolution, Range::between(4, 500));
  check(found, "grading", params.setting.grading, Range::between(0.2, 5.0));
  append(found, "", cloth::problems(cloth::thesisParams(params.setting)));
  append(found, "", placeProblems(params.placement.frame_id, params.placement.origin));
  check(found, "marker_rate [Hz]", params.marker_rate, Range::between(0.1, 1000.0));
  append(found, "markers/", problems(params.markers));
  check(found, "viewer_patience [s]", params.viewer_patience, Range::between(0.0, 600.0));
  check(found, "picture_pause [s]", params.picture_pause, Range::between(0.0, 600.0));
  return found;
}

}  // namespace

PlayerParams::PlayerParams()
{
  placement.frame_id = "world";
  placement.origin = cloth::Vec3d(0.0, 0.0, 9.0);
  markers.strain_range = { 0.0, 0.15 };
  markers.edge_width = 0.05;
  markers.point_size = 0.12;
}

LoadedPlayerParams loadPlayerParams(const XmlRpc::XmlRpcValue& tree)
{
  LoadedPlayerParams loaded;
  ParamReader reader(tree);
  readAll(reader, loaded.params);
  reader.noteLeftOver();
  loaded.problems = reader.problems();
  append(loaded.problems, "", problems(loaded.params));
  return loaded;
}

}  // namespace cloth_tearing
