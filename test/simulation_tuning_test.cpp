// Claims of parameters that change while the cloth lives, and of another cloth put in its place.
#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/simulation_loop.h"
#include "scenes.h"

namespace cloth
{
namespace
{

Simulation hanging(const SimulationParams& params, int particles = 12)
{
  const ClothModel flat = sheet(1.0, 1.0, particles, particles);
  return { upright(flat), edgeOf(flat, "top"), params };
}

/// Takes hold of the lower edge's middle and pulls it down, through the tear strain.
void pullDown(Simulation& simulation)
{
  GraspRequest request;
  request.point = Vec3d(0.0, 0.0, -1.0);
  request.radius = 0.15;
  request.frame.position = request.point;
  DragTarget target;
  target.pose.position = request.point - Vec3d(0, 0, 0.8);
  target.linear_speed = 1.0;
  simulation.drag(simulation.grasp(request).id, target);
}

Simulation torn(const SimulationParams& params)
{
  Simulation simulation = hanging(params);
  pullDown(simulation);
  EXPECT_GT(run(simulation, 800).size(), 5u);
  return simulation;
}

/// Every value that may change, changed.
SimulationParams changed(SimulationParams params)
{
  params.material.areal_density = 0.2;
  params.material.stiffness_law = StiffnessLaw::PER_SPRING;
  params.material.stiffness = 80.0;
  params.material.bend_shear_stiffness = 9.0;
  params.material.damping = 0.01;
  params.environment.gravity = Vec3d(0.5, 0.0, -7.0);
  params.environment.air_friction = 0.3;
  params.environment.wind = Vec3d(0.0, 1.0, 0.0);
  params.environment.wind_drag = 0.6;
  params.tearing.tear_strain = 0.19;
  params.tearing.weak_tear_strain = 0.15;
  params.tearing.one_point_tear_strain = 0.14;
  params.tearing.tear_radius = 0.05;
  params.tearing.crack_length = 0.04;
  params.tearing.hem_factor = 1.5;
  params.tearing.hem_width = 0.3;
  params.tearing.max_tears_per_step = 3;
  params.tearing.min_length = 0.3;
  params.tearing.min_altitude = 0.15;
  params.contact.floor = true;
  params.contact.floor_height = -1.2;
  params.contact.floor_friction = 0.9;
  params.contact.friction = 0.4;
  params.contact.thickness = 0.004;
  params.contact.bounds_min = Vec3d(-3.0, -3.0, -3.0);
  params.contact.bounds_max = Vec3d(3.0, 3.0, 3.0);
  params.solver.max_strain = 0.25;
  params.solver.max_substeps = 16;
  return params;
}

class TunedWithBothSolvers : public WithBothSolvers
{
};
INSTANTIATE_TEST_SUITE_P(Solvers, TunedWithBothSolvers, bothSolvers(), solverName);

TEST_P(TunedWithBothSolvers, BeforeTheFirstStepIsAsIfBuiltWithTheValues)
{
  const SimulationParams later = changed(tearable(GetParam()));
  Simulation built = hanging(later);
  Simulation tuned = hanging(tearable(GetParam()));

  tuned.tune(tuningOf(later));

  EXPECT_EQ(tuned.startNotes(), built.startNotes());
  EXPECT_EQ(tuned.summary().mass, built.summary().mass);
  EXPECT_EQ(tuned.cloth().damage.hem, built.cloth().damage.hem);
  pullDown(built);
  pullDown(tuned);
  std::size_t tears = 0;
  for (int i = 0; i < 800; ++i)
  {
    tears += built.step().tears.size();
    tuned.step();
    ASSERT_EQ(tuned.stateHash(), built.stateHash()) << "step " << i;
  }
  EXPECT_GT(tears, 5u) << "or this shows little";
}

TEST_P(TunedWithBothSolvers, KeepsTheValuesThroughAReset)
{
  const SimulationParams later = changed(tearable(GetParam()));
  Simulation built = hanging(later);
  Simulation tuned = torn(tearable(GetParam()));

  tuned.tune(tuningOf(later));
  tuned.reset();

  run(built, 300);
  run(tuned, 300);
  EXPECT_EQ(tuned.stateHash(), built.stateHash());
}

TEST_P(TunedWithBothSolvers, ToTheSameValuesChangesNoBit)
{
  Simulation untouched = torn(tearable(GetParam()));
  Simulation tuned = untouched;

  EXPECT_TRUE(tuned.tune(tuningOf(tuned.params())).empty());

  run(untouched, 200);
  run(tuned, 200);
  EXPECT_EQ(tuned.stateHash(), untouched.stateHash());
}

TEST_P(TunedWithBothSolvers, TornClothKeepsItsTearsAndWhoHoldsItAndGetsTheNewMass)
{
  Simulation simulation = torn(tearable(GetParam()));
  const Summary before = simulation.summary();
  const Cloth held = simulation.cloth();
  Tuning tuning = tuningOf(simulation.params());
  tuning.material.areal_density *= 2.0;

  simulation.tune(tuning);

  const Summary after = simulation.summary();
  EXPECT_EQ(after.state_hash, before.state_hash) << "positions, topology, damage and grasps stay";
  EXPECT_NEAR(after.mass, 2.0 * before.mass, 1e-12);
  const Cloth& cloth = simulation.cloth();
  for (int i = 0; i < cloth.state.size(); ++i)
  {
    EXPECT_EQ(cloth.state.inverse_mass[i] == 0, held.state.inverse_mass[i] == 0) << i;
  }
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    EXPECT_EQ(cloth.springs.structural[i].active(), held.springs.structural[i].active()) << i;
    EXPECT_EQ(cloth.springs.bend_shear[i].active(), held.springs.bend_shear[i].active()) << i;
  }
  EXPECT_TRUE(simulation.step().fault.empty());
}

TEST(Tuning, OfTheMaterialTimeAndAgainTakesNoMoreMemory)
{
  Simulation simulation = hanging(tearable());
  Tuning tuning = tuningOf(simulation.params());
  for (int i = 0; i < 10; ++i)
  {
    tuning.material.stiffness *= 1.01;
    simulation.tune(tuning);
  }
  EXPECT_EQ(simulation.cloth().springs.changes.size(), 0u);
  simulation.reset();
  EXPECT_EQ(simulation.cloth().springs.changes.size(), 0u) << "of the untorn cloth";
}

TEST(Tuning, WakesNoPieceThatWasPutToRest)
{
  SimulationParams params = untearable();
  params.contact.bounds_min = Vec3d(-50.0, -50.0, -2.0);
  const ClothModel flat = sheet(1.0, 1.0, 6, 6);
  Simulation simulation(upright(flat), {}, params);  // falls
  run(simulation, 800);
  ASSERT_EQ(simulation.summary().pieces_at_rest, 1);
  Tuning tuning = tuningOf(params);
  tuning.material.stiffness *= 2.0;

  simulation.tune(tuning);

  const Cloth& cloth = simulation.cloth();
  const auto active = [](const SpringLaw& law) { return law.active(); };
  EXPECT_TRUE(
      std::none_of(cloth.springs.structural.begin(), cloth.springs.structural.end(), active));
  EXPECT_TRUE(
      std::none_of(cloth.springs.bend_shear.begin(), cloth.springs.bend_shear.end(), active));
  const auto before = cloth.state.position;
  run(simulation, 10);
  EXPECT_EQ(simulation.cloth().state.position, before);
}

TEST(Tuning, CountsFromTheNextStepOn)
{
  Simulation simulation = hanging(untearable());
  run(simulation, 50);
  Tuning tuning = tuningOf(simulation.params());
  tuning.environment.gravity = Vec3d(0.0, 4.0, 0.0);
  tuning.environment.wind_drag = 0.0;
  const Vec3d before = momentum(simulation.cloth());
  const double mass = simulation.summary().mass;

  simulation.tune(tuning);
  run(simulation, 1);

  const Vec3d gained = momentum(simulation.cloth()) - before;
  EXPECT_GT(gained.y(), 0.8 * 4.0 * 0.001 * mass * 11 / 12) << "the pinned row takes its share";
}

TEST(Tuning, RemakesTheHemOfTornClothAsIfItHadBeenBuiltWithIt)
{
  const ClothModel flat = sheet(1.0, 1.0, 12, 12, RectanglePattern::IRREGULAR);
  const std::vector<int> pinned = edgeOf(flat, "top");
  const auto built = [&](double width)
  { return makeCloth(flat, pinned, cotton(), RestShapeSource::IMPORTED, width); };
  Cloth narrow = built(0.1);
  Cloth wide = built(0.35);
  for (int s = 0; s < 200; s += 7)
  {
    narrow.follow(narrow.mesh.splitSpring({ s }));
    wide.follow(wide.mesh.splitSpring({ s }));
  }
  ASSERT_NE(narrow.damage.hem, wide.damage.hem);

  narrow.takeHem(built(0.35));

  EXPECT_EQ(narrow.damage.hem, wide.damage.hem);
}

struct Unfit
{
  const char* what;
  SolverKind solver;
  std::function<void(Tuning&)> change;
  const char* reason;
};

class RefusedTuning : public ::testing::TestWithParam<Unfit>
{
};

TEST_P(RefusedTuning, SaysWhyAndChangesNothing)
{
  Simulation untouched = torn(tearable(GetParam().solver));
  Simulation refused = untouched;
  Tuning tuning = tuningOf(refused.params());
  tuning.environment.gravity.x() = 3.0;  // good by itself
  GetParam().change(tuning);

  std::string reason;
  try
  {
    refused.tune(tuning);
  }
  catch (const Refusal& refusal)
  {
    reason = refusal.what();
  }

  EXPECT_NE(reason.find(GetParam().reason), std::string::npos) << reason;
  EXPECT_EQ(refused.params().environment.gravity, untouched.params().environment.gravity);
  run(untouched, 100);
  run(refused, 100);
  EXPECT_EQ(refused.stateHash(), untouched.stateHash());
  untouched.reset();
  refused.reset();
  run(untouched, 100);
  run(refused, 100);
  EXPECT_EQ(refused.stateHash(), untouched.stateHash());
}

INSTANTIATE_TEST_SUITE_P(
    Values, RefusedTuning,
    ::testing::Values(
        Unfit{ "NotFinite", SolverKind::XPBD,
               [](Tuning& t) { t.material.stiffness = std::nan(""); }, "stiffness [N/m] is nan" },
        Unfit{ "OutOfRange", SolverKind::XPBD, [](Tuning& t) { t.contact.friction = 11.0; },
               "friction [-] is 11, must be at least 0 and at most 10" },
        Unfit{ "AgainstEachOther", SolverKind::XPBD, [](Tuning& t) { t.tearing.tear_strain = 0.1; },
               "weak_tear_strain [-] is 0.16" },
        Unfit{ "AirThatWouldTurnItRound", SolverKind::XPBD,
               [](Tuning& t)
               {
                 t.environment.wind_drag = 100.0;
                 t.material.areal_density = 0.05;
               },
               "wind_drag / areal_density" },
        Unfit{ "TooSoftAtThisTimeStep", SolverKind::XPBD,
               [](Tuning& t)
               {
                 t.tearing.tear_strain = 0.16;
                 t.environment.gravity = Vec3d(0, 0, -1000.0);
               },
               "would tear by its own weight" },
        Unfit{ "TooStiffForTheForceSprings", SolverKind::FORCE_SPRINGS,
               [](Tuning& t) { t.material.stiffness = 1e6; }, "max_substeps = 8 substeps" }),
    [](const auto& info) { return std::string(info.param.what); });

TEST(Tuning, SaysHowManySubstepsItTakes)
{
  Simulation simulation = hanging(untearable(SolverKind::FORCE_SPRINGS));
  ASSERT_TRUE(simulation.startNotes().empty());
  Tuning tuning = tuningOf(simulation.params());
  tuning.material.stiffness *= 30.0;

  const std::vector<std::string> notes = simulation.tune(tuning);

  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("substeps a step"), std::string::npos) << notes[0];
}

TEST_P(TunedWithBothSolvers, AnotherClothGoesOnAsIfItHadBeenThereFromTheStart)
{
  const SimulationParams params = tearable(GetParam());
  Simulation simulation = torn(params);
  simulation.throwSphere({ Vec3d(0.0, -2.0, -0.5), Vec3d(0.0, 1.0, 0.0), 0.1, 0.0, 100.0 });
  const double time = simulation.time();
  const auto logged = simulation.loggedTears();
  const std::uint64_t last_grasp = simulation.grasps().back().id;
  Simulation other = hanging(params, 9);

  simulation.takeCloth(other);

  EXPECT_EQ(simulation.epoch(), 1u);
  EXPECT_EQ(simulation.stepCount(), 0u);
  EXPECT_EQ(simulation.revision(), 0u);
  EXPECT_EQ(simulation.time(), time);
  EXPECT_EQ(simulation.loggedTears(), logged);
  EXPECT_TRUE(simulation.grasps().empty());
  EXPECT_TRUE(simulation.spheres().empty());
  for (int round = 0; round < 2; ++round)  // and so does a reset
  {
    Simulation fresh = other;
    for (int i = 0; i < 200; ++i)
    {
      ASSERT_TRUE(simulation.step().fault.empty());
      fresh.step();
      ASSERT_EQ(simulation.stateHash(), fresh.stateHash()) << "step " << i;
    }
    simulation.reset();
  }
  pullDown(simulation);
  EXPECT_EQ(simulation.grasps().back().id, last_grasp + 1);
  const std::vector<TearEvent> tears = run(simulation, 800);
  ASSERT_FALSE(tears.empty());
  EXPECT_EQ(tears.front().sequence, logged[1] + 1);
}

TEST(Tuning, ReachesAClothThatWasBuiltBeforeIt)
{
  const SimulationParams params = untearable();
  SimulationLoop::Options options;
  options.pace = Pace::STEP;
  SimulationLoop loop(std::make_unique<Simulation>(hanging(params)), options,
                      [](const Simulation&, const StepReport&) {});
  const Simulation other = hanging(params, 9);
  SimulationParams later = params;
  later.material.stiffness = 45.0;
  loop.call([&](Simulation& simulation) { simulation.tune(tuningOf(later)); });

  loop.takeCloth(other);

  Simulation expected = hanging(later, 9);
  run(expected, 100);
  EXPECT_EQ(loop.step(100).state_hash, expected.stateHash());
}

}  // namespace
}  // namespace cloth
