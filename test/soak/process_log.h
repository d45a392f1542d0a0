// Memory and descriptors of a process over time.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace soak
{

struct ProcessSample
{
  double time = 0.0;    ///< since the log began [s]
  double memory = 0.0;  ///< resident [kB]; 0 if there is no such process
  int descriptors = 0;  ///< that are open
};

ProcessSample lookAt(pid_t process);

/// A straight line through means of blocks of equal length.
struct Slope
{
  double value = 0.0;  ///< [kB/min]
  double error = 0.0;  ///< its standard error, from how the blocks scatter about the line [kB/min]
  double naive = 0.0;  ///< what it would be if samples a second apart did not depend on each other
  std::vector<double> blocks;  ///< their means [kB]
};

/// @param blocks what comes in a second tells much of what comes in the next, so that single
///        samples would make the error too small: blocks that are much longer than that do not
Slope memorySlope(const std::vector<ProcessSample>& samples, int blocks);

/// Looks once a second, on a thread of its own, until it is destroyed.
class ProcessLog
{
public:
  explicit ProcessLog(pid_t process);
  ~ProcessLog();

  /// Those from `since` on [s].
  std::vector<ProcessSample> samples(double since) const;

private:
  void run();

  pid_t process_;
  mutable std::mutex mutex_;
  std::vector<ProcessSample> samples_;
  std::atomic<bool> over_{ false };
  std::thread thread_;
};

}  // namespace soak
