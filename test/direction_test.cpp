// Claims of thesis 4.2: the crack opens across the pull, and goes on in its direction.
#include "cloth_tearing/experiments/direction_experiment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "cloth_tearing/experiments/torn_edges.h"
#include "scenes.h"

namespace cloth
{
namespace
{

struct Cloths
{
  RectanglePattern pattern;
  std::vector<int> seeds;
};

std::string patternName(const ::testing::TestParamInfo<Cloths>& info)
{
  return info.param.pattern == RectanglePattern::ALTERNATING ? "Alternating" : "Irregular";
}

/// Which makes new cloth only where a seed changes it.
class Direction : public ::testing::TestWithParam<Cloths>
{
protected:
  Simulation cloth(int seed, Simulation (*make)(const Setting&))
  {
    Setting setting;
    setting.pattern = GetParam().pattern;
    setting.seed = static_cast<std::uint64_t>(seed);
    const int key = setting.pattern == RectanglePattern::IRREGULAR ? seed : 0;
    auto found = made_.find(key);
    if (found == made_.end())
    {
      found = made_.emplace(key, make(setting)).first;
    }
    return found->second;
  }

private:
  std::map<int, Simulation> made_;
};

INSTANTIATE_TEST_SUITE_P(
    Meshes, Direction,
    ::testing::Values(Cloths{ RectanglePattern::ALTERNATING, { 1, 2, 3, 4, 5 } },
                      Cloths{ RectanglePattern::IRREGULAR, { 1, 2, 3, 4, 5 } }),
    patternName);

TEST_P(Direction, TheCrackOpensAcrossThePullAndGoesOnAlongIt)
{
  const auto runs = static_cast<double>(GetParam().seeds.size());
  double across = 0.0;
  double course = 0.0;
  for (int i = 0; i < 8; ++i)
  {
    double of_direction = 0.0;
    for (int seed : GetParam().seeds)
    {
      Simulation simulation = cloth(seed, framedCloth);
      const DirectionPull pull = framedPull(45.0 * i, shiftOf(seed));

      const DirectionOutcome outcome = pullDisc(simulation, pull);

      ASSERT_TRUE(outcome.crack.has_value()) << pull.angle << ", seed " << seed;
      ASSERT_TRUE(outcome.course.has_value()) << pull.angle << ", seed " << seed;
      of_direction += outcome.crack->line / runs;
      course += outcome.course->angle() / (8.0 * runs);
      EXPECT_GT(outcome.course->along, 0.0) << pull.angle << ", seed " << seed;
      EXPECT_TRUE(isSound(simulation.cloth().mesh));
    }
    EXPECT_GE(of_direction, 45.0) << "pulled at " << 45 * i;
    across += of_direction / 8.0;
  }
  EXPECT_GE(across, 65.0);
  EXPECT_LE(course, 30.0) << "by chance it would be 90";
}

/// The control: what a pull has no direction for, no tear may follow.
TEST_P(Direction, APullStraightOutDoesNotSendTheTearAnyway)
{
  constexpr int SEEDS = 10;  // the way of one tear is chance
  double along = 0.0;
  double angle = 0.0;
  for (int seed = 1; seed <= SEEDS; ++seed)
  {
    Simulation simulation = cloth(seed, framedCloth);

    const DirectionOutcome outcome = pullDisc(simulation, outwardPull(shiftOf(seed)));

    ASSERT_TRUE(outcome.course.has_value()) << "seed " << seed;
    along += outcome.course->along / SEEDS;
    angle += outcome.course->angle() / SEEDS;
  }
  EXPECT_LT(std::abs(along), 0.4) << "of the first direction; pulled there it is 0.6 m and more";
  EXPECT_GT(angle, 60.0);
}

/// Why nothing is claimed of the flap in the frame.
TEST_P(Direction, UntornClothTrailsBehindTheGripperAsWell)
{
  Simulation simulation = withoutTearing(cloth(1, framedCloth));

  const DirectionOutcome outcome = pullDisc(simulation, framedPull(270.0, shiftOf(1)));

  EXPECT_EQ(outcome.tears, 0);
  EXPECT_FALSE(outcome.crack.has_value());
  EXPECT_FALSE(outcome.course.has_value());
  EXPECT_LT(outcome.flap_angle.value_or(180.0), 20.0);
  EXPECT_LT(outcome.last_flap_angle.value_or(180.0), 20.0);
}

/// Nor of a cloth that hangs: a downward pull tears its lower part off, which then hangs below.
TEST_P(Direction, WhatADownwardPullTearsOffHangsBelowTheGripper)
{
  for (int seed : GetParam().seeds)
  {
    Simulation simulation = cloth(seed, hungCloth);

    const DirectionOutcome outcome = pullDisc(simulation, downwardPull(shiftOf(seed)));

    EXPECT_TRUE(outcome.loose) << "seed " << seed;
    EXPECT_GT(outcome.last_flap_angle.value_or(0.0), 135.0) << "180 is straight ahead";
  }
}

TEST(LineAngleTo, SeesTheLineOfACrackAndNotItsTeeth)
{
  std::vector<TornEdge> saw;
  for (int i = 0; i < 10; ++i)
  {
    const double x = i;
    saw.push_back({ Vec2d(x, i % 2), Vec2d(x + 1.0, (i + 1) % 2) });
  }

  EXPECT_NEAR(lineAngleTo(saw, Vec2d(0.0, 2.0)), 90.0, 2.0);
  EXPECT_NEAR(meanAngleTo(saw, Vec2d(0.0, 2.0)), 45.0, 1e-9);
  EXPECT_NEAR(lineAngleTo({ { Vec2d(1.0, 1.0), Vec2d(3.0, 3.0) } }, Vec2d(-1.0, 0.0)), 45.0, 1e-9);
  EXPECT_THROW(lineAngleTo({}, Vec2d(0.0, 1.0)), std::invalid_argument);
}

TEST(TearCourse, HasASign)
{
  EXPECT_NEAR((TearCourse{ 2.0, 0.0 }).angle(), 0.0, 1e-9);
  EXPECT_NEAR((TearCourse{ 0.0, -1.0 }).angle(), 90.0, 1e-9);
  EXPECT_NEAR((TearCourse{ -1.0, 0.0 }).angle(), 180.0, 1e-9);
}

TEST(MeanAngleTo, WeighsEdgesByTheirLength)
{
  const TornEdge across{ Vec2d(0.0, 0.0), Vec2d(3.0, 0.0) };
  const TornEdge along{ Vec2d(0.0, 0.0), Vec2d(0.0, -1.0) };

  EXPECT_NEAR(meanAngleTo({ across, along }, Vec2d(0.0, 2.0)), 67.5, 1e-9);
  EXPECT_THROW(meanAngleTo({}, Vec2d(0.0, 1.0)), std::invalid_argument);
}

TEST(TornEdges, LieWhereTheSheetWasWhole)
{
  Setting setting;
  Simulation simulation = framedCloth(setting);
  DirectionPull pull = framedPull(0.0, Vec2d::Zero());
  pull.way = 0.6;
  pullDisc(simulation, pull);

  const std::vector<TornEdge> edges = tornEdges(simulation.cloth(), thesisSheetSize());

  double length = 0.0;
  for (const TornEdge& edge : edges)
  {
    length += edge.length();
    EXPECT_LT((edge.start - Vec2d(3.0, 4.0)).norm(), 3.0) << edge.start.transpose();
  }
  EXPECT_GT(length, 2.0);
  EXPECT_NEAR(length, tornLength(simulation.cloth()), 0.02 * length)
      << "halves keep their places; a middle spring is as long as the median";
}

}  // namespace
}  // namespace cloth
