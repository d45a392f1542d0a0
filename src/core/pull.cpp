// How far a pull has come, and whether it ends.
#include "cloth_tearing/core/pull.h"

#include <algorithm>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/grasp.h"

namespace cloth
{
namespace
{

/// The part that is behind, of a way with `all` from start to end and `left` to go [-].
double behind(double all, double left)
{
  return all > 0.0 ? std::max(0.0, 1.0 - left / all) : 1.0;
}

}  // namespace

PullProgress progressOf(const Grasp& grasp)
{
  const PullUnderWay& pull = *grasp.pull;
  PullProgress progress;
  progress.pull = pull.id;
  progress.grasp = grasp.id;
  progress.fraction = std::min(
      behind(distanceBetween(pull.start, pull.goal), distanceBetween(grasp.pose, pull.goal)),
      behind(turnBetween(pull.start, pull.goal), turnBetween(grasp.pose, pull.goal)));
  progress.force = grasp.force();
  progress.peak_force = pull.peak_force;
  progress.travelled = distanceBetween(pull.start, grasp.pose);
  progress.duration = pull.duration;
  progress.tears = pull.tears;
  return progress;
}

std::optional<PullOutcome> endOf(const Grasp& grasp, std::string& message)
{
  const PullUnderWay& pull = *grasp.pull;
  if (pull.stop_tears > 0 && pull.tears >= pull.stop_tears)
  {
    message = "stopped after " + std::to_string(pull.tears) + " tears: stop_tears is " +
              std::to_string(pull.stop_tears);
    return PullOutcome::TEARS;
  }
  if (pull.stop_force > 0.0 && grasp.force() > pull.stop_force)
  {
    message = "stopped at a force of " + text(grasp.force()) + " N: stop_force is " +
              text(pull.stop_force) + " N";
    return PullOutcome::FORCE;
  }
  if (!grasp.target)
  {
    message = "arrived";
    return PullOutcome::ARRIVED;
  }
  return std::nullopt;
}

}  // namespace cloth
