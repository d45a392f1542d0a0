// Threads that share the work of a step.
#include "cloth_tearing/core/worker_pool.h"

#include <algorithm>
#include <system_error>

#include "cloth_tearing/core/flush_subnormals.h"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace cloth
{
namespace
{

/// How often a thread looks for work, or for the end of it, before it lets others run.
constexpr int SPINS = 2000;

/// How often it then lets others run before it sleeps.
constexpr int YIELDS = 50;

/// Fewer particles are faster on one thread than on two.
constexpr int LEAST_PARTICLES = 4096;

/// A thread more than this share of them allows has nothing to do.
constexpr int PARTICLES_EACH = 2048;

void relax()
{
#if defined(__SSE2__)
  _mm_pause();
#endif
}

/// A piece that no share has.
constexpr std::uint32_t CLOSED = 0xffffffff;

constexpr std::uint64_t ticketOf(std::uint32_t round, std::uint32_t piece)
{
  return static_cast<std::uint64_t>(round) << 32 | piece;
}

}  // namespace

int threadsFor(int wanted, int particles)
{
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int most = particles < LEAST_PARTICLES ? 1 : particles / PARTICLES_EACH;
  return std::min(wanted == 0 ? processors : wanted, most);
}

WorkerPool::WorkerPool(int threads) : shares_(static_cast<std::size_t>(std::max(1, threads)))
{
  try
  {
    for (std::size_t i = 1; i < shares_.size(); ++i)
    {
      workers_.emplace_back([this, i] { serve(i); });
    }
  }
  catch (const std::system_error&)
  {
    // The others do what was meant for those that are missing.
  }
}

WorkerPool::~WorkerPool()
{
  ending_ = true;
  {
    const std::lock_guard<std::mutex> lock(sleep_);
    wake_.notify_all();
  }
  for (std::thread& worker : workers_)
  {
    worker.join();
  }
}

void WorkerPool::run(int count, const std::function<void(int)>& work)
{
  if (workers_.empty() || count <= 1 || busy_.test_and_set(std::memory_order_acquire))
  {
    for (int i = 0; i < count; ++i)
    {
      work(i);
    }
    return;
  }
  const std::uint32_t round = round_.load(std::memory_order_relaxed) + 1;
  work_ = &work;
  left_.store(count, std::memory_order_relaxed);
  const auto begin = [&](std::size_t i)
  { return static_cast<std::uint32_t>(static_cast<std::size_t>(count) * i / shares_.size()); };
  for (std::size_t i = 0; i < shares_.size(); ++i)
  {
    // Closed before it has its new end: a thread that still looks round from the last round must
    // not take a piece of this one on an old ticket.
    shares_[i].ticket.store(ticketOf(round, CLOSED), std::memory_order_relaxed);
    shares_[i].end.store(begin(i + 1), std::memory_order_release);
    shares_[i].ticket.store(ticketOf(round, begin(i)), std::memory_order_release);
  }
  round_.store(round);
  if (sleeping_.load() > 0)
  {
    const std::lock_guard<std::mutex> lock(sleep_);
    wake_.notify_all();
  }
  takePart(0, round);
  for (int spins = 0; left_.load(std::memory_order_acquire) > 0; ++spins)
  {
    spins < SPINS ? relax() : std::this_thread::yield();
  }
  busy_.clear(std::memory_order_release);
}

/// What a worker does all its life.
void WorkerPool::serve(std::size_t self)
{
  const FlushSubnormals fast;  // as in the thread that it works for
  std::uint32_t seen = 0;
  while (awaitRound(seen))
  {
    seen = round_.load(std::memory_order_acquire);
    takePart(self, seen);
  }
}

/// @return false: it is over
bool WorkerPool::awaitRound(std::uint32_t seen)
{
  const auto come = [&] { return ending_.load() || round_.load() != seen; };
  for (int i = 0; i < SPINS + YIELDS && !come(); ++i)
  {
    i < SPINS ? relax() : std::this_thread::yield();
  }
  if (!come())
  {
    std::unique_lock<std::mutex> lock(sleep_);
    ++sleeping_;
    wake_.wait(lock, come);
    --sleeping_;
  }
  return !ending_.load();
}

/// Does its own share, then what is left of the others'.
void WorkerPool::takePart(std::size_t self, std::uint32_t round)
{
  for (std::size_t i = 0; i < shares_.size(); ++i)
  {
    takeFrom(shares_[(self + i) % shares_.size()], round);
  }
}

void WorkerPool::takeFrom(Share& share, std::uint32_t round)
{
  std::uint64_t ticket = share.ticket.load(std::memory_order_acquire);
  while (ticket >> 32 == round)
  {
    const auto piece = static_cast<std::uint32_t>(ticket);
    if (piece >= share.end.load(std::memory_order_acquire))
    {
      return;
    }
    if (share.ticket.compare_exchange_weak(ticket, ticket + 1, std::memory_order_acq_rel))
    {
      (*work_)(static_cast<int>(piece));
      left_.fetch_sub(1, std::memory_order_acq_rel);
      ++ticket;
    }
  }
}

}  // namespace cloth
