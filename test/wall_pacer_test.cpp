// Claims of the pacer: so many steps in so much time, whatever the speed and when it changes.
#include "cloth_tearing/core/wall_pacer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cloth
{
namespace
{

using Clock = WallPacer::Clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr double TIME_STEP = 0.001;  // [s]

/// A pacer with a clock of its own, which is looked at every few milliseconds.
class Pacing : public ::testing::Test
{
protected:
  /// @return steps that were done meanwhile
  int runFor(milliseconds time, milliseconds slice = milliseconds(4))
  {
    int steps = 0;
    for (const Clock::time_point end = now_ + time; now_ < end; now_ += slice)
    {
      pacer_.look(now_);
      for (; pacer_.stepDue(); ++steps)
      {
        pacer_.stepped(TIME_STEP);
      }
    }
    return steps;
  }

  Clock::time_point now_;
  WallPacer pacer_{ 1.0, now_ };
};

TEST_F(Pacing, StepsAsOftenAsItsSpeedSays)
{
  for (const double speed : { 0.001, 0.02, 1.0, 2.0, 300.0 })
  {
    pacer_.setSpeed(speed, now_);
    const double expected = 10.0 * speed / TIME_STEP;
    EXPECT_NEAR(runFor(seconds(10)), expected, 1.0 + 0.001 * expected) << speed;
  }
}

TEST_F(Pacing, TellsWhenTheNextStepIsDue)
{
  pacer_.setSpeed(0.01, now_);
  EXPECT_TRUE(pacer_.stepDue());
  pacer_.stepped(TIME_STEP);
  EXPECT_FALSE(pacer_.stepDue());
  EXPECT_EQ(pacer_.due() - now_, milliseconds(100));
}

TEST_F(Pacing, DoesNotMakeUpForMuchLostTime)
{
  runFor(seconds(1));
  now_ += seconds(5);
  EXPECT_LE(runFor(milliseconds(4)), 102);
  EXPECT_LE(runFor(milliseconds(4)), 5);
}

TEST_F(Pacing, ChangesItsSpeedWithoutAJump)
{
  runFor(seconds(1));
  now_ += seconds(1);  // nobody looked
  pacer_.setSpeed(1000.0, now_);
  EXPECT_LE(runFor(milliseconds(4)), 1) << "what passed is not measured by the new speed";
  now_ += seconds(1);
  pacer_.look(now_);  // a machine that cannot keep up
  pacer_.setSpeed(0.1, now_);
  EXPECT_LE(runFor(milliseconds(4)), 1) << "what the old speed left to do is not done";
}

TEST_F(Pacing, DoesNotWaitOutAStepOfTheOldSpeed)
{
  pacer_.setSpeed(0.001, now_);
  runFor(milliseconds(4));
  EXPECT_EQ(pacer_.due() - now_, milliseconds(996));
  pacer_.setSpeed(1.0, now_);
  EXPECT_LE(pacer_.due() - now_, milliseconds(1));
}

TEST_F(Pacing, BeginsAnewWithoutDebts)
{
  runFor(seconds(1));
  now_ += seconds(5);
  pacer_.begin(now_);
  EXPECT_EQ(runFor(milliseconds(4)), 1);
}

TEST(Speed, IsRefusedBeyondItsLimits)
{
  for (const double speed : { 0.0, -1.0, 0.0009, 1001.0, std::nan("") })
  {
    std::vector<std::string> found;
    checkSpeed(found, speed);
    ASSERT_EQ(found.size(), 1u) << speed;
    EXPECT_EQ(found[0].find("speed is "), 0u) << found[0];
  }
  std::vector<std::string> found;
  checkSpeed(found, 0.001);
  checkSpeed(found, 1000.0);
  EXPECT_TRUE(found.empty());
}

}  // namespace
}  // namespace cloth
