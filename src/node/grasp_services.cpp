// Takes hold of the cloth, drags it and lets go, as requested.
#include "cloth_tearing/node/grasp_services.h"

#include <algorithm>
#include <chrono>
#include <iterator>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/node/grasp_conversions.h"

namespace cloth_tearing
{

namespace
{

using Clock = std::chrono::steady_clock;

const ros::WallDuration ALIVE_PERIOD(0.1);

}  // namespace

GraspServices::GraspServices(const NodeContext& context) : context_(context)
{
  RequestServer& requests = context_.requests;
  ros::NodeHandle& node = context_.node;
  requests.serve<Grasp>(node, "grasp", [this](auto& q, auto& a) { grasp(q, a); });
  requests.serve<Drag>(node, "drag", [this](auto& q, auto&) { onDrag(q); });
  requests.serve<Release>(node, "release", [this](auto& q, auto& a) { release(q, a); });
  requests.serve<Pin>(node, "pin", [this](auto& q, auto& a) { pin(q, a); });
  requests.serve<Pin>(node, "unpin", [this](auto& q, auto& a) { unpin(q, a); });
  requests.serve<GetGraspEvents>(
      node, "get_grasp_events", [this](auto& q, auto& a) { onGetGraspEvents(q, a); },
      Effect::LOOKS);
  targets_ = requests.listen<GraspTargets>(node, "grasp_targets", 10,
                                           [this](const GraspTargets& m) { steer(m); });
  alive_timer_ = node.createSteadyTimer(
      ALIVE_PERIOD, [this](const ros::SteadyTimerEvent&) { onAliveTimer(); }, false, false);
}

void GraspServices::grasp(const Grasp::Request& request, Grasp::Response& response)
{
  cloth::refuseIf(problems(request));
  cloth::GraspRequest wish = toCore(request, context_.frames.toCloth(request.header));
  if (!wish.followed.empty())
  {
    wish.frame = context_.frames.toCloth(wish.followed, ros::Time(0), "gripper_frame");
    const std::string loss = context_.follower.lossOf(context_.frames.latest(wish.followed));
    if (!loss.empty())
    {
      throw cloth::Refusal("gripper_frame " + wish.followed + ": " + loss);
    }
  }
  std::uint32_t epoch = 0;
  const cloth::GraspTaken taken = context_.loop.call(
      [&](cloth::Simulation& simulation)
      {
        epoch = simulation.epoch();
        return simulation.grasp(wish);
      });
  if (request.keep_alive > 0.0)
  {
    watch({ taken.id, epoch, request.keep_alive });
  }
  response.grasp_id = taken.id;
  response.held_particles = static_cast<std::uint32_t>(taken.held_particles);
  response.distance = taken.distance;
}

void GraspServices::onDrag(const Drag::Request& request)
{
  hear(request.grasp_id);
  cloth::refuseIf(problems(request));
  Destination destination = toCore(request, context_.frames.toCloth(request.header));
  const std::uint64_t id = request.grasp_id;
  context_.loop.call(
      [this, &destination, id](cloth::Simulation& simulation)
      {
        hear(id);  // again: it may have waited for long
        if (destination.keeps_rotation)
        {
          destination.target.pose.rotation = simulation.findGrasp(id).pose.rotation;
        }
        simulation.drag(id, destination.target);
      });
}

void GraspServices::release(const Release::Request& request, Release::Response& response)
{
  const std::uint64_t id = request.grasp_id;
  const bool pin = request.pin != 0;
  const cloth::AfterGrasp after = pin ? cloth::AfterGrasp::PINNED : cloth::AfterGrasp::FREE;
  response.released = static_cast<std::uint32_t>(context_.loop.call(
      [this, id, pin, after](cloth::Simulation& simulation)
      {
        forget(id);
        if (id == 0)
        {
          return simulation.releaseAll(after);
        }
        simulation.release(id, pin ? "released on request, and pinned" : "released on request",
                           after);
        return 1;
      }));
}

void GraspServices::pin(const Pin::Request& request, Pin::Response& response)
{
  changePins(request, response,
             [](cloth::Simulation& simulation, const cloth::PinRequest& pins)
             { return simulation.pin(pins); });
}

void GraspServices::unpin(const Pin::Request& request, Pin::Response& response)
{
  changePins(request, response,
             [](cloth::Simulation& simulation, const cloth::PinRequest& pins)
             { return simulation.unpin(pins); });
}

template <class Change>
void GraspServices::changePins(const Pin::Request& request, Pin::Response& response, Change change)
{
  cloth::refuseIf(problems(request));
  const cloth::Pose to_cloth =
      request.radius == 0.0 ? cloth::Pose() : context_.frames.toCloth(request.header);
  const cloth::PinRequest pins = toCore(request, to_cloth);
  response.changed = static_cast<std::uint32_t>(
      context_.loop.call([&](cloth::Simulation& simulation) { return change(simulation, pins); }));
}

void GraspServices::onGetGraspEvents(const GetGraspEvents::Request& request,
                                     GetGraspEvents::Response& response)
{
  std::vector<cloth::GraspEvent> events;
  std::array<std::uint64_t, 2> kept{};
  context_.loop.call(
      [&](cloth::Simulation& simulation)
      {
        events = simulation.graspEventsSince(request.since, mostOf(request.max_count));
        kept = simulation.loggedGraspEvents();
      });
  response.header.frame_id = context_.placement.frame_id;
  response.header.stamp = ros::Time::now();
  response.events = toMessages(events, context_.placement);
  response.oldest = kept[0];
  response.newest = kept[1];
}

void GraspServices::steer(const GraspTargets& message)
{
  hear(message);
  cloth::refuseIf(problems(message));
  const cloth::Pose to_cloth = context_.frames.toCloth(message.header);
  context_.loop.call(
      [&](cloth::Simulation& simulation)
      {
        hear(message);  // again: it may have waited for long
        steerAll(simulation, message, to_cloth);
      });
}

/// All of them or none. A grasp gets there in the simulated time since it was last steered.
void GraspServices::steerAll(cloth::Simulation& simulation, const GraspTargets& message,
                             const cloth::Pose& to_cloth)
{
  std::vector<cloth::Pose> poses;
  std::vector<std::string> found;
  for (const GraspTarget& target : message.targets)
  {
    const cloth::Grasp& grasp = simulation.findGrasp(target.grasp_id);
    poses.push_back(poseFor(target.pose, to_cloth, grasp.pose));
    const std::string name = "grasp " + std::to_string(grasp.id);
    cloth::check(found, name + ": pose.position [m]", poses.back().position, cloth::MAX_COORDINATE);
    if (!grasp.followed.empty())
    {
      found.push_back(name + " follows the frame " + grasp.followed);
    }
  }
  cloth::refuseIf(found);
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    const std::uint64_t id = message.targets[i].grasp_id;
    const auto before = steered_at_.find(id);
    const double since =
        before == steered_at_.end() ? cloth::LONGEST_GLIDE : simulation.time() - before->second;
    simulation.steer(id, poses[i], std::min(since, cloth::LONGEST_GLIDE));
    steered_at_[id] = simulation.time();
  }
  for (auto steered = steered_at_.begin(); steered != steered_at_.end();)
  {
    steered = simulation.hasGrasp(steered->first) ? std::next(steered) : steered_at_.erase(steered);
  }
}

// -- grasps that last as long as somebody speaks for them ----------------------------------------

void GraspServices::watch(const KeepAlive::Watched& grasp)
{
  const std::lock_guard<std::mutex> lock(alive_mutex_);
  alive_.watch(grasp, Clock::now());
  alive_timer_.start();
}

void GraspServices::hear(std::uint64_t grasp)
{
  const std::lock_guard<std::mutex> lock(alive_mutex_);
  alive_.hear(grasp, Clock::now());
}

void GraspServices::hear(const GraspTargets& message)
{
  for (const GraspTarget& target : message.targets)
  {
    hear(target.grasp_id);
  }
}

/// @param grasp 0 = all
void GraspServices::forget(std::uint64_t grasp)
{
  const std::lock_guard<std::mutex> lock(alive_mutex_);
  grasp == 0 ? alive_.forgetAll() : alive_.forget(grasp);
}

void GraspServices::onAliveTimer()
{
  {
    const std::lock_guard<std::mutex> lock(alive_mutex_);
    if (alive_.empty())
    {
      alive_timer_.stop();
    }
    if (!alive_.look(Clock::now()))
    {
      return;
    }
  }
  try
  {
    context_.loop.call([this](cloth::Simulation& simulation) { endSilent(simulation); });
    context_.publisher.touch();
  }
  catch (const cloth::Busy&)  // the next turn does it
  {
  }
  const std::lock_guard<std::mutex> lock(alive_mutex_);
  alive_.skip(Clock::now());
}

/// Those that are still silent, now that it is the loop's turn. What was taken before a reset or a
/// state that was restored has ended already.
void GraspServices::endSilent(cloth::Simulation& simulation)
{
  const std::lock_guard<std::mutex> lock(alive_mutex_);
  for (const KeepAlive::Watched& silent : alive_.takeSilent(Clock::now()))
  {
    if (silent.epoch == simulation.epoch() && simulation.hasGrasp(silent.grasp))
    {
      simulation.release(silent.grasp, "nobody has spoken for it for its keep_alive of " +
                                           cloth::text(silent.patience) + " s");
    }
  }
}

}  // namespace cloth_tearing
