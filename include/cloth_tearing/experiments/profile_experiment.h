// Thesis 4.3: what tearing costs while a cloth is torn all the time.
#pragma once

#include <array>

#include "cloth_tearing/core/step_observer.h"
#include "cloth_tearing/experiments/thesis_world.h"

namespace cloth
{

/// Simulated time of the profile [s].
constexpr double PROFILE_TIME = 34.0;

struct ProfileOutcome
{
  Summary before;          ///< the cloth as it hangs
  Summary after;           ///< and as it is left
  double torn_time = 0.0;  ///< seconds of the run in which something tore, each counted whole [s]
  std::array<double, STEP_PHASES> time{};  ///< wall time of the phases of all steps [s]

  int tears() const;

  /// Wall time of all phases: the thesis' update() [s].
  double update() const;

  /// What of it goes into finding springs over their thresholds [-]. That the solver notes the long
  /// ones is part of ADVANCE.
  double detecting() const;

  /// What of it goes into cutting the mesh, and all that follows a cut [-].
  double editing() const;

  /// Whether the cloth was that of 4.3: 900 particles, 2581 structural and 2465 bend-shear springs,
  /// 1682 triangles.
  bool hasThesisCounts() const;

  /// Whether it was torn about as much as in 4.3, where it tore 510 times: 400 to 650.
  bool hasThesisTears() const;
};

/// The thesis' cloth, hung and settled with everything on that 4.3 lists: a breeze of 2 m/s from
/// the front as well.
/// @throws what hungCloth() throws
Simulation profileCloth(const Setting& setting);

/// Tears the cloth by dragging, from its lower edge up, so that there is always cloth left: takes
/// hold at a hundred places, one every 0.34 s, pulls each towards the front and in turn to one of
/// eight sides, and lets go after 0.3 s, or 8 tears if they come earlier.
///
/// @param simulation hung and settled; ends as the last pull left it
/// @param watch called after every step, between the timed ones; may be empty
/// @throws std::runtime_error if it runs away, or nothing hangs from the pins any more
ProfileOutcome profile(Simulation& simulation, const Watch& watch = {});

}  // namespace cloth
