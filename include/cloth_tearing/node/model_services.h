// Requests that put another model in the cloth's place, and that write the cloth to a file.
#pragma once

#include <cloth_tearing/Export.h>
#include <cloth_tearing/LoadModel.h>

#include <string>

#include "cloth_tearing/node/node_params.h"
#include "cloth_tearing/node/request_server.h"

namespace cloth_tearing
{

/// ~load_model and ~export. Files are read and written on the requests' threads.
class ModelServices
{
public:
  ModelServices(const NodeContext& context, const NodeParams& params);

private:
  void onLoadModel(const LoadModel::Request& request, LoadModel::Response& response);
  void onExport(const Export::Request& request, Export::Response& response);

  NodeParams wanted(const LoadModel::Request& request) const;
  std::string modelFile(const std::string& path) const;

  NodeContext context_;
  NodeParams params_;  ///< those of the start
};

}  // namespace cloth_tearing
