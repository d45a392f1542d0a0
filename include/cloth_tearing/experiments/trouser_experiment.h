// Thesis 4.2, the trouser pull: a sheet with a cut, whose legs are pulled apart.
#pragma once

#include "cloth_tearing/experiments/thesis_world.h"

namespace cloth
{

/// Force of the cloth on a grasp [N]: of all structural and bend-shear springs, with their damping,
/// between a particle that it holds and one that it does not.
///
/// Exact for the force springs. XPBD's one sweep a step leaves springs longer than their load, so
/// it reads high: about 2 percent at 30 x 30 and 1 ms, and by the square of step times resolution.
Vec3d forceOnGrasp(const Simulation& simulation, std::uint64_t grasp);

struct TrouserOutcome
{
  double advance = 0.0;     ///< how far the tear ran on in the direction of the cut [m]
  double angle = 0.0;       ///< between the cut and the line from its end to the tear's [degrees]
  double edge_angle = 0.0;  ///< mean angle between the torn edges and the cut [degrees]
  double straying = 0.0;    ///< rms distance of the tear from the line of the cut [m]
  double tortuosity = 0.0;  ///< length of the tear over its advance [-]

  /// On a leg, along its pull, from the first tear until the end [N].
  double mean_force = 0.0;
  double peak_force = 0.0;
  double edge_length = 0.0;  ///< mean rest length of the sheet's springs [m]
  int tears = 0;
  int released = 0;
  int pieces = 0;

  /// Whether the tear ran on along the cut: 3 m in its direction, end to end within 25 degrees of
  /// it, and within 1.2 m rms of its line. A tear that a grid leads astray follows the diagonals,
  /// at 37 degrees and 1.3 m; pulled at the legs' middles the largest are 22 degrees and 1.0 m.
  bool runsOn() const;
};

/// The thesis' sheet, pinned at its upper edge, cut from the middle of its lower edge half way up.
/// It has no weight: in the test that this follows (ISO 13937-2) a specimen weighs a gram and takes
/// tens of newtons to tear, while each leg of this sheet would weigh 12 N and tear it by itself.
/// @throws Refusal or std::invalid_argument, naming what is wrong
Simulation trousers(const Setting& setting);

/// Takes hold of both legs near their ends and pulls them out of the sheet, one to its front and
/// one to its back (mode III), until the tear has run on for 3 m or the grippers have arrived.
///
/// The grippers rise as they part, so that the legs stay slack until they are nearly level.
///
/// @param simulation of trousers()
/// @param shift of where the legs are held [m], see shiftOf(): what varies from run to run
/// @throws std::runtime_error if it runs away
TrouserOutcome pullLegs(Simulation& simulation, const Vec2d& shift = Vec2d::Zero(),
                        const Watch& watch = {});

}  // namespace cloth
