// The experiments as commands: each prints its table and says whether its claims hold.
#pragma once

#include "experiment_options.h"

namespace cloth
{

bool balls(const Options& options);  ///< 4.1, figures 4.1 to 4.5

}  // namespace cloth
