// The world of the thesis' chapter 4: its cloth, in its own units, hung and settled.
#pragma once

#include <functional>
#include <string>

#include "cloth_tearing/core/mesh_builder.h"
#include "cloth_tearing/core/simulation.h"

namespace cloth
{

/// Called after every step of an experiment: for tables, pictures and players.
using Watch = std::function<void(const Simulation&, const StepReport&)>;

/// Which cloth an experiment is made with.
struct Setting
{
  int resolution = 30;  ///< particles along either side
  RectanglePattern pattern = RectanglePattern::ONE_DIAGONAL;
  std::uint64_t seed = 1;  ///< of an irregular mesh
  double grading = 1.0;    ///< spacing at the border over spacing in the middle [-]
  SolverKind solver = SolverKind::XPBD;
  double time_step = 0.001;  ///< [s]
  bool lines = false;        ///< see SolverParams
};

/// A hung cloth is at rest after so long [s].
constexpr double HANGS_STILL = 6.0;

/// Width and height of the thesis' sheet [m].
inline Vec2d thesisSheetSize()
{
  return Vec2d(6.0, 8.0);
}

/// One parameter set for all experiments of a solver. XPBD has the mesh-independent stiffness and
/// tear rules; the force springs the thesis' own, to the letter: one constant for all springs, each
/// of which tears on its own strain.
SimulationParams thesisParams(const Setting& setting);

/// The sheet of thesisSheetSize().
RectangleParams thesisSheet(const Setting& setting);

/// A sheet in the x-z plane that hangs from its upper edge at z = 0, its front towards -y, before
/// it has moved.
/// @throws Refusal or std::invalid_argument, naming what is wrong
Simulation hungSheet(const RectangleParams& sheet, const SimulationParams& params);

/// Lets a cloth come to rest for `seconds`, with tearing off. @throws std::runtime_error if it runs
/// away
void settle(Simulation& simulation, double seconds);

/// The thesis' cloth, hung and settled.
/// @throws Refusal, std::invalid_argument, or std::runtime_error if it runs away
Simulation hungCloth(const Setting& setting);

/// How far below its upper edge the cloth reaches [m].
double hangingHeight(const Simulation& simulation);

/// Does one step. @throws std::runtime_error saying why, if the step had to be undone
StepReport stepOrThrow(Simulation& simulation);

/// Rest length of all edges that tears opened, both sides [m].
double tornLength(const Cloth& cloth);

}  // namespace cloth
