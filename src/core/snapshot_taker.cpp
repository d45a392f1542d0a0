// Takes one snapshot after the other, and makes anew only what has changed.
#include "cloth_tearing/core/snapshot_taker.h"

namespace cloth
{

void SnapshotTaker::take(const Simulation& simulation, Snapshot& snapshot)
{
  const Cloth& cloth = simulation.cloth();
  const State now{ simulation.epoch(), cloth.damage.tears, cloth.damage.pieces_at_rest };
  if (topology_ == nullptr || !(now == taken_))
  {
    topology_ = std::make_shared<const SurfaceTopology>(makeTopology(cloth));
    taken_ = now;
  }
  Surface& surface = snapshot.surface;
  surface.time = simulation.time();
  surface.step = simulation.stepCount();
  surface.epoch = simulation.epoch();
  surface.topology = topology_;
  takeMotion(cloth, surface);
  snapshot.spheres = simulation.spheres();
  snapshot.grasps = simulation.grasps();
}

}  // namespace cloth
