// Claims of thesis 4.1: which balls tear the cloth and which slide off it.
#include "cloth_tearing/experiments/ball_experiment.h"

#include <gtest/gtest.h>

#include "cloth_tearing/experiments/thesis_world.h"
#include "scenes.h"

namespace cloth
{
namespace
{

struct Cloths
{
  int resolution;
  RectanglePattern pattern;
  SolverKind solver;
  bool lines = false;
  double time_step = 0.001;  // [s]
};

std::string clothName(const ::testing::TestParamInfo<Cloths>& info)
{
  static const char* const PATTERNS[] = { "OneDiagonal", "Alternating", "Irregular" };
  return PATTERNS[static_cast<int>(info.param.pattern)] + nameOf(info.param.solver) +
         std::to_string(info.param.resolution) + (info.param.lines ? "Lines" : "");
}

Setting settingOf(const Cloths& cloth)
{
  Setting setting;
  setting.resolution = cloth.resolution;
  setting.pattern = cloth.pattern;
  setting.solver = cloth.solver;
  setting.lines = cloth.lines;
  setting.time_step = cloth.time_step;
  return setting;
}

class Experiments : public ::testing::TestWithParam<Cloths>
{
};

INSTANTIATE_TEST_SUITE_P(
    Balls, Experiments,
    ::testing::Values(Cloths{ 20, RectanglePattern::ONE_DIAGONAL, SolverKind::XPBD },
                      Cloths{ 30, RectanglePattern::ONE_DIAGONAL, SolverKind::XPBD },
                      Cloths{ 30, RectanglePattern::ALTERNATING, SolverKind::XPBD },
                      Cloths{ 30, RectanglePattern::IRREGULAR, SolverKind::XPBD },
                      Cloths{ 40, RectanglePattern::ONE_DIAGONAL, SolverKind::XPBD },
                      Cloths{ 40, RectanglePattern::ALTERNATING, SolverKind::XPBD },
                      Cloths{ 40, RectanglePattern::IRREGULAR, SolverKind::XPBD },
                      Cloths{ 30, RectanglePattern::ONE_DIAGONAL, SolverKind::FORCE_SPRINGS },
                      Cloths{ 30, RectanglePattern::ALTERNATING, SolverKind::FORCE_SPRINGS },
                      Cloths{ 30, RectanglePattern::IRREGULAR, SolverKind::FORCE_SPRINGS },
                      Cloths{ 40, RectanglePattern::ALTERNATING, SolverKind::FORCE_SPRINGS },
                      Cloths{ 30, RectanglePattern::ONE_DIAGONAL, SolverKind::XPBD, true, 0.002 },
                      Cloths{ 30, RectanglePattern::ALTERNATING, SolverKind::XPBD, true, 0.002 },
                      Cloths{ 30, RectanglePattern::IRREGULAR, SolverKind::XPBD, true, 0.002 }),
    clothName);

TEST_P(Experiments, EndAsInTheThesis)
{
  const Simulation hung = hungCloth(settingOf(GetParam()));
  for (const BallThrow& thrown : THESIS_THROWS)
  {
    Simulation simulation = hung;

    const BallOutcome outcome = throwBall(simulation, thrown);

    EXPECT_TRUE(outcome.agrees(thrown)) << thrown.name << ": " << outcome.total() << " tears, "
                                        << (outcome.slid ? "slid" : "not slid");
    EXPECT_EQ(outcome.slid, !thrown.tears) << thrown.name;
    EXPECT_EQ(outcome.torn_length > 0.0, thrown.tears) << thrown.name;
    EXPECT_TRUE(isSound(simulation.cloth().mesh)) << thrown.name;
  }
}

class Meshes : public ::testing::TestWithParam<Cloths>
{
};

INSTANTIATE_TEST_SUITE_P(
    Balls, Meshes,
    ::testing::Values(Cloths{ 30, RectanglePattern::ONE_DIAGONAL, SolverKind::XPBD },
                      Cloths{ 30, RectanglePattern::ALTERNATING, SolverKind::XPBD },
                      Cloths{ 30, RectanglePattern::IRREGULAR, SolverKind::XPBD }),
    clothName);

/// At 30 a side the irregular mesh may lose what the third ball would hit: 6 of 16 seeds do.
class ThreeBalls : public ::testing::TestWithParam<Cloths>
{
};

INSTANTIATE_TEST_SUITE_P(
    Balls, ThreeBalls,
    ::testing::Values(Cloths{ 30, RectanglePattern::ONE_DIAGONAL, SolverKind::XPBD },
                      Cloths{ 30, RectanglePattern::ALTERNATING, SolverKind::XPBD },
                      Cloths{ 40, RectanglePattern::IRREGULAR, SolverKind::XPBD }),
    clothName);

TEST_P(ThreeBalls, TearTheClothOneAfterTheOther)  // figure 4.1
{
  Simulation simulation = hungCloth(settingOf(GetParam()));

  const std::vector<BallOutcome> outcomes =
      throwBalls(simulation, { THREE_BALLS.begin(), THREE_BALLS.end() }, THREE_BALLS_INTERVAL);

  for (std::size_t i = 0; i < THREE_BALLS.size(); ++i)
  {
    EXPECT_TRUE(outcomes[i].toreThrough()) << THREE_BALLS[i].name << ": " << outcomes[i].total();
  }
}

/// Rest area of what has not fallen, of a cloth that hangs from z = 0 [m^2].
double hangingArea(const Cloth& cloth)
{
  double area = 0.0;
  for (int t = 0; t < cloth.mesh.triangleCount(); ++t)
  {
    const int corner = cloth.mesh.triangle({ t }).particles[0].index;
    area += cloth.state.position[corner].z() > -10.0 ? cloth.rest.area[t] : 0.0;
  }
  return area;
}

TEST_P(Meshes, KeepHangingWithTheHoleOfASmallBall)
{
  Simulation simulation = hungCloth(settingOf(GetParam()));

  throwBall(simulation, THESIS_THROWS[0]);

  EXPECT_GT(hangingArea(simulation.cloth()), 0.95 * 6.0 * 8.0);
}

TEST_P(Meshes, LeaveAWindowForOneThreshold)
{
  const Simulation hung = hungCloth(settingOf(GetParam()));
  const double threshold = hung.params().tearing.tear_strain;
  for (const BallThrow& thrown : THESIS_THROWS)
  {
    Simulation simulation = hung;

    const BallPeaks peaks = peaksOf(simulation, thrown);

    if (thrown.tears)
    {
      EXPECT_GT(peaks.patch, 1.15 * threshold) << thrown.name;
    }
    else
    {
      EXPECT_LT(peaks.patch, 0.85 * threshold) << thrown.name;
    }
    EXPECT_LE(peaks.patch, peaks.local_hem) << "a patch never reads more than its spring";
    EXPECT_LE(peaks.local_hem, peaks.local) << "a hem only takes away";
    EXPECT_EQ(simulation.revision(), 0u) << "tearing is off";
  }
}

TEST(NonUniformCloth, EndsAsInTheThesisWithHalfTheParticles)
{
  Setting setting = settingOf({ 28, RectanglePattern::ALTERNATING, SolverKind::XPBD });
  setting.grading = 2.0;  // as fine in the middle as 40 particles along a side
  const Simulation hung = hungCloth(setting);
  for (const BallThrow& thrown : THESIS_THROWS)
  {
    Simulation simulation = hung;

    EXPECT_TRUE(throwBall(simulation, thrown).agrees(thrown)) << thrown.name;
  }
}

TEST(Balls, NeedMoreSpeedToTearTheLargerTheyAre)
{
  const Simulation hung =
      hungCloth(settingOf({ 30, RectanglePattern::ALTERNATING, SolverKind::XPBD }));
  const auto tears = [&](double radius, double speed)
  {
    Simulation simulation = hung;
    return throwBall(simulation, { "", radius, speed, 0.42, true }).toreThrough();
  };

  EXPECT_TRUE(tears(0.3, 5.0));
  EXPECT_FALSE(tears(1.4, 5.0));
  EXPECT_TRUE(tears(1.4, 10.0));
  EXPECT_FALSE(tears(2.4, 5.0));
}

}  // namespace
}  // namespace cloth
