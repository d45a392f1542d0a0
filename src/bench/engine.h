// What the benchmark asks of every cloth engine, its own and its peers.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene.h"

namespace cloth_bench
{

enum class EngineKind
{
  XPBD,             ///< this project's default solver, tearing on
  XPBD_LINES,       ///< the same, whole lines of springs at once
  FORCE_SPRINGS,    ///< this project's force springs, tearing on
  NAIVE,            ///< objects and pointers, see naive_cloth.h
  NAIVE_SCATTERED,  ///< the same, its objects scattered in memory as long use leaves them
  BULLET,           ///< Bullet's soft body
};

std::string nameOf(EngineKind kind);

/// Whether the engine is another's, or stands for others.
bool isPeer(EngineKind kind);

/// Whether it can be measured here: Bullet is only where it was found.
bool isHere(EngineKind kind);

/// One cloth in one engine.
class Engine
{
public:
  virtual ~Engine() = default;

  /// One step of the time it was made for, not cut into substeps.
  virtual void step() = 0;

  virtual int particles() const = 0;

  /// Length / rest length - 1 of every structural spring [-].
  virtual std::vector<double> strains() const = 0;

  /// Speed of the fastest particle [m/s]; infinite or NaN if it ran away or tore.
  virtual double fastest() const = 0;
};

/// @param time_step [s]
/// @param threads that may share a step; peers use one
/// @throws std::runtime_error if the engine refuses this time step
std::unique_ptr<Engine> makeEngine(EngineKind kind, const Scene& scene, double time_step,
                                   int threads = 1);

/// The engines behind it, each in a file of its own.
std::unique_ptr<Engine> makeProjectEngine(EngineKind kind, const Scene& scene, double time_step,
                                          int threads);
std::unique_ptr<Engine> makeNaiveEngine(EngineKind kind, const Scene& scene, double time_step);
#ifdef CLOTH_BENCH_BULLET
std::unique_ptr<Engine> makeBulletEngine(const Scene& scene, double time_step);
#endif

}  // namespace cloth_bench
