// Moves data of grasps and pulls between the core's types and the messages, and begins pulls.
#include "cloth_tearing/node/grasp_conversions.h"

#include <limits>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/refusal.h"

namespace cloth_tearing
{

using cloth::check;
using cloth::Range;

namespace
{

const Range FINITE;

constexpr std::size_t MOST_TOLD_TEARS = 1000;  // in the result of a pull

std::uint8_t toMessage(cloth::GraspEventKind kind)
{
  switch (kind)
  {
    case cloth::GraspEventKind::TAKEN:
      return GraspEvent::TAKEN;
    case cloth::GraspEventKind::RELEASED:
      return GraspEvent::RELEASED;
    case cloth::GraspEventKind::SLIPPED:
      return GraspEvent::SLIPPED;
    case cloth::GraspEventKind::SPLIT:
      return GraspEvent::SPLIT;
    case cloth::GraspEventKind::HOLDS_LOOSE_PIECE:
      return GraspEvent::HOLDS_LOOSE_PIECE;
    case cloth::GraspEventKind::FRAME_LOST:
      return GraspEvent::FRAME_LOST;
    case cloth::GraspEventKind::FRAME_FOUND:
      break;
  }
  return GraspEvent::FRAME_FOUND;
}

std::uint8_t toMessage(cloth::PullOutcome outcome)
{
  switch (outcome)
  {
    case cloth::PullOutcome::ARRIVED:
      return PullResult::ARRIVED;
    case cloth::PullOutcome::FORCE:
      return PullResult::FORCE;
    case cloth::PullOutcome::TEARS:
      return PullResult::TEARS;
    case cloth::PullOutcome::LOST:
      return PullResult::LOST;
    case cloth::PullOutcome::CANCELLED:
      break;
  }
  return PullResult::CANCELLED;
}

GraspEvent toMessage(const cloth::GraspEvent& event, const Placement& placement)
{
  GraspEvent message;
  message.sequence = event.sequence;
  message.epoch = event.epoch;
  message.step = event.step;
  message.time = event.time;
  message.kind = toMessage(event.kind);
  message.grasp_id = event.grasp;
  message.held_particles = static_cast<std::uint32_t>(event.held_particles);
  message.position = toPoint(event.position, placement);
  message.force = event.force;
  message.area = event.area;
  message.mass = event.mass;
  message.reason = event.reason;
  return message;
}

GraspState toMessage(const cloth::Grasp& grasp, double utilisation, const Placement& placement)
{
  GraspState message;
  message.grasp_id = grasp.id;
  message.held_particles = static_cast<std::uint32_t>(grasp.held.size());
  message.pose = toPose(grasp.pose, placement);
  message.wrench.force = toVector3(grasp.smoothed.force);
  message.wrench.torque = toVector3(grasp.smoothed.torque);
  message.peak_force = grasp.peak_force;
  message.force_limit = grasp.force_limit;
  message.utilisation = utilisation;
  message.moving = grasp.moving();
  message.holds_loose_piece = grasp.loose_pieces > 0;
  message.gripper_frame = grasp.followed;
  message.frame_problem = grasp.frame_problem;
  return message;
}

/// Neither tiny nor huge numbers lose it on the way.
double lengthOf(const geometry_msgs::Vector3& direction)
{
  return toVector(direction).stableNorm();
}

void checkWay(std::vector<std::string>& found, const PullGoal& goal)
{
  check(found, "distance [m]", goal.distance, Range::between(0.0, 2.0 * cloth::MAX_COORDINATE));
  check(found, "direction", toVector(goal.direction), FINITE.high);
  check(found, "target.position", toVector(goal.target.position), FINITE.high);
  checkOrientation(found, "target.orientation", goal.target.orientation);
  if (goal.distance > 0.0 && found.empty())
  {
    check(found, "direction: its length", lengthOf(goal.direction), Range::above(0.0));
  }
}

/// What a command without a speed of turning turns with: nothing is to be turned.
constexpr double ANY_TURN = 1.0;

}  // namespace

// -- out -----------------------------------------------------------------------------------------

std::vector<GraspEvent> toMessages(const std::vector<cloth::GraspEvent>& events,
                                   const Placement& placement)
{
  std::vector<GraspEvent> messages;
  for (const cloth::GraspEvent& event : events)
  {
    messages.push_back(toMessage(event, placement));
  }
  return messages;
}

GraspStates graspStates(const cloth::Simulation& simulation, const Placement& placement)
{
  GraspStates message;
  message.header.frame_id = placement.frame_id;
  message.time = simulation.time();
  message.step = simulation.stepCount();
  message.epoch = simulation.epoch();
  for (const cloth::Grasp& grasp : simulation.grasps())
  {
    message.grasps.push_back(toMessage(grasp, simulation.utilisationNear(grasp.id), placement));
  }
  const cloth::ForceBalance balance = simulation.forceBalance();
  message.grasp_force = toVector3(balance.grasp);
  message.pin_force = toVector3(balance.pin);
  message.contact_force = toVector3(balance.contact);
  message.limiter_force = toVector3(balance.limiter);
  message.weight = toVector3(balance.weight);
  message.air_force = toVector3(balance.air);
  message.momentum_rate = toVector3(balance.momentum_rate);
  return message;
}

PullFeedback toFeedback(const cloth::PullProgress& progress, const cloth::Simulation& simulation)
{
  PullFeedback feedback;
  feedback.fraction = progress.fraction;
  feedback.force = progress.force;
  feedback.utilisation = simulation.utilisationNear(progress.grasp);
  feedback.tears = static_cast<std::uint32_t>(progress.tears);
  feedback.time = simulation.time();
  return feedback;
}

PullResult toResult(const cloth::PullEnd& end, const cloth::Simulation& simulation,
                    const Placement& placement)
{
  PullResult result;
  result.outcome = toMessage(end.outcome);
  result.message = end.message;
  result.grasp_id = end.progress.grasp;
  result.held_particles = static_cast<std::uint32_t>(end.held_particles);
  result.travelled = end.progress.travelled;
  result.duration = end.progress.duration;
  result.peak_force = end.progress.peak_force;
  result.tears = static_cast<std::uint32_t>(end.progress.tears);
  result.pieces = static_cast<std::uint32_t>(end.pieces);
  for (const cloth::TearEvent& event : simulation.tearsSince(end.first_tear, MOST_TOLD_TEARS))
  {
    if (event.sequence <= end.last_tear)
    {
      result.events.push_back(toMessage(event, placement));
    }
  }
  return result;
}

// -- in ------------------------------------------------------------------------------------------

std::vector<std::string> problems(const Pin::Request& request)
{
  std::vector<std::string> found;
  check(found, "point", toVector(request.point), FINITE.high);
  check(found, "radius [m]", request.radius, FINITE);
  if (request.particles.size() > cloth::MAX_NAMED_PARTICLES)
  {
    found.push_back("particles has " + std::to_string(request.particles.size()) +
                    " entries, must be at most " + std::to_string(cloth::MAX_NAMED_PARTICLES));
  }
  for (const std::uint32_t particle : request.particles)
  {
    if (particle > static_cast<std::uint32_t>(std::numeric_limits<int>::max()))
    {
      found.push_back("there is no particle " + std::to_string(particle));
      break;
    }
  }
  return found;
}

std::vector<std::string> problems(const GraspTargets& message)
{
  std::vector<std::string> found;
  if (message.targets.empty() || message.targets.size() > cloth::MAX_GRASPS)
  {
    return { "targets has " + std::to_string(message.targets.size()) +
             " entries, must be at least 1 and at most " + std::to_string(cloth::MAX_GRASPS) };
  }
  for (std::size_t i = 0; i < message.targets.size(); ++i)
  {
    const GraspTarget& target = message.targets[i];
    const std::string field = "targets[" + std::to_string(i) + "].pose.";
    check(found, field + "position", toVector(target.pose.position), FINITE.high);
    checkOrientation(found, field + "orientation", target.pose.orientation);
    for (std::size_t j = 0; j < i; ++j)
    {
      if (message.targets[j].grasp_id == target.grasp_id)
      {
        found.push_back("grasp " + std::to_string(target.grasp_id) + " is there twice");
      }
    }
  }
  return found;
}

std::vector<std::string> problems(const PullGoal& goal)
{
  std::vector<std::string> found;
  if (goal.grasp_id == 0)
  {
    check(found, "point", toVector(goal.point), FINITE.high);
    check(found, "radius [m]", goal.radius, FINITE);
  }
  checkWay(found, goal);
  check(found, "linear_speed [m/s]", goal.linear_speed, FINITE);
  check(found, "angular_speed [rad/s]", goal.angular_speed, FINITE);
  check(found, "stop_force [N]", goal.stop_force, Range::between(0.0, cloth::MAX_FORCE));
  if (goal.stop_tears > cloth::MAX_STOP_TEARS)
  {
    found.push_back("stop_tears is " + std::to_string(goal.stop_tears) + ", must be at most " +
                    std::to_string(cloth::MAX_STOP_TEARS));
  }
  return found;
}

cloth::PinRequest toCore(const Pin::Request& request, const cloth::Pose& to_cloth)
{
  cloth::PinRequest pins;
  pins.point = to_cloth.apply(toVector(request.point));
  pins.radius = request.radius;
  pins.particles.assign(request.particles.begin(), request.particles.end());
  return pins;
}

cloth::Pose poseFor(const geometry_msgs::Pose& target, const cloth::Pose& to_cloth,
                    const cloth::Pose& now)
{
  cloth::Pose pose = toClothFrame(target, to_cloth);
  if (isZero(target.orientation))
  {
    pose.rotation = now.rotation;
  }
  return pose;
}

cloth::PullRequest toCore(const PullGoal& goal, const cloth::Pose& to_cloth,
                          const cloth::Grasp& taken)
{
  cloth::PullRequest pull;
  pull.grasp = taken.id;
  pull.target.linear_speed = goal.linear_speed;
  pull.target.angular_speed = goal.angular_speed;
  const bool turns = goal.distance == 0.0 && !isZero(goal.target.orientation);
  if (!turns && goal.angular_speed == 0.0)
  {
    pull.target.angular_speed = ANY_TURN;
  }
  if (goal.distance > 0.0)
  {
    const cloth::Vec3d direction = toVector(goal.direction) / lengthOf(goal.direction);
    pull.target.pose = taken.pose;
    pull.target.pose.position += goal.distance * (to_cloth.rotation * direction);
  }
  else
  {
    pull.target.pose = poseFor(goal.target, to_cloth, taken.pose);
  }
  pull.stop_force = goal.stop_force;
  pull.stop_tears = static_cast<int>(goal.stop_tears);
  pull.release = goal.release;
  return pull;
}

cloth::GraspRequest graspOf(const PullGoal& goal, const cloth::Pose& to_cloth)
{
  cloth::GraspRequest grasp;
  grasp.point = to_cloth.apply(toVector(goal.point));
  grasp.radius = goal.radius;
  grasp.frame.position = grasp.point;
  return grasp;
}

std::uint64_t beginPull(cloth::Simulation& simulation, const PullGoal& goal,
                        const cloth::Pose& to_cloth)
{
  if (goal.grasp_id != 0)
  {
    return simulation.pull(toCore(goal, to_cloth, simulation.findGrasp(goal.grasp_id)));
  }
  const cloth::GraspRequest wish = graspOf(goal, to_cloth);
  std::vector<std::string> found;
  check(found, "point [m]", wish.point, cloth::MAX_COORDINATE);
  cloth::refuseIf(found);
  cloth::Grasp wished;
  wished.pose = wish.frame;
  cloth::refuseIf(problems(toCore(goal, to_cloth, wished).target));
  const std::uint64_t grasp = simulation.grasp(wish).id;
  return simulation.pull(toCore(goal, to_cloth, simulation.findGrasp(grasp)));
}

}  // namespace cloth_tearing
