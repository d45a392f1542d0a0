// Has the node's run recorded to a file of its own.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cloth_tearing/core/record.h"
#include "cloth_tearing/core/simulation.h"

namespace cloth_tearing
{

struct RecordingParams
{
  std::string folder;     ///< an absolute path; empty = nothing is recorded
  double limit = 1000.0;  ///< a file gets no longer [MB], 1 to MAX_RECORDING
};

/// Everything wrong with `params`, one sentence each, naming the parameter.
std::vector<std::string> problems(const RecordingParams& params);

/// Begins to record `simulation`, to which nothing has happened since it was built from `start`, to
/// a new file in the folder, which is made if it is missing.
/// @param on_problem called once, on the simulation's thread, with the reason when the recording
/// ends before the simulation
/// @return path of the file
/// @throws cloth::Refusal with the path and why there is no such file
std::string beginRecording(cloth::Simulation& simulation, const cloth::RecordedStart& start,
                           const RecordingParams& params,
                           const std::function<void(const std::string&)>& on_problem);

}  // namespace cloth_tearing
