// Parameters that change while the node runs, by dynamic_reconfigure under the names of cloth.yaml.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "cloth_tearing/core/simulation_loop.h"
#include "cloth_tearing/node/request_server.h"

namespace cloth_tearing
{

/// Speaks to dynamic_reconfigure's clients, for each group in its namespace: ~material/
/// set_parameters, ..., and ~set_parameters for what has no group. They know no lists, so a vector
/// is a group of x, y and z. dynamic_reconfigure's own server would make room for as many values as
/// a request says it has.
///
/// dynamic_reconfigure cannot refuse: a change that the simulation refuses is answered with the
/// values in force, warned of and counted. Values beyond a limit it brings to the limit by itself.
class LiveTuning
{
public:
  /// @param start what the cloth was built with, in frame_id
  LiveTuning(const NodeContext& context, const cloth::LoopTuning& start);
  ~LiveTuning();

  /// Shows the values in force, when something else has changed them. Warns if the simulation is
  /// too busy to tell.
  void show();

private:
  class Group;
  template <class Config>
  class GroupOf;

  template <class Config>
  void open(const std::string& name, const cloth::LoopTuning& start);

  NodeContext context_;
  std::mutex mutex_;  ///< of all groups: what they show is what is in force
  std::vector<std::unique_ptr<Group>> groups_;
};

}  // namespace cloth_tearing
