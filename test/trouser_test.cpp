// Claims of thesis 4.2, the trouser pull: the tear runs on along the cut, and what it takes.
#include "cloth_tearing/experiments/trouser_experiment.h"

#include <gtest/gtest.h>

#include <tuple>

#include "scenes.h"

namespace cloth
{
namespace
{

/// A mesh, and particles a side.
class Trousers : public ::testing::TestWithParam<std::tuple<RectanglePattern, int>>
{
};

std::string meshName(const ::testing::TestParamInfo<Trousers::ParamType>& info)
{
  static const char* const NAMES[] = { "OneDiagonal", "Alternating", "Irregular" };
  const auto [pattern, resolution] = info.param;
  return NAMES[static_cast<int>(pattern)] + std::to_string(resolution);
}

INSTANTIATE_TEST_SUITE_P(Meshes, Trousers,
                         ::testing::Combine(::testing::Values(RectanglePattern::ONE_DIAGONAL,
                                                              RectanglePattern::ALTERNATING,
                                                              RectanglePattern::IRREGULAR),
                                            ::testing::Values(20, 30, 40)),
                         meshName);

TEST_P(Trousers, TearOnAlongTheCut)
{
  Setting setting;
  std::tie(setting.pattern, setting.resolution) = GetParam();
  Simulation simulation = trousers(setting);

  const TrouserOutcome outcome = pullLegs(simulation);

  EXPECT_TRUE(outcome.runsOn()) << outcome.advance << " m on, at " << outcome.angle
                                << " degrees, straying " << outcome.straying;
  const int scraps = setting.resolution < 30 ? 1 : 0;  // coarse cloth may lose a triangle
  EXPECT_LE(outcome.pieces, 1 + scraps) << "a tear that runs on leaves the legs on the sheet";
  EXPECT_GT(outcome.mean_force, 1.0) << "measured: 1.1 to 2.4 N";
  EXPECT_GT(outcome.peak_force, outcome.mean_force);
  EXPECT_TRUE(isSound(simulation.cloth().mesh));
}

TEST(TrouserOutcome, DoesNotRunOnWhereATearFollowsTheDiagonals)
{
  TrouserOutcome outcome;
  outcome.advance = 3.1;
  outcome.angle = 10.0;
  outcome.straying = 0.5;
  ASSERT_TRUE(outcome.runsOn());

  outcome.angle = 37.0;
  EXPECT_FALSE(outcome.runsOn());
}

/// Lets cloth that hangs from one grasp come to rest.
/// @return force on the grasp minus the weight of what it does not hold, over that weight [-]
double excessForce(const Setting& setting)
{
  SimulationParams params = thesisParams(setting);
  params.environment.air_friction = 4.0;  // comes to rest sooner
  params.tearing.enabled = false;
  Simulation simulation(upright(sheet(2.0, 2.0, 8, 8)), {}, params);
  GraspRequest hold;
  hold.radius = 0.6;
  const std::uint64_t grasp = simulation.grasp(hold).id;
  run(simulation, stepsFor(simulation, 5.0));

  const Cloth& cloth = simulation.cloth();
  double free_mass = 0.0;
  for (int i = 0; i < cloth.mesh.particleCount(); ++i)
  {
    free_mass += cloth.attachments[i].held() ? 0.0 : cloth.rest.mass[i];
  }
  const Vec3d weight = free_mass * params.environment.gravity;
  return (forceOnGrasp(simulation, grasp) - weight).norm() / weight.norm();
}

TEST(ForceOnGrasp, IsTheWeightOfWhatHangsFromIt)
{
  Setting setting;
  setting.solver = SolverKind::FORCE_SPRINGS;

  EXPECT_LT(excessForce(setting), 0.001);
}

/// One sweep a step leaves the springs a little longer than their load, by the square of the step.
TEST(ForceOnGrasp, IsTheWeightWithXpbdToo)
{
  Setting setting;
  EXPECT_LT(excessForce(setting), 0.03);

  setting.time_step = 0.0005;
  EXPECT_LT(excessForce(setting), 0.01);
}

}  // namespace
}  // namespace cloth
