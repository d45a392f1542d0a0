// The world of the thesis' chapter 4: its cloth, in its own units, hung and settled.
#pragma once

#include "cloth_tearing/core/mesh_builder.h"
#include "cloth_tearing/core/simulation.h"

namespace cloth
{

/// One parameter set for all experiments of a solver. XPBD tears by the mesh-independent rules;
/// the force springs by the thesis' own local rule, to the letter.
SimulationParams thesisParams(SolverKind solver);

/// The sheet of 6 x 8, `resolution` particles along either side.
RectangleParams thesisSheet(int resolution, RectanglePattern pattern, std::uint64_t seed);

/// A sheet in the x-z plane that hangs from its upper edge at z = 0, its front towards -y, after
/// `seconds` of settling with tearing off.
/// @throws Refusal, std::invalid_argument, or std::runtime_error if it runs away
Simulation hungCloth(const RectangleParams& sheet, const SimulationParams& params, double seconds);

/// How far below its upper edge the cloth reaches [m].
double hangingHeight(const Simulation& simulation);

/// Does one step. @throws std::runtime_error saying why, if the step had to be undone
StepReport stepOrThrow(Simulation& simulation);

}  // namespace cloth
