// thesis_experiments balls: which balls tear the cloth, and which slide off it (4.1).
#include <algorithm>
#include <cstdio>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/experiments/ball_experiment.h"
#include "experiment_commands.h"
#include "experiment_output.h"

namespace cloth
{
namespace
{

struct Run
{
  const BallThrow& thrown;
  const BallOutcome& outcome;
  std::string experiment;
  bool agrees;
};

void print(const Setting& setting, const Run& run)
{
  const BallOutcome& outcome = run.outcome;
  std::printf(
      "%-18s %5.2f ms  %-18s %-18s basic %3d  weak %3d  one %3d  released %d  pieces %d  %s\n",
      clothName(setting).c_str(), 1e3 * setting.time_step, run.thrown.name, outcome.inWords(),
      outcome.tears[0], outcome.tears[1], outcome.tears[2], outcome.tears[3], outcome.pieces,
      run.agrees ? "ok" : "NOT AS IN THE THESIS");
  std::fflush(stdout);
}

Row columns(const Setting& setting, const Run& run)
{
  const BallThrow& thrown = run.thrown;
  const BallOutcome& outcome = run.outcome;
  Row row = settingColumns(setting);
  row.insert(row.end(), { { "experiment", run.experiment },
                          { "radius", text(thrown.radius) },
                          { "speed", text(thrown.speed) },
                          { "height", text(thrown.height) },
                          { "aside", text(thrown.aside) },
                          { "basic", std::to_string(outcome.tears[0]) },
                          { "weak_point", std::to_string(outcome.tears[1]) },
                          { "one_point", std::to_string(outcome.tears[2]) },
                          { "released", std::to_string(outcome.tears[3]) },
                          { "slid", outcome.slid ? "1" : "0" },
                          { "pieces", std::to_string(outcome.pieces) },
                          { "torn_length", text(outcome.torn_length) },
                          { "peak_strain", text(outcome.peak_strain) },
                          { "as_in_thesis", run.agrees ? "1" : "0" } });
  return row;
}

/// How many experiments were made, and how many ended otherwise than in the thesis.
struct Count
{
  int made = 0;
  int wrong = 0;

  void add(bool agrees)
  {
    ++made;
    wrong += agrees ? 0 : 1;
  }
};

void report(const Setting& setting, const Run& run, Output& output)
{
  print(setting, run);
  output.row(columns(setting, run));
}

void fiveBalls(const Simulation& hung, const Setting& setting, Output& output, Count& count)
{
  for (std::size_t i = 0; i < THESIS_THROWS.size(); ++i)
  {
    const BallThrow& thrown = THESIS_THROWS[i];
    const std::string experiment = std::to_string(i + 1);
    Simulation simulation = hung;
    const BallOutcome outcome = throwBall(simulation, thrown);
    count.add(outcome.agrees(thrown));
    report(setting, { thrown, outcome, experiment, outcome.agrees(thrown) }, output);
    output.snapshot("balls_" + fileName(setting) + "_" + experiment + ".obj", simulation);
  }
}

/// In the figure two balls have torn the cloth and a third is about to; a later ball may find the
/// cloth gone.
void threeBalls(const Simulation& hung, const Setting& setting, Output& output, Count& count)
{
  Simulation simulation = hung;
  const std::vector<BallThrow> throws(THREE_BALLS.begin(), THREE_BALLS.end());
  const std::vector<BallOutcome> outcomes = throwBalls(simulation, throws, THREE_BALLS_INTERVAL);
  const bool agrees = std::count_if(outcomes.begin(), outcomes.end(),
                                    [](const BallOutcome& o) { return o.toreThrough(); }) >= 2;
  count.add(agrees);
  for (std::size_t i = 0; i < throws.size(); ++i)
  {
    report(setting, { throws[i], outcomes[i], "three", agrees }, output);
  }
  output.snapshot("balls_" + fileName(setting) + "_three.obj", simulation);
}

}  // namespace

bool balls(const Options& options)
{
  Output output(options.output, "balls.csv");
  Count count;
  for (const Setting& setting : options.settings({ 30 }, ALL_MESHES, { 1 }))
  {
    const Simulation hung = hungCloth(setting);
    fiveBalls(hung, setting, output, count);
    threeBalls(hung, setting, output, count);
  }
  std::printf("%d of %d as in the thesis\n", count.made - count.wrong, count.made);
  return count.wrong == 0;
}

}  // namespace cloth
