// Times the copy of the cloth that leaves the core, and what becomes of it before it is published:
// markers and surface messages.
#include <benchmark/benchmark.h>

#include <string>

#include "cloth_tearing/core/snapshot_taker.h"
#include "cloth_tearing/node/cloth_markers.h"
#include "cloth_tearing/node/conversions.h"

namespace
{

using namespace cloth_tearing;  // NOLINT: the subject of every line below

const Placement PLACEMENT{ "world", cloth::Vec3d(0.0, 0.0, 1.5) };

/// Opens the sheet round every `spacing`-th particle that has cloth on all sides; 0 = nowhere.
void open(cloth::Cloth& cloth, int spacing)
{
  const int particles = spacing > 0 ? cloth.mesh.particleCount() : 0;
  for (int i = 0; i < particles; i += spacing)
  {
    const cloth::Fan fan = cloth.mesh.fans({ i }).front();
    if (fan.closed)
    {
      const cloth::SpringId across = fan.springs[fan.springs.size() / 2];
      cloth.follow(cloth.mesh.openAlong({ i }, fan.springs.front(), across));
    }
  }
}

/// The node's defaults with `side` particles along each edge.
NodeParams paramsOf(int side)
{
  NodeParams params;
  params.rectangle.columns = side;
  params.rectangle.rows = side;
  return params;
}

cloth::Snapshot sheet(int side, int spacing)
{
  const NodeParams params = paramsOf(side);
  const PlacedModel placed = placedModel(params);
  cloth::Cloth cloth = cloth::makeCloth(placed.model, placed.pinned, params.simulation.material,
                                        cloth::RestShapeSource::IMPORTED, 0.0);
  open(cloth, spacing);
  cloth::Snapshot snapshot;
  snapshot.surface = makeSurface(cloth);
  return snapshot;
}

/// @param torn as in the frame after a tear
void takeSnapshot(benchmark::State& state, bool torn)
{
  const NodeParams params = paramsOf(static_cast<int>(state.range(0)));
  const PlacedModel placed = placedModel(params);
  const cloth::Simulation simulation(placed.model, placed.pinned, params.simulation);
  cloth::SnapshotTaker taker;
  cloth::Snapshot snapshot;
  taker.take(simulation, snapshot);
  for (auto _ : state)
  {
    taker = torn ? cloth::SnapshotTaker() : taker;
    taker.take(simulation, snapshot);
    benchmark::DoNotOptimize(snapshot.surface.position.data());
  }
}

void drawMarkers(benchmark::State& state, Coloring coloring)
{
  const cloth::Snapshot snapshot =
      sheet(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  MarkerStyle style;
  style.coloring = coloring;
  ClothMarkers painter(style, PLACEMENT);
  visualization_msgs::MarkerArray markers;
  painter.draw(snapshot, markers);  // what stays while nothing tears
  for (auto _ : state)
  {
    painter.draw(snapshot, markers);
    benchmark::DoNotOptimize(markers.markers.data());
  }
}

/// As in the frame after a tear.
void drawTornMarkers(benchmark::State& state)
{
  std::array<cloth::Snapshot, 2> snapshots = {
    sheet(static_cast<int>(state.range(0)), static_cast<int>(state.range(1))),
    sheet(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)))
  };
  ClothMarkers painter(MarkerStyle(), PLACEMENT);
  visualization_msgs::MarkerArray markers;
  painter.draw(snapshots[0], markers);
  std::size_t next = 1;
  for (auto _ : state)
  {
    painter.draw(snapshots[next], markers);
    next = 1 - next;
  }
}

void fillSurface(benchmark::State& state)
{
  const cloth::Snapshot snapshot =
      sheet(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  ClothSurface message;
  fillTopology(message, *snapshot.surface.topology);
  for (auto _ : state)
  {
    fillMotion(message, snapshot.surface, PLACEMENT);
    benchmark::DoNotOptimize(message.positions.data());
  }
}

void fillTornSurface(benchmark::State& state)
{
  const cloth::Snapshot snapshot =
      sheet(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  ClothSurface message;
  for (auto _ : state)
  {
    fillTopology(message, *snapshot.surface.topology);
    fillMotion(message, snapshot.surface, PLACEMENT);
    benchmark::DoNotOptimize(message.positions.data());
  }
}

/// Small and large, whole and torn in some hundred places.
void sizes(benchmark::internal::Benchmark* bench)
{
  bench->ArgNames({ "side", "torn_every" })
      ->Args({ 30, 0 })
      ->Args({ 100, 0 })
      ->Args({ 100, 25 })
      ->Unit(benchmark::kMicrosecond);
}

}  // namespace

BENCHMARK_CAPTURE(takeSnapshot, quiet, false)
    ->ArgName("side")
    ->Arg(100)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(takeSnapshot, torn, true)
    ->ArgName("side")
    ->Arg(100)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(drawMarkers, texture, Coloring::TEXTURE)->Apply(sizes);
BENCHMARK_CAPTURE(drawMarkers, strain, Coloring::STRAIN)->Apply(sizes);
BENCHMARK_CAPTURE(drawMarkers, plain, Coloring::PLAIN)->Apply(sizes);
BENCHMARK_CAPTURE(drawMarkers, wireframe, Coloring::WIREFRAME)->Apply(sizes);
BENCHMARK(drawTornMarkers)->Apply(sizes);
BENCHMARK(fillSurface)->Apply(sizes);
BENCHMARK(fillTornSurface)->Apply(sizes);

BENCHMARK_MAIN();
