// Claims of thesis 4.2: the crack opens across the pull, the flap hangs along it.
#include "cloth_tearing/experiments/direction_experiment.h"

#include <gtest/gtest.h>

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

TEST_P(Direction, TheCrackOpensAcrossThePull)
{
  const auto runs = static_cast<double>(GetParam().seeds.size());
  double sum = 0.0;
  for (int i = 0; i < 8; ++i)
  {
    double of_direction = 0.0;
    for (int seed : GetParam().seeds)
    {
      Simulation simulation = cloth(seed, framedCloth);
      DirectionPull pull = framedPull(45.0 * i, shiftOf(seed));
      pull.way = 0.6;

      const DirectionOutcome outcome = pullDisc(simulation, pull);

      ASSERT_TRUE(outcome.crack_angle.has_value()) << pull.angle << ", seed " << seed;
      of_direction += *outcome.crack_angle / runs;
      EXPECT_TRUE(isSound(simulation.cloth().mesh));
    }
    EXPECT_GE(of_direction, 45.0) << "pulled at " << 45 * i;
    sum += of_direction / 8.0;
  }
  EXPECT_GE(sum, 65.0);
}

TEST_P(Direction, TheFlapHangsAlongADownwardPull)
{
  double sum = 0.0;
  for (int seed : GetParam().seeds)
  {
    Simulation simulation = cloth(seed, hungCloth);

    const DirectionOutcome outcome = pullDisc(simulation, downwardPull(shiftOf(seed)));

    ASSERT_TRUE(outcome.flap_angle.has_value()) << "seed " << seed;
    sum += *outcome.flap_angle;
    EXPECT_GE(outcome.pieces, 2) << "the flap has come off";
  }
  EXPECT_LE(sum / static_cast<double>(GetParam().seeds.size()), 20.0);
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

  const std::vector<TornEdge> edges = tornEdges(simulation.cloth(), Vec2d(6.0, 8.0));

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
