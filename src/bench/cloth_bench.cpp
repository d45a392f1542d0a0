// cloth_bench: what this project's cloth costs, beside its peers in the same run.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "cases.h"
#include "engine.h"
#include "hanging_step.h"

namespace
{

const char* const USAGE =
    R"(usage: cloth_bench [--garment=FILE] [--steps=FILE] [OPTION ...]

Times hanging, windy, struck and torn cloth with this project's solvers, a naive reference and
Bullet's soft body (if it was found), each at the longest stable time step with which the 99th
percentile of hanging elongation is at most 10 %. That step is searched first, when it is needed.

  --garment=FILE  an OBJ file of a garment, measured as well
  --steps=FILE    keeps the time steps that were found, so that the next run need not search

The other options are Google Benchmark's, of which these help most:

  --benchmark_list_tests=true   names everything
  --benchmark_filter=REGEX      measures only that
  --benchmark_enable_random_interleaving=true   A B A B, so that disturbances hit all alike
  --benchmark_out=FILE          writes JSON, for scripts/bench_tables and scripts/plot_bench

scripts/bench does all of it.
)";

/// Takes our own options out of the arguments.
cloth_bench::Options takeOptions(int& count, char** arguments)
{
  cloth_bench::Options options;
  int kept = 1;
  for (int i = 1; i < count; ++i)
  {
    const std::string argument = arguments[i];
    if (argument == "--help" || argument == "-h")
    {
      std::fputs(USAGE, stdout);
      std::exit(0);
    }
    else if (argument.rfind("--garment=", 0) == 0)
    {
      options.garment = argument.substr(10);
    }
    else if (argument.rfind("--steps=", 0) == 0)
    {
      options.hanging_steps = argument.substr(8);
    }
    else
    {
      arguments[kept++] = arguments[i];
    }
  }
  count = kept;
  return options;
}

}  // namespace

int main(int count, char** arguments)
{
  try
  {
    const cloth_bench::Options options = takeOptions(count, arguments);
    benchmark::Initialize(&count, arguments);
    if (benchmark::ReportUnrecognizedArguments(count, arguments))
    {
      return 2;
    }
    if (!options.hanging_steps.empty())
    {
      cloth_bench::keepHangingStepsIn(options.hanging_steps);
    }
    if (!cloth_bench::isHere(cloth_bench::EngineKind::BULLET))
    {
      std::fputs("Bullet was not found when cloth_bench was built: it is left out\n", stderr);
    }
    if (options.garment.empty())
    {
      std::fputs("no --garment was given: it is left out\n", stderr);
    }
    cloth_bench::registerSteps(options);
    cloth_bench::registerSameBits(options);
    cloth_bench::registerPhases();
    cloth_bench::registerTears();
    cloth_bench::registerProfile();
    cloth_bench::registerRecording();
    return benchmark::RunSpecifiedBenchmarks() > 0 ? 0 : 1;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "cloth_bench: %s\n", error.what());
    return 1;
  }
}
