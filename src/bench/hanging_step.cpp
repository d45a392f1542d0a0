// Bisects the time step of a hanging cloth.
#include "hanging_step.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>

namespace cloth_bench
{
namespace
{

constexpr double SETTLING_TIME = 1.5;  ///< [s]
constexpr double SETTLING_AIR = 4.0;   ///< air friction while it comes to rest [1/s]
constexpr double REST_SPEED = 0.3;     ///< a stable cloth's fastest particle is slower then [m/s]
constexpr int COARSE = 30;             ///< particles a side that are searched from scratch
constexpr int FINE = 100;              ///< and near what was found for COARSE
constexpr double SHORTEST = 0.004;  ///< time step x particles a side, where the search begins [s]
constexpr double LONGEST = 0.6;
constexpr int COARSE_TRIALS = 9;
constexpr int FINE_TRIALS = 3;
constexpr double FINE_WINDOW = 1.15;  ///< the fine cloth's may differ from the coarse one's by that
constexpr double FAR_WINDOW = 4.0;    ///< or be so much shorter, where short edges decide

std::map<std::string, HangingStep> known;
std::string kept_in;

/// Whether a cloth is whole at the end of SETTLING_TIME.
bool staysWhole(EngineKind kind, const Scene& scene, double time_step)
{
  const std::unique_ptr<Engine> engine = makeEngine(kind, scene, time_step);
  for (int i = 0; i < static_cast<int>(SETTLING_TIME / time_step); ++i)
  {
    engine->step();
  }
  return std::isfinite(engine->fastest());
}

/// Lines hang as stiff as stated at steps at which wind or a ball would tear them: that is no use.
bool bearsScenes(EngineKind kind, MeshKind mesh, int side, double time_step)
{
  return kind != EngineKind::XPBD_LINES || mesh == MeshKind::GARMENT ||
         (staysWhole(kind, makeScene(SceneKind::WINDY, mesh, side), time_step) &&
          staysWhole(kind, makeScene(SceneKind::BALL, mesh, side), time_step));
}

/// The elongation of a cloth that hung for SETTLING_TIME; infinite if it does not come to rest.
double elongationAt(EngineKind kind, const Scene& scene, double time_step)
{
  constexpr double UNUSABLE = std::numeric_limits<double>::infinity();
  std::unique_ptr<Engine> engine;
  try
  {
    engine = makeEngine(kind, scene, time_step);
  }
  catch (const std::runtime_error&)  // the engine itself finds the step too long
  {
    return UNUSABLE;
  }
  const int steps = static_cast<int>(SETTLING_TIME / time_step);
  for (int i = 0; i < steps; ++i)
  {
    engine->step();
    const bool look = i % 100 == 99 || i + 1 == steps;
    if (look && !(engine->fastest() < (i + 1 == steps ? REST_SPEED : 100.0)))
    {
      return UNUSABLE;
    }
  }
  std::vector<double> strains = engine->strains();
  const auto nth = strains.begin() + static_cast<std::ptrdiff_t>(0.99 * strains.size());
  std::nth_element(strains.begin(), nth, strains.end());
  return std::isfinite(*nth) ? *nth : UNUSABLE;
}

/// Halves the range from a usable to an unusable step, in logarithms.
/// @param elongation_at of a step; infinite if it is of no use
HangingStep bisect(const std::function<double(double)>& elongation_at, double usable,
                   double unusable, int trials)
{
  HangingStep found;
  for (int i = 0; i < trials; ++i)
  {
    const double middle = std::sqrt(usable * unusable);
    const double elongation = elongation_at(middle);
    if (elongation <= MATCHED_ELONGATION)
    {
      usable = middle;
      found = { middle, elongation, false };
    }
    else
    {
      unusable = middle;
    }
  }
  return found;
}

HangingStep search(EngineKind kind, MeshKind mesh, int side, const std::string& garment)
{
  Scene scene = makeScene(SceneKind::HUNG, mesh, side, garment);
  scene.environment.air_friction = SETTLING_AIR;
  const auto elongation_at = [&](double time_step)
  {
    const double elongation = elongationAt(kind, scene, time_step);
    const bool good = elongation <= MATCHED_ELONGATION && bearsScenes(kind, mesh, side, time_step);
    return good ? elongation : std::numeric_limits<double>::infinity();
  };
  const double spacings = std::sqrt(static_cast<double>(scene.start.size()));
  if (side != FINE || mesh == MeshKind::GARMENT)
  {
    return bisect(elongation_at, SHORTEST / spacings, LONGEST / spacings, COARSE_TRIALS);
  }
  const double guess = hangingStep(kind, mesh, COARSE, garment).time_step * COARSE / FINE;
  const HangingStep near =
      bisect(elongation_at, guess / FINE_WINDOW, guess * FINE_WINDOW, FINE_TRIALS);
  return near.time_step > 0.0
             ? near
             : bisect(elongation_at, guess / FAR_WINDOW, guess / FINE_WINDOW, COARSE_TRIALS / 2);
}

void keep(const std::string& name, const HangingStep& step)
{
  std::fprintf(stderr, "hanging step of %s: %.4g ms, elongation %.2f %%\n", name.c_str(),
               1e3 * step.time_step, 100.0 * step.elongation);
  if (!kept_in.empty())
  {
    std::ofstream(kept_in, std::ios::app)
        << name << ' ' << step.time_step << ' ' << step.elongation << '\n';
  }
}

}  // namespace

HangingStep hangingStep(EngineKind kind, MeshKind mesh, int side, const std::string& garment)
{
  if (side > FINE && mesh != MeshKind::GARMENT)
  {
    HangingStep step = hangingStep(kind, mesh, FINE, garment);
    step.time_step *= static_cast<double>(FINE) / side;
    step.scaled = true;
    return step;
  }
  if (kind == EngineKind::NAIVE_SCATTERED)  // where its objects are makes no difference to it
  {
    return hangingStep(EngineKind::NAIVE, mesh, side, garment);
  }
  const std::string name = nameOf(kind) + "/" + nameOf(mesh) +
                           (mesh == MeshKind::GARMENT ? "" : "/" + std::to_string(side));
  const auto at = known.find(name);
  if (at != known.end())
  {
    return at->second;
  }
  const HangingStep found = search(kind, mesh, side, garment);
  if (!(found.time_step > 0.0))
  {
    throw std::runtime_error("no time step is both short enough and longer than the search goes");
  }
  keep(name, found);
  return known[name] = found;
}

void keepHangingStepsIn(const std::string& file)
{
  kept_in = file;
  std::ifstream lines(file);
  std::string name;
  HangingStep step;
  while (lines >> name)
  {
    if (!(lines >> step.time_step >> step.elongation))
    {
      throw std::runtime_error(file + " is no list of time steps: delete it");
    }
    known[name] = step;
  }
}

}  // namespace cloth_bench
