// Times a step that is recorded to a file beside one that is not.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <vector>

#include "cases.h"
#include "cloth_tearing/core/mesh_builder.h"
#include "cloth_tearing/core/pins.h"
#include "cloth_tearing/core/record.h"
#include "cloth_tearing/core/recording_file.h"

namespace cloth_bench
{
namespace
{

constexpr int STRETCH = 200;              ///< steps that are timed together
constexpr std::uint64_t ROOM = 1u << 30;  ///< [byte]

/// Hangs by its upper edge.
cloth::RecordedStart hungSheet(int side)
{
  cloth::RectangleParams rectangle;
  rectangle.columns = side;
  rectangle.rows = side;
  cloth::PinParams pins;
  pins.edges = { "top" };
  cloth::RecordedStart start;
  start.model = cloth::rectangle(rectangle);
  start.pinned = cloth::pinnedParticles(start.model, pins);
  start.params.threads = 1;
  for (cloth::Vec3d& x : start.model.positions)
  {
    x = cloth::Vec3d(x.x(), -x.z(), x.y());
  }
  return start;
}

/// @return for a step [us]
double timeOf(cloth::Simulation& simulation)
{
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < STRETCH; ++i)
  {
    simulation.step();
  }
  const std::chrono::duration<double, std::micro> taken = std::chrono::steady_clock::now() - begin;
  return taken.count() / STRETCH;
}

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Turn by turn, so that whatever else the machine does meets both.
void timeRecorded(benchmark::State& state, int side)
{
  const cloth::RecordedStart start = hungSheet(side);
  cloth::Simulation plain(start.model, start.pinned, start.params);
  cloth::Simulation recorded = plain;
  const std::string path = "/tmp/cloth_bench_" + std::to_string(getpid());
  recorded.recordTo(std::make_shared<cloth::Recorder>(
      std::make_unique<cloth::RecordingFile>(path, ROOM), start, nullptr));
  timeOf(plain);
  timeOf(recorded);
  std::vector<double> plain_times;
  std::vector<double> ratios;
  for (auto _ : state)
  {
    plain_times.push_back(timeOf(plain));
    const double time = timeOf(recorded);
    ratios.push_back(time / plain_times.back());
    state.SetIterationTime(1e-6 * time);
  }
  std::remove(path.c_str());
  state.counters["plain_us"] = median(plain_times);
  state.counters["ratio"] = median(ratios);
}

}  // namespace

void registerRecording()
{
  for (int side : { 30, 100 })
  {
    registerCase("recorded/" + std::to_string(side),
                 [side](benchmark::State& state) { timeRecorded(state, side); })
        ->Iterations(25)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
  }
}

}  // namespace cloth_bench
