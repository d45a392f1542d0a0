// thesis_experiments map: from which speed on a ball of some radius tears the cloth (4.1).
#include <cstdio>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/experiments/ball_experiment.h"
#include "experiment_commands.h"
#include "experiment_output.h"

namespace cloth
{
namespace
{

const std::vector<double> RADII = { 0.3, 0.5, 0.7, 1.0, 1.4, 1.7, 2.0, 2.4 };  ///< [m]
const std::vector<double> SPEEDS = { 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0 };
constexpr double HEIGHT = 0.42;  ///< of the balls' centres, as in figures 4.4 and 4.5

char letterOf(const BallOutcome& outcome)
{
  return outcome.toreThrough() ? '#' : outcome.total() > 0 ? '+' : '.';
}

/// Prints a row of the map.
/// @return the lowest speed from which on every ball goes through, beyond the last if none does
/// [m/s]
double throwAll(const Simulation& hung, const Setting& setting, double radius, Output& output)
{
  std::printf("  %4.1f ", radius);
  double border = 2.0 * SPEEDS.back();
  for (const double speed : SPEEDS)
  {
    Simulation simulation = hung;
    const BallOutcome outcome = throwBall(simulation, { "map", radius, speed, HEIGHT, true });
    std::printf("%6c", letterOf(outcome));
    std::fflush(stdout);
    border = !outcome.toreThrough() ? 2.0 * SPEEDS.back() : std::min(border, speed);
    Row row = settingColumns(setting);
    row.insert(row.end(), { { "radius", text(radius) },
                            { "speed", text(speed) },
                            { "tears", std::to_string(outcome.total()) },
                            { "slid", outcome.slid ? "1" : "0" },
                            { "torn_through", outcome.toreThrough() ? "1" : "0" } });
    output.row(row);
  }
  std::printf("\n");
  return border;
}

/// @return whether a larger ball never needs less speed
bool mapOf(const Setting& setting, Output& output)
{
  const Simulation hung = hungCloth(setting);
  std::printf("%s: # torn through, + torn but slid off, . not torn\n  r \\ v",
              clothName(setting).c_str());
  for (const double speed : SPEEDS)
  {
    std::printf("%6.1f", speed);
  }
  std::printf("\n");
  bool rises = true;
  double last = 0.0;
  for (const double radius : RADII)
  {
    const double border = throwAll(hung, setting, radius, output);
    rises = rises && border >= last;
    last = border;
  }
  std::printf(rises ? "the border rises with the radius\n" : "THE BORDER DOES NOT RISE\n");
  return rises;
}

}  // namespace

bool map(const Options& options)
{
  Output output(options.output, "map.csv");
  bool rises = true;
  for (const Setting& setting : options.settings({ 40 }, { RectanglePattern::ALTERNATING }, { 1 }))
  {
    rises = mapOf(setting, output) && rises;
  }
  return rises;
}

}  // namespace cloth
