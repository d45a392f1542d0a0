// Claims about saved states: a restored cloth does what the original would have done, bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <regex>
#include <set>
#include <sstream>

#include "cloth_tearing/core/archive.h"
#include "cloth_tearing/core/simulation_loop.h"
#include "determinism_scenes.h"
#include "scenes.h"

namespace cloth
{
namespace
{

constexpr int BEFORE = 100;  // steps before a state is saved
constexpr int AFTER = 150;   // steps in which what goes on from it is compared
constexpr std::size_t CHECKSUM_SIZE = 8;

/// Wind, a floor, a streamed sphere, two thrown ones and a gripper that drags, all at once.
Simulation everythingAtOnce(const determinism::Choice& solver)
{
  Simulation simulation = determinism::curtain(solver);
  determinism::drape(simulation);
  determinism::drag(simulation);
  determinism::shoot(simulation);
  return simulation;
}

std::vector<std::uint64_t> hashesOf(Simulation& simulation, int steps)
{
  const FloatTraps traps;
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < steps; ++i)
  {
    simulation.step();
    hashes.push_back(simulation.stateHash());
  }
  return hashes;
}

/// A cloth that has nothing in common with those that are restored into it.
Simulation another(std::uint64_t life = 2)
{
  const ClothModel model = sheet(0.4, 0.3, 4, 3);
  SimulationParams params;
  params.solver.time_step = 0.0005;
  params.life = life;
  return { upright(model), edgeOf(model, "top"), params };
}

/// `bytes` with the checksum that belongs to them.
std::string sealed(std::string bytes)
{
  const std::size_t end = bytes.size() - CHECKSUM_SIZE;
  ArchiveWriter writer;
  writer("checksum", checksum(bytes.data(), end));
  return bytes.replace(end, CHECKSUM_SIZE, writer.bytes());
}

std::string reasonAgainst(const Simulation& simulation, const std::string& bytes)
{
  try
  {
    simulation.restored(bytes);
    return "";
  }
  catch (const Refusal& refusal)
  {
    return refusal.what();
  }
}

class SavedState : public ::testing::TestWithParam<determinism::Choice>
{
};

TEST_P(SavedState, GoesOnBitForBitInTheSimulationThatSavedIt)
{
  Simulation simulation = everythingAtOnce(GetParam());
  run(simulation, BEFORE);
  const std::string state = simulation.save();
  const std::uint64_t hash = simulation.stateHash();
  const std::uint64_t tears = simulation.revision();
  const std::vector<std::uint64_t> hashes = hashesOf(simulation, AFTER);
  ASSERT_GT(tears, 5u) << "it has to tear before the state is saved";
  ASSERT_GT(simulation.revision(), tears + 5) << "and to go on tearing";

  simulation = simulation.restored(state);

  EXPECT_EQ(simulation.stateHash(), hash);
  EXPECT_EQ(simulation.revision(), tears);
  EXPECT_EQ(hashesOf(simulation, AFTER), hashes);
}

TEST_P(SavedState, GoesOnBitForBitInASimulationOfAnotherModel)
{
  Simulation original = everythingAtOnce(GetParam());
  run(original, BEFORE);
  Simulation copy = another();
  run(copy, 10);

  copy = copy.restored(original.save());

  EXPECT_EQ(copy.stateHash(), original.stateHash());
  EXPECT_EQ(hashesOf(copy, AFTER), hashesOf(original, AFTER));
}

TEST_P(SavedState, GoesOnBitForBitFromAnyStep)
{
  Simulation original = everythingAtOnce(GetParam());
  for (int i = 0; i < 12; ++i)
  {
    Simulation copy = another().restored(original.save());
    run(original, 20);
    run(copy, 20);
    ASSERT_EQ(copy.stateHash(), original.stateHash()) << "saved after step " << 20 * i;
  }
}

TEST_P(SavedState, AnswersRequestsAsTheOriginalDoes)
{
  Simulation original = everythingAtOnce(GetParam());
  run(original, BEFORE);
  Simulation copy = another().restored(original.save());
  for (Simulation* simulation : { &original, &copy })
  {
    simulation->releaseAll();
    GraspRequest request;
    request.point = Vec3d(-0.45, 0.0, -0.95);
    request.radius = 0.35;
    EXPECT_EQ(simulation->grasp(request).id, 2u);
    EXPECT_EQ(simulation->throwSphere({}), 3u);
    determinism::drape(*simulation);  // the streamed sphere goes back to where it came from
  }

  EXPECT_EQ(hashesOf(copy, AFTER), hashesOf(original, AFTER));
}

TEST_P(SavedState, BringsTheUntornClothAlong)
{
  Simulation original = everythingAtOnce(GetParam());
  run(original, BEFORE);
  Simulation copy = another().restored(original.save());

  original.reset();
  copy.reset();

  EXPECT_EQ(copy.revision(), 0u);
  EXPECT_EQ(copy.stateHash(), original.stateHash());
  EXPECT_EQ(hashesOf(copy, AFTER), hashesOf(original, AFTER));
}

TEST_P(SavedState, IsTheSameWhenSavedAgain)
{
  Simulation simulation = everythingAtOnce(GetParam());
  run(simulation, BEFORE);
  const std::string state = simulation.save();

  EXPECT_EQ(simulation.restored(state).save(), state);
}

/// A gripper on its way when a state is saved, in three kinds of ways.
TEST_P(SavedState, GoesOnWithGlidesAndPulls)
{
  GraspRequest request;
  request.point = Vec3d(0.1, 0.0, -0.9);
  request.radius = 0.2;
  request.frame.position = request.point;
  Pose goal;
  goal.position = Vec3d(0.4, -0.3, -1.2);
  goal.rotation = Quatd(0.8, 0.0, 0.6, 0.0);
  PullRequest pull;
  pull.grasp = 1;
  pull.target.pose = goal;
  pull.target.linear_speed = 2.0;
  pull.target.angular_speed = 3.0;
  const std::vector<std::function<void(Simulation&)>> ways = {
    [&](Simulation& simulation) { simulation.steer(1, goal, 0.2); },
    [&](Simulation& simulation) { simulation.pull(pull); },
    [&](Simulation& simulation)
    {
      PullRequest until_it_tears = pull;
      until_it_tears.stop_tears = 3;
      until_it_tears.release = true;
      simulation.pull(until_it_tears);
    },
  };
  for (const auto& go : ways)
  {
    Simulation original = determinism::curtain(GetParam());
    original.grasp(request);
    go(original);
    run(original, 30);
    Simulation copy = another().restored(original.save());
    EXPECT_EQ(hashesOf(copy, 2 * AFTER), hashesOf(original, 2 * AFTER));
    const std::vector<PullEnd> there = original.pullEndsSince(1, 10);
    const std::vector<PullEnd> here = copy.pullEndsSince(1, 10);
    ASSERT_EQ(here.size(), there.size());
    for (std::size_t i = 0; i < here.size(); ++i)
    {
      EXPECT_EQ(here[i].outcome, there[i].outcome);
      EXPECT_EQ(here[i].progress.duration, there[i].progress.duration);
      EXPECT_EQ(here[i].progress.tears, there[i].progress.tears);
      EXPECT_NE(here[i].progress.pull, there[i].progress.pull) << "nobody waits for it any more";
    }
  }
}

/// Without spheres and floor only springs that the solver saw stretched are looked at.
TEST_P(SavedState, GoesOnTearingWhereOnlyAGripperPulls)
{
  const ClothModel model = sheet(1.0, 1.0, 10, 10);
  SimulationParams params = determinism::parameters(GetParam());
  params.contact.floor = false;
  Simulation original(upright(model), edgeOf(model, "top"), params);
  determinism::drag(original);
  Simulation copy = another().restored(original.save());

  EXPECT_EQ(hashesOf(copy, 3 * AFTER), hashesOf(original, 3 * AFTER));
  EXPECT_GT(original.revision(), 0u);
}

INSTANTIATE_TEST_SUITE_P(AllSolvers, SavedState, ::testing::ValuesIn(determinism::allSolvers()),
                         [](const ::testing::TestParamInfo<determinism::Choice>& solver)
                         { return solver.param.name(); });

TEST(OneSavedState, KnowsPiecesAtRest)
{
  const ClothModel model = sheet(0.4, 0.4, 5, 5);
  SimulationParams params;
  params.contact.bounds_min.z() = -1.0;
  Simulation original(upright(model), {}, params);
  run(original, 800);
  ASSERT_EQ(original.summary().pieces_at_rest, 1);

  Simulation copy = another().restored(original.save());

  EXPECT_EQ(copy.summary().pieces_at_rest, 1);
  EXPECT_EQ(hashesOf(copy, 10), hashesOf(original, 10));
}

TEST(OneSavedState, ReturnsTheStepAndLetsTimeAndEpochRise)
{
  Simulation simulation = determinism::curtain(SolverKind::XPBD);
  run(simulation, 10);
  const std::string state = simulation.save();
  run(simulation, 30);
  const double time = simulation.time();

  simulation = simulation.restored(state);

  EXPECT_EQ(simulation.stepCount(), 10u);
  EXPECT_EQ(simulation.time(), time);
  EXPECT_EQ(simulation.epoch(), 1u);
  simulation.step();
  EXPECT_EQ(simulation.stepCount(), 11u);
  EXPECT_DOUBLE_EQ(simulation.time(), time + simulation.params().solver.time_step);
  simulation.reset();
  EXPECT_EQ(simulation.stepCount(), 0u);
  EXPECT_DOUBLE_EQ(simulation.time(), time + simulation.params().solver.time_step);
}

TEST(OneSavedState, ReturnsWhatWasCountedSinceTheReset)
{
  Simulation original = everythingAtOnce(SolverKind::XPBD);
  run(original, BEFORE);
  const Summary before = original.summary();

  const Summary after = another().restored(original.save()).summary();

  EXPECT_EQ(after.tears, before.tears);
  EXPECT_EQ(after.revision, before.revision);
  EXPECT_EQ(after.pieces, before.pieces);
  EXPECT_EQ(after.mass, before.mass);
  EXPECT_EQ(after.utilisation, before.utilisation);
}

TEST(OneSavedState, ReturnsTheParametersOfAStepAndLeavesThoseOfRequestsAndLogs)
{
  SimulationParams params = determinism::parameters(SolverKind::FORCE_SPRINGS);
  params.max_grasp_distance = 0.3;
  params.tear_log_size = 7;
  params.strength.spots.push_back({ Vec3d(0.0, 0.0, 0.0), 0.2, 0.5 });
  const ClothModel model = sheet(0.4, 0.4, 5, 5);
  Simulation original(model, edgeOf(model, "top"), params);
  TearRules rules = params.tearing;
  rules.enabled = false;
  original.setTearRules(rules);

  const SimulationParams after = another().restored(original.save()).params();

  EXPECT_EQ(after.solver.kind, SolverKind::FORCE_SPRINGS);
  EXPECT_EQ(after.solver.time_step, params.solver.time_step);
  EXPECT_EQ(after.material.stiffness, params.material.stiffness);
  EXPECT_EQ(after.environment.wind, params.environment.wind);
  EXPECT_TRUE(after.contact.floor);
  EXPECT_FALSE(after.tearing.enabled);
  EXPECT_EQ(after.strength.spots.size(), 1u);
  EXPECT_EQ(after.max_grasp_distance, SimulationParams().max_grasp_distance);
  EXPECT_EQ(after.tear_log_size, SimulationParams().tear_log_size);
  EXPECT_EQ(after.life, 2u);
}

TEST(OneSavedState, BringsTheFramesAlongThatSpheresFollow)
{
  Simulation original = another();
  Sphere finger;
  finger.id = 4;
  finger.frame = "finger";
  finger.center_in_frame = Vec3d(0.01, 0.02, 0.03);
  finger.center = Vec3d(5.0, 0.0, 0.0);
  original.setSpheres({ finger });

  const Simulation copy = another().restored(original.save());

  ASSERT_EQ(copy.spheres().size(), 1u);
  EXPECT_EQ(copy.spheres()[0].frame, "finger");
  EXPECT_EQ(copy.spheres()[0].center_in_frame, finger.center_in_frame);
}

/// Like another(), somewhere else.
Simulation anotherIn(const std::string& place)
{
  const ClothModel model = sheet(0.4, 0.3, 4, 3);
  SimulationParams params;
  params.place = place;
  return { model, edgeOf(model, "top"), params };
}

TEST(OneSavedState, IsRefusedInAnotherPlaceByBothNames)
{
  const std::string state = anotherIn("world at (0, 0, 1.5)").save();
  const std::string reason = reasonAgainst(anotherIn("map at (0, 0, 0)"), state);
  EXPECT_NE(reason.find("\"world at (0, 0, 1.5)\""), std::string::npos) << reason;
  EXPECT_NE(reason.find("\"map at (0, 0, 0)\""), std::string::npos) << reason;
  EXPECT_EQ(reasonAgainst(anotherIn("world at (0, 0, 1.5)"), state), "");
}

TEST(OneSavedState, IsOfThePlaceOfTheSimulationWhateverClothItTakes)
{
  Simulation simulation = anotherIn("world at (0, 0, 1.5)");
  simulation.takeCloth(anotherIn(""));
  EXPECT_EQ(reasonAgainst(anotherIn("world at (0, 0, 1.5)"), simulation.save()), "");
}

TEST(OneSavedState, EndsPresentGraspsAndTellsThoseThatItHolds)
{
  Simulation original = determinism::curtain(SolverKind::XPBD);
  determinism::drag(original);
  const std::string state = original.save();
  Simulation here = another();
  GraspRequest request;
  request.radius = 10.0;
  for (int i = 0; i < 2; ++i)
  {
    here.grasp(request);
    PullRequest pull;
    pull.grasp = here.grasps().front().id;
    here.pull(pull);

    here = here.restored(state);

    const std::vector<GraspEvent> events = here.graspEventsSince(1, 1000);
    ASSERT_GE(events.size(), 2u);
    const GraspEvent& ended = events[events.size() - 2];
    EXPECT_EQ(ended.kind, GraspEventKind::RELEASED);
    EXPECT_EQ(ended.grasp, pull.grasp);
    EXPECT_EQ(events.back().kind, GraspEventKind::TAKEN);
    EXPECT_EQ(events.back().grasp, 1u);
    EXPECT_EQ(events.back().epoch, here.epoch());
    EXPECT_EQ(here.pullEndsSince(1, 10).back().outcome, PullOutcome::LOST);
    here.releaseAll();
  }
  EXPECT_EQ(here.grasp(request).id, 3u) << "numbers of grasps never return";
}

// -- the log of tears -----------------------------------------------------------------------------

TEST(SavedStateLog, StaysAsItIsInTheLifeThatSavedTheState)
{
  Simulation simulation = everythingAtOnce(SolverKind::XPBD);
  run(simulation, BEFORE);
  const std::string state = simulation.save();
  run(simulation, AFTER);
  const auto logged = simulation.loggedTears();

  simulation = simulation.restored(state);

  EXPECT_EQ(simulation.loggedTears(), logged);
  run(simulation, AFTER);
  const std::vector<TearEvent> more = simulation.tearsSince(logged[1] + 1, 1);
  ASSERT_EQ(more.size(), 1u) << "it tears again, under new numbers";
  EXPECT_EQ(more[0].sequence, logged[1] + 1);
  EXPECT_EQ(more[0].epoch, 1u);
}

TEST(SavedStateLog, TakesInTheTearsOfAStateOfAnotherLifeOnce)
{
  Simulation original = everythingAtOnce(SolverKind::XPBD);
  run(original, BEFORE);
  Simulation here = everythingAtOnce(SolverKind::FORCE_SPRINGS);
  run(here, BEFORE);
  const std::uint64_t newest = here.loggedTears()[1];
  ASSERT_GT(newest, 0u);
  Simulation other = another().restored(here.save());  // life 2, with tears of its own
  const auto own = other.loggedTears();
  ASSERT_EQ(own[1], newest);
  const double time = other.time();

  for (int i = 0; i < 2; ++i)
  {
    other = other.restored(original.save());
    EXPECT_EQ(other.loggedTears()[1], own[1] + original.revision()) << "restored " << i + 1;
  }

  const std::vector<TearEvent> brought = other.tearsSince(own[1] + 1, 1000000);
  const std::vector<TearEvent> theirs = original.tearsSince(1, 1000000);
  ASSERT_EQ(brought.size(), theirs.size());
  for (std::size_t i = 0; i < theirs.size(); ++i)
  {
    EXPECT_EQ(brought[i].sequence, own[1] + 1 + i);
    EXPECT_EQ(brought[i].epoch, 2u);
    EXPECT_EQ(brought[i].time, time);
    EXPECT_EQ(brought[i].step, theirs[i].step);
    EXPECT_EQ(brought[i].kind, theirs[i].kind);
    EXPECT_EQ(brought[i].spring, theirs[i].spring);
    EXPECT_EQ(brought[i].position, theirs[i].position);
    EXPECT_EQ(brought[i].particles.size(), theirs[i].particles.size());
  }
}

TEST(SavedStateLog, OfAStateHasOnlyTheTearsThatMadeItsCloth)
{
  Simulation simulation = everythingAtOnce(SolverKind::XPBD);
  run(simulation, BEFORE);
  const std::string torn = simulation.save();
  const std::uint64_t tears = simulation.revision();
  simulation.reset();
  EXPECT_EQ(another().restored(simulation.save()).loggedTears()[1], 0u) << "an untorn cloth";
  simulation = simulation.restored(torn);
  run(simulation, AFTER);
  ASSERT_GT(simulation.revision(), tears);

  const Simulation other = another().restored(simulation.save());

  EXPECT_EQ(other.loggedTears()[1], simulation.revision());
  EXPECT_EQ(other.tearsSince(1, 1000000).back().step,
            simulation.tearsSince(1, 1000000).back().step);
}

// -- the loop ------------------------------------------------------------------------------------

TEST(SavedStateLoop, IsRestoredBetweenStepsAndCutsAStepShort)
{
  SimulationLoop::Options options;
  options.pace = Pace::STEP;
  options.patience = std::chrono::seconds(20);
  std::promise<void> running;
  std::once_flag once;
  SimulationLoop loop(std::make_unique<Simulation>(another()), options,
                      [&](const Simulation&, const StepReport&)
                      { std::call_once(once, [&] { running.set_value(); }); });
  const std::string state = loop.call([](Simulation& simulation) { return simulation.save(); });
  auto stepping = std::async(std::launch::async, [&] { return loop.step(1000000000); });
  running.get_future().wait();

  EXPECT_THROW(loop.restore("no state"), Refusal);
  const StepAnswer restored = loop.restore(state);

  const StepAnswer cut = stepping.get();
  EXPECT_NE(cut.cut_short.find("restored"), std::string::npos);
  EXPECT_GT(cut.step, 0u);
  EXPECT_EQ(cut.epoch, 0u);
  EXPECT_EQ(restored.step, 0u);
  EXPECT_EQ(restored.epoch, 1u);
  EXPECT_EQ(restored.state_hash, another().stateHash());
}

// -- bytes that are no state ----------------------------------------------------------------------

TEST(SavedStateBytes, AreRefusedWhenTheyAreNoneOrOfAnotherKind)
{
  const Simulation simulation = another();
  const std::string state = simulation.save();
  EXPECT_NE(reasonAgainst(simulation, "").find("no saved state"), std::string::npos);
  EXPECT_NE(reasonAgainst(simulation, std::string(1000, 'x')).find("no saved state"),
            std::string::npos);

  std::string newer = state;
  newer[8] = 99;
  EXPECT_NE(reasonAgainst(simulation, sealed(newer)).find("format 99"), std::string::npos);
  std::string wide = state;
  wide[12] = 8;
  EXPECT_NE(reasonAgainst(simulation, sealed(wide)).find("8 bytes wide"), std::string::npos);
  EXPECT_NE(reasonAgainst(simulation, sealed(state + "more")).find("left over"), std::string::npos);
}

TEST(SavedStateBytes, AreRefusedWithOneByteChanged)
{
  const Simulation simulation = another();
  const std::string state = simulation.save();
  const std::uint64_t hash = simulation.stateHash();
  for (std::size_t at = 0; at < state.size(); ++at)
  {
    std::string damaged = state;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    ASSERT_NE(reasonAgainst(simulation, damaged), "") << "byte " << at;
  }
  EXPECT_EQ(simulation.stateHash(), hash);
}

/// A small torn cloth with everything that a state may hold.
Simulation smallAndTorn(const determinism::Choice& solver)
{
  const ClothModel model = sheet(0.3, 0.3, 4, 4);
  SimulationParams params = determinism::parameters(solver);
  params.strength.spots.push_back({ Vec3d(0.0, 0.0, 0.0), 1.0, 0.9 });
  params.strength.lines.push_back({ Vec3d(-1.0, 0.0, 0.0), Vec3d(1.0, 0.0, 0.0), 0.1, 0.9 });
  params.strength.perforations.push_back({ params.strength.lines[0], 0.1, 0.5 });
  Simulation simulation(upright(model), edgeOf(model, "top"), params);
  GraspRequest request;
  request.point = Vec3d(0.0, 0.0, -0.3);
  request.radius = 0.12;
  DragTarget target;
  target.pose.position = Vec3d(0.1, 0.0, -0.9);
  target.linear_speed = 2.0;
  simulation.drag(simulation.grasp(request).id, target);
  simulation.throwSphere({});
  Sphere sphere;
  sphere.center = Vec3d(5.0, 0.0, 0.0);
  sphere.frame = "finger";
  simulation.setSpheres({ sphere });
  run(simulation, 120);
  return simulation;
}

/// Every change that a reader's own checks must bear: the checksum is right. What is accepted all
/// the same has to run.
void bearChanges(const Simulation& simulation, const std::string& state,
                 const std::function<unsigned char(unsigned char)>& change)
{
  const std::uint64_t hash = simulation.stateHash();
  int refused = 0;
  for (std::size_t at = 0; at + CHECKSUM_SIZE < state.size(); ++at)
  {
    std::string changed = state;
    changed[at] = static_cast<char>(change(static_cast<unsigned char>(changed[at])));
    try
    {
      Simulation restored = simulation.restored(sealed(changed));
      for (int i = 0; i < 3; ++i)
      {
        restored.step();
      }
      restored.summary();
      restored.snapshot();
    }
    catch (const Refusal& refusal)
    {
      ++refused;
      ASSERT_NE(refusal.what(), std::string()) << "byte " << at;
    }
    ASSERT_EQ(simulation.stateHash(), hash);
  }
  EXPECT_GT(refused, static_cast<int>(state.size() / 10)) << "most of a mesh cannot be changed";
}

class SavedStateBytesOf : public ::testing::TestWithParam<determinism::Choice>
{
};

TEST_P(SavedStateBytesOf, AnyStateThatIsCutOffAreRefused)
{
  const Simulation simulation = smallAndTorn(GetParam());
  ASSERT_GT(simulation.revision(), 0u);
  const std::string state = simulation.save();
  for (std::size_t size = 0; size < state.size(); ++size)
  {
    const std::string cut = state.substr(0, size);
    ASSERT_NE(reasonAgainst(simulation, cut), "") << size;
    if (size > CHECKSUM_SIZE)
    {
      ASSERT_NE(reasonAgainst(simulation, sealed(cut)), "") << size;
    }
  }
}

TEST_P(SavedStateBytesOf, AnyStateWithOneByteChangedAreRefusedOrRun)
{
  const Simulation simulation = smallAndTorn(GetParam());
  const std::string state = simulation.save();
  bearChanges(simulation, state, [](unsigned char byte) { return byte ^ 0x01; });
  bearChanges(simulation, state, [](unsigned char) { return 0xff; });
}

TEST(RestoredState, IsSteppedByAsManyThreadsAsItsOwnClothWants)
{
  SimulationParams params = tearable();
  params.threads = 2;
  const auto sheetOf = [&params](int side)
  { return Simulation(upright(sheet(1.0, 1.0, side, side)), { 0 }, params); };
  const Simulation small = sheetOf(20);
  const Simulation large = sheetOf(70);
  ASSERT_EQ(small.threads(), 1);
  ASSERT_EQ(large.threads(), 2);

  EXPECT_EQ(small.restored(large.save()).threads(), 2);
  EXPECT_EQ(large.restored(small.save()).threads(), 1);
}

INSTANTIATE_TEST_SUITE_P(AllSolvers, SavedStateBytesOf,
                         ::testing::ValuesIn(determinism::allSolvers()),
                         [](const ::testing::TestParamInfo<determinism::Choice>& solver)
                         { return solver.param.name(); });

// -- nothing is forgotten -------------------------------------------------------------------------

/// Members that a transfer function names and leaves out on purpose.
const std::set<std::string> LEFT_OUT = {
  "max_grasp_distance of params",
  "tear_log_size of params",
  "limits of params",
  "life of params",
  "place of params",
  "news of grippers",
  "solver of simulation",  // `memory` stands for it
  "contact of simulation",
  "tearing of simulation",
  "loose_pieces of simulation",
  "acceleration of simulation",
  "outer of simulation",
  "suspects of simulation",
  "undo of simulation",
  "balance of simulation",
  "wanted_until of simulation",
  "log of simulation",
  "grasp_log of simulation",
  "pull_log of simulation",
  "adopted of simulation",
  "start_time of simulation",
  "start_step of simulation",
  "epoch of simulation",
  "workers of simulation",
  "recorder of simulation",  // who records it is nobody else's matter
  "threads of params",
  "changes of springs",  // whoever follows them has: a step ends with that
};

TEST(Transfer, WritesEveryMemberThatItNames)
{
  // A structure with a member more does not compile there; one that is named but not written does.
  std::ifstream file(CLOTH_TEARING_SOURCE_DIR "/include/cloth_tearing/core/transfer.h");
  std::stringstream text;
  text << file.rdbuf();
  const std::string source = text.str();
  const std::regex binding("auto& \\[([^\\]]*)\\] = (\\w+);([\\s\\S]*?)\n\\}");
  const std::regex name("\\w+");
  int structures = 0;
  for (std::sregex_iterator at(source.begin(), source.end(), binding), none; at != none; ++at)
  {
    const std::string names = (*at)[1];
    const std::string body = (*at)[3];
    ++structures;
    for (std::sregex_iterator n(names.begin(), names.end(), name); n != none; ++n)
    {
      const std::string member = n->str();
      const std::string whose = member + " of " + at->str(2);
      const std::string call = "\"" + member + "\", " + member;
      EXPECT_NE(body.find(call) != std::string::npos, LEFT_OUT.count(whose) > 0) << whose;
    }
  }
  EXPECT_GT(structures, 25);
}

}  // namespace
}  // namespace cloth
