// Tells when the parts of a step begin, so that others can time them: the core has no clock.
#pragma once

namespace cloth
{

/// The parts of a step, in their order.
enum class StepPhase
{
  CARRY,    ///< grasps move their particles; the state to go back to is kept
  ADVANCE,  ///< gravity, air, wind and springs
  LIMIT,    ///< the strain limiter of the force springs
  CONTACT,  ///< spheres and floor
  DETECT,   ///< which springs are over their thresholds, by their own and by patch strain
  CHECK,    ///< whether the step must be undone
  EDIT,     ///< tears: edits of the mesh and all that follows them, pieces at rest included
  END,      ///< the step is over
};
constexpr int STEP_PHASES = static_cast<int>(StepPhase::END);

/// Watches a step from inside. Must not touch the simulation.
class StepObserver
{
public:
  virtual ~StepObserver() = default;

  /// A phase begins, and the one before it ends. A step that is undone ends after CHECK.
  virtual void enter(StepPhase phase) = 0;
};

}  // namespace cloth
