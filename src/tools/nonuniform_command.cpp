// thesis_experiments nonuniform: half the particles, fine only where balls strike (4.1, 4.3).
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/experiments/ball_experiment.h"
#include "experiment_commands.h"
#include "experiment_output.h"

namespace cloth
{
namespace
{

constexpr int ROUNDS = 3;  ///< the two cloths take turns so many times

struct Run
{
  int particles = 0;
  int wrong = 0;                ///< balls that end otherwise than in the thesis
  std::vector<double> seconds;  ///< a round
};

void play(const Simulation& hung, Run& run)
{
  const auto start = std::chrono::steady_clock::now();
  run.particles = hung.cloth().mesh.particleCount();
  run.wrong = 0;
  for (const BallThrow& thrown : THESIS_THROWS)
  {
    Simulation simulation = hung;
    run.wrong += throwBall(simulation, thrown).agrees(thrown) ? 0 : 1;
  }
  run.seconds.push_back(
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

/// Half the particles, with the uniform sheet's spacing in the middle.
Setting coarsened(const Setting& uniform, double grading)
{
  Setting setting = uniform;
  setting.resolution = static_cast<int>(std::lround(uniform.resolution / std::sqrt(2.0)));
  setting.grading = grading;
  return setting;
}

void report(const char* name, const Setting& setting, const Run& run, Output& output)
{
  std::printf("  %-12s %5d particles  %d of 5 as in the thesis  %.2f s\n", name, run.particles,
              5 - run.wrong, median(run.seconds));
  Row row = settingColumns(setting);
  row.insert(row.end(), { { "particles", std::to_string(run.particles) },
                          { "wrong", std::to_string(run.wrong) },
                          { "seconds", text(median(run.seconds)) } });
  output.row(row);
}

bool compare(const Setting& uniform, double grading, Output& output)
{
  const Setting coarse = coarsened(uniform, grading);
  const Simulation hung_uniform = hungCloth(uniform);
  const Simulation hung_coarse = hungCloth(coarse);
  Run full;
  Run half;
  for (int round = 0; round < ROUNDS; ++round)
  {
    play(hung_uniform, full);
    play(hung_coarse, half);
  }
  std::printf("%s\n", clothName(uniform).c_str());
  report("uniform", uniform, full, output);
  report("non-uniform", coarse, half, output);
  std::printf("  time saved: %.0f %%\n",
              100.0 * (1.0 - median(half.seconds) / median(full.seconds)));
  return full.wrong == 0 && half.wrong == 0;
}

}  // namespace

bool nonuniform(const Options& options)
{
  Output output(options.output, "nonuniform.csv");
  bool all = true;
  const double grading = options.grading.value_or(2.0);
  Options uniform = options;
  uniform.grading = 1.0;
  for (const Setting& setting : uniform.settings({ 40 }, ALL_MESHES, { 1 }))
  {
    all = compare(setting, grading, output) && all;
  }
  std::printf(all ? "half the particles, the same outcomes\n" : "OUTCOMES DIFFER\n");
  return all;
}

}  // namespace cloth
