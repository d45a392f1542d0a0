// The thread that owns the simulation: paces it, and takes commands between its steps.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <thread>

#include "cloth_tearing/core/clock_follower.h"
#include "cloth_tearing/core/command_queue.h"
#include "cloth_tearing/core/simulation.h"
#include "cloth_tearing/core/wall_pacer.h"

namespace cloth
{

enum class Pace
{
  WALL,   ///< real time on the steady clock, or so many times as fast
  FREE,   ///< as fast as possible
  STEP,   ///< only when asked to, by step()
  CLOCK,  ///< as an outside clock goes, see ClockFollower
};

struct LoopState
{
  Pace pace = Pace::WALL;
  bool paused = false;
  double real_time_factor = 0.0;  ///< simulated over elapsed time, over about the last second [-];
                                  ///< 0 while it stands, or has been told another speed since
  bool awaits_clock = false;      ///< Pace::CLOCK, running, and the clock has shown nothing yet
  std::uint64_t clock_jumps = 0;  ///< of the clock that is followed; each was skipped
  double lost_time = 0.0;         ///< by which it fell behind that clock, without the jumps [s]
  bool falls_behind = false;      ///< it did so within about the last second
  double speed = 1.0;             ///< wanted by Pace::WALL: simulated over real time [-]
};

/// What may change while it runs.
struct LoopTuning : Tuning
{
  double speed = 1.0;  ///< see LoopState
};

/// Answer to step().
struct StepAnswer
{
  std::uint64_t steps = 0;  ///< done by this request
  std::string cut_short;    ///< why it ended early: a reset or a fault; empty if it did not
  double time = 0.0;        ///< [s]
  std::uint64_t step = 0;
  std::uint32_t epoch = 0;
  std::uint64_t state_hash = 0;
  std::uint64_t tears = 0;  ///< during this request
};

/// Runs a Simulation on a thread of its own. All members may be called from any thread but the
/// loop's own.
class SimulationLoop
{
public:
  /// Called on the loop's thread after every step: quick work only.
  using Listener = std::function<void(const Simulation&, const StepReport&)>;

  struct Options
  {
    Pace pace = Pace::WALL;
    bool paused = false;                         ///< start paused
    double speed = 1.0;                          ///< of Pace::WALL [-], see checkSpeed
    std::chrono::milliseconds patience{ 1000 };  ///< how long a command may wait before it is Busy
    int max_commands = 1000;  ///< that wait at once, 1 to MAX_COMMANDS; one more is Busy

    /// Called on the loop's thread before every step, to bring in what moves by itself elsewhere;
    /// must not wait.
    std::function<void(Simulation&)> before_step;

    /// Called on the loop's thread when commands may have been run: quick work only.
    std::function<void(const Simulation&)> after_commands;

    /// What Pace::CLOCK follows, and is told of when it jumped or is fallen behind. Both are called
    /// on the loop's thread and must not wait.
    std::function<ClockFollower::Reading()> clock;
    std::function<void(const std::string&)> on_clock_jump;
  };

  /// @throws std::invalid_argument if Pace::CLOCK has no clock, or the speed is none
  SimulationLoop(std::unique_ptr<Simulation> simulation, const Options& options, Listener listener);
  SimulationLoop(const SimulationLoop&) = delete;
  SimulationLoop& operator=(const SimulationLoop&) = delete;

  /// Ends the thread after the step it is in; whoever waits for an answer, or asks from now on,
  /// gets Busy.
  void stop();

  /// Stops.
  ~SimulationLoop();

  /// Runs `command(Simulation&)` between two steps and returns its answer, or rethrows what it
  /// threw.
  /// @throws Busy if it could not be run in time; it will not be run later
  template <class Command>
  auto call(Command&& command)
  {
    return queue_.call(std::forward<Command>(command), options_.patience);
  }

  /// Has `command` run between two steps and does not wait for that. It must not throw, and is
  /// dropped if the loop ends first.
  /// @throws Busy if too many commands wait, or the loop is ending
  void post(std::function<void(Simulation&)> command) { queue_.post(std::move(command)); }

  /// Does `steps` steps and answers when they are done; 0 only asks. Requests are served one
  /// after the other; other commands are taken between their steps.
  /// @throws Refusal unless paused or Pace::STEP
  StepAnswer step(std::uint64_t steps);

  void pause();
  void resume();

  LoopTuning tuning();

  /// Changes what `change(LoopTuning&)` changes of what is in force, between two steps: all of it
  /// or nothing. Another speed makes no jump: the simulation goes on from where it is.
  /// @return notes as Simulation::tune
  /// @throws Refusal as Simulation::tune and checkSpeed, and what `change` throws
  std::vector<std::string> tune(const std::function<void(LoopTuning&)>& change);

  /// Resets the simulation; a step() under way is cut short.
  void reset();

  /// Goes on in a saved state; a step() under way is cut short. Answers as step(0).
  /// @throws Refusal as Simulation::restored(); nothing has changed then
  StepAnswer restore(const std::string& state);

  /// Puts another cloth in place of the simulation's, see Simulation::takeCloth; a step() under way
  /// is cut short.
  /// @param other built with the simulation's parameters
  /// @throws Refusal as Simulation::tune, if these have been tuned since and it cannot follow
  void takeCloth(Simulation other);

  LoopState state() const;

private:
  using Clock = std::chrono::steady_clock;

  /// A step() that is under way. Lives on the loop's thread.
  struct Request
  {
    std::uint64_t left = 0;
    StepAnswer answer;
    std::promise<StepAnswer> promise;
  };

  void run();
  void oneStep();
  void keepPace();
  void setSpeed(double speed);
  void followClock();
  void followAnew();
  void tellJump(const std::string& jump);
  void tell(StepAnswer& answer) const;
  void answerRequest(const std::string& cut_short);
  void cutRequests(const std::string& why);
  void measure();

  Options options_;
  Listener listener_;
  std::unique_ptr<Simulation> simulation_;
  CommandQueue<Simulation> queue_;
  std::deque<std::unique_ptr<Request>> requests_;
  std::atomic<bool> ending_{ false };
  std::atomic<bool> paused_{ false };
  std::atomic<double> real_time_factor_{ 0.0 };
  std::atomic<double> speed_;
  WallPacer pacer_;         ///< of the loop's thread
  ClockFollower follower_;  ///< of the loop's thread
  std::atomic<bool> following_{ false };
  std::atomic<std::uint64_t> clock_jumps_{ 0 };
  LostTime lost_;  ///< of the loop's thread
  std::atomic<double> lost_time_{ 0.0 };
  std::atomic<bool> falls_behind_{ false };
  Clock::time_point measured_at_;
  double measured_time_ = 0.0;  ///< simulated time then [s]
  double measured_lost_ = 0.0;  ///< lost time then [s]
  std::thread thread_;          ///< last: it starts when everything else is there
};

}  // namespace cloth
