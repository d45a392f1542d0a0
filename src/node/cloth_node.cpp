// The node: services and topics around one simulation.
#include "cloth_tearing/node/cloth_node.h"

#include <ros/console.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <type_traits>

#include "cloth_tearing/core/refusal.h"

namespace cloth_tearing
{

namespace
{

constexpr std::uint32_t REQUEST_THREADS = 4;
constexpr std::uint32_t STEP_THREADS = 2;
constexpr double COMPLAIN_EVERY = 5.0;  // [s], about what comes on a topic

ros::NodeHandle servedBy(ros::NodeHandle node, ros::CallbackQueue& queue)
{
  node.setCallbackQueue(&queue);
  return node;
}

cloth::SimulationLoop::Options loopOptions(const NodeParams& params)
{
  cloth::SimulationLoop::Options options;
  options.pace = params.pace;
  options.paused = params.paused;
  options.patience = std::chrono::milliseconds(static_cast<int>(1000.0 * params.command_patience));
  return options;
}

std::unique_ptr<cloth::Simulation> makeSimulation(const NodeParams& params)
{
  const PlacedModel placed = placedModel(params);
  for (const std::string& finding : placed.findings)
  {
    ROS_WARN_STREAM(params.model_file << ": " << finding);
  }
  auto simulation =
      std::make_unique<cloth::Simulation>(placed.model, placed.pinned, inClothFrame(params));
  for (const std::string& note : simulation->startNotes())
  {
    ROS_WARN_STREAM(note);
  }
  return simulation;
}

}  // namespace

ClothNode::ClothNode(const ros::NodeHandle& node, const NodeParams& params)
    : placement_{ params.frame_id, params.cloth_pose.position }
    , node_(servedBy(node, queue_))
    , step_node_(servedBy(node, step_queue_))
    , frames_(placement_, std::chrono::duration<double>(params.tf_patience))
    , publisher_(node_, params, placement_)
    , loop_(std::make_unique<cloth::SimulationLoop>(
          makeSimulation(params), loopOptions(params),
          [this](const cloth::Simulation&, const cloth::StepReport& report)
          { publisher_.onStep(report); }))
    , spinner_(REQUEST_THREADS, &queue_)
    , step_spinner_(STEP_THREADS, &step_queue_)
{
  openRequests();
  publisher_.start(*loop_);
  spinner_.start();
  step_spinner_.start();
}

ClothNode::~ClothNode()
{
  frames_.stopWaiting();
  loop_->stop();  // whoever waits for it is answered
  spinner_.stop();
  step_spinner_.stop();
  publisher_.stop();
}

// -- requests
// --------------------------------------------------------------------------------------

void ClothNode::openRequests()
{
  using std_srvs::Trigger;
  serve<Grasp>(node_, "grasp", [this](auto& q, auto& a) { onGrasp(q, a); });
  serve<Drag>(node_, "drag", [this](auto& q, auto&) { onDrag(q); });
  serve<Release>(node_, "release", [this](auto& q, auto& a) { onRelease(q, a); });
  serve<ThrowSphere>(node_, "throw_sphere", [this](auto& q, auto& a) { onThrowSphere(q, a); });
  serve<GetTearEvents>(node_, "get_tear_events",
                       [this](auto& q, auto& a) { onGetTearEvents(q, a); });
  serve<Step>(step_node_, "step", [this](auto& q, auto& a) { onStep(q, a); });
  serve<Trigger>(node_, "pause", [this](auto&, auto&) { loop_->pause(); });
  serve<Trigger>(node_, "resume",
                 [this](auto&, auto&) { settleFaults([this] { loop_->resume(); }); });
  serve<Trigger>(node_, "reset",
                 [this](auto&, auto&) { settleFaults([this] { loop_->reset(); }); });
  spheres_ = node_.subscribe("spheres", 1, &ClothNode::onSpheres, this);
}

/// Does `work` and returns why it was refused, empty if it was done.
template <class Work>
std::string ClothNode::refusal(const std::string& name, Work work)
{
  try
  {
    work();
    return "";
  }
  catch (const std::exception& error)  // Refusal and Busy say why; nothing else may hide the reason
  {
    const std::string reason = *error.what() == '\0' ? "refused" : error.what();
    publisher_.countRefusal(name, reason);
    return reason;
  }
}

/// A refusal is an answer with its reason: the callback itself never fails. What was done is seen
/// at once.
template <class Service, class Work>
void ClothNode::serve(ros::NodeHandle& node, const std::string& name, Work work)
{
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  const boost::function<bool(Request&, Response&)> callback =
      [this, name, work](Request& request, Response& response)
  {
    response.success = true;
    const std::string reason = refusal(name, [&] { work(request, response); });
    if (!reason.empty())
    {
      response = Response();
      response.message = reason;
    }
    else if (!std::is_same<Service, GetTearEvents>::value)  // which only looks
    {
      publisher_.touch();
    }
    return true;
  };
  services_.push_back(node.advertiseService(name, callback));
}

/// Forgets the faults so far once `command` has succeeded. The next one may come before it returns.
template <class Command>
void ClothNode::settleFaults(Command command)
{
  const std::uint64_t settled = publisher_.faults();
  command();
  publisher_.clearFault(settled);
}

void ClothNode::onGrasp(const Grasp::Request& request, Grasp::Response& response)
{
  cloth::refuseIf(problems(request));
  const cloth::GraspRequest wish = toCore(request, frames_.toCloth(request.header));
  const cloth::GraspTaken taken =
      loop_->call([&wish](cloth::Simulation& simulation) { return simulation.grasp(wish); });
  response.grasp_id = taken.id;
  response.held_particles = static_cast<std::uint32_t>(taken.held_particles);
  response.distance = taken.distance;
}

void ClothNode::onDrag(const Drag::Request& request)
{
  cloth::refuseIf(problems(request));
  Destination destination = toCore(request, frames_.toCloth(request.header));
  const std::uint64_t id = request.grasp_id;
  loop_->call(
      [&destination, id](cloth::Simulation& simulation)
      {
        for (const cloth::Grasp& grasp : simulation.grasps())
        {
          if (grasp.id == id && destination.keeps_rotation)
          {
            destination.target.pose.rotation = grasp.pose.rotation;
          }
        }
        simulation.drag(id, destination.target);
      });
}

void ClothNode::onRelease(const Release::Request& request, Release::Response& response)
{
  const std::uint64_t id = request.grasp_id;
  response.released = static_cast<std::uint32_t>(loop_->call(
      [id](cloth::Simulation& simulation)
      {
        if (id == 0)
        {
          return simulation.releaseAll();
        }
        simulation.release(id);
        return 1;
      }));
}

void ClothNode::onThrowSphere(const ThrowSphere::Request& request, ThrowSphere::Response& response)
{
  cloth::refuseIf(problems(request));
  const cloth::ThrowRequest wish = toCore(request, frames_.toCloth(request.header));
  response.sphere_id =
      loop_->call([&wish](cloth::Simulation& simulation) { return simulation.throwSphere(wish); });
}

void ClothNode::onGetTearEvents(const GetTearEvents::Request& request,
                                GetTearEvents::Response& response)
{
  const std::uint64_t since = request.since;
  const std::size_t most =
      request.max_count == 0 ? std::numeric_limits<std::size_t>::max() : request.max_count;
  std::vector<cloth::TearEvent> events;
  std::array<std::uint64_t, 2> kept{};
  loop_->call(
      [&](cloth::Simulation& simulation)
      {
        events = simulation.tearsSince(since, most);
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
  fill(response, loop_->step(request.steps));
}

void ClothNode::onSpheres(const CollisionSpheres::ConstPtr& message)
{
  const std::string reason = refusal(
      "spheres",
      [&]
      {
        cloth::refuseIf(problems(*message));
        std::vector<cloth::Sphere> spheres;
        if (!message->spheres.empty())
        {
          spheres = toCore(*message, frames_.toCloth(message->header));
        }
        loop_->call([&spheres](cloth::Simulation& simulation) { simulation.setSpheres(spheres); });
        publisher_.touch();
      });
  if (!reason.empty())
  {
    ROS_WARN_STREAM_THROTTLE(COMPLAIN_EVERY, "A message on spheres was refused: " << reason);
  }
}

}  // namespace cloth_tearing
