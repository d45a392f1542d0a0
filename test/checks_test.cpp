// Claims of the sentences in which values are refused.
#include "cloth_tearing/core/checks.h"

#include <gtest/gtest.h>

#include <clocale>

#include "cloth_tearing/core/refusal.h"

namespace cloth
{
namespace
{

using Sentences = std::vector<std::string>;

constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
constexpr double INFINITE = std::numeric_limits<double>::infinity();

Sentences judged(double value, const Range& range)
{
  Sentences found;
  check(found, "size [m]", value, range);
  return found;
}

TEST(Checks, PassWhatIsWithinTheRangeUpToItsLimits)
{
  EXPECT_TRUE(judged(0.0, Range::between(0.0, 1.0)).empty());
  EXPECT_TRUE(judged(1.0, Range::between(0.0, 1.0)).empty());
  EXPECT_TRUE(judged(1.0, Range::aboveUpTo(0.0, 1.0)).empty());
  EXPECT_TRUE(judged(1e-300, Range::above(0.0)).empty());
  EXPECT_TRUE(judged(-5.0, Range::atLeast(-5.0)).empty());
  EXPECT_TRUE(judged(-1e300, Range()).empty());
}

TEST(Checks, NameFieldValueAndLimit)
{
  EXPECT_EQ(judged(1.5, Range::between(0.0, 1.0)),
            Sentences{ "size [m] is 1.5, must be at least 0 and at most 1" });
  EXPECT_EQ(judged(0.0, Range::aboveUpTo(0.0, 1.0)),
            Sentences{ "size [m] is 0, must be greater than 0 and at most 1" });
  EXPECT_EQ(judged(0.0, Range::above(0.0)), Sentences{ "size [m] is 0, must be greater than 0" });
  EXPECT_EQ(judged(-6.0, Range::atLeast(-5.0)), Sentences{ "size [m] is -6, must be at least -5" });
}

TEST(Checks, TellAValueFromTheLimitThatItMisses)
{
  EXPECT_EQ(judged(1000001.0, Range::between(0.0, 1000000.0)),
            Sentences{ "size [m] is 1000001, must be at least 0 and at most 1e+06" });
  EXPECT_EQ(judged(1.0 + 1.0 / 1048576, Range::between(0.0, 1.0)),
            Sentences{ "size [m] is 1.0000009536743164, must be at least 0 and at most 1" });
}

TEST(Checks, LetNothingPassThatIsNotFinite)
{
  for (double value : { NOT_A_NUMBER, INFINITE, -INFINITE })
  {
    for (const Range& range :
         { Range(), Range::above(0.0), Range::atLeast(0.0), Range::between(-1.0, 1.0) })
    {
      EXPECT_EQ(judged(value, range).size(), 1u) << value;
    }
  }
  for (double value : { NOT_A_NUMBER, -NOT_A_NUMBER })
  {
    EXPECT_EQ(judged(value, Range()), Sentences{ "size [m] is nan, must be finite" });
  }
}

TEST(Checks, NameTheCoordinateThatIsWrong)
{
  Sentences found;
  check(found, "place [m]", Vec3d(1, -3, NOT_A_NUMBER), 2.0);
  EXPECT_EQ(found, (Sentences{ "place [m].y is -3, must be at least -2 and at most 2",
                               "place [m].z is nan, must be at least -2 and at most 2" }));
}

TEST(Checks, WantUnitQuaternions)
{
  Sentences found;
  check(found, "pose", Quatd(0, 0, 1, 0));
  check(found, "pose", Quatd(1.0005, 0, 0, 0));
  EXPECT_TRUE(found.empty());
  check(found, "pose", Quatd(0, 0, 0, 0));
  check(found, "pose", Quatd(1, 0, NOT_A_NUMBER, 0));
  EXPECT_EQ(found, (Sentences{ "pose has length 0, must be a unit quaternion",
                               "pose has length nan, must be a unit quaternion" }));
}

TEST(Checks, WriteNumbersShortAndWithAPoint)
{
  EXPECT_EQ(text(0.1), "0.1");
  EXPECT_EQ(text(1e-7), "1e-07");
  EXPECT_EQ(text(1234567.0), "1.23457e+06");
  EXPECT_EQ(text(-2.0), "-2");
}

TEST(Refusals, CollectAllProblemsOneALine)
{
  EXPECT_NO_THROW(refuseIf({}));
  try
  {
    refuseIf({ "one", "two" });
    FAIL() << "must be refused";
  }
  catch (const Refusal& refusal)
  {
    EXPECT_STREQ(refusal.what(), "one\ntwo");
  }
}

TEST(Refusals, TellTheFirstTwentyProblemsAndHowManyMore)
{
  try
  {
    refuseIf(Sentences(23, "one"));
    FAIL() << "must be refused";
  }
  catch (const Refusal& refusal)
  {
    std::string expected;
    for (int i = 0; i < 20; ++i)
    {
      expected += "one\n";
    }
    EXPECT_EQ(refusal.what(), expected + "and 3 more");
  }
}

}  // namespace
}  // namespace cloth
