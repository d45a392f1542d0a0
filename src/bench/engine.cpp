// Names the engines and makes the one that is asked for.
#include "engine.h"

#include <stdexcept>

namespace cloth_bench
{

std::string nameOf(EngineKind kind)
{
  switch (kind)
  {
    case EngineKind::XPBD:
      return "xpbd";
    case EngineKind::XPBD_LINES:
      return "xpbd_lines";
    case EngineKind::FORCE_SPRINGS:
      return "force_springs";
    case EngineKind::NAIVE:
      return "naive";
    case EngineKind::NAIVE_SCATTERED:
      return "naive_scattered";
    case EngineKind::BULLET:
      return "bullet";
  }
  throw std::invalid_argument("there is no such engine");
}

bool isPeer(EngineKind kind)
{
  return kind == EngineKind::NAIVE || kind == EngineKind::NAIVE_SCATTERED ||
         kind == EngineKind::BULLET;
}

bool isHere(EngineKind kind)
{
#ifdef CLOTH_BENCH_BULLET
  (void)kind;
  return true;
#else
  return kind != EngineKind::BULLET;
#endif
}

std::unique_ptr<Engine> makeEngine(EngineKind kind, const Scene& scene, double time_step,
                                   int threads)
{
  switch (kind)
  {
    case EngineKind::XPBD:
    case EngineKind::XPBD_LINES:
    case EngineKind::FORCE_SPRINGS:
      return makeProjectEngine(kind, scene, time_step, threads);
    case EngineKind::NAIVE:
    case EngineKind::NAIVE_SCATTERED:
      return makeNaiveEngine(kind, scene, time_step);
    case EngineKind::BULLET:
#ifdef CLOTH_BENCH_BULLET
      return makeBulletEngine(scene, time_step);
#else
      break;
#endif
  }
  throw std::runtime_error(nameOf(kind) + " was not found when the benchmark was built");
}

}  // namespace cloth_bench
