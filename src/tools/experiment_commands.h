// The experiments as commands: each prints its table and says whether its claims hold.
#pragma once

#include "experiment_options.h"

namespace cloth
{

bool balls(const Options& options);       ///< 4.1, figures 4.1 to 4.5
bool peaks(const Options& options);       ///< 4.1, where thresholds have to lie
bool map(const Options& options);         ///< 4.1, radius against speed
bool variations(const Options& options);  ///< 4.1 with other parameters
bool nonuniform(const Options& options);  ///< 4.3, half the particles
bool profile(const Options& options);     ///< 4.3, the cost of tearing
bool texture(const Options& options);     ///< 3.3, figure 3.22
bool direction(const Options& options);   ///< 4.2
bool trouser(const Options& options);     ///< 4.2: a tear that runs on from a cut

}  // namespace cloth
