// The promises of the running node about time: it follows /clock, tells it, and does without it.
#include <cloth_tearing/Grasp.h>
#include <cloth_tearing/SimulationStatus.h>
#include <cloth_tearing/Step.h>
#include <diagnostic_msgs/DiagnosticArray.h>
#include <rosgraph_msgs/Clock.h>
#include <std_srvs/Trigger.h>

#include <string>
#include <vector>

#include "child_process.h"
#include "node_client.h"

using cloth_tearing::SimulationStatus;
using rosgraph_msgs::Clock;
using std_srvs::Trigger;

namespace
{

cloth_tearing::Step::Response step(const std::string& node, std::uint32_t steps)
{
  cloth_tearing::Step::Request request;
  request.steps = steps;
  return ask<cloth_tearing::Step>(node + "/step", request);
}

/// The /clock of this test and the cloth that follows it. They live as long as the process: time
/// goes on from test to test.
class Followed
{
public:
  static Followed& instance()
  {
    static Followed followed;
    return followed;
  }

  /// Shows `time` [ms] and waits until the cloth's stamps say so.
  void show(std::int64_t time)
  {
    Clock message;
    message.clock.fromNSec(static_cast<std::uint64_t>(time) * 1000000);
    clock_.publish(message);
    status_.waitFor("the stamp " + std::to_string(time), [&message](const SimulationStatus& s)
                    { return s.header.stamp == message.clock; });
  }

  /// Waits until the cloth has done `step` steps and knows of so many jumps.
  SimulationStatus await(std::uint64_t step, std::uint64_t jumps)
  {
    return status_.waitFor("step " + std::to_string(step) + ", jump " + std::to_string(jumps),
                           [step, jumps](const SimulationStatus& s)
                           { return s.step >= step && s.clock_jumps >= jumps; });
  }

  /// Waits for `count` more messages: several looks at the clock. @return the last of them
  SimulationStatus after(std::size_t count)
  {
    const std::size_t before = status_.all().size();
    std::size_t seen = 0;
    return status_.waitFor("more words", [&seen, before, count](const SimulationStatus&)
                           { return ++seen >= before + count; });
  }

private:
  Followed()
      : clock_(ros::NodeHandle().advertise<Clock>("/clock", 100, true)), status_("/follower/status")
  {
  }

  ros::Publisher clock_;
  Collector<SimulationStatus> status_;
};

}  // namespace

// The first test: nobody has published /clock yet.
TEST(NodeWithoutClock, AnswersAllTheSame)
{
  ASSERT_TRUE(ros::Time::isSimTime());
  ASSERT_TRUE(ros::Time::now().isZero());
  Followed& cloth = Followed::instance();
  const SimulationStatus waiting = cloth.after(3);
  EXPECT_EQ(waiting.step, 0u);
  EXPECT_EQ(waiting.pace, "clock");
  EXPECT_TRUE(waiting.header.stamp.isZero());

  cloth_tearing::Grasp::Request request;
  request.header.frame_id = "nowhere";
  EXPECT_FALSE(ask<cloth_tearing::Grasp>("/follower/grasp", request).success)
      << "it waits for tf, but not for ever";
  EXPECT_TRUE(ask<Trigger>("/follower/pause").success);
  EXPECT_EQ(step("/follower", 4).step, 4u);
  EXPECT_TRUE(ask<Trigger>("/follower/reset").success);
  EXPECT_TRUE(ask<Trigger>("/follower/resume").success);
  EXPECT_EQ(step("/stepped", 5).step, 5u);
  EXPECT_TRUE(ask<Trigger>("/stepped/reset").success);
}

TEST(NodeWithoutClock, IsStartedAnswersAndEndsAtAnyPace)
{
  ASSERT_TRUE(ros::Time::now().isZero());
  for (const char* const name : { "wall", "free", "step", "clock" })
  {
    const std::string pace = name;
    const std::string node = "/timeless_" + pace;
    ChildProcess process({ CLOTH_TEARING_NODE, "__name:=timeless_" + pace, "_pace:=" + pace,
                           "_rectangle/columns:=5", "_rectangle/rows:=5" },
                         60);
    EXPECT_TRUE(ask<Trigger>(node + "/pause").success) << pace;
    const std::uint64_t before = step(node, 0).step;
    EXPECT_EQ(step(node, 7).step, before + 7) << pace;
    EXPECT_TRUE(ask<Trigger>(node + "/reset").success) << pace;
    EXPECT_TRUE(ask<Trigger>(node + "/resume").success) << pace;
    process.signal(SIGINT);
    EXPECT_EQ(process.exitStatus(), 0) << pace;
  }
}

TEST(NodeWithoutClock, SaysOnDiagnosticsThatItWaits)
{
  using diagnostic_msgs::DiagnosticArray;
  ASSERT_TRUE(ros::Time::now().isZero());
  Collector<DiagnosticArray> diagnostics("/diagnostics");

  const auto words = diagnostics.waitFor(
      "the follower's", [](const DiagnosticArray& array)
      { return array.status.at(0).name == "follower: solver" && array.status.size() == 2; });

  EXPECT_EQ(words.status.at(0).message, "waits for a clock to follow");
  EXPECT_EQ(words.status.at(0).level, diagnostic_msgs::DiagnosticStatus::WARN);
  EXPECT_EQ(words.status.at(1).name, "follower: topology");
  EXPECT_EQ(words.status.at(1).message, "whole");
}

TEST(NodeWithClock, FollowsItStepByStep)
{
  Followed& cloth = Followed::instance();
  cloth.show(10000);
  ASSERT_EQ(cloth.after(3).step, 0u) << "here it begins";

  cloth.show(10120);
  cloth.await(120, 0);
  EXPECT_EQ(cloth.after(3).step, 120u);
  cloth.show(10121);
  cloth.await(121, 0);
  const SimulationStatus stopped = cloth.after(3);
  EXPECT_EQ(stopped.step, 121u) << "a clock that stands stops the cloth";
  EXPECT_EQ(stopped.header.stamp, ros::Time(10.121));
  EXPECT_EQ(stopped.state_hash, step("/stepped", 121).state_hash) << "the pace is not in the cloth";
}

TEST(NodeWithClock, IsNotCarriedAwayWhenItJumps)
{
  Followed& cloth = Followed::instance();
  const std::uint64_t begin = cloth.after(1).step;
  cloth.show(800000);
  cloth.await(begin, 1);
  cloth.show(800010);
  cloth.await(begin + 10, 1);
  cloth.show(3000);
  cloth.await(begin + 10, 2);
  cloth.show(3020);
  cloth.await(begin + 30, 2);

  const SimulationStatus status = cloth.after(3);

  EXPECT_EQ(status.step, begin + 30);
  EXPECT_EQ(status.clock_jumps, 2u);
}

TEST(NodeWithClock, StepsOnAsOftenAsABagThatLoopsShowsItTo)
{
  Followed& cloth = Followed::instance();
  ASSERT_TRUE(ask<Trigger>("/follower/reset").success);
  const std::uint64_t jumps = cloth.after(3).clock_jumps;
  std::uint64_t steps = 0;
  for (std::uint64_t round = 1; round <= 5; ++round)
  {
    cloth.show(2000);  // where the bag begins
    cloth.await(steps, jumps + round);
    for (const std::int64_t played : { 1, 20, 21, 60, 100 })
    {
      cloth.show(2000 + played);
    }
    steps += 100;
    cloth.await(steps, jumps + round);
  }

  const SimulationStatus status = cloth.after(3);

  EXPECT_EQ(status.step, 500u);
  EXPECT_EQ(status.clock_jumps, jumps + 5);
  ASSERT_TRUE(ask<Trigger>("/stepped/reset").success);
  EXPECT_EQ(status.state_hash, step("/stepped", 500).state_hash) << "no jump is in the cloth";
}

TEST(NodeThatTellsTheTime, DoesSoExactlyWithItsSteps)
{
  Collector<Clock> told("/told_clock");
  const Clock begin = told.first();
  EXPECT_EQ(begin.clock.toNSec(), 1u) << "valid from the beginning";

  step("/teller", 219);
  ASSERT_TRUE(ask<Trigger>("/teller/reset").success);
  step("/teller", 41);

  std::vector<std::uint64_t> expected = { 1 };
  for (std::uint64_t tick = 1; tick <= 13; ++tick)
  {
    expected.push_back(tick * 20000000);  // 50 Hz, right through the reset
  }
  told.waitFor("the last tick", [&expected](const Clock& message)
               { return message.clock.toNSec() == expected.back(); });
  std::vector<std::uint64_t> times;
  for (const Clock& message : told.all())
  {
    times.push_back(message.clock.toNSec());
  }
  EXPECT_EQ(times, expected);
  Collector<Clock> late("/told_clock");
  EXPECT_EQ(late.first().clock.toNSec(), expected.back()) << "for those who come later";
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "time_rostest");
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
