// How long a step of an engine may be: the longest that is stable and stretches cloth little
// enough.
#pragma once

#include "engine.h"

namespace cloth_bench
{

/// The 99th percentile of a hung cloth's elongation that counts as stiff enough [-].
constexpr double MATCHED_ELONGATION = 0.10;

/// The longest usable step and what was measured with it.
struct HangingStep
{
  double time_step = 0.0;   ///< [s]; 0 = none was found
  double elongation = 0.0;  ///< 99th percentile over structural springs, at rest [-]
  bool scaled = false;      ///< from a coarser cloth by 1 / side; `elongation` is that one's
};

/// Searches at 30 and at 100 particles a side and for a garment; finer cloth gets the step of 100
/// in proportion to its spacing. Remembers what it found.
HangingStep hangingStep(EngineKind kind, MeshKind mesh, int side, const std::string& garment);

/// Takes over what an earlier run has found, if the file is there, and adds what is found from now
/// on. @throws std::runtime_error if it cannot be read
void keepHangingStepsIn(const std::string& file);

}  // namespace cloth_bench
