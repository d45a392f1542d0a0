// thesis_experiments profile: what tearing costs while a cloth is torn all the time (4.3).
#include <algorithm>
#include <cstdio>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/experiments/profile_experiment.h"
#include "experiment_commands.h"
#include "experiment_output.h"

namespace cloth
{
namespace
{

constexpr int RUNS = 5;                ///< of each cloth, in turns: the times are medians
constexpr double TIME_PER_CENT = 2.0;  ///< of update for tearing, in the thesis

const char* const PHASES[STEP_PHASES] = { "carry",  "advance", "limit", "contact",
                                          "detect", "check",   "edit" };

/// One cloth with its runs, which differ in their times alone.
struct Profiled
{
  Setting setting;
  Simulation hung;
  std::vector<ProfileOutcome> runs;
};

template <class Value>
double medianOf(const Profiled& profiled, const Value& value)
{
  std::vector<double> values;
  for (const ProfileOutcome& run : profiled.runs)
  {
    values.push_back(value(run));
  }
  return median(values);
}

/// Median share of update [%].
double share(const Profiled& profiled, int phase)
{
  return medianOf(profiled, [phase](const ProfileOutcome& run)
                  { return 100.0 * run.time[phase] / run.update(); });
}

double tearingShare(const Profiled& profiled)
{
  return medianOf(profiled, [](const ProfileOutcome& run)
                  { return 100.0 * (run.detecting() + run.editing()); });
}

double perTear(const Profiled& profiled)
{
  return medianOf(profiled, [](const ProfileOutcome& run)
                  { return 1e6 * run.editing() * run.update() / std::max(1, run.tears()); });
}

void printCounts(const char* when, const Summary& summary)
{
  std::printf(
      "  %-7s %5d particles  %5d structural springs  %5d bend-shear springs  %5d triangles"
      "  %3d pieces\n",
      when, summary.particles, summary.springs, summary.bend_shear_springs, summary.triangles,
      summary.pieces);
}

void print(const Profiled& profiled, const std::string& name)
{
  const ProfileOutcome& run = profiled.runs.front();
  const auto& tears = run.after.tears;
  std::printf("%s, %.0f s simulated at %.2f ms\n", name.c_str(), PROFILE_TIME,
              1e3 * profiled.setting.time_step);
  printCounts("before", run.before);
  printCounts("after", run.after);
  std::printf(
      "  %d tears: basic %d, weak point %d, one point %d, released %d; in %.0f of %.0f "
      "seconds\n",
      run.tears(), static_cast<int>(tears[0]), static_cast<int>(tears[1]),
      static_cast<int>(tears[2]), static_cast<int>(tears[3]), run.torn_time, PROFILE_TIME);
  const double update = medianOf(profiled, [](const ProfileOutcome& r) { return r.update(); });
  std::printf("  update, median of %d runs: %.2f s, %.1f us a step:", RUNS, update,
              1e6 * update * profiled.setting.time_step / PROFILE_TIME);
  for (int i = 0; i < STEP_PHASES; ++i)
  {
    std::printf("  %s %.2f %%", PHASES[i], share(profiled, i));
  }
  std::printf("\n  detecting and editing together: %.2f %% of update (thesis: 2); %.1f us a tear\n",
              tearingShare(profiled), perTear(profiled));
}

Row columns(const Profiled& profiled)
{
  const ProfileOutcome& run = profiled.runs.front();
  Row row = settingColumns(profiled.setting);
  row.insert(row.end(), { { "particles_before", std::to_string(run.before.particles) },
                          { "springs_before", std::to_string(run.before.springs) },
                          { "bend_shear_before", std::to_string(run.before.bend_shear_springs) },
                          { "triangles_before", std::to_string(run.before.triangles) },
                          { "particles_after", std::to_string(run.after.particles) },
                          { "springs_after", std::to_string(run.after.springs) },
                          { "bend_shear_after", std::to_string(run.after.bend_shear_springs) },
                          { "triangles_after", std::to_string(run.after.triangles) },
                          { "pieces", std::to_string(run.after.pieces) },
                          { "basic", std::to_string(run.after.tears[0]) },
                          { "weak_point", std::to_string(run.after.tears[1]) },
                          { "one_point", std::to_string(run.after.tears[2]) },
                          { "released", std::to_string(run.after.tears[3]) } });
  for (int i = 0; i < STEP_PHASES; ++i)
  {
    row.push_back({ std::string(PHASES[i]) + "_percent", text(share(profiled, i)) });
  }
  row.push_back({ "tearing_percent", text(tearingShare(profiled)) });
  row.push_back({ "us_per_tear", text(perTear(profiled)) });
  return row;
}

/// Whether counts, tears and time are those of 4.3, and the runs alike; only 30 x 30 is held to it.
bool holds(const Profiled& profiled)
{
  const ProfileOutcome& first = profiled.runs.front();
  const bool alike = std::all_of(profiled.runs.begin(), profiled.runs.end(),
                                 [&](const ProfileOutcome& run)
                                 { return run.after.state_hash == first.after.state_hash; });
  const bool judged = profiled.setting.resolution == 30;
  const bool quick = tearingShare(profiled) <= TIME_PER_CENT;
  const bool thesis = first.hasThesisCounts() && first.hasThesisTears();
  std::printf("  counts and tears: %s; time: %s%s\n",
              !judged  ? "not judged, 4.3 has 30 x 30"
              : thesis ? "as in the thesis"
                       : "NOT AS IN THE THESIS",
              !judged ? "not judged"
              : quick ? "no more than in the thesis"
                      : "MORE THAN IN THE THESIS",
              alike ? "" : "; THE RUNS DIFFER");
  return alike && ((thesis && quick) || !judged);
}

}  // namespace

bool profile(const Options& options)
{
  Output output(options.output, "profile.csv");
  std::vector<Profiled> all;
  for (const Setting& setting : options.settings({ 30 }, { RectanglePattern::ONE_DIAGONAL }, { 1 }))
  {
    all.push_back({ setting, profileCloth(setting), {} });
  }
  for (int run = 0; run < RUNS; ++run)
  {
    for (Profiled& profiled : all)
    {
      Simulation simulation = profiled.hung;
      profiled.runs.push_back(profile(simulation));
      if (run == 0)
      {
        output.snapshot("profile_" + fileName(profiled.setting) + ".obj", simulation);
      }
    }
  }
  bool hold = true;
  for (const Profiled& profiled : all)
  {
    print(profiled, clothName(profiled.setting));
    hold = holds(profiled) && hold;
    output.row(columns(profiled));
  }
  return hold;
}

}  // namespace cloth
