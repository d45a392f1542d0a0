// thesis_experiments balls: which balls tear the cloth, and which slide off it (4.1).
#include <cstdio>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/experiments/ball_experiment.h"
#include "experiment_commands.h"
#include "experiment_output.h"

namespace cloth
{
namespace
{

void print(const Setting& setting, const BallThrow& thrown, const BallOutcome& outcome)
{
  const char* const what = outcome.toreThrough()  ? "torn through"
                           : outcome.total() == 0 ? "not torn"
                                                  : "torn, not through";
  std::printf(
      "%-18s %5.2f ms  %-17s %-18s basic %3d  weak %3d  one %3d  released %d  pieces %d  %s\n",
      clothName(setting).c_str(), 1e3 * setting.time_step, thrown.name, what, outcome.tears[0],
      outcome.tears[1], outcome.tears[2], outcome.tears[3], outcome.pieces,
      outcome.agrees(thrown) ? "ok" : "NOT AS IN THE THESIS");
  std::fflush(stdout);
}

Row columns(const Setting& setting, const std::string& experiment, const BallThrow& thrown,
            const BallOutcome& outcome)
{
  Row row = settingColumns(setting);
  row.insert(row.end(), { { "experiment", experiment },
                          { "radius", text(thrown.radius) },
                          { "speed", text(thrown.speed) },
                          { "aside", text(thrown.aside) },
                          { "height", text(thrown.height) },
                          { "basic", std::to_string(outcome.tears[0]) },
                          { "weak_point", std::to_string(outcome.tears[1]) },
                          { "one_point", std::to_string(outcome.tears[2]) },
                          { "released", std::to_string(outcome.tears[3]) },
                          { "slid", outcome.slid ? "1" : "0" },
                          { "pieces", std::to_string(outcome.pieces) },
                          { "torn_length", text(outcome.torn_length) },
                          { "peak_strain", text(outcome.peak_strain) },
                          { "as_in_thesis", outcome.agrees(thrown) ? "1" : "0" } });
  return row;
}

struct Count
{
  int runs = 0;
  int wrong = 0;
};

void report(const Setting& setting, const std::string& experiment, const BallThrow& thrown,
            const BallOutcome& outcome, Output& output, Count& count)
{
  ++count.runs;
  count.wrong += outcome.agrees(thrown) ? 0 : 1;
  print(setting, thrown, outcome);
  output.row(columns(setting, experiment, thrown, outcome));
}

void ballsOn(const Setting& setting, Output& output, Count& count)
{
  const Simulation hung = hungCloth(setting);
  for (std::size_t i = 0; i < THESIS_THROWS.size(); ++i)
  {
    const std::string experiment = std::to_string(i + 1);
    Simulation simulation = hung;
    const BallOutcome outcome = throwBall(simulation, THESIS_THROWS[i]);
    report(setting, experiment, THESIS_THROWS[i], outcome, output, count);
    output.snapshot("balls_" + clothName(setting) + "_" + experiment + ".obj", simulation);
  }

  Simulation simulation = hung;
  const std::vector<BallThrow> three(THREE_BALLS.begin(), THREE_BALLS.end());
  const std::vector<BallOutcome> outcomes = throwBalls(simulation, three, THREE_BALLS_INTERVAL);
  for (std::size_t i = 0; i < three.size(); ++i)
  {
    report(setting, "three", three[i], outcomes[i], output, count);
  }
  output.snapshot("balls_" + clothName(setting) + "_three.obj", simulation);
}

}  // namespace

bool balls(const Options& options)
{
  Output output(options.output, "balls.csv");
  Count count;
  for (const Setting& setting : options.settings({ 30 }, ALL_MESHES, { 1 }))
  {
    ballsOn(setting, output, count);
  }
  std::printf("%d of %d as in the thesis\n", count.runs - count.wrong, count.runs);
  return count.wrong == 0;
}

}  // namespace cloth
