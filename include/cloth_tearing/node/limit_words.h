// Tells all limits of a node, for its start.
#pragma once

#include <string>

#include "cloth_tearing/node/node_params.h"

namespace cloth_tearing
{

/// One line for each limit in force: parameter, value, unit and the most that it may be set to;
/// then those that no parameter sets.
std::string limitsInWords(const NodeParams& params);

}  // namespace cloth_tearing
