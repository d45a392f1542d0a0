// Takes commands, steps, keeps the pace.
#include "cloth_tearing/core/simulation_loop.h"

#include <algorithm>
#include <stdexcept>

#include "cloth_tearing/core/checks.h"

namespace cloth
{
namespace
{

/// The loop wakes this often at most when it keeps real time, and does what is due in one go.
constexpr std::chrono::milliseconds SLICE{ 4 };

/// How often a loop that waits looks up although nobody called.
constexpr std::chrono::seconds IDLE{ 1 };

constexpr std::chrono::milliseconds MEASURE_INTERVAL{ 1000 };

const SimulationLoop::Options& checked(const SimulationLoop::Options& options)
{
  if (options.pace == Pace::CLOCK && !options.clock)
  {
    throw std::invalid_argument("Pace::CLOCK needs a clock to follow");
  }
  std::vector<std::string> found;
  checkSpeed(found, options.speed);
  check(found, "max_commands", options.max_commands, Range::between(1, MAX_COMMANDS));
  if (!found.empty())
  {
    throw std::invalid_argument(found.front());
  }
  return options;
}

}  // namespace

SimulationLoop::SimulationLoop(std::unique_ptr<Simulation> simulation, const Options& options,
                               Listener listener)
    : options_(checked(options))
    , listener_(std::move(listener))
    , simulation_(std::move(simulation))
    , queue_(static_cast<std::size_t>(options.max_commands))
    , paused_(options.paused)
    , speed_(options.speed)
    , pacer_(options.speed, Clock::now())
    , follower_(simulation_->params().solver.time_step)
    , measured_at_(Clock::now())
    , measured_time_(simulation_->time())
    , thread_([this] { run(); })
{
}

SimulationLoop::~SimulationLoop()
{
  stop();
}

void SimulationLoop::stop()
{
  ending_ = true;
  queue_.close();
  if (thread_.joinable())
  {
    thread_.join();
  }
}

void SimulationLoop::run()
{
  while (!ending_)
  {
    queue_.runAll(*simulation_);
    if (options_.after_commands)
    {
      options_.after_commands(*simulation_);
    }
    if (!requests_.empty())
    {
      oneStep();
    }
    else if (paused_ || options_.pace == Pace::STEP)
    {
      followAnew();
      queue_.waitUntil(Clock::now() + IDLE);
    }
    else if (options_.pace == Pace::FREE)
    {
      oneStep();
    }
    else if (options_.pace == Pace::CLOCK)
    {
      followClock();
    }
    else
    {
      keepPace();
    }
    tellJump(lost_.tell(Clock::now()));
    measure();
  }
  for (auto& request : requests_)
  {
    request->promise.set_exception(std::make_exception_ptr(Busy("busy: the simulation is ending")));
  }
}

/// Steps until simulated time has caught up with the clock, or a command waits no longer.
void SimulationLoop::keepPace()
{
  const double time_step = simulation_->params().solver.time_step;
  const Clock::time_point start = Clock::now();
  pacer_.look(start);
  while (pacer_.stepDue() && Clock::now() < start + SLICE && !paused_)
  {
    oneStep();
    pacer_.stepped(time_step);
  }
  if (!pacer_.stepDue())
  {
    queue_.waitUntil(std::clamp(pacer_.due(), start + SLICE, start + IDLE));
  }
}

/// What was measured at another speed says nothing of this one.
void SimulationLoop::setSpeed(double speed)
{
  if (speed != speed_)
  {
    const Clock::time_point now = Clock::now();
    pacer_.setSpeed(speed, now);
    speed_ = speed;
    real_time_factor_ = 0.0;
    measured_at_ = now;
    measured_time_ = simulation_->time();
  }
}

/// Steps until simulated time has caught up with the clock that is followed, or a command waits no
/// longer. A clock that stands still or is not there stops the cloth.
void SimulationLoop::followClock()
{
  const Clock::time_point start = Clock::now();
  const std::string jump = follower_.look(options_.clock());
  following_ = follower_.following();
  clock_jumps_ += jump.empty() ? 0 : 1;
  tellJump(jump);
  lost_.add(follower_.lost());
  lost_time_ = lost_.total();
  while (follower_.stepDue() && Clock::now() < start + SLICE && !paused_)
  {
    oneStep();
    follower_.stepped();
  }
  if (!follower_.stepDue())
  {
    queue_.waitUntil(start + SLICE);
  }
}

/// Following the clock begins with its next reading, in time steps as they are now.
void SimulationLoop::followAnew()
{
  follower_ = ClockFollower(simulation_->params().solver.time_step);
  following_ = false;
}

void SimulationLoop::tellJump(const std::string& jump)
{
  if (!jump.empty() && options_.on_clock_jump)
  {
    options_.on_clock_jump(jump);
  }
}

void SimulationLoop::oneStep()
{
  if (options_.before_step)
  {
    options_.before_step(*simulation_);
  }
  const StepReport report = simulation_->step();
  if (!report.fault.empty())
  {
    paused_ = true;
  }
  listener_(*simulation_, report);
  if (requests_.empty())
  {
    return;
  }
  Request& request = *requests_.front();
  if (!report.fault.empty())
  {
    cutRequests(report.fault);
    return;
  }
  ++request.answer.steps;
  --request.left;
  request.answer.tears += report.tears.size();
  while (!requests_.empty() && requests_.front()->left == 0)
  {
    answerRequest({});
  }
}

void SimulationLoop::tell(StepAnswer& answer) const
{
  answer.time = simulation_->time();
  answer.step = simulation_->stepCount();
  answer.epoch = simulation_->epoch();
  answer.state_hash = simulation_->stateHash();
}

void SimulationLoop::answerRequest(const std::string& cut_short)
{
  Request& request = *requests_.front();
  request.answer.cut_short = cut_short;
  tell(request.answer);
  request.promise.set_value(request.answer);
  requests_.pop_front();
}

void SimulationLoop::cutRequests(const std::string& why)
{
  while (!requests_.empty())
  {
    answerRequest(why);
  }
}

StepAnswer SimulationLoop::step(std::uint64_t steps)
{
  std::future<StepAnswer> answer = call(
      [&](Simulation&)
      {
        if (!paused_ && options_.pace != Pace::STEP)
        {
          throw Refusal("the simulation is running: pause it before stepping it");
        }
        auto request = std::make_unique<Request>();
        request->left = steps;
        auto promised = request->promise.get_future();
        requests_.push_back(std::move(request));
        if (steps == 0 && requests_.size() == 1)
        {
          answerRequest({});
        }
        return promised;
      });
  return answer.get();
}

void SimulationLoop::pause()
{
  call([this](Simulation&) { paused_ = true; });
}

void SimulationLoop::resume()
{
  call(
      [this](Simulation&)
      {
        if (paused_)
        {
          pacer_.begin(Clock::now());
          paused_ = false;
        }
      });
}

LoopTuning SimulationLoop::tuning()
{
  return call(
      [this](const Simulation& simulation) {
        return LoopTuning{ tuningOf(simulation.params()), speed_ };
      });
}

std::vector<std::string> SimulationLoop::tune(const std::function<void(LoopTuning&)>& change)
{
  return call(
      [&](Simulation& simulation)
      {
        LoopTuning wanted{ tuningOf(simulation.params()), speed_ };
        change(wanted);
        std::vector<std::string> found;
        checkSpeed(found, wanted.speed);
        refuseIf(found);
        std::vector<std::string> notes = simulation.tune(wanted);
        setSpeed(wanted.speed);
        return notes;
      });
}

void SimulationLoop::reset()
{
  call(
      [this](Simulation& simulation)
      {
        cutRequests("the simulation was reset");
        simulation.reset();
      });
}

StepAnswer SimulationLoop::restore(const std::string& state)
{
  return call(
      [&](Simulation& simulation)
      {
        Simulation restored = simulation.restored(state);
        cutRequests("another state was restored");
        simulation.become(std::move(restored), state);
        followAnew();
        StepAnswer answer;
        tell(answer);
        return answer;
      });
}

void SimulationLoop::takeCloth(Simulation other)
{
  call(
      [this, &other](Simulation& simulation)
      {
        other.tune(tuningOf(simulation.params()));
        cutRequests("another cloth was put in its place");
        simulation.takeCloth(std::move(other));
        followAnew();
      });
}

LoopState SimulationLoop::state() const
{
  const bool awaits_clock = options_.pace == Pace::CLOCK && !paused_ && !following_;
  return { options_.pace, paused_,    real_time_factor_, awaits_clock,
           clock_jumps_,  lost_time_, falls_behind_,     speed_ };
}

void SimulationLoop::measure()
{
  const Clock::time_point now = Clock::now();
  if (now - measured_at_ < MEASURE_INTERVAL)
  {
    return;
  }
  const double elapsed = std::chrono::duration<double>(now - measured_at_).count();
  real_time_factor_ = (simulation_->time() - measured_time_) / elapsed;
  falls_behind_ = lost_.total() > measured_lost_;
  measured_lost_ = lost_.total();
  measured_at_ = now;
  measured_time_ = simulation_->time();
}

}  // namespace cloth
