// Everything that the player of experiments is told at its start.
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <string>
#include <vector>

#include "cloth_tearing/core/simulation_loop.h"
#include "cloth_tearing/experiments/thesis_world.h"
#include "cloth_tearing/node/conversions.h"
#include "cloth_tearing/node/node_params.h"

namespace cloth_tearing
{

/// The defaults play with the parameters of the tables, where config/thesis.yaml hangs the cloth.
/// The markers are large, as it is, and their colours end where it is about to tear.
struct PlayerParams
{
  PlayerParams();

  std::string experiment;  ///< one of cloth::plays()
  cloth::Setting setting;
  cloth::Pace pace = cloth::Pace::WALL;  ///< or FREE
  Placement placement;                   ///< frame_id, cloth_pose/position
  double marker_rate = 30.0;             ///< ~markers so often on the wall clock [Hz], 0.1 to 1000
  MarkerStyle markers;
  double viewer_patience = 0.0;  ///< wait so long for a first subscriber [s], 0 to 600
  bool stop_at_moments = false;  ///< stop for a picture at each moment of the experiment
  double picture_pause = 3.0;    ///< so long [s], 0 to 600
  bool exit_when_done = false;   ///< else it stays, so that the end can be looked at
};

struct LoadedPlayerParams
{
  PlayerParams params;
  std::vector<std::string> problems;  ///< one sentence each; empty if `params` can be used
};

/// As loadParams(): wrong types, values and names are all reported.
///
/// @param tree the node's private namespace: a struct, or an invalid value if there is none
LoadedPlayerParams loadPlayerParams(const XmlRpc::XmlRpcValue& tree);

}  // namespace cloth_tearing
