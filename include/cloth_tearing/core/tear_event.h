// What a tear leaves behind for those who watch.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cloth_tearing/core/types.h"

namespace cloth
{

enum class TearKind
{
  BASIC,       ///< sound cloth opens across a spring (3.2.1)
  WEAK_POINT,  ///< a tear runs on along a spring (3.2.2)
  ONE_POINT,   ///< a one-point connection lets go (3.2.3)
  RELEASED,    ///< no finer tear is possible: the spring carries no load any more
};
constexpr int TEAR_KINDS = 4;

enum class CauseKind
{
  NONE,
  GRASP,
  SPHERE,         ///< of a stream
  THROWN_SPHERE,  ///< with an id of our own
};

/// The grasp or sphere nearest to a tear.
struct TearCause
{
  CauseKind kind = CauseKind::NONE;
  std::uint64_t id = 0;  ///< grasp id or sphere id
  double distance =
      0.0;  ///< from the tear to the nearest held particle or the sphere's surface [m]
};

struct TearEvent
{
  /// A particle that the tear added: a copy has its original twice, a split point lies between two.
  struct Added
  {
    ParticleId id;
    std::array<ParticleId, 2> parents;
  };

  std::uint64_t sequence = 0;  ///< 1, 2, ... for the life of the simulation, resets included
  std::uint32_t epoch = 0;
  std::uint64_t step = 0;
  double time = 0.0;  ///< [s]
  TearKind kind = TearKind::BASIC;
  std::vector<Added> particles;
  SpringId spring;  ///< the overstretched spring
  SpringId path;    ///< the spring along which a weak point gave way; none for other kinds
  std::vector<TriangleId> triangles;  ///< touched by the edit, added ones too
  Vec3d position = Vec3d::Zero();     ///< where it tore [m], cloth frame
  Vec2d uv = Vec2d::Zero();           ///< the same place on the texture [-]
  double strain = 0.0;                ///< the strain that was read [-]
  double threshold = 0.0;             ///< and what it exceeded [-]
  double tension = 0.0;               ///< force in the spring before it tore [N]
  TearCause cause;
  int pieces = 0;           ///< pieces of cloth after it
  double loose_area = 0.0;  ///< rest area of the smaller piece if it parted the cloth, else 0 [m^2]
  double loose_mass = 0.0;  ///< its mass [kg]
};

}  // namespace cloth
