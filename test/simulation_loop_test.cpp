// Claims of the loop and its queue: exact steps, commands between steps, patience, pace, ending.
#include "cloth_tearing/core/simulation_loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "scenes.h"

namespace cloth
{
namespace
{

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

/// Longer than anything here takes on a busy machine.
constexpr seconds DEADLINE{ 60 };

/// @param time_step [s]
Simulation smallSimulation(double time_step)
{
  const ClothModel flat = sheet(0.5, 0.5, 6, 6);
  SimulationParams params = untearable();
  params.solver.time_step = time_step;
  return { upright(flat), edgeOf(flat, "top"), params };
}

std::unique_ptr<Simulation> smallSimulation()
{
  return std::make_unique<Simulation>(smallSimulation(0.001));
}

SimulationLoop::Options options(Pace pace, milliseconds patience = DEADLINE)
{
  SimulationLoop::Options options;
  options.pace = pace;
  options.patience = patience;
  return options;
}

void ignore(const Simulation&, const StepReport&)
{
}

/// A door that a listener waits at, so that a step takes as long as a test wants.
class Gate
{
public:
  void open()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    open_ = true;
    changed_.notify_all();
  }
  void pass()
  {
    std::unique_lock<std::mutex> lock(mutex_);
    ++waiting_;
    changed_.notify_all();
    EXPECT_TRUE(changed_.wait_for(lock, DEADLINE, [this] { return open_; }));
  }
  void awaitVisitor()
  {
    std::unique_lock<std::mutex> lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, DEADLINE, [this] { return waiting_ > 0; }));
  }

private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool open_ = false;
  int waiting_ = 0;
};

/// Waits until the answer is there, but not for ever.
template <class Answer>
Answer inTime(std::future<Answer>& future)
{
  if (future.wait_for(DEADLINE) != std::future_status::ready)
  {
    std::cerr << "no answer within the deadline\n";
    std::abort();  // the future's own destructor would wait for ever
  }
  return future.get();
}

/// Waits for a condition that another thread brings about.
template <class Condition>
bool eventually(Condition&& condition)
{
  const Clock::time_point end = Clock::now() + DEADLINE;
  while (!condition())
  {
    if (Clock::now() > end)
    {
      return false;
    }
    std::this_thread::yield();
  }
  return true;
}

TEST(LoopSteps, ExactlyAsOftenAsAskedAndAnswersWhenItIsDone)
{
  std::atomic<int> listened{ 0 };
  SimulationLoop loop(smallSimulation(), options(Pace::STEP),
                      [&](const Simulation&, const StepReport&) { ++listened; });

  const StepAnswer answer = loop.step(137);

  EXPECT_EQ(listened, 137);
  EXPECT_EQ(answer.steps, 137u);
  EXPECT_EQ(answer.step, 137u);
  EXPECT_NEAR(answer.time, 0.137, 1e-9);
  EXPECT_TRUE(answer.cut_short.empty());
  Simulation alone = *smallSimulation();
  run(alone, 137);
  EXPECT_EQ(answer.state_hash, alone.stateHash()) << "as without a loop";
}

TEST(LoopSteps, ZeroOnlyAsks)
{
  SimulationLoop loop(smallSimulation(), options(Pace::STEP), ignore);
  loop.step(5);
  const StepAnswer answer = loop.step(0);
  EXPECT_EQ(answer.steps, 0u);
  EXPECT_EQ(answer.step, 5u);
}

TEST(LoopSteps, ServesTwoClientsOneAfterTheOther)
{
  Gate gate;
  SimulationLoop loop(smallSimulation(), options(Pace::STEP),
                      [&](const Simulation& s, const StepReport&)
                      {
                        if (s.stepCount() == 1)
                        {
                          gate.pass();
                        }
                      });
  auto first = std::async(std::launch::async, [&] { return loop.step(300); });
  gate.awaitVisitor();
  auto second = std::async(std::launch::async, [&] { return loop.step(200); });
  gate.open();

  EXPECT_EQ(inTime(first).step, 300u);
  const StepAnswer answer = inTime(second);
  EXPECT_EQ(answer.steps, 200u);
  EXPECT_EQ(answer.step, 500u);
  EXPECT_EQ(loop.step(0).step, 500u) << "and then it stands";
}

TEST(LoopSteps, ZeroBehindALongStepAsksWhenThatIsDone)
{
  Gate gate;
  SimulationLoop loop(smallSimulation(), options(Pace::STEP),
                      [&](const Simulation& s, const StepReport&)
                      {
                        if (s.stepCount() == 1)
                        {
                          gate.pass();
                        }
                      });
  auto first = std::async(std::launch::async, [&] { return loop.step(30000); });
  gate.awaitVisitor();
  auto second = std::async(std::launch::async, [&] { return loop.step(0); });
  gate.open();

  EXPECT_EQ(inTime(first).step, 30000u);
  const StepAnswer answer = inTime(second);
  EXPECT_EQ(answer.steps, 0u);
  EXPECT_EQ(loop.step(0).step, 30000u) << "nothing steps on";
}

TEST(LoopSteps, AreRefusedWhileItRunsByItself)
{
  SimulationLoop loop(smallSimulation(), options(Pace::FREE), ignore);
  EXPECT_THROW(loop.step(1), Refusal);
  EXPECT_THROW(loop.step(0), Refusal);
  loop.pause();
  const std::uint64_t before = loop.step(0).step;
  EXPECT_EQ(loop.step(3).step, before + 3);
}

TEST(LoopCommands, AreAnsweredWhileALongStepIsUnderWay)
{
  SimulationLoop loop(smallSimulation(), options(Pace::STEP), ignore);
  auto endless = std::async(std::launch::async, [&] { return loop.step(1000000000); });
  ASSERT_TRUE(
      eventually([&] { return loop.call([](Simulation& s) { return s.stepCount(); }) > 10; }));

  const GraspTaken taken = loop.call(
      [](Simulation& s)
      {
        GraspRequest request;
        request.point = s.cloth().state.position[35].cast<double>();
        request.radius = 0.01;
        return s.grasp(request);
      });
  EXPECT_EQ(taken.held_particles, 1);
  EXPECT_EQ(loop.call([](Simulation& s) { return s.releaseAll(); }), 1);
  loop.pause();
  EXPECT_TRUE(loop.state().paused);
  loop.resume();
  EXPECT_GT(loop.call([](Simulation& s) { return s.summary(); }).step, 10u);

  loop.reset();
  const StepAnswer answer = inTime(endless);
  EXPECT_LT(answer.steps, 1000000000u);
  EXPECT_EQ(answer.cut_short, "the simulation was reset");
}

TEST(LoopCommands, CarryTheirExceptionsBack)
{
  SimulationLoop loop(smallSimulation(), options(Pace::STEP), ignore);
  EXPECT_THROW(loop.call([](Simulation& s) { s.release(77); }), Refusal);
  EXPECT_THROW(loop.call([](Simulation&) -> int { throw std::out_of_range("x"); }),
               std::out_of_range);
  EXPECT_EQ(loop.step(1).step, 1u) << "and it goes on";
}

TEST(LoopCommands, AreBusyAfterTheirPatienceAndNotRunLater)
{
  Gate gate;
  SimulationLoop loop(smallSimulation(), options(Pace::STEP, milliseconds(20)),
                      [&](const Simulation&, const StepReport&) { gate.pass(); });
  auto stepping = std::async(std::launch::async, [&] { return loop.step(1); });
  gate.awaitVisitor();
  std::atomic<bool> ran{ false };

  EXPECT_THROW(loop.call([&](Simulation&) { ran = true; }), Busy);

  gate.open();
  EXPECT_EQ(inTime(stepping).step, 1u);
  EXPECT_TRUE(eventually(
      [&]
      {
        try
        {
          loop.call([](Simulation&) {});
          return true;
        }
        catch (const Busy&)
        {
          return false;
        }
      }));
  EXPECT_FALSE(ran);
}

TEST(LoopCommands, ThatArePostedHoldUpNobodyAndRunInTheirOrder)
{
  Gate gate;
  SimulationLoop loop(smallSimulation(), options(Pace::STEP),
                      [&](const Simulation&, const StepReport&) { gate.pass(); });
  auto stepping = std::async(std::launch::async, [&] { return loop.step(1); });
  gate.awaitVisitor();
  std::vector<int> ran;
  for (int i = 0; i < 3; ++i)
  {
    loop.post([&ran, i](Simulation&) { ran.push_back(i); });
  }
  EXPECT_TRUE(ran.empty()) << "the loop stands at the gate";

  gate.open();
  inTime(stepping);
  EXPECT_EQ(loop.call([&](Simulation&) { return ran; }), (std::vector<int>{ 0, 1, 2 }));
  loop.stop();
  EXPECT_THROW(loop.post([](Simulation&) {}), Busy);
}

TEST(LoopPace, FreeRunsUntilPausedAndGoesOnAfterwards)
{
  SimulationLoop loop(smallSimulation(), options(Pace::FREE), ignore);
  const auto count = [&] { return loop.call([](Simulation& s) { return s.stepCount(); }); };
  ASSERT_TRUE(eventually([&] { return count() > 100; }));
  loop.pause();
  loop.pause();
  const std::uint64_t paused = count();
  EXPECT_EQ(loop.step(2).step, paused + 2) << "only what it is told";
  loop.resume();
  loop.resume();
  EXPECT_TRUE(eventually([&] { return count() > paused + 100; }));
}

TEST(LoopPace, WallNeverRunsAheadOfTheClock)
{
  const Clock::time_point start = Clock::now();
  SimulationLoop loop(smallSimulation(), options(Pace::WALL), ignore);
  double time = 0.0;
  ASSERT_TRUE(eventually(
      [&]
      {
        time = loop.call([](Simulation& s) { return s.time(); });
        const double elapsed = std::chrono::duration<double>(Clock::now() - start).count();
        EXPECT_LT(time, elapsed + 0.01);
        return time > 0.3 || ::testing::Test::HasFailure();
      }));
}

TEST(LoopPace, WallGoesByItsSpeed)
{
  SimulationLoop::Options slow = options(Pace::WALL);
  slow.speed = 0.1;
  const Clock::time_point start = Clock::now();
  SimulationLoop loop(smallSimulation(), slow, ignore);
  const auto elapsed = [&](Clock::time_point since)
  { return std::chrono::duration<double>(Clock::now() - since).count(); };
  const auto time = [&] { return loop.call([](Simulation& s) { return s.time(); }); };
  ASSERT_TRUE(eventually(
      [&]
      {
        const double now = time();
        EXPECT_LT(now, 0.1 * elapsed(start) + 0.002);
        return now > 0.03 || ::testing::Test::HasFailure();
      }));

  const Clock::time_point change = Clock::now();
  const double before = time();
  loop.tune([](LoopTuning& tuning) { tuning.speed = 4.0; });

  EXPECT_TRUE(eventually([&] { return time() - before > 1.0 + elapsed(change); }))
      << "faster than real time";
  EXPECT_EQ(loop.state().speed, 4.0);
}

TEST(LoopPace, SaysHowItKeepsUp)
{
  SimulationLoop loop(smallSimulation(), options(Pace::WALL), ignore);
  EXPECT_TRUE(eventually([&] { return loop.state().real_time_factor > 0.0; }));
  EXPECT_LT(loop.state().real_time_factor, 1.2);
  EXPECT_EQ(loop.state().pace, Pace::WALL);
}

TEST(LoopTunings, AreAllOfItOrNothing)
{
  SimulationLoop loop(smallSimulation(), options(Pace::STEP), ignore);
  const LoopTuning before = loop.tuning();
  EXPECT_EQ(before.speed, 1.0);
  for (const auto& [speed, max_strain] : { std::pair(0.0, 0.2), std::pair(2.0, 0.0) })
  {
    EXPECT_THROW(loop.tune(
                     [&, speed = speed, max_strain = max_strain](LoopTuning& tuning)
                     {
                       tuning.speed = speed;
                       tuning.max_strain = max_strain;
                     }),
                 Refusal);
    EXPECT_EQ(loop.tuning().speed, before.speed);
    EXPECT_EQ(loop.tuning().max_strain, before.max_strain);
  }

  loop.tune(
      [](LoopTuning& tuning)
      {
        tuning.speed = 2.0;
        tuning.max_strain = 0.2;
      });

  EXPECT_EQ(loop.tuning().speed, 2.0);
  EXPECT_EQ(loop.tuning().max_strain, 0.2);
}

TEST(LoopPace, HasNoSpeedOfZero)
{
  SimulationLoop::Options stopped = options(Pace::WALL);
  stopped.speed = 0.0;
  EXPECT_THROW(SimulationLoop(smallSimulation(), stopped, ignore), std::invalid_argument);
}

TEST(LoopPace, CanStartPaused)
{
  SimulationLoop::Options paused = options(Pace::FREE);
  paused.paused = true;
  SimulationLoop loop(smallSimulation(), paused, ignore);
  EXPECT_TRUE(loop.state().paused);
  EXPECT_EQ(loop.step(0).step, 0u);
}

/// A clock that a test moves by hand, and what was said of it.
struct HandClock
{
  void show(milliseconds time) { now = time.count(); }

  SimulationLoop::Options options()
  {
    SimulationLoop::Options options;
    options.pace = Pace::CLOCK;
    options.patience = DEADLINE;
    options.clock = [this]
    { return now < 0 ? ClockFollower::Reading() : ClockFollower::Reading(milliseconds(now)); };
    options.on_clock_jump = [this](const std::string& note) { notes.push_back(note); };
    return options;
  }

  std::atomic<std::int64_t> now{ -1 };  // [ms]; there is none before
  std::vector<std::string> notes;       // of the loop's thread
};

std::uint64_t stepsOf(SimulationLoop& loop)
{
  return loop.call([](Simulation& s) { return s.stepCount(); });
}

/// Whether the loop comes to `steps` and stays there: it looks at its clock again, and again.
bool standsAt(SimulationLoop& loop, std::uint64_t steps)
{
  if (!eventually([&] { return stepsOf(loop) >= steps; }))
  {
    return false;
  }
  const Clock::time_point later = Clock::now() + milliseconds(30);  // several slices
  return eventually([&] { return Clock::now() > later || stepsOf(loop) != steps; }) &&
         stepsOf(loop) == steps;
}

TEST(LoopClock, IsFollowedStepByStepAndStopsTheClothWhenItStops)
{
  HandClock clock;
  SimulationLoop loop(smallSimulation(), clock.options(), ignore);
  EXPECT_TRUE(standsAt(loop, 0)) << "there is no clock";
  EXPECT_TRUE(loop.state().awaits_clock);

  clock.show(milliseconds(5000));
  EXPECT_TRUE(standsAt(loop, 0)) << "it begins to follow";
  EXPECT_FALSE(loop.state().awaits_clock);
  clock.show(milliseconds(5001));
  EXPECT_TRUE(standsAt(loop, 1));
  clock.show(milliseconds(5400));
  EXPECT_TRUE(standsAt(loop, 400));
  EXPECT_EQ(loop.state().clock_jumps, 0u);
}

TEST(LoopClock, MayJumpWithoutTheCloth)
{
  HandClock clock;
  clock.show(milliseconds(5000));
  SimulationLoop loop(smallSimulation(), clock.options(), ignore);
  ASSERT_TRUE(eventually([&] { return !loop.state().awaits_clock; }));

  clock.show(milliseconds(905000));
  ASSERT_TRUE(eventually([&] { return loop.state().clock_jumps == 1; }));
  clock.show(milliseconds(905010));
  EXPECT_TRUE(standsAt(loop, 10));
  clock.show(milliseconds(10));
  ASSERT_TRUE(eventually([&] { return loop.state().clock_jumps == 2; }));
  clock.show(milliseconds(15));
  EXPECT_TRUE(standsAt(loop, 15));

  const auto notes = loop.call([&](Simulation&) { return clock.notes; });
  EXPECT_EQ(notes, (std::vector<std::string>{ "the clock jumped by 900 s: skipped",
                                              "the clock jumped by -905 s: skipped" }));
}

TEST(LoopClock, IsFollowedAnewAfterAPause)
{
  HandClock clock;
  clock.show(milliseconds(5000));
  SimulationLoop loop(smallSimulation(), clock.options(), ignore);
  ASSERT_TRUE(eventually([&] { return !loop.state().awaits_clock; }));
  EXPECT_THROW(loop.step(1), Refusal);
  loop.pause();
  EXPECT_EQ(loop.step(3).step, 3u);
  clock.show(milliseconds(5500));
  EXPECT_TRUE(standsAt(loop, 3));

  loop.resume();
  ASSERT_TRUE(eventually([&] { return !loop.state().awaits_clock; }));
  clock.show(milliseconds(5504));

  EXPECT_TRUE(standsAt(loop, 7)) << "what passed meanwhile is not made up for";
}

TEST(LoopClock, MayBeTooFastWhichIsToldAndCounted)
{
  HandClock clock;
  clock.show(milliseconds(0));
  std::atomic<bool> hurries{ true };
  SimulationLoop::Options options = clock.options();
  options.clock = [&]
  {
    clock.show(milliseconds(clock.now + (hurries ? 1000 : 0)));  // as much as is no jump
    return ClockFollower::Reading(milliseconds(clock.now));
  };
  const Clock::time_point start = Clock::now();
  SimulationLoop loop(smallSimulation(), options, ignore);

  ASSERT_TRUE(eventually([&] { return loop.state().falls_behind; }));
  hurries = false;
  ASSERT_TRUE(eventually([&] { return !loop.state().falls_behind; }));
  const auto missing = [&]
  {
    const double shown = 0.001 * static_cast<double>(clock.now) - 1.0;  // since the first reading
    return shown - loop.state().lost_time - 0.001 * static_cast<double>(stepsOf(loop));
  };
  EXPECT_TRUE(eventually([&] { return std::abs(missing()) < 1e-6; })) << missing();
  EXPECT_EQ(loop.state().clock_jumps, 0u);
  const auto notes = loop.call([&](Simulation&) { return clock.notes; });
  ASSERT_FALSE(notes.empty());
  EXPECT_EQ(notes.front().find("fell behind the clock by "), 0u) << notes.front();
  EXPECT_LE(notes.size(), 1 + static_cast<std::size_t>((Clock::now() - start) / seconds(5)));
}

/// Follows a clock for 20 ms with a cloth of 1 ms steps, then with what `replace` puts there.
template <class Replace>
void expectStepsOfFourMilliseconds(const Replace& replace)
{
  HandClock clock;
  clock.show(milliseconds(5000));
  SimulationLoop loop(smallSimulation(), clock.options(), ignore);
  ASSERT_TRUE(eventually([&] { return !loop.state().awaits_clock; }));
  clock.show(milliseconds(5020));
  ASSERT_TRUE(standsAt(loop, 20));

  replace(loop);
  const std::uint64_t begin = stepsOf(loop);
  ASSERT_TRUE(eventually([&] { return !loop.state().awaits_clock; }));
  clock.show(milliseconds(5100));

  EXPECT_TRUE(standsAt(loop, begin + 20));
}

TEST(LoopClock, IsFollowedInTheTimeStepOfARestoredState)
{
  expectStepsOfFourMilliseconds([](SimulationLoop& loop)
                                { loop.restore(smallSimulation(0.004).save()); });
}

TEST(LoopClock, IsFollowedInTheTimeStepOfAnotherCloth)
{
  expectStepsOfFourMilliseconds([](SimulationLoop& loop)
                                { loop.takeCloth(smallSimulation(0.004)); });
}

TEST(LoopClock, HasToBeThereToBeFollowed)
{
  EXPECT_THROW(SimulationLoop(smallSimulation(), options(Pace::CLOCK), ignore),
               std::invalid_argument);
}

TEST(LoopPace, DoesNotChangeTheCloth)
{
  constexpr std::uint64_t STEPS = 150;
  Simulation alone = *smallSimulation();
  run(alone, STEPS);
  for (const Pace pace : { Pace::WALL, Pace::FREE, Pace::STEP, Pace::CLOCK })
  {
    HandClock clock;
    clock.show(milliseconds(0));
    SimulationLoop::Options paced = clock.options();
    paced.pace = pace;
    std::atomic<std::uint64_t> hash{ 0 };
    SimulationLoop loop(smallSimulation(), paced,
                        [&](const Simulation& s, const StepReport&)
                        {
                          if (s.stepCount() == STEPS)
                          {
                            hash = s.stateHash();
                          }
                        });
    if (pace == Pace::STEP)
    {
      loop.step(STEPS);
    }
    ASSERT_TRUE(eventually([&] { return !loop.state().awaits_clock; }));
    clock.show(milliseconds(STEPS));
    ASSERT_TRUE(eventually([&] { return hash != 0; }));
    EXPECT_EQ(hash, alone.stateHash()) << static_cast<int>(pace);
  }
}

TEST(LoopFaults, PauseItAndCutTheStepShort)
{
  SimulationParams params = untearable();
  params.max_speed = 0.5;  // free fall gets there after 51 ms
  std::string fault;
  SimulationLoop loop(
      std::make_unique<Simulation>(sheet(0.5, 0.5, 4, 4), std::vector<int>{}, params),
      options(Pace::STEP),
      [&](const Simulation&, const StepReport& report) { fault = report.fault; });

  const StepAnswer answer = loop.step(1000);

  EXPECT_GT(answer.steps, 40u);
  EXPECT_LT(answer.steps, 60u);
  EXPECT_NE(answer.cut_short.find("max_speed = 0.5"), std::string::npos) << answer.cut_short;
  EXPECT_TRUE(loop.state().paused);
  EXPECT_EQ(loop.call([&](Simulation&) { return fault; }), answer.cut_short);
}

TEST(LoopEnd, GivesBusyToWhoeverWaitsForSteps)
{
  Gate gate;
  auto loop = std::make_unique<SimulationLoop>(smallSimulation(), options(Pace::STEP),
                                               [&](const Simulation& s, const StepReport&)
                                               {
                                                 if (s.stepCount() == 5)
                                                 {
                                                   gate.pass();
                                                 }
                                               });
  SimulationLoop& running = *loop;
  auto step = std::async(std::launch::async, [&] { return running.step(1000000000); });
  gate.awaitVisitor();
  auto ending = std::async(std::launch::async, [&] { loop.reset(); });
  gate.open();

  inTime(ending);
  EXPECT_THROW(inTime(step), Busy);
}

TEST(Queue, RefusesOnceItIsClosed)
{
  CommandQueue<int> queue(10);
  queue.close();
  EXPECT_THROW(queue.call([](int&) {}, milliseconds(1)), Busy);
}

TEST(Queue, AnswersBusyAtOnceToThoseWhoWaitWhenItCloses)
{
  CommandQueue<int> queue(10);
  std::atomic<bool> calling{ false };
  auto call = std::async(std::launch::async,
                         [&]
                         {
                           calling = true;
                           queue.call([](int&) {}, std::chrono::hours(1));
                         });
  ASSERT_TRUE(eventually([&] { return calling.load(); }));
  queue.close();
  EXPECT_THROW(inTime(call), Busy);
}

TEST(Queue, WakesItsOwnerForACommand)
{
  CommandQueue<int> queue(10);
  int target = 41;
  auto call = std::async(std::launch::async,
                         [&] { return queue.call([](int& t) { return ++t; }, DEADLINE); });
  queue.waitUntil(Clock::now() + DEADLINE);
  queue.runAll(target);
  EXPECT_EQ(inTime(call), 42);
}

TEST(Queue, KeepsTheOrderOfOneCaller)
{
  SimulationLoop loop(smallSimulation(), options(Pace::FREE), ignore);
  for (int i = 0; i < 200; ++i)
  {
    const auto before = loop.call([](Simulation& s) { return s.stepCount(); });
    const auto after = loop.call([](Simulation& s) { return s.stepCount(); });
    EXPECT_LE(before, after);
  }
}

}  // namespace
}  // namespace cloth
