// Takes hold of cloth, sends grasps on their way, lets go.
#include "cloth_tearing/core/grippers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/refusal.h"

namespace cloth
{
namespace
{

/// The particles that a grasp takes, and how far the nearest free one is [m].
std::vector<ParticleId> within(const Cloth& cloth, const GraspRequest& request, double max_distance,
                               double& nearest)
{
  std::vector<ParticleId> inside;
  ParticleId closest;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < cloth.mesh.particleCount(); ++i)
  {
    if (cloth.attachments[i].pinned() || cloth.damage.at_rest[i])
    {
      continue;
    }
    const double squared = (cloth.state.position[i].cast<double>() - request.point).squaredNorm();
    if (squared < least)
    {
      least = squared;
      closest = { i };
    }
    if (squared <= request.radius * request.radius && request.radius > 0.0)
    {
      inside.push_back({ i });
    }
  }
  nearest = std::sqrt(least);
  if (request.radius == 0.0 && nearest <= max_distance)
  {
    inside.push_back(closest);
  }
  return inside;
}

void letGo(Cloth& cloth, const Grasp& grasp)
{
  for (const Grasp::Held& held : grasp.held)
  {
    const Vec3 velocity = cloth.state.velocity[held.particle.index];
    cloth.attach(held.particle, {});
    cloth.state.velocity[held.particle.index] = velocity;
  }
}

}  // namespace

GraspTaken Grippers::take(Cloth& cloth, const GraspRequest& request, double max_distance)
{
  std::vector<std::string> found;
  check(found, "point [m]", request.point, MAX_COORDINATE);
  check(found, "radius [m]", request.radius, Range::between(0.0, MAX_COORDINATE));
  if (request.frame.position != request.point)  // as it mostly is: told once
  {
    check(found, "frame position [m]", request.frame.position, MAX_COORDINATE);
  }
  check(found, "frame orientation", request.frame.rotation);
  refuseIf(found);

  GraspTaken taken;
  const std::vector<ParticleId> inside = within(cloth, request, max_distance, taken.distance);
  if (inside.empty())
  {
    const double reach = request.radius > 0.0 ? request.radius : max_distance;
    const std::string limit = request.radius > 0.0 ? "radius" : "max_grasp_distance";
    if (std::isinf(taken.distance))
    {
      throw Refusal("there is no particle to take hold of: all are pinned or were put to rest");
    }
    throw Refusal("there is no particle within " + text(reach) + " m (" + limit +
                  ") of the point; the nearest that is not pinned is " + text(taken.distance) +
                  " m away");
  }
  for (ParticleId p : inside)
  {
    const Attachment& attachment = cloth.attachments[p.index];
    if (attachment.held())
    {
      throw Refusal("particle " + std::to_string(p.index) + " is held by grasp " +
                    std::to_string(attachment.grasp) + ": release that first");
    }
  }

  Grasp grasp;
  grasp.id = next_++;
  grasp.pose = request.frame;
  grasp.pose.rotation.normalize();
  for (ParticleId p : inside)
  {
    grasp.held.push_back(
        { p, grasp.pose.applyInverse(cloth.state.position[p.index].cast<double>()) });
    cloth.attach(p, { Attachment::Kind::GRASP, grasp.id });
  }
  taken.id = grasp.id;
  taken.held_particles = static_cast<int>(inside.size());
  grasps_.push_back(std::move(grasp));
  return taken;
}

Grasp& Grippers::find(std::uint64_t id)
{
  const auto found =
      std::find_if(grasps_.begin(), grasps_.end(), [id](const Grasp& g) { return g.id == id; });
  if (found == grasps_.end())
  {
    throw Refusal("there is no grasp " + std::to_string(id));
  }
  return *found;
}

void Grippers::drag(std::uint64_t grasp, const DragTarget& target)
{
  Grasp& dragged = find(grasp);
  refuseIf(problems(target));
  dragged.target = target;
  dragged.target->pose.rotation.normalize();
}

void Grippers::release(Cloth& cloth, std::uint64_t grasp)
{
  const Grasp& held = find(grasp);
  letGo(cloth, held);
  grasps_.erase(grasps_.begin() + (&held - grasps_.data()));
}

int Grippers::releaseAll(Cloth& cloth)
{
  for (const Grasp& grasp : grasps_)
  {
    letGo(cloth, grasp);
  }
  const int released = static_cast<int>(grasps_.size());
  grasps_.clear();
  return released;
}

void Grippers::carry(ParticleState& state, double dt)
{
  for (Grasp& grasp : grasps_)
  {
    cloth::carry(grasp, state, dt);
  }
}

}  // namespace cloth
