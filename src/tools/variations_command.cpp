// thesis_experiments variations: do the five balls end the same with another cloth (4.1)?
#include <algorithm>
#include <cstdio>
#include <functional>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/experiments/ball_experiment.h"
#include "experiment_commands.h"
#include "experiment_output.h"

namespace cloth
{
namespace
{

struct Variation
{
  const char* name;
  void (*scale)(SimulationParams&, double);
};

const std::vector<Variation> VARIATIONS = {
  { "areal_density", [](SimulationParams& p, double f) { p.material.areal_density *= f; } },
  { "stiffness", [](SimulationParams& p, double f) { p.material.stiffness *= f; } },
  { "bend_shear_stiffness",
    [](SimulationParams& p, double f) { p.material.bend_shear_stiffness *= f; } },
  { "damping", [](SimulationParams& p, double f) { p.material.damping *= f; } },
  { "air_friction", [](SimulationParams& p, double f) { p.environment.air_friction *= f; } },
  { "time_step", [](SimulationParams& p, double f) { p.solver.time_step *= f; } },
  { "tear_strain", [](SimulationParams& p, double f) { p.tearing.tear_strain *= f; } },
  { "weak_tear_strain",
    [](SimulationParams& p, double f)
    {
      p.tearing.weak_tear_strain *= f;
      p.tearing.one_point_tear_strain *= f;
    } },
  { "tear_radius", [](SimulationParams& p, double f) { p.tearing.tear_radius *= f; } },
  { "crack_length", [](SimulationParams& p, double f) { p.tearing.crack_length *= f; } },
};

const std::vector<double> FACTORS = { 0.8, 0.9, 1.1, 1.2 };

SimulationParams varied(const Setting& setting, const Variation& variation, double factor)
{
  SimulationParams params = thesisParams(setting);
  variation.scale(params, factor);
  // The weak thresholds are never above the intact one.
  TearRules& rules = params.tearing;
  rules.weak_tear_strain = std::min(rules.weak_tear_strain, rules.tear_strain);
  rules.one_point_tear_strain = std::min(rules.one_point_tear_strain, rules.tear_strain);
  return params;
}

/// @return the numbers of the balls that end otherwise than in the thesis
std::string flips(const Setting& setting, const SimulationParams& params, const Row& run,
                  Output& output)
{
  Simulation hung = hungSheet(thesisSheet(setting), params);
  settle(hung, HANGS_STILL);
  std::string flipped;
  for (std::size_t i = 0; i < THESIS_THROWS.size(); ++i)
  {
    Simulation simulation = hung;
    const BallOutcome outcome = throwBall(simulation, THESIS_THROWS[i]);
    const bool agrees = outcome.agrees(THESIS_THROWS[i]);
    flipped +=
        agrees ? ""
               : (flipped.empty() ? "" : "; ") + std::to_string(i + 1) + " " + outcome.inWords();
    Row row = run;
    row.insert(row.end(), { { "experiment", std::to_string(i + 1) },
                            { "tears", std::to_string(outcome.total()) },
                            { "slid", outcome.slid ? "1" : "0" },
                            { "torn_length", text(outcome.torn_length) },
                            { "peak_strain", text(outcome.peak_strain) },
                            { "as_in_thesis", agrees ? "1" : "0" } });
    output.row(row);
  }
  return flipped;
}

/// @return how many of the variations change an outcome
int variationsOf(const Setting& setting, Output& output)
{
  std::printf("%s\n", clothName(setting).c_str());
  int changed = 0;
  for (const Variation& variation : VARIATIONS)
  {
    for (const double factor : FACTORS)
    {
      Row run = settingColumns(setting);
      run.insert(run.end(), { { "parameter", variation.name }, { "factor", text(factor) } });
      const std::string flipped = flips(setting, varied(setting, variation, factor), run, output);
      changed += flipped.empty() ? 0 : 1;
      std::printf("  %-21s x %.1f  %s%s\n", variation.name, factor,
                  flipped.empty() ? "ok" : "FLIPPED: ball ", flipped.c_str());
      std::fflush(stdout);
    }
  }
  return changed;
}

}  // namespace

bool variations(const Options& options)
{
  Output output(options.output, "variations.csv");
  int changed = 0;
  int runs = 0;
  for (const Setting& setting : options.settings({ 40 }, { RectanglePattern::ALTERNATING }, { 1 }))
  {
    changed += variationsOf(setting, output);
    runs += static_cast<int>(VARIATIONS.size() * FACTORS.size());
  }
  std::printf("%d of %d variations leave all five outcomes as they are\n", runs - changed, runs);
  return changed == 0;
}

}  // namespace cloth
