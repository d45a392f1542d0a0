// Claims of XPBD with lines: cloth as stiff as stated at long steps, by forces that springs have.
#include <gtest/gtest.h>

#include <numeric>

#include "cloth_tearing/core/solver.h"
#include "cloth_tearing/core/spring_lines.h"
#include "scenes.h"

namespace cloth
{
namespace
{

constexpr double GRAVITY = 9.81;

SimulationParams withLines(SimulationParams params)
{
  params.solver.lines = true;
  return params;
}

/// Cloth whose own weight stretches its top by 5 %, in air that lets it come to rest soon.
SimulationParams heavy(int side, double dt_n)
{
  SimulationParams params = untearable();
  params.solver.time_step = dt_n / side;
  params.material.areal_density = 0.2;
  params.material.stiffness = 20.0 * 0.2 * GRAVITY;
  params.material.bend_shear_stiffness = 0.2 * params.material.stiffness;
  params.material.damping = 0.02;
  params.environment.air_friction = 3.0;
  params.environment.wind_drag = 0.0;
  return params;
}

Simulation hungSheet(int side, RectanglePattern pattern, const SimulationParams& params)
{
  const ClothModel flat = sheet(1.0, 1.0, side, side, pattern);
  return { upright(flat), edgeOf(flat, "top"), params };
}

/// The strain that 99 of 100 springs do not exceed [-].
double strainOfMost(const Cloth& cloth)
{
  std::vector<double> strains;
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    strains.push_back(cloth.strain({ i }));
  }
  std::sort(strains.begin(), strains.end());
  return strains[strains.size() * 99 / 100];
}

TEST(Lines, HangAsStiffAtThreeTimesTheStep)
{
  for (RectanglePattern pattern : { RectanglePattern::ONE_DIAGONAL, RectanglePattern::ALTERNATING })
  {
    Simulation spring_by_spring = hungSheet(40, pattern, heavy(40, 0.25));
    Simulation lines = hungSheet(40, pattern, withLines(heavy(40, 0.25)));
    run(spring_by_spring, stepsFor(spring_by_spring, 4.0));
    run(lines, stepsFor(lines, 4.0));

    EXPECT_GT(strainOfMost(spring_by_spring.cloth()), 0.2);
    EXPECT_LT(strainOfMost(lines.cloth()), 0.06);
    EXPECT_LT(fastest(lines.cloth().state), 0.05);
  }
}

/// Particles below each other, the first one held, without cloth around them.
struct Chain
{
  static constexpr int COUNT = 100;
  static constexpr double SPACING = 0.01;   // [m]
  static constexpr double MASS = 0.001;     // [kg]
  static constexpr double STIFFNESS = 1e3;  // [N/m]
  static constexpr double STEP = 0.0025;    // [s]

  ParticleState state;
  SpringTable springs;
  std::unique_ptr<Solver> solver;

  explicit Chain(bool lines)
  {
    SolverParams params;
    params.lines = lines;
    solver = makeSolver(params);
    for (int i = 0; i < COUNT; ++i)
    {
      state.position.push_back(Vec3(0, 0, static_cast<Real>(-SPACING * i)));
    }
    state.velocity.resize(COUNT);
    state.inverse_mass.assign(COUNT, static_cast<Real>(1.0 / MASS));
    state.inverse_mass[0] = 0;
    for (int i = 0; i + 1 < COUNT; ++i)
    {
      springs.structural.push_back(
          { i, i + 1, static_cast<Real>(SPACING), static_cast<Real>(STIFFNESS), 0 });
    }
    springs.bend_shear.resize(springs.structural.size());
  }

  /// @param air how fast it brakes [1/s]
  void step(double air)
  {
    Vec3Array acceleration(COUNT, Vec3(0, 0, -GRAVITY));
    for (int i = 0; i < COUNT; ++i)
    {
      acceleration[i] -= static_cast<Real>(air) * state.velocity[i];
    }
    state.previous = state.position;
    solver->advance(state, springs, acceleration, STEP);
  }

  double stretch(int spring) const
  {
    return (state.position[spring] - state.position[spring + 1]).norm() - SPACING;
  }
};

TEST(Lines, OfAChainAreSolvedExactly)
{
  Chain chain(true);
  for (int i = 0; i < 6000; ++i)
  {
    chain.step(8.0);
  }

  for (int i = 0; i + 1 < Chain::COUNT; ++i)
  {
    const double load = (Chain::COUNT - 1 - i) * Chain::MASS * GRAVITY;
    EXPECT_NEAR(chain.stretch(i), load / Chain::STIFFNESS, 0.01 * load / Chain::STIFFNESS + 2e-6);
  }
  const double weight = (Chain::COUNT - 1) * Chain::MASS * GRAVITY;
  EXPECT_NEAR(-chain.solver->heldForce(0).z(), weight, 0.01 * weight);
}

TEST(Lines, HoldInOneStepWhatSpringBySpringTakesMany)
{
  Chain alone(false);
  Chain line(true);
  alone.step(0.0);
  line.step(0.0);

  const double fall = GRAVITY * Chain::STEP * Chain::STEP;
  EXPECT_LT(-alone.state.position[10].z() - 10 * Chain::SPACING, 1.01 * fall);
  EXPECT_GT(alone.solver->heldForce(0).norm(), 0.0);
  EXPECT_LT(-line.state.position[1].z() - Chain::SPACING, 0.5 * fall)
      << "the topmost one feels all that is below";
  EXPECT_GT(-line.solver->heldForce(0).z(), -2.0 * alone.solver->heldForce(0).z());
}

TEST(Lines, AreCutByATear)
{
  Chain chain(true);
  for (int i = 0; i < 6000; ++i)
  {
    chain.step(8.0);
  }
  const int cut = 60;
  chain.springs.release({ cut });
  const double below = chain.state.position[Chain::COUNT - 1].z();
  double lower_speed = 0.0;
  const int steps = 40;
  for (int i = 0; i < steps; ++i)
  {
    chain.step(0.0);
  }
  for (int i = cut + 1; i < Chain::COUNT; ++i)
  {
    lower_speed += chain.state.velocity[i].z() / (Chain::COUNT - cut - 1);
  }
  EXPECT_NEAR(lower_speed, -GRAVITY * Chain::STEP * steps, 1e-3) << "the lower part falls freely";
  EXPECT_LT(chain.state.position[Chain::COUNT - 1].z(), below);
  for (int i = 0; i < 6000; ++i)
  {
    chain.step(8.0);
  }
  EXPECT_NEAR(-chain.solver->heldForce(0).z(), cut * Chain::MASS * GRAVITY, 0.01 * GRAVITY * 0.06)
      << "the upper part hangs on";
}

TEST(Lines, KeepMomentum)
{
  SimulationParams params = withLines(vacuum());
  params.material.damping = 0.05;
  params.solver.time_step = 0.01;
  const ClothModel model = sheet(1.0, 1.0, 20, 20, RectanglePattern::IRREGULAR);
  Simulation simulation(model, {}, params);
  Cloth& cloth = const_cast<Cloth&>(simulation.cloth());
  for (int i = 0; i < cloth.state.size(); ++i)
  {
    const Vec3d& x = model.positions[i];
    cloth.state.velocity[i] =
        Vec3d(0.3 * x.y() + 0.1, -0.2 * x.x() + 0.05, 0.4 * x.x() * x.y()).cast<Real>();
  }
  const Vec3d before = momentum(cloth);

  run(simulation, 1000);

  EXPECT_GT(before.norm(), 1e-3);
  EXPECT_LT((momentum(simulation.cloth()) - before).norm(), 1e-3 * before.norm());
}

TEST(Lines, LetGraspsFeelTheWeight)
{
  SimulationParams params = withLines(heavy(30, 0.2));
  params.environment.air_friction = 5.0;
  Simulation simulation(upright(sheet(0.5, 0.5, 31, 31)), {}, params);
  std::vector<std::uint64_t> grasps;
  for (double x : { -0.25, 0.25 })
  {
    GraspRequest request;
    request.point = Vec3d(x, 0.0, 0.0);
    request.radius = 0.06;
    request.frame.position = request.point;
    grasps.push_back(simulation.grasp(request).id);
  }
  run(simulation, stepsFor(simulation, 8.0));

  Vec3d carried = Vec3d::Zero();
  for (const Grasp& grasp : simulation.grasps())
  {
    carried += grasp.wrench.force;
  }
  const double weight = simulation.summary().mass * GRAVITY;
  EXPECT_LT((carried - Vec3d(0.0, 0.0, -weight)).norm(), 0.01 * weight) << carried.transpose();
}

/// A sheet that was let go from the horizontal, in a vacuum.
TEST(Lines, GainNoEnergySwinging)
{
  SimulationParams params = withLines(heavy(30, 0.083));
  params.material.damping = 0.0;
  params.environment.air_friction = 0.0;
  const ClothModel flat = sheet(1.0, 1.0, 30, 30);
  Simulation simulation(flat, edgeOf(flat, "top"), params);
  const auto energy = [&]
  {
    const Cloth& cloth = simulation.cloth();
    double sum = kineticEnergy(cloth) + elasticEnergy(cloth);
    for (int i = 0; i < cloth.state.size(); ++i)
    {
      sum += cloth.rest.mass[i] * GRAVITY * cloth.state.position[i].z();
    }
    return sum;
  };
  const double before = energy();
  double most = before;
  for (int i = 0; i < stepsFor(simulation, 3.0); ++i)
  {
    run(simulation, 1);
    most = std::max(most, energy());
  }
  EXPECT_LT(most - before, 0.01) << "its weight falls by about 1 J";
}

// -- how long a step may be -----------------------------------------------------------------------

Simulation hungByDefault(int side, RectanglePattern pattern, double dt_n)
{
  SimulationParams params;
  params.solver.time_step = dt_n / side;
  params.solver.lines = true;
  return hungSheet(side, pattern, params);
}

TEST(Lines, TearNoClothByItsOwnWeightAtAStepThatIsAccepted)
{
  for (int side : { 30, 60 })
  {
    for (const auto& [pattern, dt_n] : { std::pair{ RectanglePattern::ONE_DIAGONAL, 0.37 },
                                         std::pair{ RectanglePattern::ALTERNATING, 0.35 },
                                         std::pair{ RectanglePattern::IRREGULAR, 0.165 } })
    {
      Simulation simulation = hungByDefault(side, pattern, dt_n);
      EXPECT_TRUE(run(simulation, stepsFor(simulation, 2.0)).empty()) << side;
      EXPECT_LT(fastest(simulation.cloth().state), 0.3) << side;
    }
  }
}

TEST(Lines, AreRefusedAStepAtWhichTheClothWouldTear)
{
  const auto refusal = [](RectanglePattern pattern, double dt_n)
  { return refusalOf([&] { hungByDefault(30, pattern, dt_n); }); };
  EXPECT_NE(refusal(RectanglePattern::ONE_DIAGONAL, 0.5).find("must be at most 2 with lines"),
            std::string::npos);
  EXPECT_NE(refusal(RectanglePattern::ALTERNATING, 0.5).find("time_step [s] is 0.016"),
            std::string::npos);
  EXPECT_NE(refusal(RectanglePattern::IRREGULAR, 0.25).find("must be at most 0.15"),
            std::string::npos);
}

TEST(Lines, AreToldOfAStepAtWhichTheClothMayRattle)
{
  const auto notes = [](double dt_n)
  { return hungByDefault(30, RectanglePattern::ONE_DIAGONAL, dt_n).startNotes(); };
  EXPECT_TRUE(notes(0.22).empty());
  ASSERT_EQ(notes(0.26).size(), 1u);
  EXPECT_NE(notes(0.26)[0].find("may rattle and tear"), std::string::npos);
}

TEST(Lines, AreRefusedToForceSprings)
{
  SolverParams params;
  params.lines = true;
  EXPECT_TRUE(problems(params).empty());
  params.kind = SolverKind::FORCE_SPRINGS;
  ASSERT_EQ(problems(params).size(), 1u);
  EXPECT_EQ(problems(params)[0].substr(0, 27), "lines is true, must be fals");
}

TEST(Lines, AreKeptWhenCrumpledClothIsTuned)
{
  SimulationParams params = withLines(heavy(20, 0.2));
  params.contact.floor = true;
  params.contact.floor_height = -0.5;
  Simulation simulation(upright(sheet(1.0, 1.0, 20, 20)), {}, params);
  run(simulation, stepsFor(simulation, 1.5));
  const auto lengthOf = [](const Simulation& of)
  { return of.save().size(); };  // the lines are most of what may differ
  Tuning tuning = tuningOf(simulation.params());
  tuning.material.damping = 0.03;

  const std::size_t before = lengthOf(simulation);
  simulation.tune(tuning);
  run(simulation, 1);

  EXPECT_EQ(lengthOf(simulation), before);
}

}  // namespace
}  // namespace cloth
