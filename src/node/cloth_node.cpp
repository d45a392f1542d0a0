// The node: services and topics around one simulation.
#include "cloth_tearing/node/cloth_node.h"

#include <ros/console.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <thread>

#include "cloth_tearing/core/kernels.h"
#include "cloth_tearing/node/limit_words.h"

namespace cloth_tearing
{

namespace
{

constexpr std::uint32_t REQUEST_THREADS = 4;
constexpr std::uint32_t STEP_THREADS = 2;

ros::NodeHandle servedBy(ros::NodeHandle node, ros::CallbackQueue& queue)
{
  node.setCallbackQueue(&queue);
  return node;
}

/// ROS time; nothing as long as use_sim_time is set and /clock has not told it.
cloth::ClockFollower::Reading rosTime()
{
  const ros::Time now = ros::Time::now();
  if (now.isZero())
  {
    return {};
  }
  return std::chrono::nanoseconds(now.toNSec());
}

cloth::SimulationLoop::Options loopOptions(const NodeParams& params, FrameFollower& follower,
                                           ClothPublisher& publisher, NewestNumber& pull_ends)
{
  cloth::SimulationLoop::Options options;
  options.pace = params.pace;
  options.paused = params.paused;
  options.speed = params.speed;
  options.patience = std::chrono::milliseconds(static_cast<int>(1000.0 * params.command_patience));
  options.max_commands = params.max_commands;
  options.clock = rosTime;
  options.before_step = [&follower](cloth::Simulation& simulation)
  { follower.beforeStep(simulation); };
  options.after_commands = [&publisher, &pull_ends](const cloth::Simulation& simulation)
  {
    publisher.onCommands(simulation);
    pull_ends.raise(simulation.loggedPullEnds()[1]);
  };
  options.on_clock_jump = [](const std::string& jump) { ROS_WARN_STREAM(jump); };
  return options;
}

/// A number that no other run of a node has: saved states tell by it whose tears they bring.
std::uint64_t newLife()
{
  std::random_device source;
  return static_cast<std::uint64_t>(source()) << 32 | source();
}

void tellHowItIsComputed(const cloth::Simulation& simulation)
{
  if (const char* wish = cloth::kernels::ignoredWish())
  {
    ROS_WARN_STREAM("CLOTH_TEARING_SIMD is \""
                    << wish << "\", which this processor does not have: ignored");
  }
  ROS_INFO_STREAM(simulation.cloth().state.size()
                  << " particles, " << simulation.threads() << " of "
                  << std::thread::hardware_concurrency() << " threads, "
                  << cloth::kernels::best().name << " instructions");
}

std::unique_ptr<cloth::Simulation> makeSimulation(const NodeParams& params,
                                                  const Placement& placement,
                                                  ClothPublisher& publisher)
{
  const PlacedModel placed = placedModel(params);
  for (const std::string& finding : placed.findings)
  {
    ROS_WARN_STREAM(params.model_file << ": " << finding);
  }
  cloth::SimulationParams simulation_params = inClothFrame(params);
  simulation_params.life = newLife();
  simulation_params.place = toWords(placement);
  auto simulation =
      std::make_unique<cloth::Simulation>(placed.model, placed.pinned, simulation_params);
  for (const std::string& note : simulation->startNotes())
  {
    ROS_WARN_STREAM(note);
  }
  tellHowItIsComputed(*simulation);
  ROS_INFO_STREAM(limitsInWords(params));
  if (!params.recording.folder.empty())
  {
    publisher.recordingBegins(beginRecording(
        *simulation, { placed.model, placed.pinned, simulation_params }, params.recording,
        [&publisher](const std::string& reason) { publisher.recordingEnds(reason); }));
  }
  return simulation;
}

}  // namespace

ClothNode::ClothNode(const ros::NodeHandle& node, const NodeParams& params)
    : placement_{ params.frame_id, params.cloth_pose.position }
    , node_(servedBy(node, queue_))
    , step_node_(servedBy(node, step_queue_))
    , frames_(placement_, std::chrono::duration<double>(params.tf_patience))
    , follower_(frames_, params)
    , publisher_(node_, params, placement_)
    , clock_(node_, params)
    , requests_(publisher_)
    , transforms_(frames_.buffer(), requests_)
    , states_(params.states)
    , loop_(makeSimulation(params, placement_, publisher_),
            loopOptions(params, follower_, publisher_, pull_ends_),
            [this](const cloth::Simulation& simulation, const cloth::StepReport& report)
            {
              clock_.onStep(simulation.time());
              if (!report.fault.empty())
              {
                keepFault(simulation);
              }
              publisher_.onStep(simulation, report);
              pull_ends_.raise(simulation.loggedPullEnds()[1]);
            })
    , grasps_(context())
    , spheres_(context())
    , pulls_(context(), pull_ends_)
    , predictions_(context())
    , state_services_(context(), states_, [this] { tuning_.show(); })
    , tuning_(context(), { cloth::tuningOf(params.simulation), params.speed })
    , models_(context(), params)
    , spinner_(REQUEST_THREADS, &queue_)
    , step_spinner_(STEP_THREADS, &step_queue_)
    , watchdog_(node.getNamespace(), std::chrono::duration<double>(params.master_period))
{
  openRequests();
  publisher_.start(loop_);
  if (params.handles.enabled)
  {
    handles_ = std::make_unique<HandleServer>(context(), params.handles, grasps_, spheres_);
  }
  watchdog_.start();  // before the first request is answered: then it knows all services
  spinner_.start();
  step_spinner_.start();
}

ClothNode::~ClothNode()
{
  watchdog_.stop();  // what is taken back from now on is not registered again
  frames_.stopWaiting();
  loop_.stop();  // whoever waits for it is answered
  handles_.reset();
  pulls_.stop();
  predictions_.stop();
  spinner_.stop();
  step_spinner_.stop();
  publisher_.stop();
}

NodeContext ClothNode::context()
{
  return { node_, placement_, frames_, publisher_, requests_, loop_, follower_ };
}

void ClothNode::openRequests()
{
  using std_srvs::Trigger;
  requests_.serve<GetTearEvents>(
      node_, "get_tear_events", [this](auto& q, auto& a) { onGetTearEvents(q, a); }, Effect::LOOKS);
  requests_.serve<Step>(step_node_, "step", [this](auto& q, auto& a) { onStep(q, a); });
  requests_.serve<Trigger>(node_, "pause", [this](auto&, auto&) { loop_.pause(); });
  requests_.serve<Trigger>(node_, "resume",
                           [this](auto&, auto&) { settleFaults([this] { loop_.resume(); }); });
  requests_.serve<Trigger>(node_, "reset",
                           [this](auto&, auto&) { settleFaults([this] { loop_.reset(); }); });
}

/// The state before a fault, to look at: restored, a step brings the fault again.
void ClothNode::keepFault(const cloth::Simulation& simulation)
{
  try
  {
    const std::string state = simulation.save();
    states_.keep("fault", state);
    ROS_ERROR_STREAM(
        "The state before a fault is kept: restore the state \"fault\", then a step "
        "shows it again");
    if (states_.hasFiles())
    {
      states_.write("fault", state);
    }
  }
  catch (const std::exception& error)
  {
    ROS_WARN_STREAM("The state before a fault is not kept: " << error.what());
  }
}

/// Forgets the faults so far once `command` has succeeded. The next one may come before it returns.
template <class Command>
void ClothNode::settleFaults(Command command)
{
  const std::uint64_t settled = publisher_.faults();
  command();
  publisher_.clearFault(settled);
}

void ClothNode::onGetTearEvents(const GetTearEvents::Request& request,
                                GetTearEvents::Response& response)
{
  const std::uint64_t since = request.since;
  std::vector<cloth::TearEvent> events;
  std::array<std::uint64_t, 2> kept{};
  loop_.call(
      [&](cloth::Simulation& simulation)
      {
        events = simulation.tearsSince(since, mostOf(request.max_count));
        kept = simulation.loggedTears();
      });
  response.header.frame_id = placement_.frame_id;
  response.header.stamp = ros::Time::now();
  response.events = toMessages(events, placement_);
  response.oldest = kept[0];
  response.newest = kept[1];
}

void ClothNode::onStep(const Step::Request& request, Step::Response& response)
{
  fill(response, loop_.step(request.steps));
}

}  // namespace cloth_tearing
