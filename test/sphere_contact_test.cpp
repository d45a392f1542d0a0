// Claims of contact: swept spheres, push-out, friction, dynamic balls, draping, the floor, streams.
#include "cloth_tearing/core/sphere_contact.h"

#include <gtest/gtest.h>

#include <random>

#include "scenes.h"

namespace cloth
{
namespace
{

Sphere ball(const Vec3d& center, double radius, const Vec3d& velocity = Vec3d::Zero())
{
  Sphere sphere;
  sphere.id = 1;
  sphere.center = center;
  sphere.radius = radius;
  sphere.velocity = velocity;
  return sphere;
}

/// How often the ray from `origin` along `direction` crosses the cloth.
int crossings(const Cloth& cloth, const Vec3d& origin, const Vec3d& direction)
{
  int count = 0;
  for (int i = 0; i < cloth.mesh.triangleCount(); ++i)
  {
    const auto& p = cloth.mesh.triangle({ i }).particles;
    const Vec3d a = cloth.state.position[p[0].index].cast<double>() - origin;
    const Vec3d b = cloth.state.position[p[1].index].cast<double>() - origin;
    const Vec3d c = cloth.state.position[p[2].index].cast<double>() - origin;
    const double u = direction.dot(b.cross(c));
    const double v = direction.dot(c.cross(a));
    const double w = direction.dot(a.cross(b));
    const bool inside = (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
    const Vec3d normal = (b - a).cross(c - a);
    count += inside && normal.dot(a) * normal.dot(direction) > 0.0;
  }
  return count;
}

/// Distance from a point to the nearest of many points on each triangle [m].
double clothDistance(const Cloth& cloth, const Vec3d& point)
{
  double least = 1e9;
  for (int i = 0; i < cloth.mesh.triangleCount(); ++i)
  {
    const auto& p = cloth.mesh.triangle({ i }).particles;
    for (int j = 0; j <= 6; ++j)
    {
      for (int k = 0; j + k <= 6; ++k)
      {
        const Vec3d x = (j * cloth.state.position[p[0].index].cast<double>() +
                         k * cloth.state.position[p[1].index].cast<double>() +
                         (6 - j - k) * cloth.state.position[p[2].index].cast<double>()) /
                        6.0;
        least = std::min(least, (x - point).norm());
      }
    }
  }
  return least;
}

TEST(SphereContact, LetsNoSmallFastBallThroughUntearableCloth)
{
  // Cells of 0.1 m; aimed at a particle, the middle of an edge, the middle of a face.
  const ClothModel model = sheet(1.0, 1.0, 11, 11, RectanglePattern::ONE_DIAGONAL);
  for (const Vec3d& aim : { Vec3d(0.0, -0.5, 0), Vec3d(0.05, -0.5, 0), Vec3d(0.033, -0.533, 0) })
  {
    for (double speed : { 5.0, 20.0, 100.0 })
    {
      for (double radius : { 0.002, 0.02 })
      {
        SimulationParams params = vacuum();
        params.contact.max_sphere_speed = 200.0;
        Simulation simulation(model, wholeBorder(model), params);
        ThrowRequest thrown;
        thrown.center = aim - Vec3d(0, 0, 0.1503);
        thrown.velocity = Vec3d(0, 0, speed);
        thrown.radius = radius;
        simulation.throwSphere(thrown);

        run(simulation, static_cast<int>(0.45 / speed / 0.001));

        const Vec3d at = simulation.spheres().at(0).center;
        ASSERT_GT(at.z(), 0.1) << "it must have arrived";
        EXPECT_EQ(crossings(simulation.cloth(), at, Vec3d(1e-4, 2e-4, 1)), 1)
            << "in front of it, speed " << speed << " radius " << radius << " aim "
            << aim.transpose();
        EXPECT_EQ(crossings(simulation.cloth(), at, Vec3d(1e-4, 2e-4, -1)), 0) << "behind it";
      }
    }
  }
}

TEST(SphereContact, LetsNoBallThroughWhereverAndHoweverItHits)
{
  std::mt19937_64 random(1);
  const auto between = [&](double low, double high)
  { return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53; };
  for (int shot = 0; shot < 300; ++shot)
  {
    SimulationParams params = vacuum(shot % 2 == 0 ? SolverKind::XPBD : SolverKind::FORCE_SPRINGS);
    params.contact.friction = shot % 4 < 2 ? 0.3 : 0.0;
    params.solver.max_strain = 10.0;
    const auto pattern = static_cast<RectanglePattern>(shot % 3);
    const ClothModel model = sheet(1.0, 1.0, 11, 11, pattern);
    Simulation simulation(model, wholeBorder(model), params);
    const Vec3d aim(between(-0.3, 0.3), between(-0.8, -0.2), 0.0);
    const Vec3d way = Vec3d(between(-0.5, 0.5), between(-0.5, 0.5), 1.0).normalized();
    const double speed = between(5.0, 30.0);
    ThrowRequest thrown;
    thrown.radius = between(0.005, 0.05);
    thrown.center = aim - (thrown.radius + 0.05) * way;
    thrown.velocity = speed * way;
    simulation.throwSphere(thrown);

    run(simulation, static_cast<int>((thrown.radius + 0.25) / speed / 0.001));

    const Vec3d at = simulation.spheres().at(0).center;
    EXPECT_EQ(crossings(simulation.cloth(), at, Vec3d(1e-4, 2e-4, 1)) % 2, 1)
        << "shot " << shot << " at " << speed << " m/s, radius " << thrown.radius;
  }
}

TEST(SphereContact, ThrowsNothingAboutWhereABallStrikesHeldCloth)
{
  for (const SolverKind solver : { SolverKind::XPBD, SolverKind::FORCE_SPRINGS })
  {
    SimulationParams params;
    params.solver.kind = solver;
    params.solver.max_substeps = 64;
    const ClothModel flat = sheet(1.0, 1.0, 15, 15);
    Simulation hung(upright(flat), edgeOf(flat, "top"), params);
    run(hung, 200);
    for (const double height : { 0.03, 0.0, -0.01, -0.03, -0.1 })
    {
      for (const double speed : { 1.0, 3.0, 10.0 })
      {
        Simulation simulation = hung;
        ThrowRequest thrown;
        thrown.center = Vec3d(0.013, -0.3, height);
        thrown.velocity = Vec3d(0, speed, 0);
        thrown.radius = 0.06;
        simulation.throwSphere(thrown);
        for (int i = 0; i < static_cast<int>(600.0 / speed); ++i)
        {
          const StepReport report = simulation.step();
          ASSERT_EQ(report.fault, "")
              << nameOf(solver) << " at " << height << " m, " << speed << " m/s";
        }
      }
    }
  }
}

TEST(SphereContact, PushesOutOverSeveralStepsWhereASphereIsBornInsideTheCloth)
{
  SimulationParams params = vacuum();
  params.contact.push_speed = 2.0;
  params.contact.friction = 0.0;
  const ClothModel model = sheet(1.0, 1.0, 11, 11);
  Simulation simulation(model, {}, params);
  simulation.setSpheres({ ball(Vec3d(0, -0.5, -0.02), 0.06) });
  const double depth = 0.0599 - 0.02;
  int steps = 0;
  double furthest = 0.0;

  while (clothDistance(simulation.cloth(), Vec3d(0, -0.5, -0.02)) < 0.0599 && steps < 500)
  {
    const Vec3Array before = simulation.cloth().state.position;
    run(simulation, 1);
    ++steps;
    for (std::size_t i = 0; i < before.size(); ++i)
    {
      const double way = (simulation.cloth().state.position[i] - before[i]).cast<double>().norm();
      furthest = std::max(furthest, way);
    }
  }

  EXPECT_LT(steps, 500) << "it comes out";
  EXPECT_GE(steps, depth / (2.0 * 0.001) - 1) << "but not faster than push_speed";
  EXPECT_LT(furthest, 3.0 * 2.0 * 0.001) << "no particle jumps";
  EXPECT_LT(fastest(simulation.cloth().state), 3.0) << "nor is it shot away";
}

TEST(SphereContact, TearsNothingWhereASphereIsBornInThePlaneOfTheCloth)
{
  const ClothModel flat = sheet(1.0, 1.0, 30, 30);
  Simulation hung(upright(flat), edgeOf(flat, "top"), SimulationParams());
  run(hung, 100);
  for (const double radius : { 0.05, 0.1, 0.2 })
  {
    Simulation simulation = hung;
    const Vec3d center(0.01, 0.0, -0.5);
    simulation.setSpheres({ ball(center, radius) });

    const std::size_t tears = run(simulation, 300).size();

    EXPECT_EQ(tears, 0u) << radius;
    EXPECT_GT(clothDistance(simulation.cloth(), center), 0.95 * radius) << "and it came out";
  }
}

/// A small sheet on a sphere so large that it is a plane, or on the floor, on a slope.
double speedOnSlope(bool floor, double slope, double friction)
{
  SimulationParams params = vacuum();
  params.contact.friction = friction;
  params.contact.floor = floor;
  params.contact.floor_friction = friction;
  params.environment.gravity = 9.81 * Vec3d(std::sin(slope), 0, -std::cos(slope));
  Simulation simulation(moved(sheet(0.2, 0.2, 5, 5), Vec3d(0, 0.1, 0.0021)), {}, params);
  if (!floor)
  {
    simulation.setSpheres({ ball(Vec3d(0, 0, -100), 100) });
  }
  run(simulation, 500);
  return momentum(simulation.cloth()).x() / simulation.summary().mass;
}

TEST(Friction, HoldsOnAGentleSlopeAndSlidesByCoulombOnASteepOne)
{
  for (bool floor : { false, true })
  {
    EXPECT_NEAR(speedOnSlope(floor, 0.2, 0.3), 0.0, 0.002) << "tan 0.2 < 0.3";
    const double sliding = 9.81 * (std::sin(0.4) - 0.3 * std::cos(0.4)) * 0.5;
    EXPECT_NEAR(speedOnSlope(floor, 0.4, 0.3), sliding, 0.02 * sliding);
    const double free = 9.81 * std::sin(0.4) * 0.5;
    EXPECT_NEAR(speedOnSlope(floor, 0.4, 0.0), free, 0.02 * free) << "none, no rubbing";
  }
}

TEST(Friction, DoesNotLetHeldClothCreepDownASlope)
{
  for (bool floor : { false, true })
  {
    SimulationParams params = untearable();
    params.contact.friction = 0.5;
    params.contact.floor = floor;
    params.contact.floor_friction = 0.5;
    params.environment.gravity = 9.81 * Vec3d(std::sin(0.2), 0, -std::cos(0.2));
    Simulation simulation(moved(sheet(0.2, 0.2, 5, 5), Vec3d(0, 0.1, 0.0021)), {}, params);
    if (!floor)
    {
      simulation.setSpheres({ ball(Vec3d(0, 0, -10), 10) });
    }
    run(simulation, 200);
    const Vec3 before = simulation.cloth().state.position[12];

    run(simulation, 5000);

    EXPECT_LT((simulation.cloth().state.position[12] - before).norm(), floor ? 1e-6 : 1e-3);
  }
}

TEST(Floor, StopsASlidingSheetByItsFriction)
{
  SimulationParams params = vacuum();
  params.environment.gravity = Vec3d(0, 0, -9.81);
  params.contact.floor = true;
  params.contact.floor_friction = 0.4;
  Simulation simulation(moved(sheet(0.2, 0.2, 5, 5), Vec3d(0, 0, 0.0015)), {}, params);
  const_cast<Cloth&>(simulation.cloth()).state.velocity.assign(25, Vec3(1, 0, 0));

  run(simulation, 100);
  EXPECT_NEAR(momentum(simulation.cloth()).x() / simulation.summary().mass, 1.0 - 0.4 * 9.81 * 0.1,
              0.02);
  run(simulation, 200);
  EXPECT_EQ(fastest(simulation.cloth().state), 0.0);
}

TEST(Floor, PushesOutWhatStartsBelowItOverSeveralSteps)
{
  SimulationParams params = untearable();
  params.contact.floor = true;
  params.contact.floor_height = -0.9;
  params.contact.push_speed = 2.0;
  const ClothModel flat = sheet(1.0, 1.0, 12, 12);
  Simulation simulation(upright(flat), edgeOf(flat, "top"), params);
  for (int i = 0; i < 300; ++i)
  {
    const Vec3Array before = simulation.cloth().state.position;
    run(simulation, 1);
    for (std::size_t p = 0; p < before.size(); ++p)
    {
      ASSERT_LT((simulation.cloth().state.position[p] - before[p]).norm(), 0.006) << "step " << i;
    }
  }
  for (const Vec3& x : simulation.cloth().state.position)
  {
    EXPECT_GT(x.z(), -0.9);
  }
}

TEST(Floor, BearsClothThatComesToRestAndStaysThereBitForBit)
{
  for (SolverKind solver : { SolverKind::XPBD, SolverKind::FORCE_SPRINGS })
  {
    SimulationParams params = untearable(solver);
    params.contact.floor = true;
    params.contact.floor_height = -0.5;
    Simulation simulation(moved(sheet(1, 1, 15, 15, RectanglePattern::IRREGULAR), { 0, 0, -0.2 }),
                          {}, params);
    run(simulation, 2000);
    const std::uint64_t hash = simulation.stateHash();

    run(simulation, 1000);

    EXPECT_EQ(fastest(simulation.cloth().state), 0.0) << nameOf(solver);
    EXPECT_EQ(simulation.stateHash(), hash) << nameOf(solver);
    for (const Vec3& x : simulation.cloth().state.position)
    {
      EXPECT_NEAR(x.z(), -0.5 + params.contact.thickness, 1e-6);
    }
  }
}

/// What the floor does to a particle (Coulomb), written for one of them.
void land(ParticleState& state, int i, const ContactParams& params, Real dt)
{
  const auto height = static_cast<Real>(params.floor_height + params.thickness);
  const auto friction = static_cast<Real>(params.floor_friction);
  const Vec3 v = state.velocity[i];
  const Real z = state.position[i].z();
  if (!(z < height) || !(state.inverse_mass[i] > 0))
  {
    return;
  }
  Vec3 change = Vec3::Zero();
  if (v.z() < 0)
  {
    const Real slip = std::sqrt(v.x() * v.x() + v.y() * v.y());
    const Real share = slip > 0 ? std::min(slip, friction * -v.z()) / slip : Real(0);
    change = Vec3(0 - share * v.x(), 0 - share * v.y(), -v.z());
  }
  state.velocity[i] += change;
  const bool sticks = state.velocity[i].x() == 0 && state.velocity[i].y() == 0;
  state.position[i] = sticks ? state.previous[i] : Vec3(state.position[i] + dt * change);
  state.position[i].z() = std::max(
      z, std::min(height, state.previous[i].z() + static_cast<Real>(params.push_speed) * dt));
}

TEST(Floor, TakesUpEachParticleAsIfItWereAloneWhereverItLiesInMemory)
{
  ContactParams params;
  params.floor = true;
  const double dt = 0.001;
  std::mt19937_64 numbers(3);
  const auto within = [&](double range)
  { return static_cast<Real>(range * (static_cast<double>(numbers() >> 11) * 0x1p-52 - 1.0)); };
  WorkerPool three(3);
  for (int columns : { 3, 16, 61 })
  {
    Cloth cloth =
        makeCloth(sheet(1.0, 1.0, columns, 37), { 1, 7 }, cotton(), RestShapeSource::IMPORTED, 0.0);
    ParticleState& state = cloth.state;
    state.previous.resize(state.size());
    for (int i = 0; i < state.size(); ++i)
    {
      const bool still = i % 5 == 0;
      state.previous[i] = Vec3(within(1.0), within(1.0), within(0.004));
      state.velocity[i] = still ? Vec3(0, 0, within(1.0)) : Vec3(within(1), within(1), within(2));
      state.position[i] = state.previous[i] + Vec3(static_cast<Real>(dt) * state.velocity[i]);
    }
    ParticleState expected = state;
    std::vector<int> lain;
    for (int i = 0; i < state.size(); ++i)
    {
      land(expected, i, params, static_cast<Real>(dt));
      if (state.position[i].z() < 0.002F && state.inverse_mass[i] > 0)
      {
        lain.push_back(i);
      }
    }
    for (WorkerPool* workers : { static_cast<WorkerPool*>(nullptr), &three })
    {
      Cloth taken_up = cloth;
      SphereContact contact;
      std::vector<Sphere> none;
      contact.resolve(taken_up, none, params, dt, workers);
      EXPECT_EQ(taken_up.state.position, expected.position) << columns;
      EXPECT_EQ(taken_up.state.velocity, expected.velocity) << columns;
      EXPECT_EQ(contact.pushed(), lain) << columns;
      EXPECT_GT(lain.size(), 20u);
    }
  }
}

TEST(Balls, AreKinematicWithoutAMass)
{
  SimulationParams params = vacuum();
  params.environment.gravity = Vec3d(0, 0, -9.81);
  const ClothModel model = sheet(1.0, 1.0, 11, 11);
  Simulation simulation(model, wholeBorder(model), params);
  simulation.setSpheres({ ball(Vec3d(0, -0.5, -0.2), 0.1, Vec3d(0.1, 0, 2)) });

  run(simulation, 200);

  EXPECT_EQ(simulation.spheres().at(0).velocity, Vec3d(0.1, 0, 2));
  EXPECT_LT((simulation.spheres().at(0).center - Vec3d(0.02, -0.5, 0.2)).norm(), 1e-9);
  EXPECT_GT(simulation.cloth().state.position[60].z(), 0.28) << "the cloth goes with it";
}

TEST(Balls, WithAMassShareTheirMomentumWithTheCloth)
{
  SimulationParams params = vacuum();
  const ClothModel model = sheet(1.0, 1.0, 11, 11);
  Simulation simulation(model, {}, params);
  Sphere sphere = ball(Vec3d(0.03, -0.5, -0.2), 0.1, Vec3d(0.3, 0, 3));
  sphere.mass = 0.2;
  simulation.setSpheres({ sphere });
  const Vec3d before = 0.2 * sphere.velocity;

  run(simulation, 300);

  const Sphere& after = simulation.spheres().at(0);
  EXPECT_LT(after.velocity.z(), 2.5) << "the cloth has slowed it";
  const Vec3d total = 0.2 * after.velocity + momentum(simulation.cloth());
  EXPECT_LT((total - before).norm(), 1e-4 * before.norm());
}

TEST(Balls, WithAMassFallAndLieOnTheFloor)
{
  SimulationParams params = untearable();
  params.contact.floor = true;
  Simulation simulation(moved(sheet(0.2, 0.2, 3, 3), Vec3d(5, 0, 1)), {}, params);
  ThrowRequest thrown;
  thrown.center = Vec3d(0, 0, 0.5);
  thrown.radius = 0.1;
  thrown.mass = 1.0;
  simulation.throwSphere(thrown);

  run(simulation, 1000);

  EXPECT_EQ(simulation.spheres().at(0).center.z(), 0.1);
  EXPECT_EQ(simulation.spheres().at(0).velocity.z(), 0.0);
}

TEST(Drape, CoversASphereWithoutEnteringItAndCalmsDown)
{
  for (SolverKind solver : { SolverKind::XPBD, SolverKind::FORCE_SPRINGS })
  {
    SimulationParams params = untearable(solver);
    params.contact.friction = 0.5;
    params.environment.air_friction = 1.0;
    Simulation simulation(moved(sheet(1, 1, 21, 21), Vec3d(0, 0.5, 0.3)), {}, params);
    simulation.setSpheres({ ball(Vec3d::Zero(), 0.25) });
    double least = 1.0;

    for (int i = 0; i < 30; ++i)
    {
      run(simulation, 100);
      least = std::min(least, clothDistance(simulation.cloth(), Vec3d::Zero()));
    }

    EXPECT_GT(least, 0.25 - 1e-4) << nameOf(solver);
    double lowest = 0.0;
    for (const Vec3& x : simulation.cloth().state.position)
    {
      lowest = std::min<double>(lowest, x.z());
    }
    EXPECT_LT(lowest, -0.1) << "it hangs down all around, " << nameOf(solver);
    EXPECT_GT(lowest, -0.6) << "and did not slide off, " << nameOf(solver);
    EXPECT_LT(meanSpeed(simulation.cloth().state), 0.03) << nameOf(solver);
  }
}

class StreamedSpheres : public ::testing::Test
{
protected:
  static SimulationParams parameters()
  {
    SimulationParams params = vacuum();
    params.contact.max_sphere_speed = 50.0;
    params.contact.sphere_timeout = 0.1;
    return params;
  }

  ClothModel model = sheet(1.0, 1.0, 11, 11);
  Simulation simulation{ model, wholeBorder(model), parameters() };
  Vec3d below = Vec3d(0, -0.5, -0.03);
  Vec3d above = Vec3d(0, -0.5, 0.015);
};

TEST_F(StreamedSpheres, MoveSweptFromWhereTheyAre)
{
  simulation.setSpheres({ ball(below, 0.01) });
  run(simulation, 1);

  simulation.setSpheres({ ball(above, 0.01) });
  run(simulation, 1);

  EXPECT_LT((simulation.spheres().at(0).center - above).norm(), 1e-12);
  EXPECT_EQ(crossings(simulation.cloth(), above, Vec3d(1e-4, 2e-4, 1)), 1) << "pushed ahead";
}

TEST_F(StreamedSpheres, FasterThanTheLimitArePlacedAnewWithoutTouching)
{
  Simulation untouched = simulation;
  run(untouched, 2);
  simulation.setSpheres({ ball(below, 0.01) });
  run(simulation, 1);

  const Vec3d far = above + Vec3d(0, 0, 0.02);  // 65 m/s
  simulation.setSpheres({ ball(far, 0.01) });
  run(simulation, 1);

  EXPECT_LT((simulation.spheres().at(0).center - far).norm(), 1e-12);
  EXPECT_EQ(simulation.cloth().state.position, untouched.cloth().state.position);
}

TEST_F(StreamedSpheres, MoveBetweenMessagesAtTheSpeedOfTheStreamThoughItNamesNone)
{
  const double period = 0.033;  // 30 Hz, 3 m/s: more than max_sphere_speed allows in one step
  simulation.setSpheres({ ball(Vec3d(3, 0, 0), 0.1) });
  run(simulation, 33);
  for (int message = 1; message <= 5; ++message)
  {
    simulation.setSpheres({ ball(Vec3d(3 + 3.0 * period * message, 0, 0), 0.1) });
    double before = simulation.spheres().at(0).center.x();
    for (int i = 0; i < 33; ++i)
    {
      run(simulation, 1);
      const double now = simulation.spheres().at(0).center.x();
      EXPECT_NEAR(now - before, 0.003, 1e-9) << "message " << message << ", step " << i;
      before = now;
    }
  }
}

TEST_F(StreamedSpheres, MoveOnUntilTheirTimeIsUpAndThenStand)
{
  simulation.setSpheres({ ball(Vec3d(3, 0, 0), 0.1, Vec3d(1, 0, 0)) });

  run(simulation, 300);

  EXPECT_NEAR(simulation.spheres().at(0).center.x(), 3.1, 0.0015);
  EXPECT_EQ(simulation.spheres().at(0).velocity, Vec3d::Zero().eval());
}

TEST_F(StreamedSpheres, VanishWhenTheyAreNotInTheSetAnyMore)
{
  Sphere other = ball(Vec3d(3, 0, 0), 0.1);
  other.id = 2;
  simulation.setSpheres({ ball(below, 0.01), other });
  ThrowRequest thrown;
  thrown.center = Vec3d(5, 0, 0);
  simulation.throwSphere(thrown);
  EXPECT_EQ(simulation.spheres().size(), 3u);

  simulation.setSpheres({ other });
  ASSERT_EQ(simulation.spheres().size(), 2u);
  EXPECT_EQ(simulation.spheres()[0].source, SphereSource::THROWN) << "thrown ones are not theirs";
  EXPECT_EQ(simulation.spheres()[1].id, 2u);

  simulation.setSpheres({});
  EXPECT_EQ(simulation.spheres().size(), 1u);
}

TEST_F(StreamedSpheres, AreRefusedTogetherWithAllThatIsWrong)
{
  simulation.setSpheres({ ball(below, 0.01) });
  Sphere wrong = ball(Vec3d(std::nan(""), 0, 0), -1.0);
  wrong.id = 7;
  try
  {
    simulation.setSpheres({ ball(above, 0.01), ball(below, 0.01), wrong });
    FAIL() << "must be refused";
  }
  catch (const Refusal& refusal)
  {
    const std::string what = refusal.what();
    EXPECT_NE(what.find("sphere 1 is there twice"), std::string::npos) << what;
    EXPECT_NE(what.find("sphere 7: center [m].x is nan"), std::string::npos) << what;
    EXPECT_NE(what.find("sphere 7: radius [m] is -1, must be at least 0.0001 and at most 100"),
              std::string::npos)
        << what;
  }
  ASSERT_EQ(simulation.spheres().size(), 1u);
  EXPECT_EQ(simulation.spheres()[0].center, below) << "nothing has changed";
}

TEST(ThrownSpheres, EndByLifetimeBoundsAndReset)
{
  SimulationParams params = vacuum();
  params.contact.bounds_max = Vec3d(2, 2, 2);
  params.contact.bounds_min = Vec3d(-2, -2, -2);
  Simulation simulation(sheet(1, 1, 4, 4), {}, params);
  ThrowRequest thrown;
  thrown.center = Vec3d(0, 0, 1);
  thrown.lifetime = 0.05;
  const std::uint64_t first = simulation.throwSphere(thrown);
  thrown.lifetime = 100.0;
  thrown.velocity = Vec3d(0, 0, 10);
  EXPECT_EQ(simulation.throwSphere(thrown), first + 1);
  thrown.velocity = Vec3d::Zero();
  simulation.throwSphere(thrown);

  run(simulation, 49);
  EXPECT_EQ(simulation.spheres().size(), 3u);
  run(simulation, 3);
  EXPECT_EQ(simulation.spheres().size(), 2u) << "its time was up";
  run(simulation, 60);
  EXPECT_EQ(simulation.spheres().size(), 1u) << "it left the bounds";
  simulation.reset();
  EXPECT_TRUE(simulation.spheres().empty());
}

TEST(ThrownSpheres, AreRefusedByName)
{
  Simulation simulation(sheet(1, 1, 4, 4), {}, vacuum());
  ThrowRequest thrown;
  thrown.radius = 0.0;
  thrown.lifetime = 0.0;
  thrown.velocity.x() = std::numeric_limits<double>::infinity();
  try
  {
    simulation.throwSphere(thrown);
    FAIL() << "must be refused";
  }
  catch (const Refusal& refusal)
  {
    const std::string what = refusal.what();
    EXPECT_NE(what.find("radius [m] is 0"), std::string::npos) << what;
    EXPECT_NE(what.find("lifetime [s] is 0"), std::string::npos) << what;
    EXPECT_NE(what.find("velocity [m/s].x is inf"), std::string::npos) << what;
  }
  EXPECT_TRUE(simulation.spheres().empty());
}

TEST(ContactParams, AreRefusedByName)
{
  ContactParams params;
  params.friction = -1.0;
  params.thickness = 0.0;
  params.push_speed = 0.0;
  params.floor_friction = 100.0;
  params.bounds_min.x() = 60.0;
  params.max_sphere_speed = 0.0;
  params.sphere_timeout = -1.0;
  EXPECT_EQ(problems(params).size(), 7u);
  EXPECT_TRUE(problems(ContactParams()).empty());
}

// -- spheres that follow a frame -----------------------------------------------------------------

class FollowedSphere : public ::testing::Test
{
protected:
  FollowedSphere()
  {
    Sphere sphere;
    sphere.id = 7;
    sphere.center = Vec3d(0.0, 0.0, 1.0);
    sphere.radius = 0.1;
    simulation.setSpheres({ sphere });
  }
  const Sphere& sphere() const { return simulation.spheres().at(0); }

  Simulation simulation{ sheet(1.0, 1.0, 5, 5), {}, vacuum() };
};

TEST_F(FollowedSphere, GlidesToWhereItIsSentAndStaysThere)
{
  for (int i = 1; i <= 5; ++i)
  {
    simulation.moveSphere(7, Vec3d(0.01 * i, 0.0, 1.0), 0.02);
    for (int k = 0; k < 20; ++k)
    {
      const double before = sphere().center.x();
      run(simulation, 1);
      EXPECT_NEAR(sphere().center.x() - before, 0.0005, 1e-9);
    }
  }
  run(simulation, 1000);  // twice sphere_timeout
  EXPECT_NEAR(sphere().center.x(), 0.05, 1e-9);
}

TEST_F(FollowedSphere, IsPlacedAnewWhereNoMotionLeadsThatFast)
{
  simulation.moveSphere(7, Vec3d(0.0, 0.0, 11.0), 0.1);  // 100 m/s
  EXPECT_EQ(sphere().center, Vec3d(0.0, 0.0, 11.0));
  EXPECT_TRUE(sphere().fresh);
}

TEST_F(FollowedSphere, IsRefusedUnlessItIsThereAndThePlaceIsOne)
{
  const auto refused = [&](std::uint64_t id, const Vec3d& center, double time)
  {
    try
    {
      simulation.moveSphere(id, center, time);
    }
    catch (const Refusal& refusal)
    {
      return std::string(refusal.what());
    }
    return std::string("granted");
  };
  const std::uint64_t hash = simulation.stateHash();
  EXPECT_EQ(refused(8, Vec3d::Zero(), 0.1), "there is no sphere 8");
  EXPECT_NE(refused(7, Vec3d(0, 5000, 0), 0.1).find("sphere 7: center [m].y is 5000"),
            std::string::npos);
  EXPECT_NE(refused(7, Vec3d::Zero(), -0.1).find("time [s] is -0.1"), std::string::npos);
  EXPECT_EQ(simulation.stateHash(), hash);
}

}  // namespace
}  // namespace cloth
