// Claims of the whole world: a step's report, reset, copies, the log, runaways, pieces put to rest.
#include "cloth_tearing/core/simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/state_hash.h"
#include "scenes.h"

namespace cloth
{
namespace
{

/// A sheet that hangs from its upper edge, 12 x 12.
Simulation hanging(const SimulationParams& params)
{
  const ClothModel flat = sheet(1.0, 1.0, 12, 12);
  return { upright(flat), edgeOf(flat, "top"), params };
}

/// Takes hold of the lower edge's middle and pulls it down, through the tear strain.
void pullDown(Simulation& simulation, double way = 0.8)
{
  GraspRequest request;
  request.point = Vec3d(0.0, 0.0, -1.0);
  request.radius = 0.15;
  request.frame.position = request.point;
  const std::uint64_t id = simulation.grasp(request).id;
  DragTarget target;
  target.pose.position = request.point - Vec3d(0, 0, way);
  target.linear_speed = 1.0;
  simulation.drag(id, target);
}

Simulation torn(const SimulationParams& params = tearable())
{
  Simulation simulation = hanging(params);
  pullDown(simulation);
  EXPECT_GT(run(simulation, 800).size(), 5u);
  return simulation;
}

TEST(Step, ReportsEachTearInFull)
{
  Simulation simulation = hanging(tearable());
  pullDown(simulation);
  std::uint64_t sequence = 0;
  std::uint64_t tears = 0;
  int particles = simulation.cloth().mesh.particleCount();
  for (int i = 0; i < 800; ++i)
  {
    const StepReport report = simulation.step();
    ASSERT_TRUE(report.fault.empty()) << report.fault;
    for (const TearEvent& event : report.tears)
    {
      EXPECT_EQ(event.sequence, ++sequence);
      EXPECT_EQ(event.step, simulation.stepCount());
      EXPECT_EQ(event.time, simulation.time());
      EXPECT_EQ(event.epoch, 0u);
      EXPECT_GT(event.strain, event.threshold);
      EXPECT_GT(event.tension, 0.0);
      EXPECT_TRUE(event.position.allFinite());
      EXPECT_GE(event.uv.minCoeff(), -1e-9);
      EXPECT_LE(event.uv.maxCoeff(), 1.0 + 1e-9);
      EXPECT_TRUE(event.spring.valid());
      EXPECT_EQ(event.path.valid(), event.kind == TearKind::WEAK_POINT);
      EXPECT_EQ(event.cause.kind, CauseKind::GRASP);
      EXPECT_EQ(event.cause.id, simulation.grasps()[0].id);
      for (const auto& added : event.particles)
      {
        EXPECT_EQ(added.id.index, particles++) << "every new particle is in exactly one event";
      }
      ++tears;
    }
    EXPECT_EQ(simulation.revision(), tears);
  }
  EXPECT_GT(tears, 5u);
  EXPECT_EQ(particles, simulation.cloth().mesh.particleCount());
  const Summary summary = simulation.summary();
  EXPECT_EQ(summary.tears[0] + summary.tears[1] + summary.tears[2] + summary.tears[3], tears);
  EXPECT_TRUE(isSound(simulation.cloth().mesh));
}

TEST(Step, ReportsTheLargestStrain)
{
  Simulation simulation = hanging(untearable());
  run(simulation, 500);
  const StepReport report = simulation.step();
  double most = 0.0;
  for (int i = 0; i < simulation.cloth().mesh.springCount(); ++i)
  {
    most = std::max(most, simulation.cloth().strain({ i }));
  }
  EXPECT_EQ(report.max_strain, most);
  EXPECT_EQ(simulation.summary().max_strain, most);
}

class Detection : public WithBothSolvers
{
};
INSTANTIATE_TEST_SUITE_P(Step, Detection, bothSolvers(), solverName);

TEST_P(Detection, FindsAmongStretchedAndPushedSpringsWhatALookAtAllOfThemFinds)
{
  SimulationParams params = tearable(GetParam());
  params.solver.max_substeps = 64;
  Simulation quick = hanging(params);
  Simulation thorough = hanging(params);
  ThrowRequest beside;  // its box overlaps much of the cloth: every spring is looked at
  beside.center = Vec3d(1.9, 1.9, 1.4);
  beside.radius = 2.0;
  beside.lifetime = 10.0;
  thorough.throwSphere(beside);
  ThrowRequest ball;
  ball.center = Vec3d(0.2, -1.0, -0.4);
  ball.velocity = Vec3d(0.0, 4.0, 0.0);
  ball.radius = 0.06;
  for (Simulation* simulation : { &quick, &thorough })
  {
    pullDown(*simulation);
    simulation->throwSphere(ball);
  }

  const std::vector<TearEvent> found = run(quick, 1500);
  const std::vector<TearEvent> expected = run(thorough, 1500);

  EXPECT_GT(expected.size(), 5u);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    EXPECT_EQ(found[i].step, expected[i].step) << i;
    EXPECT_EQ(found[i].spring, expected[i].spring) << i;
    EXPECT_EQ(found[i].strain, expected[i].strain) << i;
  }
  EXPECT_EQ(quick.cloth().state.position, thorough.cloth().state.position);
}

TEST(DetectionOfTears, FollowsAThresholdThatIsLowered)
{
  SimulationParams params = tearable();
  params.tearing.tear_strain = 2.0;
  params.tearing.weak_tear_strain = 2.0;
  params.tearing.one_point_tear_strain = 2.0;
  Simulation simulation = hanging(params);
  pullDown(simulation, 0.2);
  EXPECT_TRUE(run(simulation, 300).empty());

  simulation.setTearRules(tearable().tearing);

  EXPECT_FALSE(run(simulation, 10).empty());
}

TEST(DetectionOfTears, WorksAfterAReset)
{
  Simulation simulation = torn();
  simulation.reset();
  pullDown(simulation);
  EXPECT_GT(run(simulation, 800).size(), 5u);
}

/// Keeps what it is told.
class Notes : public StepObserver
{
public:
  void enter(StepPhase phase) override { phases.push_back(phase); }
  std::vector<StepPhase> phases;
};

TEST(StepObserver, IsToldOfEachPhaseInOrder)
{
  Simulation simulation = hanging(tearable());
  Notes notes;

  simulation.step(&notes);

  ASSERT_EQ(notes.phases.size(), static_cast<std::size_t>(STEP_PHASES) + 1);
  for (int i = 0; i <= STEP_PHASES; ++i)
  {
    EXPECT_EQ(notes.phases[i], static_cast<StepPhase>(i));
  }
}

TEST(StepObserver, IsToldThatAnUndoneStepEndsAfterItsCheck)
{
  SimulationParams params = untearable();
  params.max_speed = 1e-6;
  Simulation simulation = hanging(params);
  Notes notes;

  EXPECT_FALSE(simulation.step(&notes).fault.empty());

  ASSERT_GE(notes.phases.size(), 2u);
  EXPECT_EQ(notes.phases[notes.phases.size() - 2], StepPhase::CHECK);
  EXPECT_EQ(notes.phases.back(), StepPhase::END);
}

TEST(StepObserver, ChangesNothing)
{
  Simulation watched = hanging(tearable());
  Simulation alone = watched;
  pullDown(watched);
  pullDown(alone);
  Notes notes;
  for (int i = 0; i < 500; ++i)
  {
    watched.step(&notes);
    alone.step();
  }
  EXPECT_GT(watched.revision(), 0u);
  EXPECT_EQ(watched.stateHash(), alone.stateHash());
}

TEST(Place, PutsEveryParticleWhereItIsToldAtRest)
{
  Simulation simulation = torn();
  Vec3Array positions = simulation.cloth().state.position;
  for (auto x : positions)
  {
    x.y() += Real(1);
  }

  simulation.place(positions);

  EXPECT_EQ(simulation.cloth().state.position, positions);
  EXPECT_EQ(fastest(simulation.cloth().state), 0.0);
}

TEST(Place, RefusesPositionsThatAreNoneAndChangesNothing)
{
  Simulation simulation = hanging(untearable());
  const Vec3Array before = simulation.cloth().state.position;
  Vec3Array positions = before;
  positions[7].x() = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_THROW(simulation.place(positions), Refusal);
  positions = before;
  positions.resize(positions.size() - 1);
  EXPECT_THROW(simulation.place(positions), Refusal);
  EXPECT_EQ(simulation.cloth().state.position, before);
}

TEST(Tearing, ConservesMassAreaAndTexture)
{
  const Simulation whole = hanging(tearable());
  const Simulation simulation = torn();
  EXPECT_NEAR(simulation.summary().mass, whole.summary().mass, 1e-12);
  EXPECT_NEAR(simulation.summary().rest_area, whole.summary().rest_area, 1e-12);
  EXPECT_NEAR(textureArea(simulation.cloth().mesh), textureArea(whole.cloth().mesh), 1e-12);
}

TEST(Tearing, CanBeSwitchedOffAndOn)
{
  Simulation simulation = hanging(tearable());
  TearRules rules = simulation.params().tearing;
  rules.enabled = false;
  simulation.setTearRules(rules);
  pullDown(simulation, 0.5);
  EXPECT_TRUE(run(simulation, 600).empty());
  EXPECT_GT(simulation.summary().utilisation, 1.0);

  rules.enabled = true;
  simulation.setTearRules(rules);
  EXPECT_FALSE(run(simulation, 10).empty());

  rules.tear_strain = -1.0;
  EXPECT_THROW(simulation.setTearRules(rules), Refusal);
  EXPECT_GT(simulation.params().tearing.tear_strain, 0.0);
}

TEST(Utilisation, IsOneWhereTheNextTearIs)
{
  Simulation simulation = hanging(tearable());
  pullDown(simulation);
  double before = 0.0;
  for (int i = 0; i < 800; ++i)
  {
    before = simulation.summary().utilisation;
    if (!simulation.step().tears.empty())
    {
      break;
    }
    EXPECT_LE(simulation.summary().utilisation, 1.0);
  }
  EXPECT_GT(before, 0.9);
}

TEST(ThrownSpheres, AreRefusedWhenThereAreAThousand)
{
  Simulation simulation = hanging(tearable());
  for (int i = 0; i < 1000; ++i)
  {
    simulation.throwSphere(ThrowRequest());
  }
  try
  {
    simulation.throwSphere(ThrowRequest());
    FAIL() << "must be refused";
  }
  catch (const Refusal& refusal)
  {
    EXPECT_STREQ(refusal.what(),
                 "there would be 1001 spheres, must be at most limits/spheres = 1000");
  }
  EXPECT_EQ(simulation.spheres().size(), 1000u);
}

TEST(Reset, BringsTheFirstStateBackAndTimeGoesOn)
{
  Simulation simulation = hanging(tearable());
  const std::uint64_t hash = simulation.stateHash();
  pullDown(simulation);
  run(simulation, 800);
  simulation.throwSphere(ThrowRequest());
  const double time = simulation.time();
  const std::uint64_t last = simulation.loggedTears()[1];
  ASSERT_GT(last, 0u);
  EXPECT_NE(simulation.stateHash(), hash);

  simulation.reset();

  EXPECT_EQ(simulation.stateHash(), hash);
  EXPECT_EQ(simulation.epoch(), 1u);
  EXPECT_EQ(simulation.time(), time);
  EXPECT_EQ(simulation.stepCount(), 0u);
  EXPECT_EQ(simulation.revision(), 0u);
  EXPECT_TRUE(simulation.grasps().empty());
  EXPECT_TRUE(simulation.spheres().empty());
  EXPECT_EQ(simulation.summary().tears[0], 0u);
  EXPECT_EQ(simulation.loggedTears()[1], last) << "the log goes on";
}

TEST(Reset, IsFollowedByTheSameRunAsAtFirst)
{
  for (SolverKind solver : { SolverKind::XPBD, SolverKind::FORCE_SPRINGS })
  {
    SimulationParams params = tearable(solver);
    params.solver.max_substeps = 64;
    params.solver.time_step = 0.004;  // so that tears ask the force springs for more substeps
    Simulation simulation = hanging(params);
    pullDown(simulation);
    const std::size_t first = run(simulation, 300).size();
    const Vec3Array positions = simulation.cloth().state.position;

    simulation.reset();
    pullDown(simulation);
    const std::size_t second = run(simulation, 300).size();

    EXPECT_EQ(second, first);
    EXPECT_EQ(simulation.cloth().state.position, positions) << nameOf(solver);
  }
}

TEST(Copy, GoesOnByItselfAndAlike)
{
  for (SolverKind solver : { SolverKind::XPBD, SolverKind::FORCE_SPRINGS })
  {
    SimulationParams params = tearable(solver);
    params.solver.max_substeps = 32;
    Simulation simulation = hanging(params);
    pullDown(simulation);
    run(simulation, 400);

    Simulation copy = simulation;
    const std::uint64_t hash = simulation.stateHash();
    const std::size_t tears = run(copy, 400).size();
    EXPECT_EQ(simulation.stateHash(), hash) << "the original stands still";
    EXPECT_EQ(run(simulation, 400).size(), tears);
    EXPECT_EQ(simulation.stateHash(), copy.stateHash()) << nameOf(solver);
    EXPECT_GT(copy.revision(), 0u);

    Simulation other(sheet(1, 1, 3, 3), {}, vacuum());
    other = simulation;
    EXPECT_EQ(other.stateHash(), simulation.stateHash());
  }
}

TEST(Log, HandsOutTearsFromANumberOn)
{
  const Simulation simulation = torn();
  const auto [oldest, newest] = simulation.loggedTears();
  EXPECT_EQ(oldest, 1u);
  ASSERT_GT(newest, 5u);

  EXPECT_EQ(simulation.tearsSince(1, 1000).size(), newest);
  EXPECT_EQ(simulation.tearsSince(0, 1000).size(), newest);
  const std::vector<TearEvent> some = simulation.tearsSince(3, 2);
  ASSERT_EQ(some.size(), 2u);
  EXPECT_EQ(some[0].sequence, 3u);
  EXPECT_EQ(some[1].sequence, 4u);
  EXPECT_TRUE(simulation.tearsSince(newest + 1, 1000).empty());
  EXPECT_TRUE(simulation.tearsSince(1, 0).empty());
}

TEST(Log, KeepsTheNewestWhenItIsFull)
{
  SimulationParams params = tearable();
  params.tear_log_size = 3;
  const Simulation simulation = torn(params);
  const auto [oldest, newest] = simulation.loggedTears();
  EXPECT_EQ(newest, simulation.revision());
  EXPECT_EQ(oldest, newest - 2);
  EXPECT_EQ(simulation.tearsSince(1, 1000).size(), 3u);
  EXPECT_EQ(Simulation(sheet(1, 1, 3, 3), {}, vacuum()).loggedTears(),
            (std::array<std::uint64_t, 2>{ 1, 0 }));
}

class Runaway : public ::testing::Test
{
protected:
  static SimulationParams parameters()
  {
    SimulationParams params = untearable();
    params.runaway_strain = 2.0;
    return params;
  }
  void expectUndone(const std::string& words)
  {
    const std::uint64_t hash = simulation.stateHash();
    const double time = simulation.time();
    const StepReport report = simulation.step();
    EXPECT_NE(report.fault.find(words), std::string::npos) << report.fault;
    EXPECT_NE(report.fault.find("the step was undone"), std::string::npos) << report.fault;
    EXPECT_TRUE(report.tears.empty());
    EXPECT_EQ(simulation.stateHash(), hash);
    EXPECT_EQ(simulation.time(), time);
    EXPECT_EQ(simulation.stepCount(), 300u);
  }
  ParticleState& state() { return const_cast<Cloth&>(simulation.cloth()).state; }
  void SetUp() override { run(simulation, 300); }

  Simulation simulation = hanging(parameters());
};

TEST_F(Runaway, IsUndoneWhenAParticleIsTooFast)
{
  state().velocity[100] = Vec3(0, 300, 0);
  expectUndone("beyond max_speed = 200");
}

TEST_F(Runaway, IsUndoneWhenASpringIsOverstrained)
{
  state().position[100] = Vec3(0, 0, -4);
  expectUndone("exceeds runaway_strain = 2");
}

TEST_F(Runaway, IsUndoneWhenSomethingIsNotANumber)
{
  state().velocity[100].x() = std::numeric_limits<Real>::quiet_NaN();
  expectUndone("");
  EXPECT_TRUE(state().position[99].allFinite()) << "and has not spread";
}

TEST_F(Runaway, TakesSpheresAndGraspsBackToo)
{
  pullDown(simulation);
  ThrowRequest thrown;
  thrown.center = Vec3d(0, -3, 0);
  thrown.velocity = Vec3d(0, 1, 0);
  thrown.lifetime = 0.0005;  // gone in the step that is undone
  simulation.throwSphere(thrown);
  state().velocity[3] = Vec3(0, 0, 0);
  state().velocity[70] = Vec3(0, 300, 0);
  expectUndone("max_speed");
  EXPECT_EQ(simulation.spheres().size(), 1u);
  EXPECT_TRUE(simulation.grasps()[0].target.has_value());
}

/// Two sheets, one pinned and one loose, as one model; the loose one has the higher numbers.
ClothModel twoSheets(const Vec3d& second_at)
{
  ClothModel model = upright(sheet(1.0, 1.0, 4, 4));
  const ClothModel other = moved(sheet(0.3, 0.3, 3, 3), second_at);
  for (const Vec3d& x : other.positions)
  {
    model.positions.push_back(x);
  }
  for (ModelTriangle t : other.triangles)
  {
    for (int& v : t.vertices)
    {
      v += 16;
    }
    model.triangles.push_back(t);
  }
  return model;
}

SimulationParams narrowWorld(const Vec3d& low)
{
  SimulationParams params = untearable();
  params.contact.bounds_min = low;
  params.contact.bounds_max = Vec3d::Constant(50.0);
  return params;
}

TEST(Bounds, PutALoosePieceToRestAndSaySoOnce)
{
  Simulation simulation(twoSheets(Vec3d(3, 0, 0)), { 0, 3 }, narrowWorld(Vec3d(-9, -9, -3)));
  int said = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const StepReport report = simulation.step();
    ASSERT_TRUE(report.fault.empty());
    for (const std::string& note : report.notes)
    {
      EXPECT_EQ(note, "a loose piece of 9 particles left the bounds and was put to rest");
      ++said;
    }
  }
  EXPECT_EQ(said, 1);
  EXPECT_EQ(simulation.summary().pieces, 2);
  EXPECT_EQ(simulation.summary().pieces_at_rest, 1);
  const Vec3 where = simulation.cloth().state.position[20];
  EXPECT_LT(where.z(), -3);
  EXPECT_GT(where.z(), -6);
  run(simulation, 100);
  EXPECT_EQ(simulation.cloth().state.position[20], where) << "no longer stepped";
  EXPECT_EQ(simulation.cloth().state.velocity[20], Vec3::Zero().eval());
  EXPECT_EQ(simulation.snapshot().surface.topology->triangles.size(), 18u) << "nor drawn";
  EXPECT_NEAR(simulation.summary().rest_area, 1.09, 1e-9) << "but kept";
  GraspRequest request;
  request.point = where.cast<double>();
  EXPECT_THROW(simulation.grasp(request), Refusal);
}

TEST(Bounds, LeaveAPieceThatIsHeldAlone)
{
  Simulation simulation(twoSheets(Vec3d(3, 0, 0)), { 0, 3, 16 }, narrowWorld(Vec3d(-9, -9, -0.1)));
  run(simulation, 500);
  EXPECT_EQ(simulation.summary().pieces_at_rest, 0);
}

TEST(Bounds, PutALoosePieceToRestAlsoWhereAPinnedOneHangsOut)
{
  Simulation simulation(twoSheets(Vec3d(3, 0, 0)), { 0, 3 }, narrowWorld(Vec3d(-9, -9, -0.5)));
  run(simulation, 1000);
  EXPECT_EQ(simulation.summary().pieces_at_rest, 1);
}

TEST(StateHash, DiffersWithAnythingThatDecidesWhatComesNext)
{
  Simulation simulation = hanging(untearable());
  pullDown(simulation);
  simulation.setSpheres({ Sphere() });
  const auto differs = [&](const std::function<void(Simulation&)>& change)
  {
    Simulation other = simulation;
    EXPECT_EQ(other.stateHash(), simulation.stateHash());
    change(other);
    return other.stateHash() != simulation.stateHash();
  };
  const auto state = [](Simulation& s) -> ParticleState&
  { return const_cast<Cloth&>(s.cloth()).state; };
  EXPECT_TRUE(differs([&](Simulation& s) { state(s).position[5].x() += Real(1e-6); }));
  EXPECT_TRUE(differs([&](Simulation& s) { state(s).velocity[50].y() = Real(1e-20); }));
  EXPECT_TRUE(differs([](Simulation& s) { s.releaseAll(); }));
  EXPECT_TRUE(differs([](Simulation& s) { s.throwSphere(ThrowRequest()); }));
  EXPECT_TRUE(differs(
      [](Simulation& s)
      {
        Sphere moved;
        moved.center.x() = 0.01;
        s.setSpheres({ moved });
      }));
  EXPECT_TRUE(differs(
      [](Simulation& s)
      {
        DragTarget target;
        target.pose.position = Vec3d(0, 0, 3);
        s.drag(s.grasps()[0].id, target);
      }));
  EXPECT_TRUE(differs(
      [](Simulation& s)
      {
        DragTarget target = *s.grasps()[0].target;
        target.linear_speed *= 2.0;
        s.drag(s.grasps()[0].id, target);
      }));
}

TEST(Parameters, AreRefusedAllAtOnceByName)
{
  SimulationParams params;
  params.material.stiffness = 0.0;
  params.environment.air_friction = -1.0;
  params.solver.time_step = 1.0;
  params.tearing.tear_strain = 0.0;
  params.contact.thickness = 0.0;
  params.max_grasp_distance = 0.0;
  params.grasp_force_filter = -1.0;
  params.max_gripper_speed = 0.0;
  params.max_gripper_turn = 101.0;
  params.max_speed = 0.0;
  params.runaway_strain = std::nan("");
  params.threads = 257;
  params.tear_log_size = 0;
  try
  {
    Simulation(sheet(1, 1, 3, 3), {}, params);
    FAIL() << "must be refused";
  }
  catch (const Refusal& refusal)
  {
    const std::string what = refusal.what();
    for (const char* field :
         { "stiffness [N/m]", "air_friction", "time_step", "tear_strain", "thickness",
           "max_grasp_distance", "grasp_force_filter", "max_gripper_speed", "max_gripper_turn",
           "max_speed", "runaway_strain", "threads", "tear_log_size" })
    {
      EXPECT_NE(what.find(field), std::string::npos) << field << "\nnot in\n" << what;
    }
  }
  EXPECT_TRUE(problems(SimulationParams()).empty());
}

TEST(Motion, TooSmallForNormalNumbersIsZeroInAStepAndThereAlone)
{
  SimulationParams params = vacuum();
  params.environment.gravity = Vec3d(0, 0, -1e-37);
  Simulation simulation(sheet(1, 1, 5, 5), { 0 }, params);

  simulation.step();

  for (const Vec3& v : simulation.cloth().state.velocity)
  {
    EXPECT_NE(std::fpclassify(v.z()), FP_SUBNORMAL);
  }
  volatile float smallest = std::numeric_limits<float>::min();
  EXPECT_GT(smallest / 2.0f, 0.0f) << "the caller's arithmetic is its own";
}

TEST(Model, IsRefusedTooFarFromItsOriginForFloatPositions)
{
  ClothModel model = sheet(1, 1, 3, 3);
  model.positions[4].y() = MAX_COORDINATE + 1.0;
  try
  {
    Simulation(model, {}, SimulationParams());
    FAIL() << "must be refused";
  }
  catch (const Refusal& refusal)
  {
    EXPECT_NE(std::string(refusal.what()).find("reaches 1001 m"), std::string::npos)
        << refusal.what();
  }
}

TEST(Summary, CountsAThirtyByThirtyRectangleAsTheThesisDoes)
{
  Simulation simulation(rectangle(RectangleParams()), {}, vacuum());
  const Summary summary = simulation.summary();
  EXPECT_EQ(summary.particles, 900);
  EXPECT_EQ(summary.springs, 2581);
  EXPECT_EQ(summary.bend_shear_springs, 2465);
  EXPECT_EQ(summary.triangles, 1682);
  EXPECT_EQ(summary.pieces, 1);
  EXPECT_NEAR(summary.rest_area, 1.0, 1e-12);
  EXPECT_NEAR(summary.mass, 0.15, 1e-12);
}

}  // namespace
}  // namespace cloth
