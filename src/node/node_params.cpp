// What is wrong with the node's parameters, and what becomes of them.
#include "cloth_tearing/node/node_params.h"

#include <ros/package.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/obj_reader.h"
#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/node/frame_names.h"

namespace cloth_tearing
{

using cloth::check;
using cloth::Range;

namespace
{

constexpr double FARTHEST_ORIGIN = 1e7;  // [m], of the cloth frame from that of frame_id

void append(std::vector<std::string>& found, const std::string& group,
            const std::vector<std::string>& problems)
{
  for (const std::string& problem : problems)
  {
    found.push_back(group + problem);
  }
}

/// What is wrong with the simulation's parameters, each group under its own name.
std::vector<std::string> grouped(const cloth::SimulationParams& simulation)
{
  const std::vector<std::pair<std::string, std::vector<std::string>>> groups = {
    { "material/", problems(simulation.material) },
    { "environment/", problems(simulation.environment) },
    { "tearing/", problems(simulation.tearing) },
    { "strength/", problems(simulation.strength) },
    { "contact/", problems(simulation.contact) },
  };
  std::vector<std::string> rest = problems(simulation);
  std::vector<std::string> found;
  for (const auto& group : groups)
  {
    append(found, group.first, group.second);
    for (const std::string& problem : group.second)
    {
      rest.erase(std::remove(rest.begin(), rest.end(), problem), rest.end());
    }
  }
  append(found, "", rest);
  return found;
}

constexpr double MEGABYTE = 1e6;

/// What is there and can only disappoint: a pipe would never end.
/// @param most length of the file [MB]
void refuseUnreadable(const std::string& file, double most)
{
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status))
  {
    return;  // whoever opens it says why
  }
  if (!std::filesystem::is_regular_file(status))
  {
    throw cloth::Refusal("model_file " + file + " is no file");
  }
  std::vector<std::string> found;
  check(found, "model_file " + file + ": its length [MB]",
        static_cast<double>(std::filesystem::file_size(file, error)) / MEGABYTE,
        Range::between(0.0, most));
  if (!found.empty())
  {
    throw cloth::Refusal(found.front() + " (limits/model_file)");
  }
}

const std::string PACKAGE_SCHEME = "package://";

bool inPackage(const std::string& path)
{
  return path.compare(0, PACKAGE_SCHEME.size(), PACKAGE_SCHEME) == 0;
}

void checkPath(std::vector<std::string>& found, const std::string& parameter,
               const std::string& path)
{
  if (!inPackage(path) && (path.empty() || path.front() != '/'))
  {
    found.push_back(parameter + " is \"" + path + "\", must be an absolute path or " +
                    PACKAGE_SCHEME + "PACKAGE/PATH");
  }
}

}  // namespace

std::string resolvedPath(const std::string& parameter, const std::string& path)
{
  if (!inPackage(path))
  {
    return path;
  }
  const std::size_t name = PACKAGE_SCHEME.size();
  const std::size_t slash = path.find('/', name);
  const std::string package = path.substr(name, slash - name);
  const std::string folder = ros::package::getPath(package);
  if (folder.empty() || slash == std::string::npos)
  {
    throw std::runtime_error(
        parameter + " " + path + ": " +
        (folder.empty() ? "there is no package " + package : "there is no path after the package"));
  }
  return folder + path.substr(slash);
}

std::vector<std::string> placeProblems(const std::string& frame_id, const cloth::Vec3d& position)
{
  std::vector<std::string> found;
  if (frame_id.empty())
  {
    found.push_back("frame_id is empty, must name a tf frame");
  }
  checkFrameName(found, "frame_id", frame_id);
  check(found, "cloth_pose/position [m]", position, FARTHEST_ORIGIN);
  return found;
}

std::vector<std::string> problems(const MarkerStyle& style)
{
  std::vector<std::string> found;
  check(found, "checks", style.checks, Range::between(1, 200));
  check(found, "edge_width [m]", style.edge_width, Range::aboveUpTo(0.0, 1.0));
  check(found, "point_size [m]", style.point_size, Range::aboveUpTo(0.0, 1.0));
  for (int i = 0; i < 3; ++i)
  {
    check(found, "plain_color[" + std::to_string(i) + "]", style.plain_color[i],
          Range::between(0.0, 1.0));
  }
  if (!(style.strain_range[0] < style.strain_range[1]))
  {
    found.push_back("strain_range is from " + cloth::text(style.strain_range[0]) + " to " +
                    cloth::text(style.strain_range[1]) + ", must ascend");
  }
  return found;
}

std::vector<std::string> problems(const HandleParams& handles)
{
  std::vector<std::string> found;
  check(found, "rate [Hz]", handles.rate, Range::between(0.1, 1000.0));
  check(found, "radius [m]", handles.radius, Range::between(1e-4, 1000.0));
  check(found, "throw_speed [m/s]", handles.throw_speed, Range::aboveUpTo(0.0, 1000.0));
  check(found, "ball_radius [m]", handles.ball_radius, Range::between(1e-4, 100.0));
  return found;
}

std::vector<std::string> problems(const NodeParams& params)
{
  std::vector<std::string> found;
  append(found, "", placeProblems(params.frame_id, params.cloth_pose.position));
  cloth::checkSpeed(found, params.speed);
  check(found, "clock_rate [Hz]", params.clock_rate, Range::between(0.1, 100000.0));
  if (params.publish_clock && params.pace == cloth::Pace::CLOCK)
  {
    found.push_back(
        "publish_clock is true with pace clock, must be false: it would follow its own clock");
  }
  check(found, "tf_patience [s]", params.tf_patience, Range::between(0.0, 10.0));
  check(found, "command_patience [s]", params.command_patience, Range::between(0.01, 60.0));
  check(found, "frame_timeout [s]", params.frame_timeout, Range::between(0.01, 60.0));
  check(found, "grasp_state_rate [Hz]", params.grasp_state_rate, Range::between(0.1, 1000.0));
  check(found, "marker_rate [Hz]", params.marker_rate, Range::between(0.1, 1000.0));
  check(found, "surface_rate [Hz]", params.surface_rate, Range::between(0.1, 1000.0));
  check(found, "status_rate [Hz]", params.status_rate, Range::between(0.1, 1000.0));
  check(found, "master_period [s]", params.master_period, Range::between(0.1, 3600.0));
  append(found, "markers/", problems(params.markers));
  append(found, "handles/", problems(params.handles));
  if (!params.model_file.empty())
  {
    checkPath(found, "model_file", params.model_file);
  }
  for (std::size_t i = 0; i < params.model_folders.size(); ++i)
  {
    checkPath(found, "model_folders[" + std::to_string(i) + "]", params.model_folders[i]);
  }
  if (!params.export_folder.empty())
  {
    checkPath(found, "export_folder", params.export_folder);
  }
  append(found, "import/", problems(params.import));
  append(found, "rectangle/", problems(params.rectangle));
  append(found, "pins: ", problems(params.pins));
  append(found, "", grouped(params.simulation));
  append(found, "", problems(params.states));
  check(found, "limits/model_file [MB]", params.max_model_file,
        Range::between(0.001, cloth::MAX_MODEL_FILE));
  check(found, "limits/commands", params.max_commands, Range::between(1, cloth::MAX_COMMANDS));
  append(found, "", problems(params.recording));
  return found;
}

double floorInClothFrame(bool floor, double height, double origin)
{
  return floor ? height - origin : height;
}

cloth::SimulationParams inClothFrame(const NodeParams& params)
{
  cloth::SimulationParams simulation = params.simulation;
  simulation.strength = cloth::turned(simulation.strength, params.cloth_pose.rotation);
  cloth::ContactParams& contact = simulation.contact;
  contact.floor_height =
      floorInClothFrame(contact.floor, contact.floor_height, params.cloth_pose.position.z());
  return simulation;
}

PlacedModel placedModel(const NodeParams& params)
{
  PlacedModel placed;
  if (params.model_file.empty())
  {
    placed.model = cloth::rectangle(params.rectangle);
  }
  else
  {
    const std::string file = resolvedPath("model_file", params.model_file);
    refuseUnreadable(file, params.max_model_file);
    cloth::ImportOptions import = params.import;
    import.max_bytes = static_cast<std::size_t>(MEGABYTE * params.max_model_file);
    cloth::ObjImport imported = cloth::readObjFile(file, import);
    placed.model = std::move(imported.model);
    for (const cloth::ImportFinding& finding : imported.report.findings)
    {
      placed.findings.push_back("line " + std::to_string(finding.line) + ": " + finding.text);
    }
  }
  placed.pinned = cloth::pinnedParticles(placed.model, params.pins);
  for (cloth::Vec3d& position : placed.model.positions)
  {
    position = params.cloth_pose.rotation * position;
  }
  return placed;
}

}  // namespace cloth_tearing
