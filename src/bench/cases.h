// What cloth_bench measures: each group of cases in a file of its own.
#pragma once

#include <benchmark/benchmark.h>

#include <exception>
#include <string>
#include <vector>

namespace cloth_bench
{

/// What the command line chooses.
struct Options
{
  std::string garment;        ///< OBJ file of a garment; empty = none is measured
  std::string hanging_steps;  ///< file that keeps the time steps found; empty = none
  std::vector<int> threads = { 1, 2 };
};

/// Registers a case whose failure ends itself alone.
template <class Measure>
benchmark::internal::Benchmark* registerCase(const std::string& name, const Measure& measure)
{
  return benchmark::RegisterBenchmark(name.c_str(),
                                      [measure](benchmark::State& state)
                                      {
                                        try
                                        {
                                          measure(state);
                                        }
                                        catch (const std::exception& error)
                                        {
                                          state.SkipWithError(error.what());
                                        }
                                      });
}

/// step/ENGINE/SCENE/MESH/SIDE/threads:T: what a step of hanging cloth costs, for all engines.
void registerSteps(const Options& options);

/// same_bits/SIDE: whether the cloth is the same for each number of threads.
void registerSameBits(const Options& options);

/// phases/ENGINE/SCENE/SIDE: which part of a step takes how much of it.
void registerPhases();

/// torn/ENGINE/MESH/SIDE/threads:T: what a step costs while the cloth is torn, and each tear.
void registerTears();

/// profile and after_tears/...: a thesis' cloth that was torn 500 times.
void registerProfile();

/// recorded/SIDE: what a step costs that is recorded to a file, beside one that is not.
void registerRecording();

}  // namespace cloth_bench
