// Claims about threads that share work.
#include "cloth_tearing/core/worker_pool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <future>
#include <numeric>
#include <thread>
#include <vector>

namespace cloth
{
namespace
{

TEST(WorkerPool, DoesEachPieceOnceHoweverManyThreadsThereAre)
{
  for (int threads : { 1, 2, 3, 7 })
  {
    WorkerPool pool(threads);
    for (int count : { 0, 1, 2, 3, 64, 1000 })
    {
      std::vector<std::atomic<int>> done(static_cast<std::size_t>(count));
      pool.run(count, [&](int i) { ++done[i]; });
      for (int i = 0; i < count; ++i)
      {
        ASSERT_EQ(done[i], 1) << "piece " << i << " of " << count << ", " << threads << " threads";
      }
    }
  }
}

TEST(WorkerPool, IsDoneWhenItReturnsTimeAfterTime)
{
  WorkerPool pool(3);
  std::vector<int> values(50, 0);  // each written by whoever gets it, read by the caller
  for (int round = 1; round <= 20000; ++round)
  {
    pool.run(static_cast<int>(values.size()), [&](int i) { values[i] += i; });
    ASSERT_EQ(std::accumulate(values.begin(), values.end(), 0), round * 49 * 50 / 2);
  }
}

/// A thread that still looks for work of the last round must not take any of the next on its way.
TEST(WorkerPool, DoesEachPieceOnceThoughRoundsOfOtherSizesFollowAtOnce)
{
  for (int threads : { 2, 3, 7 })
  {
    WorkerPool pool(threads);
    std::vector<int> done(64);
    for (int round = 0; round < 1000000; ++round)
    {
      const int count = std::array<int, 5>{ 8, 6, 3, 64, 8 }[round % 5];
      std::fill(done.begin(), done.begin() + count, 0);
      pool.run(count, [&](int i) { ++done[i]; });
      ASSERT_EQ(std::count(done.begin(), done.begin() + count, 1), count)
          << "round " << round << ", " << threads << " threads";
    }
  }
}

TEST(Stretches, CoverEachPlaceOnce)
{
  WorkerPool pool(3);
  for (WorkerPool* workers : { static_cast<WorkerPool*>(nullptr), &pool })
  {
    for (int count : { 0, 1, 9, 10, 11, 100, 101 })
    {
      std::vector<std::atomic<int>> done(static_cast<std::size_t>(count) + 1);
      shareStretches(
          workers, count,
          [&](int begin, int end)
          { std::for_each(done.begin() + begin, done.begin() + end, [](auto& n) { ++n; }); },
          10);
      for (int i = 0; i <= count; ++i)
      {
        EXPECT_EQ(done[i], i < count ? 1 : 0) << "place " << i << " of " << count;
      }
    }
  }
}

TEST(WorkerPool, ServesACallerWhoComesWhileAnotherIsServed)
{
  WorkerPool pool(2);
  std::atomic<int> inner{ 0 };
  pool.run(4, [&](int) { pool.run(10, [&](int) { ++inner; }); });
  EXPECT_EQ(inner, 40);
}

TEST(WorkerPool, ServesCallersOfManyThreads)
{
  WorkerPool pool(3);
  std::vector<std::future<int>> callers;
  for (int caller = 0; caller < 4; ++caller)
  {
    callers.push_back(std::async(std::launch::async,
                                 [&pool]
                                 {
                                   std::atomic<int> done{ 0 };
                                   for (int i = 0; i < 500; ++i)
                                   {
                                     pool.run(7, [&](int) { ++done; });
                                   }
                                   return done.load();
                                 }));
  }
  for (std::future<int>& caller : callers)
  {
    EXPECT_EQ(caller.get(), 3500);
  }
}

TEST(WorkerPool, UsesThreadsOnlyWhereTheyPayOff)
{
  EXPECT_EQ(threadsFor(0, 900), 1);
  EXPECT_EQ(threadsFor(8, 900), 1);
  EXPECT_EQ(threadsFor(1, 1000000), 1);
  EXPECT_EQ(threadsFor(7, 1000000), 7);
  EXPECT_EQ(threadsFor(64, 10000), 4);
}

}  // namespace
}  // namespace cloth
