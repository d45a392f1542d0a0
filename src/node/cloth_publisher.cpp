// Publishes what the simulation does: markers, surface, status, grasps and tears.
#include "cloth_tearing/node/cloth_publisher.h"

#include <ros/console.h>

#include <algorithm>

namespace cloth_tearing
{

namespace
{

constexpr std::uint32_t TEAR_QUEUE = 1000;
constexpr std::size_t LONGEST_REFUSAL = 1000;  // of what ~status repeats [characters]
constexpr std::chrono::seconds IDLE(1);        // nobody listens: who comes wakes the thread

std::chrono::steady_clock::duration periodOf(double rate)
{
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(1.0 / rate));
}

}  // namespace

ClothPublisher::ClothPublisher(ros::NodeHandle node, const NodeParams& params,
                               const Placement& placement)
    : placement_(placement)
    , diagnostics_(node)
    , grasps_(node, placement)
    , painter_(params.markers, placement)
{
  open<visualization_msgs::MarkerArray>(node, "markers", params.marker_rate, markers_);
  open<ClothSurface>(node, "surface", params.surface_rate, surface_);
  open<SimulationStatus>(node, "status", params.status_rate, status_);
  open<GraspStates>(node, "grasp_states", params.grasp_state_rate, grasp_states_);
  tear_events_ = node.advertise<TearEvents>("tear_events", TEAR_QUEUE);
}

ClothPublisher::~ClothPublisher()
{
  stop();
}

template <class Message>
void ClothPublisher::open(ros::NodeHandle& node, const std::string& name, double rate,
                          Channel& channel)
{
  channel.period = periodOf(rate);
  channel.due = Clock::now();
  channel.topic = StateTopic::advertise<Message>(node, name,
                                                 [this, &channel]
                                                 {
                                                   const std::lock_guard<std::mutex> lock(mutex_);
                                                   channel.wanted = true;
                                                   urgent_ = true;
                                                   wake_.notify_all();
                                                 });
}

void ClothPublisher::start(cloth::SimulationLoop& loop)
{
  loop_ = &loop;
  thread_ = std::thread([this] { run(); });
}

void ClothPublisher::stop()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    wake_.notify_all();
  }
  if (thread_.joinable())
  {
    thread_.join();
  }
}

// -- from the simulation's thread and from callbacks ----------------------------------------------

void ClothPublisher::onStep(const cloth::Simulation& simulation, const cloth::StepReport& report)
{
  ++version_;
  postponed_ = report.postponed;
  for (const std::string& note : report.notes)
  {
    ROS_WARN_STREAM(note);
  }
  if (!report.fault.empty())
  {
    ROS_ERROR_STREAM(
        "The simulation went back to its last good state and paused: " << report.fault);
    const std::lock_guard<std::mutex> lock(mutex_);
    fault_ = report.fault;
    ++faults_;
  }
  if (!report.tears.empty())
  {
    publishTears(report.tears);
  }
  const bool grasps_changed = grasps_.publishEvents(simulation);
  if (!report.tears.empty() || !report.fault.empty() || grasps_changed)
  {
    touch();
  }
}

void ClothPublisher::onCommands(const cloth::Simulation& simulation)
{
  if (grasps_.publishEvents(simulation))
  {
    touch();
  }
}

void ClothPublisher::publishTears(const std::vector<cloth::TearEvent>& tears) const
{
  if (tear_events_.getNumSubscribers() == 0)
  {
    return;
  }
  const auto message = boost::make_shared<TearEvents>();
  message->header.frame_id = placement_.frame_id;
  message->header.stamp = ros::Time::now();
  message->events = toMessages(tears, placement_);
  tear_events_.publish(message);
}

void ClothPublisher::touch()
{
  ++version_;
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.changed = true;
  grasp_states_.changed = true;
  urgent_ = true;
  wake_.notify_all();
}

std::uint64_t ClothPublisher::faults()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return faults_;
}

void ClothPublisher::clearFault(std::uint64_t settled)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (faults_ == settled)
  {
    fault_.clear();
  }
}

void ClothPublisher::countRefusal(const std::string& name, const std::string& reason)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  ++refusals_;
  last_refusal_ = name + ": " + reason.substr(0, LONGEST_REFUSAL);
}

void ClothPublisher::recordingBegins(const std::string& path)
{
  ROS_INFO_STREAM("Records to " << path);
  const std::lock_guard<std::mutex> lock(mutex_);
  recording_ = path;
}

void ClothPublisher::recordingEnds(const std::string& reason)
{
  ROS_ERROR_STREAM("The recording ends, the simulation goes on: " << reason);
  const std::lock_guard<std::mutex> lock(mutex_);
  recording_problem_ = reason;
}

// -- the publishing thread ------------------------------------------------------------------------

void ClothPublisher::run()
{
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stopping_)
  {
    wake_.wait_until(lock, nextTurn(), [this] { return stopping_ || urgent_; });
    urgent_ = false;
    lock.unlock();
    bool missed = false;
    try
    {
      takeTurns();
    }
    catch (const cloth::Busy&)  // a step takes longer than the patience: another turn comes
    {
      missed = true;
    }
    lock.lock();
    for (Channel* channel : { &markers_, &surface_, &status_, &grasp_states_ })
    {
      channel->wanted |= missed;  // nobody knows whose turn it was
    }
  }
}

void ClothPublisher::takeTurns()
{
  grasps_.openWrenches();
  const Clock::time_point now = Clock::now();
  const bool markers = takeTurn(markers_, false, now);
  const bool surface = takeTurn(surface_, false, now);
  if (markers || surface)
  {
    publishSnapshot(markers, surface);
  }
  if (takeTurn(status_, true, now))
  {
    publishStatus();
  }
  if (diagnostics_.isDue())
  {
    diagnostics_.publish(statusSource());
  }
  if (takeTurn(grasp_states_, false, now))
  {
    publishGrasps();
  }
}

ClothPublisher::Clock::time_point ClothPublisher::nextTurn() const
{
  Clock::time_point next = Clock::now() + IDLE;
  for (const Channel* channel : { &markers_, &surface_, &status_, &grasp_states_ })
  {
    if (heard(*channel))
    {
      next = std::min(next, channel->due);
    }
  }
  if (diagnostics_.heard())
  {
    next = std::min(next, diagnostics_.due());
  }
  return next;
}

bool ClothPublisher::heard(const Channel& channel) const
{
  return channel.topic.heard() || (&channel == &grasp_states_ && grasps_.heard());
}

/// Whether to publish now; sets when to look again. What changed may go before its turn, but never
/// sooner after the last time than its rate says.
bool ClothPublisher::takeTurn(Channel& channel, bool unchanged_too, Clock::time_point now)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!heard(channel))
  {
    channel.wanted = false;
    channel.changed = false;
    return false;
  }
  const bool on_time = now >= channel.due;
  const bool rested = now >= channel.last + channel.period;
  const bool news = unchanged_too || channel.seen != version_;
  const bool publish = channel.wanted || (on_time && news) || (rested && channel.changed);
  channel.due = on_time ? channel.due + channel.period : channel.due;
  if (channel.due < now || (publish && !on_time))  // nobody listened for a while, or it goes early
  {
    channel.due = now + channel.period;
  }
  if (publish)
  {
    channel.last = now;
    channel.wanted = false;
    channel.changed = false;
  }
  return publish;
}

void ClothPublisher::publishSnapshot(bool markers, bool surface)
{
  const std::uint64_t version = version_;  // before the snapshot: it may be newer, never older
  loop_->call([this](cloth::Simulation& simulation) { taker_.take(simulation, snapshot_); });
  const ros::Time stamp = ros::Time::now();
  if (markers)
  {
    publishMarkers(stamp);
    markers_.seen = version;
  }
  if (surface)
  {
    publishSurface(stamp);
    surface_.seen = version;
  }
}

void ClothPublisher::publishMarkers(const ros::Time& stamp)
{
  marker_message_.renew();
  painter_.draw(snapshot_, *marker_message_);
  for (visualization_msgs::Marker& marker : marker_message_->markers)
  {
    marker.header.stamp = stamp;
  }
  markers_.topic.publish(marker_message_.shared());
}

void ClothPublisher::publishSurface(const ros::Time& stamp)
{
  const cloth::Surface& surface = snapshot_.surface;
  if (surface_message_.renew() || told_topology_ != surface.topology)
  {
    fillTopology(*surface_message_, *surface.topology);
    told_topology_ = surface.topology;
  }
  fillMotion(*surface_message_, surface, placement_);
  surface_message_->header.stamp = stamp;
  surface_.topic.publish(surface_message_.shared());
}

StatusSource ClothPublisher::statusSource()
{
  StatusSource source;
  source.postponed = postponed_;
  loop_->call(
      [&source](cloth::Simulation& simulation)
      {
        source.summary = simulation.summary();
        source.time_step = simulation.params().solver.time_step;
        source.grasps = static_cast<int>(simulation.grasps().size());
        source.spheres = static_cast<int>(simulation.spheres().size());
      });
  source.loop = loop_->state();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    source.fault = fault_;
    source.refusals = refusals_;
    source.last_refusal = last_refusal_;
    source.recording = recording_;
    source.recording_problem = recording_problem_;
  }
  return source;
}

void ClothPublisher::publishStatus()
{
  const auto message = boost::make_shared<SimulationStatus>(toMessage(statusSource(), placement_));
  message->header.stamp = ros::Time::now();
  status_.topic.publish(message);
}

void ClothPublisher::publishGrasps()
{
  const std::uint64_t version = version_;
  const auto states = boost::make_shared<GraspStates>();
  *states = loop_->call([this](cloth::Simulation& simulation)
                        { return graspStates(simulation, placement_); });
  states->header.stamp = ros::Time::now();
  grasps_.publishWrenches(*states);
  grasp_states_.topic.publish(states);
  grasp_states_.seen = version;
}

}  // namespace cloth_tearing
