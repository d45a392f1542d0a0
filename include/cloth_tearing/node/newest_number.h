// A number that one thread raises and others wait for.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace cloth_tearing
{

class NewestNumber
{
public:
  /// Whoever waits for more than there was goes on.
  void raise(std::uint64_t number)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (number > number_)
    {
      number_ = number;
      raised_.notify_all();
    }
  }

  /// Waits until it is more than `known`, or somebody says wake(), but no longer than `patience`.
  void waitFor(std::uint64_t known, std::chrono::milliseconds patience)
  {
    std::unique_lock<std::mutex> lock(mutex_);
    raised_.wait_for(lock, patience, [&] { return ended_ || woken_ || number_ > known; });
    woken_ = false;
  }

  /// Whoever waits, or waits next, goes on.
  void wake()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    woken_ = true;
    raised_.notify_all();
  }

  /// Nobody waits any more, now and from now on.
  void end()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_ = true;
    raised_.notify_all();
  }

private:
  std::mutex mutex_;
  std::condition_variable raised_;
  std::uint64_t number_ = 0;
  bool woken_ = false;
  bool ended_ = false;
};

}  // namespace cloth_tearing
