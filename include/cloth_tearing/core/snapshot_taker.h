// Takes one snapshot after the other, and makes anew only what has changed.
#pragma once

#include <cstdint>
#include <memory>

#include "cloth_tearing/core/simulation.h"
#include "cloth_tearing/core/surface.h"

namespace cloth
{

/// For one simulation, whatever it is reset or restored to.
class SnapshotTaker
{
public:
  /// Writes over `snapshot`, whose memory is used again. It shares its topology with the last one
  /// as long as nothing tears, is put to rest, or begins anew.
  void take(const Simulation& simulation, Snapshot& snapshot);

private:
  /// What changes whenever the topology does.
  struct State
  {
    std::uint32_t epoch;
    std::uint64_t tears;
    int pieces_at_rest;

    bool operator==(const State& other) const
    {
      return epoch == other.epoch && tears == other.tears && pieces_at_rest == other.pieces_at_rest;
    }
  };

  State taken_{};  ///< of `topology_`
  std::shared_ptr<const SurfaceTopology> topology_;
};

}  // namespace cloth
