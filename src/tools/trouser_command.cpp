// thesis_experiments trouser: how a tear runs on from a cut, and the force it takes (4.2).
#include <cstdio>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/experiments/direction_experiment.h"
#include "cloth_tearing/experiments/trouser_experiment.h"
#include "experiment_commands.h"
#include "experiment_output.h"

namespace cloth
{
namespace
{

constexpr int LEAST_RESOLUTION =
    10;  ///< in a coarser sheet a leg may hold no particle near its end
const std::vector<int> SEEDS = { 1, 2, 3 };

void print(const Setting& setting, const TrouserOutcome& outcome)
{
  std::printf("%-12s %4d %5d %8.3f %8.2f %6.1f %6.1f %8.3f %7.3f %7.2f %7.2f %6d %4d %6d  %s\n",
              nameOf(setting.pattern), setting.resolution, static_cast<int>(setting.seed),
              outcome.edge_length, outcome.advance, outcome.angle, outcome.edge_angle,
              outcome.straying, outcome.tortuosity, outcome.mean_force, outcome.peak_force,
              outcome.tears, outcome.released, outcome.pieces,
              outcome.runsOn() ? "ok" : "DOES NOT RUN ON ALONG THE CUT");
  std::fflush(stdout);
}

Row columns(const Setting& setting, const TrouserOutcome& outcome)
{
  Row row = settingColumns(setting);
  row.insert(row.end(), { { "edge_length", text(outcome.edge_length) },
                          { "advance", text(outcome.advance) },
                          { "angle", text(outcome.angle) },
                          { "edge_angle", text(outcome.edge_angle) },
                          { "straying", text(outcome.straying) },
                          { "tortuosity", text(outcome.tortuosity) },
                          { "mean_force", text(outcome.mean_force) },
                          { "peak_force", text(outcome.peak_force) },
                          { "tears", std::to_string(outcome.tears) },
                          { "released", std::to_string(outcome.released) },
                          { "pieces", std::to_string(outcome.pieces) },
                          { "runs_on", outcome.runsOn() ? "1" : "0" } });
  return row;
}

}  // namespace

bool trouser(const Options& options)
{
  for (const int resolution : options.resolutions)
  {
    if (resolution < LEAST_RESOLUTION)
    {
      throw UsageError("--resolution is " + std::to_string(resolution) + ", must be at least " +
                       std::to_string(LEAST_RESOLUTION) + " for the trousers");
    }
  }
  std::printf(
      "A sheet cut half way up, its legs pulled apart, one to the front, one to the back.\n"
      "edge: mean rest length of a spring [m]; advance of the tear along the cut [m]; its angle to "
      "the cut,\nend to end and mean over its edges [degrees]; rms straying from the cut's line "
      "[m]; length over\nadvance; mean and peak force on a leg while it tears [N]. Seeds move "
      "where the legs are held, and\ndraw irregular meshes.\n\n"
      "mesh            n  seed     edge  advance  angle  edges straying  length    mean    peak  "
      "tears freed pieces\n");
  Output output(options.output, "trouser.csv");
  bool holds = true;
  Options cloths = options;
  cloths.seeds.clear();  // they move the legs as well, on every mesh
  for (Setting setting : cloths.settings({ 20, 30, 40, 60 }, ALL_MESHES, { 1 }))
  {
    for (const int seed : options.seeds.empty() ? SEEDS : options.seeds)
    {
      setting.seed = static_cast<std::uint64_t>(seed);
      Simulation simulation = trousers(setting);
      const TrouserOutcome outcome = pullLegs(simulation, shiftOf(setting.seed));
      print(setting, outcome);
      output.row(columns(setting, outcome));
      output.snapshot("trouser_" + fileName(setting) + ".obj", simulation);
      holds &= outcome.runsOn();
    }
  }
  std::printf("%s\n", holds ? "the tear runs on along the cut" : "NOT ALL TEARS RUN ON");
  return holds;
}

}  // namespace cloth
