// Threads that share the work of a step.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace cloth
{

/// Runs many small pieces of work side by side, thousands of times a second: its threads spin for
/// a moment before they sleep. One that lost its processor to somebody else holds up nobody, as
/// long as it has no piece in hand: others do its share.
class WorkerPool
{
public:
  /// @param threads the caller's included, >= 1; fewer if the system starts no more
  explicit WorkerPool(int threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  int threads() const { return static_cast<int>(shares_.size()); }

  /// Calls work(0), work(1), ... work(count - 1), in any order and on any thread, and returns when
  /// all are done. Work must not throw. A caller who comes while another one is being served does
  /// its work alone.
  void run(int count, const std::function<void(int)>& work);

private:
  /// What one thread begins with: of `ticket`, the upper half is the round, the lower half the next
  /// piece. Whoever counts it up has got that piece, and the round cannot end without it.
  struct alignas(64) Share
  {
    std::atomic<std::uint64_t> ticket{ 0 };
    std::atomic<std::uint32_t> end{ 0 };
  };

  void serve(std::size_t self);
  bool awaitRound(std::uint32_t seen);
  void takePart(std::size_t self, std::uint32_t round);
  void takeFrom(Share& share, std::uint32_t round);

  std::vector<Share> shares_;
  std::atomic_flag busy_ = ATOMIC_FLAG_INIT;  ///< a caller is being served
  const std::function<void(int)>* work_ = nullptr;
  alignas(64) std::atomic<std::uint32_t> round_{ 0 };
  alignas(64) std::atomic<int> left_{ 0 };
  std::atomic<int> sleeping_{ 0 };
  std::atomic<bool> ending_{ false };
  std::mutex sleep_;
  std::condition_variable wake_;
  std::vector<std::thread> workers_;
};

/// Calls work(0), ... work(count - 1): on the pool's threads, or alone if there is none.
template <class Work>
void share(WorkerPool* workers, int count, const Work& work)
{
  if (workers != nullptr && count > 1)
  {
    workers->run(count, std::cref(work));  // a copy of `work` would allocate
    return;
  }
  for (int i = 0; i < count; ++i)
  {
    work(i);
  }
}

/// Calls work(begin, end) for stretches that together are 0 to `count`, each of `length` at most if
/// they are shared.
template <class Work>
void shareStretches(WorkerPool* workers, int count, const Work& work, int length = 1024)
{
  if (workers == nullptr)
  {
    work(0, count);
    return;
  }
  share(workers, (count + length - 1) / length,
        [&](int i) { work(i * length, std::min(count, (i + 1) * length)); });
}

/// How many threads pay off for a cloth of so many particles.
///
/// @param wanted 0: as many as the machine has processors
int threadsFor(int wanted, int particles);

}  // namespace cloth
