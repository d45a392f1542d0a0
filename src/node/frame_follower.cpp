// Carries grasps and spheres along with the tf frames that they follow.
#include "cloth_tearing/node/frame_follower.h"

#include <algorithm>
#include <iterator>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/refusal.h"

namespace cloth_tearing
{

namespace
{

bool same(const cloth::Pose& a, const cloth::Pose& b)
{
  return a.position == b.position && a.rotation.coeffs() == b.rotation.coeffs();
}

/// How much later `late` is than `early` [s]. Stamps come from outside: the difference of two may
/// be more than a ros::Duration holds, which then throws.
double secondsBetween(const ros::Time& early, const ros::Time& late)
{
  return 1e-9 * static_cast<double>(static_cast<std::int64_t>(late.toNSec() - early.toNSec()));
}

}  // namespace

FrameFollower::FrameFollower(const Frames& frames, const NodeParams& params)
    : frames_(frames), timeout_(params.frame_timeout), lost_frame_(params.lost_frame)
{
}

void FrameFollower::beforeStep(cloth::Simulation& simulation)
{
  struct Follower
  {
    std::uint64_t id;
    std::string frame;
    bool lost;
  };
  std::vector<Follower> followers;  // apart: one that lets go moves the others in the list
  for (const cloth::Grasp& grasp : simulation.grasps())
  {
    if (!grasp.followed.empty())
    {
      followers.push_back({ grasp.id, grasp.followed, !grasp.frame_problem.empty() });
    }
  }
  ++look_;
  if (simulation.epoch() != epoch_)  // what a restored state holds may be far from where it belongs
  {
    sightings_.clear();
    epoch_ = simulation.epoch();
  }
  for (const Follower& follower : followers)
  {
    moveGrasp(simulation, follower.id, follower.frame, follower.lost);
  }
  for (const cloth::Sphere& sphere : simulation.spheres())  // none comes or goes by being moved
  {
    if (!sphere.frame.empty())
    {
      moveSphere(simulation, sphere);
    }
  }
  for (auto at = sightings_.begin(); at != sightings_.end();)
  {
    at = at->second.looked == look_ ? std::next(at) : sightings_.erase(at);
  }
}

const FrameFollower::Sighting& FrameFollower::look(const std::string& frame)
{
  const bool known = sightings_.count(frame) > 0;
  Sighting& sighting = sightings_[frame];
  if (sighting.looked == look_)
  {
    return sighting;
  }
  sighting.looked = look_;
  const Frames::Latest latest = frames_.latest(frame);
  if (!latest.problem.empty())
  {
    sighting.latest.problem = latest.problem;
    sighting.fresh = false;
    return sighting;
  }
  sighting.fresh = !known || !sighting.latest.problem.empty() ||
                   latest.stamp != sighting.latest.stamp ||
                   !same(latest.pose, sighting.latest.pose);
  if (sighting.fresh)
  {
    const double interval = secondsBetween(sighting.latest.stamp, latest.stamp);
    sighting.interval =
        known && interval > 0.0 ? std::min(interval, cloth::LONGEST_GLIDE) : cloth::LONGEST_GLIDE;
    sighting.latest = latest;
  }
  return sighting;
}

std::string FrameFollower::lossOf(const Frames::Latest& latest) const
{
  if (!latest.problem.empty() || latest.stamp.isZero())
  {
    return latest.problem;
  }
  const double age = secondsBetween(latest.stamp, ros::Time::now());
  return age > timeout_ ? "its newest transform is " + cloth::text(age) +
                              " s old, beyond frame_timeout = " + cloth::text(timeout_) + " s"
                        : "";
}

void FrameFollower::moveGrasp(cloth::Simulation& simulation, std::uint64_t id,
                              const std::string& frame, bool was_lost)
{
  const Sighting& sighting = look(frame);
  std::string loss = lossOf(sighting.latest);
  if (loss.empty() && (sighting.fresh || was_lost))
  {
    try
    {
      simulation.follow(id, sighting.latest.pose, sighting.interval);
    }
    catch (const cloth::Refusal& refusal)  // it leads out of the world
    {
      loss = refusal.what();
    }
  }
  if (loss.empty())
  {
    if (was_lost)
    {
      simulation.frameFound(id);
    }
    return;
  }
  if (!was_lost)
  {
    simulation.frameLost(id, frame + ": " + loss);
  }
  if (lost_frame_ == LostFrame::RELEASE)
  {
    simulation.release(id, "the frame that it followed is lost: " + frame + ": " + loss);
  }
}

void FrameFollower::moveSphere(cloth::Simulation& simulation, const cloth::Sphere& sphere)
{
  const Sighting& sighting = look(sphere.frame);
  if (!sighting.fresh)
  {
    return;
  }
  try
  {
    simulation.moveSphere(sphere.id, sighting.latest.pose.apply(sphere.center_in_frame),
                          sighting.interval);
  }
  catch (const cloth::Refusal&)  // out of the world: it stays where it was to be last
  {
  }
}

}  // namespace cloth_tearing
