// Commands from any thread, run by the thread that owns their target, answered with a promise.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace cloth
{

/// A command could not be run in time; it will not be run later.
class Busy : public std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// The only thing that threads share with the owner of a Target.
template <class Target>
class CommandQueue
{
public:
  using Clock = std::chrono::steady_clock;

  /// @param most commands that may wait at once: callers who gave up leave theirs behind
  explicit CommandQueue(std::size_t most) : most_(most) {}

  /// Hands `command(Target&)` to the owner, waits for its answer and returns it or rethrows what
  /// it threw.
  /// @throws Busy if it did not start within `patience`, too many wait, or the queue is closed
  template <class Command>
  auto call(Command&& command, Clock::duration patience)
  {
    using Answer = std::invoke_result_t<Command, Target&>;
    using Work = std::packaged_task<Answer(Target&)>;
    auto work = std::make_shared<Work>(std::forward<Command>(command));
    std::future<Answer> answer = work->get_future();
    // Claimed by the owner to run it, or by the caller to give up.
    auto claimed = std::make_shared<std::atomic<bool>>(false);
    push(
        [work = std::move(work), claimed](Target& target)
        {
          if (!claimed->exchange(true))
          {
            (*work)(target);
          }
        });
    if (answer.wait_for(patience) != std::future_status::ready && !claimed->exchange(true))
    {
      throw Busy("busy: the simulation did not take the command in time");
    }
    try
    {
      return answer.get();
    }
    catch (const std::future_error&)  // close() has dropped the only holder of `work`
    {
      throw Busy("busy: the simulation is ending");
    }
  }

  /// Hands `command(Target&)` to the owner and goes on. It must not throw.
  /// @throws Busy if too many wait, or the queue is closed
  void post(std::function<void(Target&)> command) { push(std::move(command)); }

  /// Runs what is waiting. For the owner.
  void runAll(Target& target)
  {
    std::deque<Task> tasks;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      tasks.swap(tasks_);
    }
    for (Task& task : tasks)
    {
      task(target);
    }
  }

  /// Waits until there is something to run, the queue is closed, or `deadline`. For the owner.
  void waitUntil(Clock::time_point deadline)
  {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_until(lock, deadline, [this] { return closed_ || !tasks_.empty(); });
  }

  /// Refuses commands from now on; those that wait are dropped and their callers get Busy.
  void close()
  {
    std::deque<Task> dropped;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      closed_ = true;
      dropped.swap(tasks_);
    }
    changed_.notify_all();
  }

private:
  using Task = std::function<void(Target&)>;

  void push(Task task)
  {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (closed_)
      {
        throw Busy("busy: the simulation is ending");
      }
      if (tasks_.size() >= most_)
      {
        throw Busy(
            "busy: there would be " + std::to_string(tasks_.size() + 1) +
            " commands that wait, must be at most limits/commands = " + std::to_string(most_));
      }
      tasks_.push_back(std::move(task));
    }
    changed_.notify_all();
  }

  const std::size_t most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Task> tasks_;
  bool closed_ = false;
};

}  // namespace cloth
