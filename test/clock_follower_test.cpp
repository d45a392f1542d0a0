// Claims of following a clock: exact counts, whatever the clock does.
#include "cloth_tearing/core/clock_follower.h"

#include <gtest/gtest.h>

#include <vector>

namespace cloth
{
namespace
{

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

int stepAllDue(ClockFollower& follower)
{
  int steps = 0;
  for (; follower.stepDue(); ++steps)
  {
    follower.stepped();
  }
  return steps;
}

TEST(FollowedClock, MakesOneStepDuePerTimeStepHoweverItTicks)
{
  for (const nanoseconds tick : { nanoseconds(milliseconds(1)), nanoseconds(microseconds(300)),
                                  nanoseconds(milliseconds(250)), nanoseconds(333333300) })
  {
    ClockFollower follower(0.001);
    const nanoseconds start = hours(500000);  // as much as since 1970
    nanoseconds now = start;
    int steps = stepAllDue(follower);
    for (; now - start < seconds(20); now += tick)
    {
      EXPECT_EQ(follower.look(now), "");
      steps += stepAllDue(follower);
      ASSERT_EQ(steps, (now - start) / milliseconds(1)) << "after ticks of " << tick.count();
    }
  }
}

TEST(FollowedClock, CountsTimeStepsThatAreNoWholeNanoseconds)
{
  ClockFollower follower(1.0 / 3000.0);
  int steps = 0;
  for (int i = 0; i <= 3000; ++i)
  {
    follower.look(nanoseconds(i * 1000000000LL / 3000));  // rounded down
    steps += stepAllDue(follower);
    ASSERT_EQ(steps, i);
  }
}

TEST(FollowedClock, MakesNothingDueWhileItIsNotThereOrStands)
{
  ClockFollower follower(0.001);
  EXPECT_EQ(follower.look({}), "");
  EXPECT_FALSE(follower.following());
  follower.look(seconds(7));
  EXPECT_TRUE(follower.following());
  EXPECT_EQ(stepAllDue(follower), 0);
  follower.look(seconds(7));
  follower.look({});
  EXPECT_EQ(stepAllDue(follower), 0);
  follower.look(seconds(7) + milliseconds(2));
  EXPECT_EQ(stepAllDue(follower), 2);
}

TEST(FollowedClock, MayJumpAndIsFollowedFromThere)
{
  ClockFollower follower(0.001);
  follower.look(seconds(100));
  follower.look(seconds(100) + milliseconds(5));

  EXPECT_EQ(follower.look(seconds(90)), "the clock jumped by -10.005 s: skipped");
  EXPECT_EQ(stepAllDue(follower), 5) << "what was due before still is";
  EXPECT_EQ(follower.look(seconds(91)), "") << "as far as may be made up for";
  EXPECT_EQ(stepAllDue(follower), 1000);
  EXPECT_EQ(follower.look(seconds(92) + nanoseconds(1)), "the clock jumped by 1 s: skipped");
  EXPECT_EQ(stepAllDue(follower), 0);
}

TEST(FollowedClock, IsNotMadeUpForWithoutBound)
{
  ClockFollower follower(0.001);
  for (int i = 0; i <= 10; ++i)
  {
    EXPECT_EQ(follower.look(milliseconds(700 * i)), "");
  }
  EXPECT_EQ(stepAllDue(follower), 1000);
  follower.look(milliseconds(7003));
  EXPECT_EQ(stepAllDue(follower), 3);
}

TEST(FollowedClock, SaysWhatIsNotMadeUpFor)
{
  ClockFollower follower(0.001);
  follower.look(seconds(0));
  follower.look(milliseconds(700));
  EXPECT_EQ(follower.lost(), 0.0);
  follower.look(milliseconds(1400));
  EXPECT_NEAR(follower.lost(), 0.4, 1e-8);
  follower.look(milliseconds(1450));
  EXPECT_NEAR(follower.lost(), 0.05, 1e-8);
  follower.look({});
  EXPECT_EQ(follower.lost(), 0.0) << "nothing more";
  EXPECT_EQ(stepAllDue(follower), 1000);
  follower.look(seconds(90));
  EXPECT_EQ(follower.lost(), 0.0) << "a jump is no loss";
}

TEST(LostTime, IsToldEveryFiveSecondsAtMost)
{
  LostTime lost;
  const LostTime::Clock::time_point start;
  EXPECT_EQ(lost.tell(start), "");
  lost.add(0.25);
  EXPECT_EQ(lost.tell(start), "fell behind the clock by 0.25 s: not made up for");
  lost.add(0.5);
  lost.add(1.0);
  EXPECT_EQ(lost.tell(start + milliseconds(4999)), "");
  EXPECT_EQ(lost.tell(start + seconds(5)), "fell behind the clock by 1.5 s: not made up for");
  EXPECT_EQ(lost.tell(start + seconds(20)), "") << "nothing more";
  EXPECT_EQ(lost.total(), 1.75);
}

}  // namespace
}  // namespace cloth
