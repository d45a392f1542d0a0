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
};

std::string clothName(const ::testing::TestParamInfo<Cloths>& info)
{
  static const char* const PATTERNS[] = { "OneDiagonal", "Alternating", "Irregular" };
  return PATTERNS[static_cast<int>(info.param.pattern)] + nameOf(info.param.solver) +
         std::to_string(info.param.resolution);
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
                      Cloths{ 30, RectanglePattern::ONE_DIAGONAL, SolverKind::FORCE_SPRINGS },
                      Cloths{ 30, RectanglePattern::ALTERNATING, SolverKind::FORCE_SPRINGS }),
    clothName);

TEST_P(Experiments, EndAsInTheThesis)
{
  const Cloths& cloth = GetParam();
  Setting setting;
  setting.resolution = cloth.resolution;
  setting.pattern = cloth.pattern;
  setting.solver = cloth.solver;
  const Simulation hung = hungCloth(setting);
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

}  // namespace
}  // namespace cloth
