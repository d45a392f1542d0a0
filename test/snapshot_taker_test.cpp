// Claims of snapshots that are taken one after the other.
#include "cloth_tearing/core/snapshot_taker.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace cloth
{
namespace
{

void expectSame(const SurfaceTopology& a, const SurfaceTopology& b)
{
  EXPECT_EQ(a.revision, b.revision);
  EXPECT_EQ(a.parents, b.parents);
  EXPECT_EQ(a.torn_edges, b.torn_edges);
  EXPECT_EQ(a.weak_points, b.weak_points);
  EXPECT_TRUE(std::equal(a.triangles.begin(), a.triangles.end(), b.triangles.begin(),
                         b.triangles.end(),
                         [](const SurfaceTriangle& one, const SurfaceTriangle& other)
                         { return one.particles == other.particles && one.uv == other.uv; }));
  EXPECT_TRUE(std::equal(a.springs.begin(), a.springs.end(), b.springs.begin(), b.springs.end(),
                         [](const SurfaceSpring& one, const SurfaceSpring& other) {
                           return one.particles == other.particles &&
                                  one.rest_length == other.rest_length;
                         }));
}

void expectSame(const Snapshot& a, const Snapshot& b)
{
  EXPECT_EQ(a.surface.time, b.surface.time);
  EXPECT_EQ(a.surface.step, b.surface.step);
  EXPECT_EQ(a.surface.epoch, b.surface.epoch);
  EXPECT_EQ(a.surface.position, b.surface.position);
  EXPECT_EQ(a.surface.held.size(), b.surface.held.size());
  expectSame(*a.surface.topology, *b.surface.topology);
  EXPECT_EQ(a.spheres.size(), b.spheres.size());
  EXPECT_EQ(a.grasps.size(), b.grasps.size());
}

/// A sheet in free fall through its bounds, torn by a ball on the way.
Simulation fallingSheet()
{
  SimulationParams params = tearable();
  params.contact.bounds_min = Vec3d::Constant(-2.0);
  Simulation simulation(upright(sheet(1.0, 1.0, 12, 12)), {}, params);
  ThrowRequest thrown;
  thrown.center = Vec3d(0.02, -0.4, -0.4);
  thrown.velocity = Vec3d(0, 8, 0);
  thrown.radius = 0.12;
  simulation.throwSphere(thrown);
  GraspRequest request;
  request.point = Vec3d(0.5, 0.0, 0.0);
  simulation.grasp(request);
  return simulation;
}

TEST(SnapshotTaker, TakesWhatASnapshotOfItsOwnHas)
{
  Simulation simulation = fallingSheet();
  SnapshotTaker taker;
  Snapshot snapshot;
  taker.take(simulation, snapshot);
  expectSame(snapshot, simulation.snapshot());

  std::size_t tears = 0;
  for (int i = 0; i < 2000 && simulation.summary().pieces_at_rest == 0; ++i)
  {
    tears += run(simulation, 1).size();
    if (i == 300)
    {
      simulation.releaseAll();
    }
    taker.take(simulation, snapshot);
    expectSame(snapshot, simulation.snapshot());
  }
  EXPECT_GT(tears, 5u);
  EXPECT_GT(simulation.summary().pieces_at_rest, 0);

  simulation.reset();
  taker.take(simulation, snapshot);
  expectSame(snapshot, simulation.snapshot());
}

TEST(SnapshotTaker, SharesTheTopologyUntilSomethingTears)
{
  Simulation simulation(sheet(1.0, 1.0, 5, 4), { 0, 4 }, tearable());
  SnapshotTaker taker;
  Snapshot before;
  Snapshot after;
  taker.take(simulation, before);

  run(simulation, 10);
  taker.take(simulation, after);
  EXPECT_EQ(before.surface.topology, after.surface.topology);
  EXPECT_NE(before.surface.position, after.surface.position);

  simulation.reset();
  taker.take(simulation, after);
  EXPECT_NE(before.surface.topology, after.surface.topology) << "of another epoch";
}

}  // namespace
}  // namespace cloth
