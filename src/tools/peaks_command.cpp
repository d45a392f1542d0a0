// thesis_experiments peaks: in which window a tear threshold has to lie, on which mesh (4.1).
#include <algorithm>
#include <cstdio>
#include <limits>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/experiments/ball_experiment.h"
#include "experiment_commands.h"
#include "experiment_output.h"

namespace cloth
{
namespace
{

/// Thresholds between these tear where the thesis saw tears, and nowhere else.
struct Window
{
  double low = 0.0;  ///< largest peak of the balls that slide off
  double high = std::numeric_limits<double>::infinity();  ///< smallest of those that tear

  void add(double peak, bool tears)
  {
    (tears ? high : low) = tears ? std::min(high, peak) : std::max(low, peak);
  }
};

struct Windows
{
  Window local;
  Window local_hem;
  Window patch;

  void add(const BallPeaks& peaks, bool tears)
  {
    local.add(peaks.local, tears);
    local_hem.add(peaks.local_hem, tears);
    patch.add(peaks.patch, tears);
  }
};

void print(const char* what, const Window& window)
{
  std::printf("  %-32s above %.3f, below %.3f%s\n", what, window.low, window.high,
              window.low < window.high ? "" : ": NONE SERVES ALL");
}

void peaksOn(const Setting& setting, Output& output, Windows& all)
{
  const Simulation hung = hungCloth(setting);
  std::printf("%-18s", clothName(setting).c_str());
  for (std::size_t i = 0; i < THESIS_THROWS.size(); ++i)
  {
    Simulation simulation = hung;
    const BallPeaks peaks = peaksOf(simulation, THESIS_THROWS[i]);
    all.add(peaks, THESIS_THROWS[i].tears);
    std::printf("  %.3f %.3f %.3f", peaks.local, peaks.local_hem, peaks.patch);
    std::fflush(stdout);
    Row row = settingColumns(setting);
    row.insert(row.end(), { { "experiment", std::to_string(i + 1) },
                            { "tears", THESIS_THROWS[i].tears ? "1" : "0" },
                            { "local", text(peaks.local) },
                            { "local_hem", text(peaks.local_hem) },
                            { "patch", text(peaks.patch) } });
    output.row(row);
  }
  std::printf("\n");
}

}  // namespace

bool peaks(const Options& options)
{
  Output output(options.output, "peaks.csv");
  Windows windows;
  std::printf(
      "largest strains with tearing off, of balls 1 to 5: of a spring; the same with a hem; "
      "of a patch\n");
  for (const Setting& setting : options.settings({ 20, 30, 40, 60 }, ALL_MESHES, { 1 }))
  {
    peaksOn(setting, output, windows);
  }
  std::printf("a threshold that serves all of these lies\n");
  print("for a spring's strain:", windows.local);
  print("for a spring's strain, with hem:", windows.local_hem);
  print("for patch strain, with hem:", windows.patch);
  return windows.patch.low < windows.patch.high;
}

}  // namespace cloth
