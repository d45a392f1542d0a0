// Many at once: no tear and no call of a service is lost.
#include <cloth_tearing/GetTearEvents.h>
#include <cloth_tearing/Step.h>
#include <cloth_tearing/TearEvents.h>
#include <ros/callback_queue.h>

#include <numeric>

#include "../src/bench/service_storm.h"
#include "node_client.h"

using cloth_tearing::GetTearEvents;
using cloth_tearing::Step;
using cloth_tearing::TearEvent;
using cloth_tearing::TearEvents;

namespace
{

constexpr std::uint64_t BURST = 5000;

/// Steps one by one until so many tears were made. @return how many steps that took
int tear(const std::string& node, std::uint64_t tears)
{
  std::uint64_t newest = 0;
  int steps = 0;
  for (; newest < tears && steps < 200; ++steps)
  {
    Step::Request one;
    one.steps = 1;
    EXPECT_TRUE(ask<Step>(node + "/step", one).success);
    GetTearEvents::Request none;
    none.since = ~std::uint64_t{ 0 };
    newest = ask<GetTearEvents>(node + "/get_tear_events", none).newest;
  }
  EXPECT_GE(newest, tears) << "after " << steps << " steps";
  return steps;
}

GetTearEvents::Response eventsSince(const std::string& node, std::uint64_t since,
                                    std::uint32_t max_count)
{
  GetTearEvents::Request request;
  request.since = since;
  request.max_count = max_count;
  return ask<GetTearEvents>(node + "/get_tear_events", request);
}

std::vector<std::uint64_t> sequences(const std::vector<TearEvent>& events)
{
  std::vector<std::uint64_t> numbers;
  for (const TearEvent& event : events)
  {
    numbers.push_back(event.sequence);
  }
  return numbers;
}

std::vector<std::uint64_t> fromTo(std::uint64_t first, std::uint64_t last)
{
  std::vector<std::uint64_t> numbers(last + 1 - first);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

/// Listens to a topic, but takes only what it is told to.
class SlowListener
{
public:
  explicit SlowListener(const std::string& topic)
  {
    handle_.setCallbackQueue(&queue_);
    subscriber_ = handle_.subscribe(topic, 1, &SlowListener::take, this);
    EXPECT_TRUE(isSoon([this] { return subscriber_.getNumPublishers() > 0; }));
  }

  /// The messages that its queue of one has kept.
  std::size_t heard()
  {
    queue_.callAvailable();
    return heard_;
  }

private:
  void take(const TearEvents&) { ++heard_; }

  std::size_t heard_ = 0;
  ros::CallbackQueue queue_;
  ros::NodeHandle handle_;
  ros::Subscriber subscriber_;
};

}  // namespace

TEST(TearBurst, IsInTheLogWithoutAGapHoweverSlowTheTopicsListenerIs)
{
  SlowListener listener("/tissue/tear_events");

  const int steps = tear("/tissue", BURST);

  const GetTearEvents::Response all = eventsSince("/tissue", 0, 0);
  EXPECT_EQ(all.oldest, 1u);
  EXPECT_GE(all.newest, BURST);
  EXPECT_EQ(sequences(all.events), fromTo(1, all.newest));
  EXPECT_LT(listener.heard(), static_cast<std::size_t>(steps)) << "it was not slow";
  std::printf("burst: %lu tears in %d steps\n", static_cast<unsigned long>(all.newest), steps);
}

TEST(TearBurst, IsReadInPagesWithoutAGap)
{
  const std::uint64_t newest = eventsSince("/tissue", 0, 1).newest;
  ASSERT_GE(newest, BURST) << "the test before tore it";

  std::vector<std::uint64_t> read;
  std::uint64_t next = 1;
  while (next <= newest)
  {
    const std::vector<std::uint64_t> page = sequences(eventsSince("/tissue", next, 999).events);
    ASSERT_FALSE(page.empty());
    EXPECT_LE(page.size(), 999u);
    read.insert(read.end(), page.begin(), page.end());
    next = page.back() + 1;
  }
  EXPECT_EQ(read, fromTo(1, newest));
}

TEST(TearBurst, LeavesTheNewestInALogThatIsTooShortWhichTellsTheOldest)
{
  tear("/forgetful", 500);

  const GetTearEvents::Response all = eventsSince("/forgetful", 0, 0);
  EXPECT_EQ(all.newest - all.oldest + 1, 100u);
  EXPECT_EQ(sequences(all.events), fromTo(all.oldest, all.newest));
  EXPECT_EQ(sequences(eventsSince("/forgetful", 1, 10).events), fromTo(all.oldest, all.oldest + 9))
      << "what was dropped is skipped, and that shows by the number";
}

TEST(ServiceStorm, GetsAnAnswerToEachOfTwoThousandCallsOfAHundredClients)
{
  ASSERT_TRUE(ros::service::waitForService("/cloth/step", ros::Duration(PATIENCE)));

  const StormReport report = serviceStorm("/cloth", 100, 20);

  EXPECT_EQ(report.calls, 2000);
  EXPECT_EQ(report.answered, 2000);
  EXPECT_GT(report.served, 0);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "burst_rostest");
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
