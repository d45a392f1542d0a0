// Takes hold of cloth, sends grasps on their way, lets go.
#include "cloth_tearing/core/grippers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/held_pieces.h"
#include "cloth_tearing/core/refusal.h"

namespace cloth
{
namespace
{

constexpr double MOST_GLIDE_TIME = 3600.0;  ///< [s]

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

/// @param nearest how far the nearest free particle is [m]
/// @throws Refusal if there is nothing inside, or another grasp holds some of it
void refuseUnlessFree(const Cloth& cloth, const GraspRequest& request,
                      const std::vector<ParticleId>& inside, double max_distance, double nearest)
{
  if (inside.empty())
  {
    const double reach = request.radius > 0.0 ? request.radius : max_distance;
    const std::string limit = request.radius > 0.0 ? "radius" : "max_grasp_distance";
    if (std::isinf(nearest))
    {
      throw Refusal("there is no particle to take hold of: all are pinned or were put to rest");
    }
    throw Refusal("there is no particle within " + text(reach) + " m (" + limit +
                  ") of the point; the nearest that is not pinned is " + text(nearest) + " m away");
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
  check(found, "force_limit [N]", request.force_limit, Range::between(0.0, MAX_FORCE));
  refuseIf(found);

  GraspTaken taken;
  const std::vector<ParticleId> inside = within(cloth, request, max_distance, taken.distance);
  refuseUnlessFree(cloth, request, inside, max_distance, taken.distance);

  Grasp grasp;
  grasp.id = next_++;
  grasp.pose = request.frame;
  grasp.pose.rotation.normalize();
  grasp.force_limit = request.force_limit;
  grasp.followed = request.followed;
  for (ParticleId p : inside)
  {
    grasp.held.push_back(
        { p, grasp.pose.applyInverse(cloth.state.position[p.index].cast<double>()) });
    cloth.attach(p, { Attachment::Kind::GRASP, grasp.id });
  }
  taken.id = grasp.id;
  taken.held_particles = static_cast<int>(inside.size());
  grasps_.push_back(std::move(grasp));
  grasps_.back().loose_pieces = looseHolds(cloth, grasps_).back().pieces;
  tell(grasps_.back(), GraspEventKind::TAKEN, "taken hold of");
  findLoosePieces(cloth, "");
  return taken;
}

bool Grippers::has(std::uint64_t id) const
{
  return std::any_of(grasps_.begin(), grasps_.end(), [id](const Grasp& g) { return g.id == id; });
}

const Grasp& Grippers::find(std::uint64_t id) const
{
  const auto found =
      std::find_if(grasps_.begin(), grasps_.end(), [id](const Grasp& g) { return g.id == id; });
  if (found == grasps_.end())
  {
    throw Refusal("there is no grasp " + std::to_string(id));
  }
  return *found;
}

Grasp& Grippers::find(std::uint64_t id)
{
  return const_cast<Grasp&>(static_cast<const Grippers&>(*this).find(id));
}

/// One that commands may move. @throws Refusal if it follows a frame
Grasp& Grippers::free(std::uint64_t id)
{
  Grasp& grasp = find(id);
  if (!grasp.followed.empty())
  {
    throw Refusal("grasp " + std::to_string(id) + " follows the frame \"" + grasp.followed +
                  "\": nothing else can move it");
  }
  return grasp;
}

/// One that follows a frame. @throws Refusal if it does not
Grasp& Grippers::following(std::uint64_t id)
{
  Grasp& grasp = find(id);
  if (grasp.followed.empty())
  {
    throw Refusal("grasp " + std::to_string(id) + " follows no frame");
  }
  return grasp;
}

void Grippers::tell(const Grasp& grasp, GraspEventKind kind, const std::string& reason)
{
  GraspEvent event;
  event.kind = kind;
  event.grasp = grasp.id;
  event.held_particles = static_cast<int>(grasp.held.size());
  event.position = grasp.pose.position;
  event.force = grasp.force();
  event.reason = reason;
  news_.events.push_back(std::move(event));
}

void Grippers::end(const Grasp& grasp, PullOutcome outcome, const std::string& message)
{
  PullEnd end;
  end.outcome = outcome;
  end.message = message;
  end.progress = progressOf(grasp);
  end.held_particles = static_cast<int>(grasp.held.size());
  end.first_tear = grasp.pull->first_tear;
  news_.ends.push_back(std::move(end));
}

/// Another command moves the grasp from now on.
void Grippers::takeOver(Grasp& grasp)
{
  if (grasp.pull)
  {
    end(grasp, PullOutcome::CANCELLED, "another command moves the grasp now");
  }
  grasp.pull.reset();
  grasp.target.reset();
  grasp.glide.reset();
}

void Grippers::drag(std::uint64_t grasp, const DragTarget& target)
{
  Grasp& dragged = free(grasp);
  refuseIf(problems(target));
  takeOver(dragged);
  dragged.target = target;
  dragged.target->pose.rotation.normalize();
}

void Grippers::glide(Grasp& grasp, const Pose& pose, double time)
{
  std::vector<std::string> found;
  check(found, "target position [m]", pose.position, MAX_COORDINATE);
  check(found, "target orientation", pose.rotation);
  check(found, "time [s]", time, Range::between(0.0, MOST_GLIDE_TIME));
  refuseIf(found);
  takeOver(grasp);
  grasp.glide = Glide{ pose, time };
  grasp.glide->goal.rotation.normalize();
}

void Grippers::steer(std::uint64_t grasp, const Pose& pose, double time)
{
  glide(free(grasp), pose, time);
}

void Grippers::follow(std::uint64_t grasp, const Pose& pose, double time)
{
  glide(following(grasp), pose, time);
}

void Grippers::frameLost(std::uint64_t grasp, const std::string& reason)
{
  Grasp& lost = following(grasp);
  if (lost.frame_problem.empty())
  {
    tell(lost, GraspEventKind::FRAME_LOST, reason);
  }
  lost.frame_problem = reason.empty() ? "the frame is missing" : reason;
}

void Grippers::frameFound(std::uint64_t grasp)
{
  Grasp& found = following(grasp);
  if (!found.frame_problem.empty())
  {
    found.frame_problem.clear();
    tell(found, GraspEventKind::FRAME_FOUND, "the frame \"" + found.followed + "\" is back");
  }
}

void Grippers::stopFollowing(std::uint64_t grasp)
{
  Grasp& freed = following(grasp);
  freed.followed.clear();
  freed.frame_problem.clear();
  freed.glide.reset();
}

std::uint64_t Grippers::pull(const PullRequest& request, std::uint64_t next_tear)
{
  Grasp& pulled = free(request.grasp);
  std::vector<std::string> found = problems(request.target);
  check(found, "stop_force [N]", request.stop_force, Range::between(0.0, MAX_FORCE));
  check(found, "stop_tears", request.stop_tears, Range::between(0, MAX_STOP_TEARS));
  refuseIf(found);
  drag(request.grasp, request.target);
  PullUnderWay pull;
  pull.id = next_pull_++;
  pull.start = pulled.pose;
  pull.goal = pulled.target->pose;
  pull.stop_force = request.stop_force;
  pull.stop_tears = request.stop_tears;
  pull.release = request.release;
  pull.first_tear = next_tear;
  pulled.pull = pull;
  return pull.id;
}

bool Grippers::cancelPull(Cloth& cloth, std::uint64_t pull)
{
  for (std::size_t i = 0; i < grasps_.size(); ++i)
  {
    Grasp& grasp = grasps_[i];
    if (grasp.pull && grasp.pull->id == pull)
    {
      endPull(cloth, i, PullOutcome::CANCELLED, "cancelled");
      return true;
    }
  }
  return false;
}

/// The grasp stands still, or lets go if the pull asked for that. @return whether it let go
bool Grippers::endPull(Cloth& cloth, std::size_t place, PullOutcome outcome,
                       const std::string& message)
{
  Grasp& grasp = grasps_[place];
  end(grasp, outcome, message);
  const bool release = grasp.pull->release;
  grasp.pull.reset();
  grasp.target.reset();
  if (release)
  {
    letGo(cloth, place, GraspEventKind::RELEASED, "its pull ended: " + message);
  }
  return release;
}

void Grippers::letGo(Cloth& cloth, std::size_t place, GraspEventKind kind,
                     const std::string& reason, AfterGrasp after)
{
  const Grasp& grasp = grasps_[place];
  if (grasp.pull)
  {
    end(grasp, PullOutcome::LOST, reason);
  }
  tell(grasp, kind, reason);
  for (const Grasp::Held& held : grasp.held)
  {
    const bool pinned = after == AfterGrasp::PINNED;
    cloth.attach(held.particle, { pinned ? Attachment::Kind::PIN : Attachment::Kind::NONE, 0 });
  }
  grasps_.erase(grasps_.begin() + static_cast<std::ptrdiff_t>(place));
}

void Grippers::release(Cloth& cloth, std::uint64_t grasp, const std::string& reason,
                       AfterGrasp after)
{
  const auto place = static_cast<std::size_t>(&find(grasp) - grasps_.data());
  letGo(cloth, place, GraspEventKind::RELEASED, reason, after);
  findLoosePieces(cloth, "grasp " + std::to_string(grasp) + " let go");
}

int Grippers::releaseAll(Cloth& cloth, const std::string& reason, AfterGrasp after)
{
  const int released = static_cast<int>(grasps_.size());
  while (!grasps_.empty())
  {
    letGo(cloth, 0, GraspEventKind::RELEASED, reason, after);
  }
  return released;
}

void Grippers::carry(ParticleState& state, double dt, const GripperLimits& limits)
{
  for (Grasp& grasp : grasps_)
  {
    cloth::carry(grasp, state, dt, limits);
  }
}

void Grippers::feel(const StepForces& forces, double filter)
{
  const double share = forces.dt / (filter + forces.dt);
  for (Grasp& grasp : grasps_)
  {
    Wrench wrench;
    for (const Grasp::Held& held : grasp.held)
    {
      const int p = held.particle.index;
      const Vec3d force = -forces.byHolder(p);
      const Vec3d arm = forces.cloth.state.position[p].cast<double>() - grasp.pose.position;
      wrench.force += force;
      wrench.torque += arm.cross(force);
    }
    grasp.wrench = wrench;
    grasp.smoothed.force += share * (wrench.force - grasp.smoothed.force);
    grasp.smoothed.torque += share * (wrench.torque - grasp.smoothed.torque);
    grasp.peak_force = std::max(grasp.peak_force, std::sqrt(wrench.force.squaredNorm()));
  }
}

void Grippers::conclude(Cloth& cloth, const std::vector<Grasp>& before,
                        const std::vector<TearEvent>& tears, double dt)
{
  noteTears(cloth, before, tears);
  for (std::size_t i = 0; i < grasps_.size();)
  {
    const Grasp& grasp = grasps_[i];
    if (grasp.force_limit > 0.0 && grasp.force() > grasp.force_limit)
    {
      letGo(cloth, i, GraspEventKind::SLIPPED,
            "slipped: the force of " + text(grasp.force()) +
                " N exceeds force_limit = " + text(grasp.force_limit) + " N");
      findLoosePieces(cloth, "another grasp slipped");
    }
    else if (!grasp.pull || !concludePull(cloth, i, dt))
    {
      ++i;
    }
  }
}

bool Grippers::mayLetGo() const
{
  return std::any_of(grasps_.begin(), grasps_.end(),
                     [](const Grasp& grasp)
                     {
                       return (grasp.force_limit > 0.0 && grasp.force() > grasp.force_limit) ||
                              (grasp.pull && grasp.pull->release);
                     });
}

/// @return whether the grasp let go
bool Grippers::concludePull(Cloth& cloth, std::size_t place, double dt)
{
  Grasp& grasp = grasps_[place];
  PullUnderWay& pull = *grasp.pull;
  pull.duration += dt;
  pull.peak_force = std::max(pull.peak_force, grasp.force());
  std::string message;
  const std::optional<PullOutcome> outcome = endOf(grasp, message);
  const bool released = outcome && endPull(cloth, place, *outcome, message);
  if (released)
  {
    findLoosePieces(cloth, "another grasp let go");
  }
  return released;
}

void Grippers::noteTears(const Cloth& cloth, const std::vector<Grasp>& before,
                         const std::vector<TearEvent>& tears)
{
  if (tears.empty() || grasps_.empty())
  {
    return;
  }
  for (std::size_t i = 0; i < grasps_.size(); ++i)
  {
    Grasp& grasp = grasps_[i];
    if (grasp.held.size() > before[i].held.size())
    {
      tell(grasp, GraspEventKind::SPLIT, "a tear parted the patch that it holds");
    }
    if (grasp.pull)
    {
      grasp.pull->tears += static_cast<int>(std::count_if(
          tears.begin(), tears.end(),
          [&](const TearEvent& event)
          { return event.cause.kind == CauseKind::GRASP && event.cause.id == grasp.id; }));
    }
  }
  const auto parts = [](const TearEvent& event) { return event.loose_area > 0.0; };
  if (std::any_of(tears.begin(), tears.end(), parts))
  {
    findLoosePieces(cloth, "a tear parted it from the rest");
  }
}

void Grippers::findLoosePieces(const Cloth& cloth, const std::string& reason)
{
  const std::vector<LooseHold> holds = looseHolds(cloth, grasps_);
  for (std::size_t i = 0; i < grasps_.size(); ++i)
  {
    Grasp& grasp = grasps_[i];
    const bool more = holds[i].pieces > grasp.loose_pieces;
    grasp.loose_pieces = holds[i].pieces;
    if (more)
    {
      tell(grasp, GraspEventKind::HOLDS_LOOSE_PIECE, reason);
      news_.events.back().area = holds[i].area;
      news_.events.back().mass = holds[i].mass;
    }
  }
}

void Grippers::resume(std::uint64_t next_tear)
{
  for (Grasp& grasp : grasps_)
  {
    if (grasp.pull)
    {
      grasp.pull->id = next_pull_++;
      grasp.pull->first_tear = next_tear;
    }
    tell(grasp, GraspEventKind::TAKEN, "held in the state that was restored");
  }
}

Grippers::News Grippers::takeNews()
{
  News news;
  std::swap(news, news_);
  return news;
}

}  // namespace cloth
