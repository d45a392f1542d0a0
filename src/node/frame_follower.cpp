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

bool isThere(const cloth::Simulation& simulation, std::uint64_t sphere)
{
  return std::any_of(simulation.spheres().begin(), simulation.spheres().end(),
                     [sphere](const cloth::Sphere& s)
                     { return s.source == cloth::SphereSource::STREAMED && s.id == sphere; });
}

}  // namespace

FrameFollower::FrameFollower(const Frames& frames, const NodeParams& params)
    : frames_(frames), timeout_(params.frame_timeout), lost_frame_(params.lost_frame)
{
}

void FrameFollower::setSpheres(const std::vector<FramedSphere>& spheres)
{
  spheres_ = spheres;
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
  for (const Follower& follower : followers)
  {
    moveGrasp(simulation, follower.id, follower.frame, follower.lost);
  }
  for (const FramedSphere& sphere : spheres_)
  {
    moveSphere(simulation, sphere);
  }
  for (auto way = ways_.begin(); way != ways_.end();)
  {
    way = way->second.looked == look_ ? std::next(way) : ways_.erase(way);
  }
}

const FrameFollower::Way& FrameFollower::look(const std::string& frame)
{
  const bool known = ways_.count(frame) > 0;
  Way& way = ways_[frame];
  if (way.looked == look_)
  {
    return way;
  }
  way.looked = look_;
  const Frames::Latest latest = frames_.latest(frame);
  if (!latest.problem.empty())
  {
    way.latest.problem = latest.problem;
    way.fresh = false;
    return way;
  }
  way.fresh = !known || !way.latest.problem.empty() || latest.stamp != way.latest.stamp ||
              !same(latest.pose, way.latest.pose);
  if (way.fresh)
  {
    const double interval = (latest.stamp - way.latest.stamp).toSec();
    way.interval =
        known && interval > 0.0 ? std::min(interval, cloth::LONGEST_GLIDE) : cloth::LONGEST_GLIDE;
    way.latest = latest;
  }
  return way;
}

/// Why a frame cannot be followed now; empty if it can.
std::string FrameFollower::lossOf(const Way& way) const
{
  if (!way.latest.problem.empty() || way.latest.stamp.isZero())
  {
    return way.latest.problem;
  }
  const double age = (ros::Time::now() - way.latest.stamp).toSec();
  return age > timeout_ ? "its newest transform is " + cloth::text(age) +
                              " s old, beyond frame_timeout = " + cloth::text(timeout_) + " s"
                        : "";
}

void FrameFollower::moveGrasp(cloth::Simulation& simulation, std::uint64_t id,
                              const std::string& frame, bool was_lost)
{
  const Way& way = look(frame);
  std::string loss = lossOf(way);
  if (loss.empty() && (way.fresh || was_lost))
  {
    try
    {
      simulation.follow(id, way.latest.pose, way.interval);
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
  simulation.frameLost(id, frame + ": " + loss);
  if (lost_frame_ == LostFrame::RELEASE)
  {
    simulation.release(id, "the frame that it followed is lost: " + frame + ": " + loss);
  }
}

void FrameFollower::moveSphere(cloth::Simulation& simulation, const FramedSphere& sphere)
{
  const Way& way = look(sphere.frame);
  if (!way.fresh || !isThere(simulation, sphere.id))
  {
    return;
  }
  try
  {
    simulation.moveSphere(sphere.id, way.latest.pose.apply(sphere.center), way.interval);
  }
  catch (const cloth::Refusal&)  // out of the world: it stays where it was to be last
  {
  }
}

}  // namespace cloth_tearing
