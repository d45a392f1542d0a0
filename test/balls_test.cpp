// Claims of thesis 4.1: which balls tear the cloth and which slide off it.
#include <gtest/gtest.h>

#include "scenes.h"

namespace cloth
{
namespace
{

/// Chapter 4's cloth in its own units, with the thresholds at which all its outcomes hold.
SimulationParams thesis(SolverKind solver)
{
  SimulationParams params;
  params.solver.kind = solver;
  params.solver.time_step = 0.001;
  params.solver.max_strain = 0.1;
  params.material.areal_density = 0.1;
  params.material.stiffness = 150.0;
  params.material.bend_shear_stiffness = 30.0;
  params.material.damping = 0.02;
  params.environment.gravity = Vec3d(0, 0, -9.8);
  params.environment.air_friction = 0.4;
  params.environment.wind_drag = 0.0;
  params.contact.friction = 0.0;
  params.contact.thickness = 0.01;
  params.tearing.enabled = false;
  params.tearing.tear_radius = 0.3;
  params.tearing.tear_strain = 0.145;
  params.tearing.weak_tear_strain = 0.126;
  params.tearing.one_point_tear_strain = 0.126;
  params.tearing.crack_length = 0.18;
  params.tearing.hem_factor = 2.0;
  params.tearing.hem_width = 0.6;
  if (solver == SolverKind::FORCE_SPRINGS)
  {
    params.tearing.tear_radius = 0.0;
    params.tearing.tear_strain = 0.17;
    params.tearing.weak_tear_strain = 0.12;
    params.tearing.one_point_tear_strain = 0.12;
    params.tearing.crack_length = 0.0;
    params.tearing.hem_factor = 1.0;
  }
  return params;
}

struct Cloths
{
  RectanglePattern pattern;
  SolverKind solver;
};

/// One of the thesis' experiments.
struct Ball
{
  const char* name;
  double radius;
  double speed;
  double height;  ///< as a fraction of the hanging height
  bool tears;
};

std::string clothName(const ::testing::TestParamInfo<Cloths>& info)
{
  static const char* const PATTERNS[] = { "OneDiagonal", "Alternating", "Irregular" };
  return PATTERNS[static_cast<int>(info.param.pattern)] + nameOf(info.param.solver);
}

class Experiments : public ::testing::TestWithParam<Cloths>
{
};

INSTANTIATE_TEST_SUITE_P(
    Balls, Experiments,
    ::testing::Values(Cloths{ RectanglePattern::ONE_DIAGONAL, SolverKind::XPBD },
                      Cloths{ RectanglePattern::ALTERNATING, SolverKind::XPBD },
                      Cloths{ RectanglePattern::IRREGULAR, SolverKind::XPBD },
                      Cloths{ RectanglePattern::ONE_DIAGONAL, SolverKind::FORCE_SPRINGS },
                      Cloths{ RectanglePattern::ALTERNATING, SolverKind::FORCE_SPRINGS }),
    clothName);

TEST_P(Experiments, EndAsInTheThesis)
{
  const SimulationParams params = thesis(GetParam().solver);
  const ClothModel flat = sheet(6.0, 8.0, 20, 20, GetParam().pattern);
  Simulation settled(upright(flat), edgeOf(flat, "top"), params);
  run(settled, 6000);
  double lowest = 0.0;
  for (const Vec3& x : settled.cloth().state.position)
  {
    lowest = std::min<double>(lowest, x.z());
  }

  for (const Ball& ball : { Ball{ "1: a small ball tears", 0.5, 3.0, 0.68, true },
                            Ball{ "2: a larger one, low, slides off", 1.0, 3.0, 0.15, false },
                            Ball{ "3: the same one, high, tears", 1.0, 3.0, 0.80, true },
                            Ball{ "4: a large slow one does not tear", 2.0, 3.0, 0.42, false },
                            Ball{ "5: a large fast one does", 2.0, 10.0, 0.42, true } })
  {
    Simulation simulation = settled;
    TearRules rules = params.tearing;
    rules.enabled = true;
    simulation.setTearRules(rules);
    ThrowRequest thrown;
    thrown.center = Vec3d(0.03, -3.5, lowest * (1.0 - ball.height));
    thrown.velocity = Vec3d(0, ball.speed, 0);
    thrown.radius = ball.radius;
    thrown.lifetime = 100.0;
    simulation.throwSphere(thrown);

    const std::size_t tears = run(simulation, stepsFor(simulation, 7.0 / ball.speed + 2.0)).size();

    EXPECT_EQ(tears > 5, ball.tears) << ball.name << ", " << tears << " tears";
    EXPECT_EQ(tears > 0, ball.tears) << ball.name << ", " << tears << " tears";
    EXPECT_TRUE(isSound(simulation.cloth().mesh)) << ball.name;
  }
}

}  // namespace
}  // namespace cloth
