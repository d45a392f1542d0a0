// Loads models from the folders that it may, and exports the cloth.
#include "cloth_tearing/node/model_services.h"

#include <ros/console.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/obj_writer.h"
#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/node/file_names.h"
#include "cloth_tearing/node/whole_file.h"

namespace cloth_tearing
{

namespace
{

namespace fs = std::filesystem;

/// What is wrong with a request by itself.
std::vector<std::string> problems(const LoadModel::Request& request)
{
  using cloth::Range;
  std::vector<std::string> found;
  cloth::check(found, "scale [m]", request.scale, Range::atLeast(0.0));
  cloth::check(found, "weld_distance [m]", request.weld_distance, Range());
  if (request.model.empty())
  {
    const std::string why = " without a model: the cloth of the start comes back as it was";
    if (request.scale != 0.0)
    {
      found.push_back("scale is " + cloth::text(request.scale) + ", must be 0" + why);
    }
    if (request.weld_distance > 0.0)
    {
      found.push_back("weld_distance is " + cloth::text(request.weld_distance) +
                      ", must be 0 or less" + why);
    }
    return found;
  }
  for (const std::string& problem : pathProblems(request.model))
  {
    found.push_back("model: " + problem);
  }
  return found;
}

/// Whether `path` lies below `folder`; both are canonical.
bool isBelow(const fs::path& path, const fs::path& folder)
{
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

}  // namespace

ModelServices::ModelServices(const NodeContext& context, const NodeParams& params)
    : context_(context), params_(params)
{
  RequestServer& requests = context_.requests;
  ros::NodeHandle& node = context_.node;
  requests.serve<LoadModel>(node, "load_model", [this](auto& q, auto& a) { onLoadModel(q, a); });
  requests.serve<Export>(
      node, "export", [this](auto& q, auto& a) { onExport(q, a); }, Effect::LOOKS);
}

void ModelServices::onLoadModel(const LoadModel::Request& request, LoadModel::Response& response)
{
  cloth::refuseIf(problems(request));
  const PlacedModel placed = placedModel(wanted(request));
  const cloth::SimulationParams in_force =
      context_.loop.call([](const cloth::Simulation& simulation) { return simulation.params(); });
  cloth::Simulation other(placed.model, placed.pinned, in_force);
  response.findings = placed.findings;
  for (const std::string& note : other.startNotes())
  {
    ROS_WARN_STREAM(note);
    response.findings.push_back(note);
  }
  response.particles = static_cast<std::uint32_t>(other.cloth().mesh.particleCount());
  response.triangles = static_cast<std::uint32_t>(other.cloth().mesh.triangleCount());
  response.pieces = static_cast<std::uint32_t>(other.cloth().damage.pieces);
  const std::uint64_t settled = context_.publisher.faults();
  context_.loop.takeCloth(std::move(other));
  context_.publisher.clearFault(settled);
}

/// The node's parameters with the model that is asked for.
NodeParams ModelServices::wanted(const LoadModel::Request& request) const
{
  NodeParams params = params_;
  if (!request.model.empty())
  {
    params.model_file = modelFile(request.model);
    params.import.scale = request.scale > 0.0 ? request.scale : params.import.scale;
    params.import.weld_distance =
        request.weld_distance >= 0.0 ? request.weld_distance : params.import.weld_distance;
    cloth::refuseIf(problems(params.import));
  }
  return params;
}

/// The file at `path` below the first of model_folders that has it, links resolved.
std::string ModelServices::modelFile(const std::string& path) const
{
  std::string looked_in;
  for (const std::string& named : params_.model_folders)
  {
    looked_in += (looked_in.empty() ? "" : ", ") + named;
    std::error_code error;
    const fs::path folder = fs::canonical(resolvedPath("model_folders", named), error);
    const fs::path file = error ? fs::path() : fs::canonical(folder / path, error);
    if (error)
    {
      continue;
    }
    if (!isBelow(file, folder))
    {
      throw cloth::Refusal("model " + path + " leads out of " + named);
    }
    if (!fs::is_regular_file(file, error))
    {
      throw cloth::Refusal("model " + path + " is no file");
    }
    return file.string();
  }
  throw cloth::Refusal("there is no model " + path + " in model_folders: " +
                       (looked_in.empty() ? "the list is empty" : looked_in));
}

void ModelServices::onExport(const Export::Request& request, Export::Response& response)
{
  cloth::refuseIf(nameProblems(request.name));
  if (params_.export_folder.empty())
  {
    throw cloth::Refusal("export_folder is empty, must name a folder for anything to be exported");
  }
  const fs::path folder = resolvedPath("export_folder", params_.export_folder);
  const fs::path file = folder / (request.name + ".obj");
  const cloth::Surface surface = context_.loop.call([](const cloth::Simulation& simulation)
                                                    { return makeSurface(simulation.cloth()); });
  std::ostringstream text;
  writeObj(text, surface, context_.placement.origin);
  writeWholeFile(file.string(), request.replace ? Existing::REPLACE : Existing::KEEP, text.str());
  response.path = file.string();
}

}  // namespace cloth_tearing
