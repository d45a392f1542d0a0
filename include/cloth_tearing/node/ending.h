// Takes the signals that end a process, and sees to it that it does end.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <thread>

namespace cloth_tearing
{

/// SIGINT and SIGTERM are taken by a thread of its own, so that nothing has to be safe inside a
/// signal handler, and that they are heard whatever the other threads wait for. Whoever ends takes
/// leave of the master; one that has stopped answering holds up roscpp for ever, and then the
/// process is ended without that.
class Ending
{
public:
  /// To be made before there are other threads: they inherit that the signals are blocked.
  /// @param patience from begin() or a signal to the forced end, which has status 0
  explicit Ending(std::chrono::milliseconds patience);

  Ending(const Ending&) = delete;
  Ending& operator=(const Ending&) = delete;

  /// To be reached in time.
  ~Ending();

  /// As if a signal had come.
  void begin();

  /// Whether a signal came, or begin().
  const std::atomic<bool>& begun() const { return begun_; }

  /// Waits for that, or for a while. @return whether it has begun
  bool waitFor(std::chrono::milliseconds while_);

private:
  using Clock = std::chrono::steady_clock;

  void run();

  const std::chrono::milliseconds patience_;
  sigset_t signals_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::atomic<bool> begun_{ false };
  std::atomic<bool> over_{ false };
  std::thread thread_;
};

}  // namespace cloth_tearing
