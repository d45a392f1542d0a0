// Many users at once, for long, and all that they do drawn at random: nothing is found wrong,
// nothing is lost.
//
// CLOTH_TEARING_SOAK_SECONDS: how long (30). CLOTH_TEARING_SOAK_SEED: of what the users do (1). The
// seed decides what each of them does; how that falls together is a matter of time. A run of ten
// minutes or more is held to its slope of memory, too.
#include <cloth_tearing/GetGraspEvents.h>
#include <cloth_tearing/GetTearEvents.h>
#include <cloth_tearing/GraspEvents.h>
#include <cloth_tearing/SimulationStatus.h>
#include <cloth_tearing/TearEvents.h>
#include <ros/ros.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <tuple>

#include "process_of.h"
#include "soak/process_log.h"
#include "soak/users.h"

using namespace cloth_tearing;  // NOLINT: the messages are what all of this is about
using soak::World;

namespace
{

const std::string NODE = "/cloth";
constexpr double SHORT = 30.0;          // how long it goes unless told otherwise [s]
constexpr double MINUTE = 60.0;         // [s]
constexpr double LONG = 10.0 * MINUTE;  // from here on the slope of memory counts [s]
constexpr double WARM_UP = 1.0 / 3.0;   // of the run: logs and caches fill
constexpr int BLOCKS = 20;              // of the rest
constexpr int KEPT_OPEN = 3;            // descriptors that roscpp may keep for its next call
constexpr double SMALL_SLOPE = 20.0;    // compatible with none, whatever its error [kB/min]

double fromEnvironment(const char* name, double otherwise)
{
  const char* const text = std::getenv(name);
  return text != nullptr ? std::atof(text) : otherwise;
}

/// Follows the log of events of one kind, which has all numbers, and holds the topic to it.
template <class Events, class GetEvents>
class EventAudit
{
public:
  EventAudit(World& world, const std::string& topic)
      : world_(world)
      , topic_(topic)
      , subscriber_(ros::NodeHandle().subscribe(NODE + "/" + topic, 1000, &EventAudit::take, this))
  {
  }

  /// Asks for what is new in the log.
  void look()
  {
    typename GetEvents::Request request;
    request.since = next_;
    const auto log = world_.ask<GetEvents>("get_" + topic_, request, soak::Expect::SUCCESS);
    if (!log.events.empty() && log.events.front().sequence != next_)
    {
      world_.fail(topic_, "the log goes on at " + std::to_string(log.events.front().sequence) +
                              ", not at " + std::to_string(next_));
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& event : log.events)
    {
      logged_.push_back(markOf(event));
      next_ = event.sequence + 1;
    }
    compare();
    while (logged_.size() > KEPT)
    {
      logged_.pop_front();
    }
  }

  std::uint64_t logged() const { return next_ - 1; }

private:
  using Mark = std::tuple<std::uint64_t, std::uint32_t, std::uint64_t, int>;

  static constexpr std::size_t KEPT = 100000;

  template <class Event>
  static Mark markOf(const Event& event)
  {
    return { event.sequence, event.epoch, event.step, event.kind };
  }

  void take(const Events& message)
  {
    world_.check(topic_, message);
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& event : message.events)
    {
      if (!told_.empty() && event.sequence <= std::get<0>(told_.back()))
      {
        world_.fail(topic_, "event " + std::to_string(event.sequence) + " is told twice");
      }
      told_.push_back(markOf(event));
    }
  }

  /// All that the topic told up to here has to stand in the log.
  void compare()
  {
    while (!told_.empty() && std::get<0>(told_.front()) < next_)
    {
      if (!std::binary_search(logged_.begin(), logged_.end(), told_.front()))
      {
        world_.fail(topic_, "event " + std::to_string(std::get<0>(told_.front())) +
                                " is another one in the log");
      }
      world_.count(topic_ + " found in the log");
      told_.pop_front();
    }
  }

  World& world_;
  std::string topic_;
  std::uint64_t next_ = 1;
  std::mutex mutex_;            // guards what follows
  std::deque<Mark> told_;       ///< by the topic, not found in the log yet
  std::deque<Mark> logged_;     ///< the newest
  ros::Subscriber subscriber_;  // last: it calls take()
};

/// Lets a crowd loose on the node.
class Soak
{
public:
  Soak(World& world, pid_t process, std::uint64_t seed, const std::string& states)
      : world_(world), process_(process), seed_(seed), states_(states)
  {
  }

  void run(double seconds)
  {
    ros::NodeHandle handle;
    const std::vector<ros::Subscriber> eyes = {
      handle.subscribe<ClothSurface>(NODE + "/surface", 1,
                                     [this](const auto& message) { world_.showCloth(*message); }),
      handle.subscribe<GraspStates>(NODE + "/grasp_states", 1,
                                    [this](const auto& message) { world_.showGrasps(*message); }),
      handle.subscribe<SimulationStatus>(NODE + "/status", 100,
                                         [this](const auto& message) { see(*message); })
    };
    EventAudit<TearEvents, GetTearEvents> tears(world_, "tear_events");
    EventAudit<GraspEvents, GetGraspEvents> grasps(world_, "grasp_events");
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
    ros::WallTime report = ros::WallTime::now() + ros::WallDuration(MINUTE);
    const soak::Crowd crowd(world_, seed_, states_);
    while (ros::WallTime::now() < end && ros::ok())
    {
      world_.pause(std::chrono::milliseconds(200));
      tears.look();
      grasps.look();
      if (ros::WallTime::now() > report)
      {
        report += ros::WallDuration(MINUTE);
        tell();
      }
    }
    world_.end();
    world_.count("tears logged", tears.logged());
    world_.count("events of grasps logged", grasps.logged());
  }

private:
  /// A runaway is undone and told, but there should be none.
  void see(const SimulationStatus& status)
  {
    world_.check("status", status);
    if (!status.fault.empty() && fault_.empty())
    {
      world_.fail("fault", status.fault);
    }
    fault_ = status.fault;
  }

  void tell() const
  {
    const soak::ProcessSample now = soak::lookAt(process_);
    std::printf("soak: %.0f kB resident, %d descriptors\n", now.memory, now.descriptors);
    std::fflush(stdout);
  }

  World& world_;
  pid_t process_;
  std::uint64_t seed_;
  std::string states_;
  std::string fault_;  ///< that ~status told last
};

void tellCounts(const World& world)
{
  for (const auto& [what, count] : world.counts())
  {
    std::printf("soak: %10llu  %s\n", static_cast<unsigned long long>(count), what.c_str());
  }
}

/// Two thirds of the run, told and, if it was long, judged.
void judgeMemory(const std::vector<soak::ProcessSample>& samples, double seconds)
{
  if (samples.size() < 2 * BLOCKS)
  {
    return;
  }
  const soak::Slope slope = soak::memorySlope(samples, BLOCKS);
  std::printf("soak: memory %.1f +- %.1f kB/min (naive error %.1f), means of %d blocks of %zu s:",
              slope.value, slope.error, slope.naive, BLOCKS, samples.size() / BLOCKS);
  for (const double block : slope.blocks)
  {
    std::printf(" %.0f", block);
  }
  int least = samples.front().descriptors;
  int most = least;
  for (const soak::ProcessSample& sample : samples)
  {
    least = std::min(least, sample.descriptors);
    most = std::max(most, sample.descriptors);
  }
  std::printf(" kB\nsoak: descriptors %d to %d\n", least, most);
  if (seconds >= LONG)
  {
    EXPECT_LE(slope.value, std::max(2.0 * slope.error, SMALL_SLOPE)) << "memory grows [kB/min]";
  }
}

}  // namespace

TEST(Soak, FindsNothingWrongAndLeavesNoDescriptorOpen)
{
  const double seconds = fromEnvironment("CLOTH_TEARING_SOAK_SECONDS", SHORT);
  const auto seed = static_cast<std::uint64_t>(fromEnvironment("CLOTH_TEARING_SOAK_SEED", 1.0));
  std::string states;
  ASSERT_TRUE(ros::param::get(NODE + "/state_folder", states));
  std::filesystem::create_directories(states);  // of exports, too
  ASSERT_TRUE(ros::service::waitForService(NODE + "/step", ros::Duration(soak::PATIENCE)));
  const pid_t process = processOf(NODE);
  ASSERT_GT(process, 0);
  std::printf("soak: %.0f s, seed %llu\n", seconds, static_cast<unsigned long long>(seed));
  {
    World first(NODE);  // everybody comes and goes once: what stays open by that is no loss
    Soak(first, process, seed, states).run(1.0);
  }
  const int before = soak::lookAt(process).descriptors;
  const soak::ProcessLog log(process);
  World world(NODE);

  Soak(world, process, seed, states).run(seconds);

  tellCounts(world);
  judgeMemory(log.samples(WARM_UP * seconds), seconds);
  int after = 0;
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(soak::PATIENCE);
  do
  {
    after = soak::lookAt(process).descriptors;
    std::this_thread::yield();
  } while (after > before + KEPT_OPEN && ros::WallTime::now() < deadline);
  std::printf("soak: %d descriptors before, %d after\n", before, after);
  EXPECT_LE(after, before + KEPT_OPEN);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "soak_rostest");
  const ros::NodeHandle node;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
