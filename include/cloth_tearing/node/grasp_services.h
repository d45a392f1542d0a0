// Requests that take hold of the cloth, drag it and let go.
#pragma once

#include <cloth_tearing/Release.h>

#include "cloth_tearing/node/request_server.h"

namespace cloth_tearing
{

/// ~grasp, ~drag and ~release.
class GraspServices
{
public:
  explicit GraspServices(const NodeContext& context);

private:
  void onGrasp(const Grasp::Request& request, Grasp::Response& response);
  void onDrag(const Drag::Request& request);
  void onRelease(const Release::Request& request, Release::Response& response);

  NodeContext context_;
};

}  // namespace cloth_tearing
