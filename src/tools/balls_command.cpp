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

std::string clothName(const Setting& setting)
{
  std::string name =
      std::string(nameOf(setting.pattern)) + "_" + std::to_string(setting.resolution);
  if (setting.pattern == RectanglePattern::IRREGULAR)
  {
    name += "_" + std::to_string(setting.seed);
  }
  return name;
}

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

Row columns(const Setting& setting, std::size_t experiment, const BallThrow& thrown,
            const BallOutcome& outcome)
{
  Row row = settingColumns(setting);
  row.insert(row.end(), { { "experiment", std::to_string(experiment) },
                          { "radius", text(thrown.radius) },
                          { "speed", text(thrown.speed) },
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

/// @return how many of the five end otherwise than in the thesis
int ballsOn(const Setting& setting, Output& output)
{
  const Simulation hung = hungCloth(setting);
  int wrong = 0;
  for (std::size_t i = 0; i < THESIS_THROWS.size(); ++i)
  {
    const BallThrow& thrown = THESIS_THROWS[i];
    Simulation simulation = hung;
    const BallOutcome outcome = throwBall(simulation, thrown);
    wrong += outcome.agrees(thrown) ? 0 : 1;
    print(setting, thrown, outcome);
    output.row(columns(setting, i + 1, thrown, outcome));
    output.snapshot("balls_" + clothName(setting) + "_" + std::to_string(i + 1) + ".obj",
                    simulation);
  }
  return wrong;
}

}  // namespace

bool balls(const Options& options)
{
  Output output(options.output, "balls.csv");
  int wrong = 0;
  int runs = 0;
  for (const Setting& setting : options.settings({ 30 }, ALL_MESHES, { 1 }))
  {
    wrong += ballsOn(setting, output);
    runs += static_cast<int>(THESIS_THROWS.size());
  }
  std::printf("%d of %d as in the thesis\n", runs - wrong, runs);
  return wrong == 0;
}

}  // namespace cloth
