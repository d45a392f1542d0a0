// Claims of the outer accelerations: gravity, air friction, wind.
#include "cloth_tearing/core/forces.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace cloth
{
namespace
{

/// One right-angled triangle in the x-y plane with legs of this length, front towards +z.
Cloth triangle(double leg, bool front_up = true)
{
  ClothModel model;
  model.positions = { Vec3d(0, 0, 0), Vec3d(leg, 0, 0), Vec3d(0, leg, 0) };
  const std::array<Vec2d, 3> uv = { Vec2d(0, 0), Vec2d(1, 0), Vec2d(0, 1) };
  model.triangles.push_back(
      { front_up ? std::array<int, 3>{ 0, 1, 2 } : std::array<int, 3>{ 0, 2, 1 }, uv });
  return makeCloth(model, {}, cotton(), RestShapeSource::IMPORTED, 0.0);
}

Environment windOnly(const Vec3d& wind, double drag)
{
  Environment environment;
  environment.gravity = Vec3d::Zero();
  environment.air_friction = 0.0;
  environment.wind = wind;
  environment.wind_drag = drag;
  return environment;
}

Vec3d totalForce(const Cloth& cloth, const Environment& environment)
{
  Vec3Array acceleration;
  OuterForces().accelerate(cloth, cloth.mesh, environment, acceleration);
  Vec3d sum = Vec3d::Zero();
  for (int i = 0; i < cloth.state.size(); ++i)
  {
    sum += cloth.rest.mass[i] * acceleration[i].cast<double>();
  }
  return sum;
}

TEST(Gravity, PullsEveryParticleAlongItsVector)
{
  Environment environment = windOnly(Vec3d::Zero(), 0.0);
  environment.gravity = Vec3d(1, -2, 3);
  Vec3Array acceleration;

  const Cloth cloth = triangle(0.3);
  OuterForces().accelerate(cloth, cloth.mesh, environment, acceleration);

  ASSERT_EQ(acceleration.size(), 3u);
  for (const Vec3& a : acceleration)
  {
    EXPECT_EQ(a, Vec3(1, -2, 3));
  }
}

TEST(Wind, PressesAlongTheNormalInProportionToAreaAndSpeed)
{
  const Vec3d force = totalForce(triangle(0.2), windOnly(Vec3d(0, 0, 5), 0.5));

  EXPECT_LT((force - Vec3d(0, 0, 0.5 * 0.02 * 5)).norm(), 1e-7);
  EXPECT_LT((totalForce(triangle(0.4), windOnly(Vec3d(0, 0, 5), 0.5)) - 4.0 * force).norm(), 1e-6);
  EXPECT_LT((totalForce(triangle(0.2), windOnly(Vec3d(0, 0, -10), 0.5)) + 2.0 * force).norm(),
            1e-6);
}

TEST(Wind, DoesNotDependOnWhichSideIsTheFront)
{
  const Environment wind = windOnly(Vec3d(1, 2, 5), 0.5);
  EXPECT_LT((totalForce(triangle(0.2, true), wind) - totalForce(triangle(0.2, false), wind)).norm(),
            1e-7);
}

TEST(Wind, SlidesAlongTheClothWithoutForce)
{
  EXPECT_LT(totalForce(triangle(0.2), windOnly(Vec3d(7, 3, 0), 0.5)).norm(), 1e-9);
}

TEST(Wind, IsFeltAgainstTheMotionOfTheCloth)
{
  Cloth cloth = triangle(0.2);
  for (auto v : cloth.state.velocity)
  {
    v = Vec3(0, 0, 5);
  }
  EXPECT_LT(totalForce(cloth, windOnly(Vec3d(0, 0, 5), 0.5)).norm(), 1e-9) << "carried along";
  EXPECT_LT((totalForce(cloth, windOnly(Vec3d::Zero(), 0.5)) - Vec3d(0, 0, -0.05)).norm(), 1e-7)
      << "held up by still air";
}

TEST(Wind, PressesOnNoMoreThanTheRestArea)
{
  Cloth cloth = triangle(0.2);
  const Vec3d force = totalForce(cloth, windOnly(Vec3d(0, 0, 5), 0.5));
  cloth.state.position[1].x() = 20;
  EXPECT_LT((totalForce(cloth, windOnly(Vec3d(0, 0, 5), 0.5)) - force).norm(), 1e-7);
  cloth.state.position[1].x() = Real(0.1);
  EXPECT_LT((totalForce(cloth, windOnly(Vec3d(0, 0, 5), 0.5)) - 0.5 * force).norm(), 1e-7);
}

TEST(Wind, PressesOnHeldClothToo)
{
  Cloth cloth = triangle(0.2);
  const Vec3d free = totalForce(cloth, windOnly(Vec3d(0, 0, 5), 0.5));
  cloth.attach({ 1 }, { Attachment::Kind::PIN, 0 });

  EXPECT_EQ(totalForce(cloth, windOnly(Vec3d(0, 0, 5), 0.5)), free) << "whoever holds it feels it";
}

TEST(Wind, CarriesFreeClothAlongUntilItMovesWithTheAir)
{
  SimulationParams params = vacuum();
  params.environment.wind = Vec3d(0, 0, 4);
  params.environment.wind_drag = 0.5;
  Simulation simulation(sheet(0.5, 0.5, 5, 5), {}, params);

  run(simulation, 300);  // a time constant of density / drag = 0.3 s

  for (const Vec3& v : simulation.cloth().state.velocity)
  {
    EXPECT_NEAR(v.z(), 4.0 * (1.0 - std::exp(-1.0)), 0.01);
  }
}

TEST(AirFriction, SlowsByItsRateWhateverTheDirection)
{
  SimulationParams params = vacuum();
  params.environment.air_friction = 0.8;
  const ClothModel model = sheet(0.5, 0.5, 4, 4);
  Simulation simulation(model, {}, params);
  const Vec3 start(3, -1, 2);
  const_cast<Cloth&>(simulation.cloth())
      .state.velocity.assign(simulation.cloth().state.size(), start);

  run(simulation, 1000);

  const Vec3d mean = momentum(simulation.cloth()) / simulation.summary().mass;
  EXPECT_LT((mean - std::exp(-0.8) * start.cast<double>()).norm(), 2e-3);
}

TEST(AirFriction, GivesFallingClothItsTerminalSpeed)
{
  SimulationParams params = vacuum();
  params.environment.gravity = Vec3d(0, 0, -9.81);
  params.environment.air_friction = 5.0;
  Simulation simulation(sheet(0.5, 0.5, 4, 4), {}, params);

  run(simulation, 3000);

  const Vec3d mean = momentum(simulation.cloth()) / simulation.summary().mass;
  EXPECT_NEAR(mean.z(), -9.81 / 5.0, 1e-3);
}

TEST(AirFriction, RefusesAirSoThickThatAStepWouldTurnTheMotionRound)
{
  SimulationParams params = vacuum();
  params.environment.wind_drag = 40.0;
  params.material.areal_density = 0.01;  // a rate of 4000 / s, 4 in a step

  const std::vector<std::string> found = problems(params);

  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("wind_drag"), std::string::npos) << found[0];
  EXPECT_THROW(Simulation(sheet(0.5, 0.5, 4, 4), {}, params), Refusal);
}

TEST(Surroundings, AreRefusedByNameBeyondTheirLimits)
{
  Environment environment;
  environment.gravity.y() = std::nan("");
  environment.air_friction = -1.0;
  environment.wind.x() = 1000.0;
  environment.wind_drag = -0.1;
  const std::vector<std::string> found = problems(environment);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].substr(0, 18), "gravity [m/s^2].y ");
  EXPECT_EQ(found[1], "air_friction [1/s] is -1, must be at least 0 and at most 50");
  EXPECT_EQ(found[2].substr(0, 12), "wind [m/s].x");
  EXPECT_EQ(found[3].substr(0, 9), "wind_drag");

  Material material;
  material.areal_density = 0.0;
  material.stiffness = -5.0;
  material.bend_shear_stiffness = -1.0;
  material.damping = std::numeric_limits<double>::infinity();
  EXPECT_EQ(problems(material).size(), 4u);
  EXPECT_TRUE(problems(Material()).empty());
  EXPECT_TRUE(problems(Environment()).empty());
}

}  // namespace
}  // namespace cloth
