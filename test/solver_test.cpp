// Claims of the two solvers: the laws of motion they keep, and how they stay stable.
#include "cloth_tearing/core/solver.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace cloth
{
namespace
{

// Two pinned corners, one that hangs.
//
//   0 ------- 1    y = 0
//     \     /
//       \ /
//        2         y = -0.1
ClothModel hangingTriangle()
{
  ClothModel model;
  model.positions = { Vec3d(-0.1, 0, 0), Vec3d(0.1, 0, 0), Vec3d(0, -0.1, 0) };
  model.triangles.push_back({ { 0, 2, 1 }, { Vec2d(0, 1), Vec2d(0.5, 0), Vec2d(1, 1) } });
  return model;
}

void setVelocities(Simulation& simulation, const std::vector<Vec3>& velocities)
{
  const_cast<Cloth&>(simulation.cloth()).state.velocity = velocities;
}

/// A motion with every kind of deformation in it, at rest as a whole only by accident.
std::vector<Vec3> stirred(const ClothModel& model)
{
  std::vector<Vec3> velocities;
  for (const Vec3d& x : model.positions)
  {
    velocities.push_back(
        Vec3d(0.3 * x.y() + 0.1, -0.2 * x.x() + 0.05, 0.4 * x.x() * x.y()).cast<Real>());
  }
  return velocities;
}

using BothSolvers = WithBothSolvers;
INSTANTIATE_TEST_SUITE_P(Solver, BothSolvers, bothSolvers(), solverName);

TEST_P(BothSolvers, LetFreeClothFallExactlyAsSymplecticEulerDoes)
{
  // Also with steps so short that a step of the fall is less than the spacing of floats there.
  for (double dt : { 0.02, 0.001, 0.0001, 0.00001 })
  {
    SimulationParams params = vacuum(GetParam());
    params.environment.gravity = Vec3d(1.5, -2.0, -9.81);
    params.solver.time_step = dt;
    params.solver.max_substeps = 64;
    params.contact.bounds_min = Vec3d::Constant(-1000.0);
    const ClothModel model = moved(sheet(0.5, 0.5, 4, 4), Vec3d(6, 3, 5));
    Simulation simulation(model, {}, params);
    const int n = 200;

    run(simulation, n);

    const Vec3d fallen = params.environment.gravity * dt * dt * (n * (n + 1) / 2);
    const Vec3d speed = params.environment.gravity * dt * n;
    double place_error = 0.0;
    double speed_error = 0.0;
    for (int i = 0; i < simulation.cloth().state.size(); ++i)
    {
      const Vec3d x = simulation.cloth().state.position[i].cast<double>();
      const Vec3d v = simulation.cloth().state.velocity[i].cast<double>();
      place_error = std::max(place_error, (x - model.positions[i] - fallen).norm());
      speed_error = std::max(speed_error, (v - speed).norm());
    }
    EXPECT_LT(speed_error, 5e-3 * speed.norm()) << "dt " << dt;
    EXPECT_LT(place_error, 5e-3 * fallen.norm() + 5e-5) << "dt " << dt;
  }
}

TEST_P(BothSolvers, StretchASpringByItsLoadOverItsStiffness)
{
  SimulationParams params = vacuum(GetParam());
  params.environment.gravity = Vec3d(0, -9.81, 0);
  params.environment.air_friction = 20.0;
  params.material.areal_density = 2.0;
  Simulation simulation(hangingTriangle(), { 0, 1 }, params);

  run(simulation, 3000);

  // Each slanted spring carries half the weight: k (l - rest) cos = m g / 2, by bisection.
  const double area = 0.5 * 0.2 * 0.1;
  const double rest = std::sqrt(0.02);
  const double k = params.material.stiffness * area / (rest * rest);
  const double weight = params.material.areal_density * area / 3.0 * 9.81;
  double low = 0.1;
  double high = 0.2;
  for (int i = 0; i < 60; ++i)
  {
    const double depth = 0.5 * (low + high);
    const double length = std::sqrt(0.01 + depth * depth);
    (2.0 * k * (length - rest) * depth / length < weight ? low : high) = depth;
  }
  ASSERT_GT(low, 0.102) << "the load must be felt";
  EXPECT_NEAR(-simulation.cloth().state.position[2].y(), low, 1e-5);
}

TEST_P(BothSolvers, StretchAnyHangingSheetAsIfItsLineStiffnessWereAboutYPlusYb)
{
  for (RectanglePattern pattern : { RectanglePattern::ONE_DIAGONAL, RectanglePattern::ALTERNATING,
                                    RectanglePattern::IRREGULAR })
  {
    SimulationParams params = vacuum(GetParam());
    params.environment.gravity = Vec3d(0, -4, 0);
    params.environment.air_friction = 8.0;
    params.solver.time_step = 0.0005;
    const ClothModel model = sheet(1.0, 1.0, 9, 9, pattern);
    Simulation simulation(model, edgeOf(model, "top"), params);

    run(simulation, 3000);

    double elongation = 0.0;
    const std::vector<int> bottom = edgeOf(model, "bottom");
    for (int p : bottom)
    {
      elongation += -1.0 - simulation.cloth().state.position[p].y();
    }
    elongation /= static_cast<double>(bottom.size());
    const double line_stiffness = params.material.areal_density * 4.0 / (2.0 * elongation);
    EXPECT_GT(line_stiffness, 0.80 * 72.0) << "pattern " << static_cast<int>(pattern);
    EXPECT_LT(line_stiffness, 1.25 * 72.0) << "pattern " << static_cast<int>(pattern);
  }
}

TEST_P(BothSolvers, GainNoEnergyWithoutASource)
{
  const SimulationParams params = vacuum(GetParam());
  const ClothModel model = sheet(1.0, 1.0, 8, 8, RectanglePattern::IRREGULAR);
  Simulation simulation(model, {}, params);
  setVelocities(simulation, stirred(model));
  const double before = kineticEnergy(simulation.cloth());
  double most = 0.0;

  for (int i = 0; i < 4000; ++i)
  {
    run(simulation, 1);
    most = std::max(most, kineticEnergy(simulation.cloth()) + elasticEnergy(simulation.cloth()));
  }

  EXPECT_LT(most, 1.02 * before);
}

TEST_P(BothSolvers, KeepMomentumUnderInternalForces)
{
  SimulationParams params = vacuum(GetParam());
  params.material.damping = 0.05;
  const ClothModel model = sheet(1.0, 1.0, 8, 8, RectanglePattern::IRREGULAR);
  Simulation simulation(model, {}, params);
  setVelocities(simulation, stirred(model));
  const Vec3d before = momentum(simulation.cloth());

  run(simulation, 2000);

  EXPECT_GT(before.norm(), 1e-3);
  EXPECT_LT((momentum(simulation.cloth()) - before).norm(), 1e-3 * before.norm());
}

TEST_P(BothSolvers, DampVibrationButNotTravel)
{
  std::array<double, 2> vibration{};
  for (int damped : { 0, 1 })
  {
    SimulationParams params = vacuum(GetParam());
    params.material.damping = damped * 0.2;
    params.solver.time_step = 0.0001;  // so short that XPBD itself hardly damps
    const ClothModel model = sheet(0.5, 0.5, 6, 6);
    Simulation simulation(model, {}, params);
    std::vector<Vec3> velocities;
    for (const Vec3d& x : model.positions)
    {
      velocities.push_back(Vec3(1, static_cast<Real>(0.5 * (x.y() + 0.25)), 0));
    }
    setVelocities(simulation, velocities);

    run(simulation, 1000);

    const Vec3d mean = momentum(simulation.cloth()) / simulation.summary().mass;
    EXPECT_NEAR(mean.x(), 1.0, 1e-3) << "travel is not damped";
    vibration[damped] = kineticEnergy(simulation.cloth()) -
                        0.5 * simulation.summary().mass * mean.squaredNorm() +
                        elasticEnergy(simulation.cloth());
  }
  EXPECT_GT(vibration[0], 2e-5);
  EXPECT_LT(vibration[1], 0.1 * vibration[0]);
}

TEST_P(BothSolvers, LeaveHeldParticlesWhereTheyAre)
{
  SimulationParams params = untearable(GetParam());
  const ClothModel model = upright(sheet(0.5, 0.5, 6, 6));
  const std::vector<int> pinned = { 0, 5, 14 };
  Simulation simulation(model, pinned, params);

  run(simulation, 1000);

  for (int p : pinned)
  {
    EXPECT_EQ(simulation.cloth().state.position[p], model.positions[p].cast<Real>().eval());
    EXPECT_EQ(simulation.cloth().state.velocity[p], Vec3::Zero().eval());
  }
}

TEST(StiffnessPerSpring, IsTheSameWhateverTheLength)
{
  Material material = cotton();
  material.stiffness_law = StiffnessLaw::PER_SPRING;
  RectangleParams sheet;
  sheet.columns = sheet.rows = 4;
  sheet.height = 2.0;

  const Cloth cloth = makeCloth(rectangle(sheet), {}, material, RestShapeSource::IMPORTED, 0.0);

  for (const SpringLaw& law : cloth.springs.structural)
  {
    EXPECT_EQ(law.stiffness, static_cast<Real>(material.stiffness));
    EXPECT_EQ(law.damping, static_cast<Real>(material.damping));
  }
  for (const SpringLaw& law : cloth.springs.bend_shear)
  {
    EXPECT_EQ(law.stiffness,
              law.active() ? static_cast<Real>(material.bend_shear_stiffness) : Real(0));
  }
}

TEST(Xpbd, StaysCalmAtALongStepAndAnyStiffness)
{
  for (double stiffness : { 1e3, 1e5, 1e7 })
  {
    SimulationParams params = untearable(SolverKind::XPBD);
    params.solver.time_step = 0.02;
    params.material.stiffness = stiffness;
    params.material.bend_shear_stiffness = 0.2 * stiffness;
    const ClothModel flat = sheet(1.0, 1.0, 15, 15, RectanglePattern::IRREGULAR);
    Simulation simulation(upright(flat), edgeOf(flat, "top"), params);

    run(simulation, 1000);

    EXPECT_LT(fastest(simulation.cloth().state), 0.5) << "stiffness " << stiffness;
    EXPECT_LT(simulation.summary().max_strain, 1.0) << "stiffness " << stiffness;
  }
}

Simulation hungSquare(int particles, const SimulationParams& params)
{
  const ClothModel flat = sheet(1.0, 1.0, particles, particles);
  return { upright(flat), edgeOf(flat, "top"), params };
}

TEST(XpbdSoftness, IsNotedAtTheStart)
{
  SimulationParams params;
  EXPECT_TRUE(hungSquare(30, params).startNotes().empty());

  params.solver.time_step = 0.003;
  const std::vector<std::string> notes = hungSquare(30, params).startNotes();

  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("softer than stiffness says"), std::string::npos) << notes[0];
}

TEST(XpbdSoftness, TearsNoClothByItsOwnWeightAtAStepThatIsAccepted)
{
  for (const auto& [particles, time_step] : { std::pair{ 30, 0.0047 }, std::pair{ 60, 0.0023 } })
  {
    SimulationParams params;
    params.solver.time_step = time_step;
    Simulation simulation = hungSquare(particles, params);

    EXPECT_TRUE(run(simulation, stepsFor(simulation, 2.0)).empty()) << particles;
  }
}

TEST(XpbdSoftness, ThatWouldTearTheClothByItsOwnWeightIsRefused)
{
  SimulationParams params;
  params.solver.time_step = 0.01;
  try
  {
    hungSquare(30, params);
    FAIL() << "must be refused";
  }
  catch (const Refusal& refusal)
  {
    const std::string what = refusal.what();
    EXPECT_NE(what.find("time_step [s] is 0.01"), std::string::npos) << what;
    EXPECT_NE(what.find("must be at most 0.15"), std::string::npos) << what;
  }

  params.tearing.enabled = false;
  Simulation untearing = hungSquare(30, params);
  EXPECT_THROW(untearing.setTearRules(TearRules()), Refusal);
}

TEST(XpbdSoftness, IsNoMatterOfAFewSlivers)
{
  ClothModel model = sheet(1.0, 1.0, 12, 12);
  const Cloth regular = makeCloth(model, {}, cotton(), RestShapeSource::IMPORTED, 0.0);
  model.positions[70] += 0.98 * (model.positions[71] - model.positions[70]);
  const Cloth pinched = makeCloth(model, {}, cotton(), RestShapeSource::IMPORTED, 0.0);
  const auto solver = makeSolver(SolverParams());

  EXPECT_NEAR(solver->stiffnessNumber(pinched.state, pinched.springs, 0.001),
              solver->stiffnessNumber(regular.state, regular.springs, 0.001), 0.05);
}

TEST(Hem, IsWhatLiesWithinItsWidthOfAPin)
{
  const ClothModel model = sheet(1.0, 1.0, 20, 20, RectanglePattern::IRREGULAR);
  const std::vector<int> pinned = { 0, 57, 58, 203, 399 };
  for (double width : { 1e-6, 0.03, 0.1, 0.4, 5.0 })
  {
    const Cloth cloth = makeCloth(model, pinned, cotton(), RestShapeSource::IMPORTED, width);
    for (std::size_t i = 0; i < model.positions.size(); ++i)
    {
      bool near = false;
      for (int pin : pinned)
      {
        near = near || (model.positions[i] - model.positions[pin]).norm() <= width;
      }
      EXPECT_EQ(cloth.damage.hem[i] != 0, near) << "particle " << i << ", width " << width;
    }
  }
}

TEST(Time, DoesNotDrift)
{
  Simulation simulation(sheet(1.0, 1.0, 3, 3), {}, vacuum());
  run(simulation, 1000);
  EXPECT_EQ(simulation.time(), 1.0);

  simulation.reset();
  run(simulation, 500);
  EXPECT_EQ(simulation.time(), 1.5);
}

TEST(Xpbd, DoesNotLimitStrain)
{
  Cloth cloth = makeCloth(hangingTriangle(), { 0, 1 }, cotton(), RestShapeSource::IMPORTED, 0.0);
  cloth.state.position[2].y() = Real(-1);
  const Vec3Array before = cloth.state.position;

  makeSolver(SolverParams())->limitStrain(cloth.state, cloth.springs);

  EXPECT_EQ(cloth.state.position, before);
}

SolverParams forceSprings()
{
  SolverParams params;
  params.kind = SolverKind::FORCE_SPRINGS;
  return params;
}

TEST(StrainLimiter, DrawsAnOverlongSpringToTheLimitAndLeavesVelocitiesAlone)
{
  Cloth cloth = makeCloth(hangingTriangle(), { 0 }, cotton(), RestShapeSource::IMPORTED, 0.0);
  cloth.state.position[2] = Vec3(Real(0.058), Real(-0.119), 0);  // 40 % from 0, compressed from 1
  cloth.state.velocity[2] = Vec3(1, -7, 3);
  const Vec3Array velocities = cloth.state.velocity;
  SolverParams params = forceSprings();
  params.max_strain = 0.10;

  makeSolver(params)->limitStrain(cloth.state, cloth.springs);

  EXPECT_NEAR(cloth.strain({ 0 }), 0.10, 1e-6);
  EXPECT_EQ(cloth.state.velocity, velocities);
  EXPECT_EQ(cloth.state.position[0], Vec3(Real(-0.1), 0, 0)) << "it is pinned";
}

TEST(StrainLimiter, SharesTheCorrectionEquallyBetweenFreeEnds)
{
  Cloth cloth = makeCloth(hangingTriangle(), {}, cotton(), RestShapeSource::IMPORTED, 0.0);
  cloth.state.position[0] = Vec3(Real(-0.2), 0, 0);
  cloth.state.position[1] = Vec3(Real(0.2), 0, 0);
  cloth.state.position[2] = Vec3(0, Real(-0.02), 0);  // the slanted springs are within the limit
  SolverParams params = forceSprings();
  params.max_strain = 0.5;

  makeSolver(params)->limitStrain(cloth.state, cloth.springs);

  EXPECT_EQ(fastest(cloth.state), 0.0) << "velocities are left alone";
  EXPECT_NEAR(cloth.state.position[0].x(), -0.15, 1e-6);
  EXPECT_NEAR(cloth.state.position[1].x(), 0.15, 1e-6);
}

TEST(StrainLimiter, LeavesWhatIsWithinTheLimitOrCompressed)
{
  Cloth cloth = makeCloth(hangingTriangle(), {}, cotton(), RestShapeSource::IMPORTED, 0.0);
  cloth.state.position[0].x() = Real(-0.05);
  const Vec3Array before = cloth.state.position;

  makeSolver(forceSprings())->limitStrain(cloth.state, cloth.springs);

  EXPECT_EQ(cloth.state.position, before);
}

/// Least number of substeps for which h^2 (2 sum k / m) + 2 h (2 sum c / m) < 4 at every particle.
int substepsByTheLaw(const Cloth& cloth, double dt)
{
  std::vector<double> k(cloth.state.size(), 0.0);
  std::vector<double> c(cloth.state.size(), 0.0);
  for (const auto* table : { &cloth.springs.structural, &cloth.springs.bend_shear })
  {
    for (const SpringLaw& law : *table)
    {
      for (int end : { law.a, law.b })
      {
        if (end >= 0)
        {
          k[end] += law.stiffness;
          c[end] += law.damping;
        }
      }
    }
  }
  for (int n = 1;; ++n)
  {
    const double h = dt / n;
    bool stable = true;
    for (int i = 0; i < cloth.state.size(); ++i)
    {
      const double w = cloth.state.inverse_mass[i];
      stable = stable && h * h * 2.0 * k[i] * w + 2.0 * h * 2.0 * c[i] * w < 4.0;
    }
    if (stable)
    {
      return n;
    }
  }
}

TEST(StabilityOfForceSprings, TakesAsManySubstepsAsTheStiffestParticleNeeds)
{
  for (double stiffness : { 60.0, 600.0, 6000.0, 60000.0 })
  {
    Material material = cotton();
    material.stiffness = stiffness;
    const ClothModel model = sheet(1.0, 1.0, 12, 12, RectanglePattern::IRREGULAR);
    const Cloth cloth = makeCloth(model, {}, material, RestShapeSource::IMPORTED, 0.0);
    SolverParams params = forceSprings();
    params.max_substeps = 64;

    const Stability stability =
        makeSolver(params)->checkStability(cloth.state, cloth.springs, 0.001, 0.0);

    const int least = substepsByTheLaw(cloth, 0.001);
    EXPECT_EQ(stability.floored, 0);
    EXPECT_GE(stability.substeps, least) << "stiffness " << stiffness;
    EXPECT_LE(stability.substeps, least + 1 + least / 10) << "stiffness " << stiffness;
  }
}

TEST(StabilityOfForceSprings, HoldsForAnyStiffnessItAccepts)
{
  for (double stiffness : { 100.0, 1000.0, 10000.0 })
  {
    SimulationParams params = vacuum(SolverKind::FORCE_SPRINGS);
    params.material.stiffness = stiffness;
    params.material.damping = stiffness / 5000.0;
    params.solver.max_substeps = 64;
    params.solver.max_strain = 10.0;
    const ClothModel model = sheet(1.0, 1.0, 12, 12, RectanglePattern::IRREGULAR);
    Simulation simulation(model, {}, params);
    setVelocities(simulation, stirred(model));
    const double before = kineticEnergy(simulation.cloth());

    run(simulation, 3000);

    EXPECT_LT(kineticEnergy(simulation.cloth()) + elasticEnergy(simulation.cloth()), 1.02 * before)
        << "stiffness " << stiffness;
  }
}

TEST(StabilityOfForceSprings, RefusesAStepThatNoSubstepsMakeStableAndSaysSo)
{
  SimulationParams params = vacuum(SolverKind::FORCE_SPRINGS);
  params.material.stiffness = 1e6;
  params.solver.max_substeps = 4;
  try
  {
    Simulation(sheet(1.0, 1.0, 12, 12), {}, params);
    FAIL() << "must be refused";
  }
  catch (const Refusal& refusal)
  {
    const std::string what = refusal.what();
    EXPECT_NE(what.find("time_step [s] is 0.001"), std::string::npos) << what;
    EXPECT_NE(what.find("max_substeps = 4"), std::string::npos) << what;
  }
}

TEST(StabilityOfForceSprings, TreatsParticlesTooLightForTheSubstepsAsHeavier)
{
  const ClothModel model = sheet(1.0, 1.0, 12, 12);
  Material material = cotton();
  material.stiffness = 1e5;
  Cloth cloth = makeCloth(model, {}, material, RestShapeSource::IMPORTED, 0.0);
  SolverParams params = forceSprings();
  params.max_substeps = 2;
  params.max_strain = 10.0;
  const auto solver = makeSolver(params);

  const Stability stability = solver->checkStability(cloth.state, cloth.springs, 0.001, 0.0);
  EXPECT_EQ(stability.substeps, 2);
  EXPECT_EQ(stability.floored, cloth.state.size());

  cloth.state.velocity = stirred(model);
  const std::vector<Vec3> still(cloth.state.size(), Vec3::Zero());
  for (int i = 0; i < 2000; ++i)
  {
    solver->advance(cloth.state, cloth.springs, still, 0.001);
  }
  EXPECT_LT(fastest(cloth.state), 2.0) << "and stays stable so";
}

TEST(StabilityOfForceSprings, LeavesRoomForAirThatBrakesHard)
{
  Material material = cotton();
  material.stiffness = 900.0;
  const Cloth cloth =
      makeCloth(sheet(1.0, 1.0, 12, 12), {}, material, RestShapeSource::IMPORTED, 0.0);
  const auto substeps = [&](double air_rate)
  {
    return makeSolver(forceSprings())
        ->checkStability(cloth.state, cloth.springs, 0.001, air_rate)
        .substeps;
  };

  EXPECT_GT(substeps(900.0), substeps(0.0));
}

TEST(StabilityOfForceSprings, IsNotedWithoutLightParticlesWhereThereAreNone)
{
  SimulationParams params = tearable(SolverKind::FORCE_SPRINGS);
  params.solver.max_substeps = 64;
  params.solver.time_step = 0.004;
  Simulation simulation = hungSquare(12, params);
  GraspRequest request;
  request.point = Vec3d(0.0, 0.0, -1.0);
  request.radius = 0.15;
  request.frame.position = request.point;
  DragTarget target;
  target.pose.position = Vec3d(0.0, 0.0, -1.8);
  simulation.drag(simulation.grasp(request).id, target);

  std::vector<std::string> notes = simulation.startNotes();
  for (int i = 0; i < 300; ++i)
  {
    const StepReport report = simulation.step();
    notes.insert(notes.end(), report.notes.begin(), report.notes.end());
  }

  ASSERT_GE(notes.size(), 2u) << "at the start, and after tears";
  for (const std::string& note : notes)
  {
    EXPECT_EQ(note.find("light particles"), std::string::npos) << note;
  }
}

TEST(SolverParams, AreRefusedByNameBeyondTheirLimits)
{
  SolverParams params;
  params.time_step = 0.5;
  params.max_strain = 0.0;
  params.max_substeps = 0;

  const std::vector<std::string> found = problems(params);

  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0], "time_step [s] is 0.5, must be at least 1e-05 and at most 0.02");
  EXPECT_EQ(found[1].substr(0, 10), "max_strain");
  EXPECT_EQ(found[2].substr(0, 12), "max_substeps");
  EXPECT_TRUE(problems(SolverParams()).empty());
}

class Springs : public WithBothSolvers
{
};
INSTANTIATE_TEST_SUITE_P(Solver, Springs, bothSolvers(), solverName);

TEST_P(Springs, AreNotedThatBeginTheStepStretched)
{
  const ClothModel model = sheet(1.0, 1.0, 12, 12);
  SimulationParams params = vacuum(GetParam());
  Simulation simulation(model, {}, params);
  setVelocities(simulation, stirred(model));
  run(simulation, 200);
  Cloth cloth = simulation.cloth();
  cloth.springs.release({ 5 });
  std::vector<double> strains;
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    strains.push_back(cloth.strain({ i }));
  }
  std::vector<double> sorted = strains;
  std::sort(sorted.begin(), sorted.end());
  std::size_t above = sorted.size() / 2;  // amid the widest gap of the longer half: no tie
  for (std::size_t i = above; i < sorted.size(); ++i)
  {
    above = sorted[i] - sorted[i - 1] > sorted[above] - sorted[above - 1] ? i : above;
  }
  const double limit = 0.5 * (sorted[above] + sorted[above - 1]);
  std::vector<int> expected;
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    if (strains[i] > limit && i != 5)
    {
      expected.push_back(i);
    }
  }
  const auto solver = makeSolver(params.solver);
  solver->checkStability(cloth.state, cloth.springs, 0.001, 0.0);
  cloth.state.previous = cloth.state.position;

  solver->watch(limit);
  solver->advance(cloth.state, cloth.springs, std::vector<Vec3>(cloth.state.size(), Vec3::Zero()),
                  0.001);

  const std::vector<int>& noted = solver->stretched();
  EXPECT_TRUE(std::is_sorted(noted.begin(), noted.end()));
  EXPECT_TRUE(std::includes(noted.begin(), noted.end(), expected.begin(), expected.end()));
  EXPECT_EQ(std::count(noted.begin(), noted.end(), 5), 0) << "it carries no load";
  EXPECT_LE(noted.size(), expected.size() + expected.size() / 10);
}

TEST_P(Springs, AreNotNotedWhileTheClothIsSlack)
{
  const ClothModel model = sheet(1.0, 1.0, 12, 12);
  const SimulationParams params = vacuum(GetParam());
  Cloth cloth = makeCloth(model, {}, params.material, RestShapeSource::IMPORTED, 0.0);
  const auto solver = makeSolver(params.solver);
  solver->checkStability(cloth.state, cloth.springs, 0.001, 0.0);

  solver->watch(0.01);
  solver->advance(cloth.state, cloth.springs, std::vector<Vec3>(cloth.state.size(), Vec3::Zero()),
                  0.001);

  EXPECT_TRUE(solver->stretched().empty());
}

}  // namespace
}  // namespace cloth
