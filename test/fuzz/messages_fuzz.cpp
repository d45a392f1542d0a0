// Fuzzer of messages: bytes are a request or message, which has to be refused or done.
#include <cloth_tearing/Export.h>
#include <cloth_tearing/GetTearEvents.h>
#include <cloth_tearing/LoadModel.h>
#include <cloth_tearing/NamedState.h>
#include <cloth_tearing/PullActionGoal.h>
#include <cloth_tearing/Release.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <sanitizer/allocator_interface.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/node/bounded_stream.h"
#include "cloth_tearing/node/grasp_conversions.h"
#include "fuzz/bytes.h"
#include "fuzz/small_state.h"

namespace cloth_tearing
{
namespace
{

constexpr int STEPS = 2;

/// What a message may take in memory for each byte of it, and anyway (a reason is a text).
constexpr std::size_t MOST_FOR_A_BYTE = 10;
constexpr std::size_t MOST_FOR_NONE = 4096;

std::size_t allocated = 0;  ///< in all, whatever was given back [bytes]

/// Only the frame of the cloth itself is known here.
const cloth::Pose HERE;

// -- what is done with a message, as by the node --------------------------------------------------

void act(cloth::Simulation& simulation, const Grasp::Request& request)
{
  cloth::refuseIf(problems(request));
  simulation.grasp(toCore(request, HERE));
}

void act(cloth::Simulation& simulation, const Drag::Request& request)
{
  cloth::refuseIf(problems(request));
  simulation.drag(request.grasp_id, toCore(request, HERE).target);
}

void act(cloth::Simulation& simulation, const Release::Request& request)
{
  simulation.release(request.grasp_id, "released on request",
                     request.pin != 0 ? cloth::AfterGrasp::PINNED : cloth::AfterGrasp::FREE);
}

void act(cloth::Simulation& simulation, const Pin::Request& request)
{
  cloth::refuseIf(problems(request));
  const cloth::PinRequest pins = toCore(request, HERE);
  cloth::Simulation(simulation).unpin(pins);
  simulation.pin(pins);
}

void act(cloth::Simulation& simulation, const ThrowSphere::Request& request)
{
  cloth::refuseIf(problems(request));
  simulation.throwSphere(toCore(request, HERE));
}

void act(cloth::Simulation& simulation, const CollisionSpheres& message)
{
  cloth::refuseIf(problems(message));
  std::vector<cloth::Sphere> spheres;
  for (const CollisionSphere& sphere : message.spheres)
  {
    spheres.push_back(toCore(sphere, HERE));
  }
  simulation.setSpheres(spheres);
}

void act(cloth::Simulation& simulation, const GraspTargets& message)
{
  cloth::refuseIf(problems(message));
  std::vector<cloth::Pose> poses;
  for (const GraspTarget& target : message.targets)
  {
    poses.push_back(poseFor(target.pose, HERE, simulation.findGrasp(target.grasp_id).pose));
  }
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    simulation.steer(message.targets[i].grasp_id, poses[i], cloth::LONGEST_GLIDE);
  }
}

void act(cloth::Simulation& simulation, const PullActionGoal& message)
{
  cloth::refuseIf(problems(message.goal));
  beginPull(simulation, message.goal, HERE);
}

void act(cloth::Simulation& simulation, const GetTearEvents::Request& request)
{
  toMessages(simulation.tearsSince(request.since, request.max_count), Placement());
}

void act(cloth::Simulation& /*simulation*/, const tf2_msgs::TFMessage& message)
{
  tf2::BufferCore buffer;
  for (const geometry_msgs::TransformStamped& transform : message.transforms)
  {
    try
    {
      buffer.setTransform(transform, "fuzz");
    }
    catch (const std::runtime_error&)  // tf2 adds stamps up, which may be too large for it
    {
    }
    try
    {
      toClothFrame(buffer.lookupTransform("world", transform.child_frame_id, {}).transform,
                   Placement());
    }
    catch (const std::runtime_error&)  // there is none; the node takes both for a lost frame
    {
    }
  }
}

/// Nothing: files and parameters are another's work.
template <class Message>
void act(cloth::Simulation& /*simulation*/, const Message& /*message*/)
{
}

// -- what must hold -------------------------------------------------------------------------------

void goOn(cloth::Simulation& simulation)
{
  for (int i = 0; i < STEPS; ++i)
  {
    simulation.step();
  }
  cloth::fuzz::expect(cloth::defects(simulation.cloth().mesh).empty(), "a cloth has defects");
  simulation.summary();
  simulation.snapshot();
}

template <class Message>
void obey(const Message& message)
{
  static const cloth::Simulation begin = cloth::fuzz::smallSimulation(cloth::SolverKind::XPBD);
  static const std::uint64_t hash = begin.stateHash();
  cloth::Simulation simulation = begin;
  try
  {
    act(simulation, message);
  }
  catch (const cloth::Refusal& refusal)
  {
    cloth::fuzz::expect(*refusal.what() != '\0', "a refusal without a reason");
    cloth::fuzz::expect(simulation.stateHash() == hash, "what was refused changed something");
  }
  goOn(simulation);
}

template <class Message>
void receive(std::uint8_t* data, std::size_t size)
{
  Message message;
  const std::size_t before = allocated;
  try
  {
    BoundedStream::read(data, size, message);
  }
  catch (const MalformedMessage& error)
  {
    cloth::fuzz::expect(allocated - before <= MOST_FOR_A_BYTE * size + MOST_FOR_NONE,
                        "a malformed message took memory");
    return;
  }
  cloth::fuzz::expect(allocated - before <= MOST_FOR_A_BYTE * size + MOST_FOR_NONE,
                      "a message took memory");
  cloth::fuzz::expect(ros::serialization::serializationLength(message) <= size,
                      "a message holds more than was sent");
  obey(message);
}

constexpr void (*KINDS[])(std::uint8_t*, std::size_t) = {
  receive<Grasp::Request>,         receive<Drag::Request>,
  receive<Release::Request>,       receive<Pin::Request>,
  receive<ThrowSphere::Request>,   receive<CollisionSpheres>,
  receive<GraspTargets>,           receive<PullActionGoal>,
  receive<tf2_msgs::TFMessage>,    receive<dynamic_reconfigure::Reconfigure::Request>,
  receive<GetTearEvents::Request>, receive<NamedState::Request>,
  receive<LoadModel::Request>,     receive<Export::Request>,
};

}  // namespace
}  // namespace cloth_tearing

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const int installed = __sanitizer_install_malloc_and_free_hooks(
      [](const volatile void*, std::size_t bytes) { cloth_tearing::allocated += bytes; },
      [](const volatile void*) {});
  cloth::fuzz::expect(installed != 0, "nobody counts what is allocated");
  if (size == 0)
  {
    return 0;
  }
  std::vector<std::uint8_t> body(data + 1, data + size);  // so that reading beyond it is seen
  cloth_tearing::KINDS[data[0] % std::size(cloth_tearing::KINDS)](body.data(), body.size());
  return 0;
}
