// Times cloth while it is torn: the whole of a step, and what a tear adds to it.
#include <time.h>

#include <algorithm>
#include <cmath>

#include "cases.h"
#include "cloth_tearing/experiments/pull.h"
#include "hanging_step.h"
#include "phase_times.h"
#include "project_engine.h"

namespace cloth_bench
{
namespace
{

using cloth::StepPhase;
using cloth::Vec3d;

constexpr double PULL_TIME = 0.12;     ///< a place is pulled for so long [s]
constexpr double PULL_SPEED = 3.0;     ///< [m/s]
constexpr double GRASP_RADIUS = 0.05;  ///< [m]
constexpr double MOST_UPDATES = 1e8;   ///< steps x particles of a run
constexpr int PULLS = 10;

double median(std::vector<double> values)
{
  if (values.empty())
  {
    return std::nan("");
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// CPU time of this process [s].
double cpuTime()
{
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What a run of pulls costs.
struct Torn
{
  std::vector<double> quiet_edit;  ///< EDIT phase of steps without tears [us]
  std::vector<double>
      tear_edit;  ///< of steps with tears that cut no one-point connection: a tear [us]
  std::vector<double> one_point_edit;  ///< of steps with one one-point tear alone [us]
  std::vector<double>
      quiet_advance;  ///< ADVANCE phase of steps with no tear in the step before [us]
  std::vector<double> after_advance;  ///< and with one [us]
  double update = 0.0;                ///< CPU time of all steps [s]
  double tearing = 0.0;               ///< DETECT and EDIT of all steps [us]
  double phases = 0.0;                ///< all phases of all steps [us]
  double particle_steps = 0.0;
  int tears = 0;
  int steps = 0;
};

/// The hand takes hold of the cloth at places that jump about and pulls them to the front.
class Hand
{
public:
  Hand(cloth::Simulation& simulation, Torn& torn) : simulation_(simulation), torn_(torn) {}

  void pull(int number, int steps)
  {
    const double across = 0.5 + 0.6180339887498949 * number;
    cloth::Pull pull;
    pull.place = { 0.1 + 0.8 * (across - std::floor(across)), 0.7 * number / PULLS };
    pull.way = PULL_SPEED * PULL_TIME * Vec3d(number % 2 == 0 ? 1.0 : -1.0, -1.0, 0.3).normalized();
    pull.speed = PULL_SPEED;
    pull.radius = GRASP_RADIUS;
    cloth::beginPull(simulation_, pull);
    const double before = cpuTime();
    for (int i = 0; i < steps; ++i)
    {
      step();
    }
    torn_.update += cpuTime() - before;
    simulation_.releaseAll();
  }

private:
  void step()
  {
    const cloth::StepReport report = simulation_.step(&times_);
    if (!report.fault.empty())
    {
      throw std::runtime_error(report.fault);
    }
    (tore_ ? torn_.after_advance : torn_.quiet_advance).push_back(times_.of(StepPhase::ADVANCE));
    sortEdit(report.tears);
    for (int phase = 0; phase < cloth::STEP_PHASES; ++phase)
    {
      torn_.phases += times_.of(static_cast<StepPhase>(phase));
    }
    torn_.tearing += times_.of(StepPhase::DETECT) + times_.of(StepPhase::EDIT);
    torn_.tears += static_cast<int>(report.tears.size());
    torn_.particle_steps += simulation_.cloth().state.size();
    ++torn_.steps;
    tore_ = !report.tears.empty();
  }

  void sortEdit(const std::vector<cloth::TearEvent>& tears)
  {
    const double edit = times_.of(StepPhase::EDIT);
    const auto one_point = std::count_if(tears.begin(), tears.end(),
                                         [](const cloth::TearEvent& tear)
                                         { return tear.kind == cloth::TearKind::ONE_POINT; });
    if (tears.empty())
    {
      torn_.quiet_edit.push_back(edit);
    }
    else if (one_point == 0)
    {
      torn_.tear_edit.push_back(edit / static_cast<double>(tears.size()));
    }
    else if (tears.size() == 1)
    {
      torn_.one_point_edit.push_back(edit);
    }
  }

  cloth::Simulation& simulation_;
  Torn& torn_;
  PhaseTimes times_;
  bool tore_ = false;
};

Torn tear(cloth::Simulation simulation, int steps_of_a_pull, int pulls)
{
  Torn torn;
  Hand hand(simulation, torn);
  for (int i = 0; i < pulls; ++i)
  {
    hand.pull(i, steps_of_a_pull);
  }
  return torn;
}

void timeTears(benchmark::State& state, EngineKind engine, MeshKind mesh, int side, int threads)
{
  const Scene scene = makeScene(SceneKind::HUNG, mesh, side);
  const double time_step = hangingStep(engine, mesh, side, "").time_step;
  const cloth::Simulation hung =
      makeSimulation(scene, projectParams(engine, scene, time_step, threads));
  const int steps =
      static_cast<int>(std::min(PULL_TIME / time_step, MOST_UPDATES / hung.cloth().state.size()));
  const double updates = static_cast<double>(steps) * hung.cloth().state.size();
  const int pulls = std::clamp(static_cast<int>(MOST_UPDATES / updates), 1, PULLS);
  Torn torn;
  for (auto _ : state)
  {
    torn = tear(hung, steps, pulls);
    state.SetIterationTime(torn.update / torn.steps);
  }
  state.counters["particles"] = torn.particle_steps / torn.steps;
  state.counters["time_step_ms"] = 1e3 * time_step;
  state.counters["ns_per_particle"] = 1e9 * torn.update / torn.particle_steps;
  state.counters["real_time_factor"] = time_step * torn.steps / torn.update;
  state.counters["tears"] = torn.tears;
  state.counters["tears_per_step"] = static_cast<double>(torn.tears) / torn.steps;
  const double quiet = median(torn.quiet_edit);
  state.counters["us_per_tear"] = median(torn.tear_edit) - quiet;
  state.counters["us_per_one_point_tear"] = median(torn.one_point_edit) - quiet;
  state.counters["us_advance_after_tear"] = median(torn.after_advance) - median(torn.quiet_advance);
  state.counters["tearing_percent"] = 100.0 * torn.tearing / torn.phases;
}

void add(EngineKind engine, MeshKind mesh, int side, int threads)
{
  const std::string name = "torn/" + nameOf(engine) + "/" + nameOf(mesh) + "/" +
                           std::to_string(side) + "/threads:" + std::to_string(threads);
  registerCase(name,
               [=](benchmark::State& state) { timeTears(state, engine, mesh, side, threads); })
      ->Iterations(1)
      ->UseManualTime()
      ->Repetitions(side > 300   ? 1
                    : side > 100 ? 2
                                 : 5)
      ->Unit(benchmark::kMicrosecond);
}

}  // namespace

void registerTears()
{
  for (int side : { 30, 100, 300 })
  {
    add(EngineKind::XPBD, MeshKind::GRID, side, 1);
    add(EngineKind::FORCE_SPRINGS, MeshKind::GRID, side, 1);
    add(EngineKind::XPBD, MeshKind::IRREGULAR, side, 1);
    add(EngineKind::XPBD_LINES, MeshKind::GRID, side, 1);
    add(EngineKind::XPBD_LINES, MeshKind::IRREGULAR, side, 1);
  }
}

}  // namespace cloth_bench
