// Serves handles: follows grasps and spheres with them, and does what their users ask for.
#include "cloth_tearing/node/handle_server.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/node/grasp_conversions.h"

namespace cloth_tearing
{

namespace
{

const std::string TOPIC = "handles/feedback";  // for refusals

constexpr std::size_t MOST_WAITING = 1000;          // feedback that is not yet obeyed
constexpr std::chrono::seconds POINTER_SILENCE(1);  // after it, nobody drags the handle any more
constexpr std::chrono::seconds NOTE_TIME(4);
constexpr double ASIDE = 3.0;  // where the hand makes way for what it took hold of, in its radii

bool isSphere(HandleKind kind)
{
  return kind == HandleKind::STREAMED_SPHERE || kind == HandleKind::THROWN_SPHERE;
}

cloth::SphereSource sourceOf(HandleKind kind)
{
  return kind == HandleKind::STREAMED_SPHERE ? cloth::SphereSource::STREAMED
                                             : cloth::SphereSource::THROWN;
}

bool same(const cloth::Pose& a, const cloth::Pose& b)
{
  return a.position == b.position && a.rotation.coeffs() == b.rotation.coeffs();
}

/// A pose alone goes the same way as the one before: only the last one counts.
bool replaces(const visualization_msgs::InteractiveMarkerFeedback& newer,
              const visualization_msgs::InteractiveMarkerFeedback& older)
{
  return newer.event_type == older.event_type && newer.marker_name == older.marker_name &&
         newer.client_id == older.client_id &&
         (newer.event_type == visualization_msgs::InteractiveMarkerFeedback::POSE_UPDATE ||
          newer.event_type == visualization_msgs::InteractiveMarkerFeedback::KEEP_ALIVE);
}

}  // namespace

HandleServer::HandleServer(const NodeContext& context, const HandleParams& params,
                           GraspServices& grasps, SphereServices& spheres)
    : context_(context)
    , params_(params)
    , grasps_(grasps)
    , spheres_(spheres)
    // With a thread and a queue of its own: nobody spins the global queue, on which it would be
    // otherwise. The private name has to be resolved before.
    , server_(std::make_unique<interactive_markers::InteractiveMarkerServer>(
          context_.node.resolveName("handles"), "", true))
    , thread_([this] { run(); })
{
}

HandleServer::~HandleServer()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    wake_.notify_all();
  }
  thread_.join();
  server_.reset();  // no feedback comes from here on
}

// -- the marker server's thread -------------------------------------------------------------------

/// Runs while the server is locked.
void HandleServer::take(const Feedback::ConstPtr& feedback)
{
  geometry_msgs::Pose pose;
  bool known = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!inbox_.empty() && replaces(*feedback, *inbox_.back()))
    {
      inbox_.back() = feedback;
    }
    else if (inbox_.size() < MOST_WAITING)
    {
      inbox_.push_back(feedback);
    }
    else
    {
      context_.publisher.countRefusal(TOPIC, "there would be " + std::to_string(MOST_WAITING + 1) +
                                                 " messages that wait, must be at most " +
                                                 std::to_string(MOST_WAITING));
    }
    const auto placed = placed_.find(feedback->marker_name);
    known = placed != placed_.end();
    pose = known ? placed->second : pose;
    wake_.notify_all();
  }
  if (known && feedback->event_type == Feedback::POSE_UPDATE)
  {
    // The server has taken the new pose as it came. Other clients see it once it is granted.
    server_->setPose(feedback->marker_name, pose);
  }
}

// -- the thread -----------------------------------------------------------------------------------

void HandleServer::run()
{
  const auto period = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(1.0 / params_.rate));
  Clock::time_point due = Clock::now();
  while (true)
  {
    std::vector<Feedback::ConstPtr> heard;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      wake_.wait_until(lock, due, [this] { return stopping_ || !inbox_.empty(); });
      if (stopping_)
      {
        return;
      }
      heard.swap(inbox_);
    }
    for (const Feedback::ConstPtr& feedback : heard)
    {
      obey(*feedback);
    }
    if (Clock::now() >= due)
    {
      show();
      due = Clock::now() + period;
    }
  }
}

// -- what users ask for ---------------------------------------------------------------------------

void HandleServer::obey(const Feedback& feedback)
{
  const std::string& name = feedback.marker_name;
  const auto shown = shown_.find(name);
  if (shown == shown_.end())
  {
    return;  // what it was on has gone in the meantime
  }
  const Handle handle = shown->second;
  const std::string reason = context_.requests.hear(TOPIC, [&] { obey(feedback, handle); });
  if (!reason.empty())
  {
    notes_[name] = { reason, Clock::now() + NOTE_TIME };
  }
}

void HandleServer::obey(const Feedback& feedback, const Handle& handle)
{
  const std::string& name = feedback.marker_name;
  switch (feedback.event_type)
  {
    case Feedback::MOUSE_DOWN:
      dragged_[name] = Clock::now();
      if (isSphere(handle.kind) && handle.followed.empty())
      {
        catchSphere(handle);
      }
      break;
    case Feedback::POSE_UPDATE:
      move(handle, feedback);
      break;
    case Feedback::KEEP_ALIVE:
      if (dragged_.count(name) > 0)
      {
        dragged_[name] = Clock::now();
      }
      break;
    case Feedback::MOUSE_UP:
      dragged_.erase(name);
      letGo();
      break;
    case Feedback::MENU_SELECT:
      command(handle, feedback.menu_entry_id);
      break;
    case Feedback::BUTTON_CLICK:
      break;
    default:
      throw cloth::Refusal(name + ": there is no event_type " +
                           std::to_string(feedback.event_type));
  }
}

void HandleServer::move(const Handle& handle, const Feedback& feedback)
{
  dragged_[feedback.marker_name] = Clock::now();
  std::vector<std::string> found;
  cloth::check(found, feedback.marker_name + ": pose.position", toVector(feedback.pose.position),
               std::numeric_limits<double>::infinity());
  checkOrientation(found, feedback.marker_name + ": pose.orientation", feedback.pose.orientation);
  cloth::refuseIf(found);
  const cloth::Pose to_cloth = context_.frames.toCloth(feedback.header);
  cloth::Pose pose = poseFor(feedback.pose, to_cloth, handle.pose);
  if (handle.kind == HandleKind::GRASP)
  {
    GraspTargets targets;
    targets.header = feedback.header;
    targets.targets.resize(1);
    targets.targets[0].grasp_id = handle.id;
    targets.targets[0].pose = feedback.pose;
    grasps_.steer(targets);
  }
  else if (handle.kind == HandleKind::HAND)
  {
    cloth::check(found, "hand: pose.position [m]", pose.position, cloth::MAX_COORDINATE);
    cloth::refuseIf(found);
    hand_ = pose;
  }
  else
  {
    pose.rotation = handle.pose.rotation;  // a ball has none
    context_.loop.call([&](cloth::Simulation& simulation)
                       { simulation.holdSphere(sourceOf(handle.kind), handle.id, pose.position); });
  }
  shown_[feedback.marker_name].pose = pose;
  place(feedback.marker_name, toPose(pose, context_.placement));
}

/// It stands still where it is now.
void HandleServer::catchSphere(const Handle& handle)
{
  const cloth::SphereSource source = sourceOf(handle.kind);
  context_.loop.call(
      [&handle, source](cloth::Simulation& simulation)
      {
        const cloth::Vec3d center = simulation.findSphere(source, handle.id).center;
        simulation.holdSphere(source, handle.id, center);
      });
}

/// Of all spheres that are under no pointer any more.
void HandleServer::letGo()
{
  context_.loop.call([this](cloth::Simulation& simulation) { letGo(simulation); });
}

void HandleServer::letGo(cloth::Simulation& simulation) const
{
  for (const Handle& handle : handlesOf(simulation, params_))
  {
    if (isSphere(handle.kind) && dragged_.count(nameOf(handle)) == 0)
    {
      simulation.letGoOfSphere(sourceOf(handle.kind), handle.id);
    }
  }
}

void HandleServer::command(const Handle& handle, std::uint32_t entry)
{
  const std::vector<HandleCommand> offered = commandsOf(handle.kind);
  const auto command = static_cast<HandleCommand>(entry);
  if (std::find(offered.begin(), offered.end(), command) == offered.end())
  {
    throw cloth::Refusal(nameOf(handle) + ": its menu has no entry " + std::to_string(entry));
  }
  switch (command)
  {
    case HandleCommand::RELEASE:
    case HandleCommand::RELEASE_AND_PIN:
      release(handle, command == HandleCommand::RELEASE_AND_PIN);
      break;
    case HandleCommand::THROW_AT_CLOTH:
      throwAtCloth(handle);
      break;
    case HandleCommand::REMOVE:
      remove(handle);
      break;
    case HandleCommand::TAKE_HOLD:
      takeHold();
      break;
    case HandleCommand::THROW_BALL:
      throwBall();
      break;
    case HandleCommand::PIN:
    case HandleCommand::UNPIN:
      changePins(command == HandleCommand::PIN);
      break;
  }
  context_.publisher.touch();
}

void HandleServer::release(const Handle& handle, bool pin)
{
  Release::Request request;
  Release::Response response;
  request.grasp_id = handle.id;
  request.pin = pin;
  grasps_.release(request, response);
}

void HandleServer::throwAtCloth(const Handle& handle)
{
  context_.loop.call(
      [&](cloth::Simulation& simulation)
      { simulation.throwAtCloth(sourceOf(handle.kind), handle.id, params_.throw_speed); });
}

void HandleServer::remove(const Handle& handle)
{
  context_.loop.call([&](cloth::Simulation& simulation)
                     { simulation.removeSphere(sourceOf(handle.kind), handle.id); });
}

/// The hand then makes way for the handle of the grasp.
void HandleServer::takeHold()
{
  Grasp::Request request;
  Grasp::Response response;
  request.header.frame_id = context_.placement.frame_id;
  request.point = toPoint(hand_.position, context_.placement);
  request.radius = params_.radius;
  grasps_.grasp(request, response);
  hand_.position = hand_.apply(-ASIDE * params_.radius * cloth::Vec3d::UnitY());
}

void HandleServer::throwBall()
{
  ThrowSphere::Request request;
  ThrowSphere::Response response;
  request.header.frame_id = context_.placement.frame_id;
  request.center = toPoint(hand_.position, context_.placement);
  request.velocity =
      toVector3(params_.throw_speed * (hand_.rotation * cloth::Vec3d(cloth::Vec3d::UnitX())));
  request.radius = params_.ball_radius;
  spheres_.throwSphere(request, response);
}

void HandleServer::changePins(bool pin)
{
  Pin::Request request;
  Pin::Response response;
  request.header.frame_id = context_.placement.frame_id;
  request.point = toPoint(hand_.position, context_.placement);
  request.radius = params_.radius;
  pin ? grasps_.pin(request, response) : grasps_.unpin(request, response);
}

// -- what they see --------------------------------------------------------------------------------

/// Brings all handles to where they belong.
void HandleServer::show()
{
  forgetWhatIsOver();
  World world;
  try
  {
    world = look();
  }
  catch (const cloth::Busy&)  // a step takes longer than the patience: another turn comes
  {
    return;
  }
  if (world.home)
  {
    hand_ = *world.home;
  }
  world.handles.push_back(handAt(hand_, params_));
  std::set<std::string> present;
  for (const Handle& handle : world.handles)
  {
    present.insert(nameOf(handle));
    showHandle(handle);
  }
  eraseAllBut(present);
  server_->applyChanges();
}

HandleServer::World HandleServer::look()
{
  return context_.loop.call(
      [this](cloth::Simulation& simulation)
      {
        World world;
        letGo(simulation);
        world.handles = handlesOf(simulation, params_);
        if (epoch_ != simulation.epoch())
        {
          world.home = handHome(simulation.cloth());
        }
        epoch_ = simulation.epoch();
        return world;
      });
}

/// One that is under a pointer keeps its looks, and stays where it was dragged to.
void HandleServer::showHandle(Handle handle)
{
  const std::string name = nameOf(handle);
  const auto shown = shown_.find(name);
  const bool known = shown != shown_.end();
  if (known && dragged_.count(name) > 0)
  {
    return;
  }
  const auto note = notes_.find(name);
  handle.note = note == notes_.end() ? "" : note->second.reason;
  const geometry_msgs::Pose pose = toPose(handle.pose, context_.placement);
  if (!known || !looksSame(handle, shown->second))
  {
    server_->insert(draw(handle, context_.placement),
                    [this](const Feedback::ConstPtr& feedback) { take(feedback); });
    place(name, pose);
  }
  else if (!same(handle.pose, shown->second.pose))
  {
    place(name, pose);
  }
  shown_[name] = handle;
}

void HandleServer::place(const std::string& name, const geometry_msgs::Pose& pose)
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    placed_[name] = pose;
  }
  server_->setPose(name, pose);
}

void HandleServer::eraseAllBut(const std::set<std::string>& present)
{
  for (auto shown = shown_.begin(); shown != shown_.end();)
  {
    const std::string& name = shown->first;
    if (present.count(name) > 0)
    {
      ++shown;
      continue;
    }
    erased_.insert(name);
    dragged_.erase(name);
    notes_.erase(name);
    const std::lock_guard<std::mutex> lock(mutex_);
    placed_.erase(name);
    shown = shown_.erase(shown);
  }
  for (auto name = erased_.begin(); name != erased_.end();)
  {
    // A pose that comes between erasing and applying makes the server keep the marker: look again.
    visualization_msgs::InteractiveMarker marker;
    const bool there = shown_.count(*name) == 0 && server_->get(*name, marker);
    if (there)
    {
      server_->erase(*name);
    }
    name = there ? std::next(name) : erased_.erase(name);
  }
}

/// Pointers that are silent, and notes that were shown long enough. Those of a handle that is
/// dragged wait.
void HandleServer::forgetWhatIsOver()
{
  const Clock::time_point now = Clock::now();
  for (auto pointer = dragged_.begin(); pointer != dragged_.end();)
  {
    const bool silent = now > pointer->second + POINTER_SILENCE;
    pointer = silent ? dragged_.erase(pointer) : std::next(pointer);
  }
  for (auto note = notes_.begin(); note != notes_.end();)
  {
    if (dragged_.count(note->first) > 0)
    {
      note->second.until = now + NOTE_TIME;
    }
    note = now > note->second.until ? notes_.erase(note) : std::next(note);
  }
}

}  // namespace cloth_tearing
