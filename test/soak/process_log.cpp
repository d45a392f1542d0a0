// Memory and descriptors of a process over time.
#include "process_log.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace soak
{

namespace
{

constexpr double MINUTE = 60.0;  // [s]

struct Line
{
  double slope = 0.0;
  double error = 0.0;
};

/// By least squares, the error from the residuals.
Line lineThrough(const std::vector<double>& x, const std::vector<double>& y)
{
  const auto n = static_cast<double>(x.size());
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  double xx = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  Line line{ xy / xx, 0.0 };
  double squares = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    const double residual = y[i] - mean_y - line.slope * (x[i] - mean_x);
    squares += residual * residual;
  }
  line.error = std::sqrt(squares / (n - 2.0) / xx);
  return line;
}

}  // namespace

ProcessSample lookAt(pid_t process)
{
  const std::string folder = "/proc/" + std::to_string(process);
  ProcessSample sample;
  std::ifstream status(folder + "/status");
  for (std::string word; status >> word;)
  {
    if (word == "VmRSS:")
    {
      status >> sample.memory;
    }
  }
  std::error_code gone;
  const std::filesystem::directory_iterator files(folder + "/fd", gone);
  sample.descriptors = static_cast<int>(std::distance(begin(files), end(files)));
  return sample;
}

Slope memorySlope(const std::vector<ProcessSample>& samples, int blocks)
{
  std::vector<double> times;
  std::vector<double> memory;
  for (const ProcessSample& sample : samples)
  {
    times.push_back(sample.time / MINUTE);
    memory.push_back(sample.memory);
  }
  Slope slope;
  std::vector<double> middles;
  const std::size_t length = samples.size() / static_cast<std::size_t>(blocks);
  for (std::size_t begin = 0; length > 0 && begin + length <= samples.size(); begin += length)
  {
    double time = 0.0;
    double mean = 0.0;
    for (std::size_t i = begin; i < begin + length; ++i)
    {
      time += times[i] / static_cast<double>(length);
      mean += memory[i] / static_cast<double>(length);
    }
    middles.push_back(time);
    slope.blocks.push_back(mean);
  }
  const Line line = lineThrough(middles, slope.blocks);
  slope.value = line.slope;
  slope.error = line.error;
  slope.naive = lineThrough(times, memory).error;
  return slope;
}

ProcessLog::ProcessLog(pid_t process) : process_(process), thread_([this] { run(); })
{
}

ProcessLog::~ProcessLog()
{
  over_ = true;
  thread_.join();
}

std::vector<ProcessSample> ProcessLog::samples(double since) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<ProcessSample> found;
  for (const ProcessSample& sample : samples_)
  {
    if (sample.time >= since)
    {
      found.push_back(sample);
    }
  }
  return found;
}

void ProcessLog::run()
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  for (int second = 1; !over_; ++second)
  {
    ProcessSample sample = lookAt(process_);
    sample.time = std::chrono::duration<double>(Clock::now() - begin).count();
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      samples_.push_back(sample);
    }
    while (!over_ && Clock::now() < begin + std::chrono::seconds(second))
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
}

}  // namespace soak
