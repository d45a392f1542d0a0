// Carries grasps towards their targets.
#include "cloth_tearing/core/grasp.h"

#include <algorithm>
#include <cmath>

#include "cloth_tearing/core/checks.h"

namespace cloth
{
namespace
{

/// @return whether it has arrived
bool moveTowards(Vec3d& position, const Vec3d& target, double distance)
{
  const Vec3d way = target - position;
  const double left = std::sqrt(way.squaredNorm());
  if (left <= distance)
  {
    position = target;
    return true;
  }
  position += distance / left * way;
  return false;
}

/// Turns by `angle` [rad] at most. Products and normalisation only: the same bits everywhere.
/// @return whether it has arrived
bool turnTowards(Quatd& rotation, const Quatd& target, double angle)
{
  Quatd way = target * rotation.conjugate();
  if (way.w() < 0.0)
  {
    way.coeffs() = -way.coeffs();
  }
  const Vec3d axis(way.x(), way.y(), way.z());  // as long as the sine of half the way
  const double sine = std::sqrt(axis.squaredNorm());
  const double half = 0.5 * angle;
  if (sine <= half * way.w())
  {
    rotation = target;
    return true;
  }
  const Vec3d turn = half / sine * axis;  // tan(half) is half to the third order
  rotation = Quatd(1.0, turn.x(), turn.y(), turn.z()) * rotation;
  rotation.coeffs() /= std::sqrt(rotation.coeffs().squaredNorm());
  return false;
}

/// Twice the sine of half the angle from one rotation to another: nearly the angle, where that is
/// small.
double turnBetween(const Quatd& from, const Quatd& to)
{
  const Quatd way = to * from.conjugate();
  return 2.0 * std::sqrt(way.x() * way.x() + way.y() * way.y() + way.z() * way.z());
}

/// Goes its share of the way, by the time that is left. (Of a wide turn it goes less at first: the
/// sine stands for the angle.)
void glideOn(Grasp& grasp, double dt, const GripperLimits& limits)
{
  Glide& glide = *grasp.glide;
  const bool last = glide.time_left <= dt;
  const double share = last ? 1.0 : dt / glide.time_left;
  const auto part = [&](double way, double most)
  { return last ? most : std::min(share * way, most); };
  const double way = distanceBetween(grasp.pose, glide.goal);
  const double turn = turnBetween(grasp.pose, glide.goal);
  const bool there =
      moveTowards(grasp.pose.position, glide.goal.position, part(way, limits.speed * dt));
  const bool turned =
      turnTowards(grasp.pose.rotation, glide.goal.rotation, part(turn, limits.turn * dt));
  glide.time_left = std::max(0.0, glide.time_left - dt);
  if (there && turned)
  {
    grasp.glide.reset();
  }
}

}  // namespace

double distanceBetween(const Pose& a, const Pose& b)
{
  return std::sqrt((b.position - a.position).squaredNorm());
}

double turnBetween(const Pose& a, const Pose& b)
{
  return turnBetween(a.rotation, b.rotation);
}

void carry(Grasp& grasp, ParticleState& state, double dt, const GripperLimits& limits)
{
  if (grasp.glide)
  {
    glideOn(grasp, dt, limits);
  }
  if (grasp.target)
  {
    const DragTarget& target = *grasp.target;
    const bool there =
        moveTowards(grasp.pose.position, target.pose.position, target.linear_speed * dt);
    const bool turned =
        turnTowards(grasp.pose.rotation, target.pose.rotation, target.angular_speed * dt);
    if (there && turned)
    {
      grasp.target.reset();
    }
  }
  for (const Grasp::Held& held : grasp.held)
  {
    const int p = held.particle.index;
    const Vec3 place = grasp.pose.apply(held.offset).cast<Real>();
    state.velocity[p] = (place - state.previous[p]) / static_cast<Real>(dt);
    state.position[p] = place;
  }
}

std::vector<std::string> problems(const DragTarget& target)
{
  std::vector<std::string> found;
  check(found, "target position [m]", target.pose.position, MAX_COORDINATE);
  check(found, "target orientation", target.pose.rotation);
  check(found, "linear_speed [m/s]", target.linear_speed, Range::aboveUpTo(0.0, MAX_GRIPPER_SPEED));
  check(found, "angular_speed [rad/s]", target.angular_speed,
        Range::aboveUpTo(0.0, MAX_GRIPPER_TURN));
  return found;
}

}  // namespace cloth
