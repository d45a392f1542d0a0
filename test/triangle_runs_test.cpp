// Triangles in runs: each lies in one place, whatever was torn, and feels the same wind there.
#include "cloth_tearing/core/triangle_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "cloth_tearing/core/forces.h"
#include "cloth_tearing/core/simulation.h"
#include "scenes.h"

namespace cloth
{
namespace
{

using kernels::LANES;

Simulation torn(RectanglePattern pattern)
{
  SimulationParams params = vacuum();
  params.tearing.enabled = true;
  params.environment.wind_drag = 0.5;
  params.environment.wind = Vec3d(1.0, 2.0, 0.5);
  const ClothModel model = upright(sheet(1.0, 1.0, 40, 40, pattern));
  Simulation simulation(model, edgeOf(sheet(1.0, 1.0, 40, 40, pattern), "top"), params);
  ThrowRequest ball;
  ball.center = Vec3d(0.0, -0.3, -0.5);
  ball.velocity = Vec3d(0.0, 12.0, 0.0);
  ball.radius = 0.1;
  simulation.throwSphere(ball);
  run(simulation, 60);
  return simulation;
}

/// The triangles that the runs hold, by what they hold, and the loose ones.
std::vector<std::array<int, 3>> allOf(const TriangleRuns& runs, const Mesh& mesh)
{
  std::vector<std::array<int, 3>> all;
  for (std::size_t i = 0; i < runs.runs().size(); ++i)
  {
    const kernels::TriangleRun& run = runs.runs()[i];
    for (int lane = 0; lane < LANES; ++lane)
    {
      if (runs.areas()[i].area[lane] > 0)
      {
        all.push_back({ run.a + lane, run.b + lane, run.c + lane });
      }
    }
  }
  for (int t : runs.loose())
  {
    const auto& p = mesh.triangle({ t }).particles;
    all.push_back({ p[0].index, p[1].index, p[2].index });
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<std::array<int, 3>> allOf(const Mesh& mesh)
{
  std::vector<int> every(mesh.triangleCount());
  std::iota(every.begin(), every.end(), 0);
  std::vector<std::array<int, 3>> all;
  for (int t : every)
  {
    const auto& p = mesh.triangle({ t }).particles;
    all.push_back({ p[0].index, p[1].index, p[2].index });
  }
  std::sort(all.begin(), all.end());
  return all;
}

class Triangles : public ::testing::TestWithParam<RectanglePattern>
{
};

INSTANTIATE_TEST_SUITE_P(Meshes, Triangles,
                         ::testing::Values(RectanglePattern::ONE_DIAGONAL,
                                           RectanglePattern::ALTERNATING,
                                           RectanglePattern::IRREGULAR));

TEST_P(Triangles, LieInOnePlaceEachBeforeAndAfterTears)
{
  const Simulation simulation = torn(GetParam());
  ASSERT_GT(simulation.cloth().damage.tears, 10u);
  const Cloth untorn = makeCloth(upright(sheet(1.0, 1.0, 40, 40, GetParam())), {},
                                 simulation.params().material, RestShapeSource::IMPORTED, 0.0);
  TriangleRuns runs(untorn.mesh);

  runs.follow(untorn.mesh, untorn.rest, untorn.springs);
  EXPECT_EQ(allOf(runs, untorn.mesh), allOf(untorn.mesh));
  if (GetParam() != RectanglePattern::IRREGULAR)
  {
    EXPECT_LT(runs.loose().size(), allOf(untorn.mesh).size() / 20) << "a grid lies in runs";
  }

  TriangleRuns of_torn(untorn.mesh);
  of_torn.follow(simulation.cloth().mesh, simulation.cloth().rest, simulation.cloth().springs);
  EXPECT_EQ(allOf(of_torn, simulation.cloth().mesh), allOf(simulation.cloth().mesh));
}

TEST_P(Triangles, LieWhereTheyWouldIfTheTornClothHadBeenLookedAtOnce)
{
  Cloth cloth = makeCloth(upright(sheet(1.0, 1.0, 20, 20, GetParam())), {}, vacuum().material,
                          RestShapeSource::IMPORTED, 0.0);
  const Mesh untorn = cloth.mesh;
  TriangleRuns step_by_step(untorn);
  for (int spring = 100; spring < 1000; spring += 90)
  {
    step_by_step.follow(cloth.mesh, cloth.rest, cloth.springs);
    cloth.springs.changes.forget();
    cloth.follow(cloth.mesh.splitSpring({ spring }));
  }
  step_by_step.follow(cloth.mesh, cloth.rest, cloth.springs);

  TriangleRuns at_once(untorn);
  cloth.springs.changes.forget();
  at_once.follow(cloth.mesh, cloth.rest, cloth.springs);

  EXPECT_EQ(step_by_step.loose(), at_once.loose());
  for (std::size_t i = 0; i < at_once.areas().size(); ++i)
  {
    for (int lane = 0; lane < LANES; ++lane)
    {
      EXPECT_EQ(step_by_step.areas()[i].area[lane], at_once.areas()[i].area[lane]) << i;
    }
  }
}

/// The particles that a group's runs and loose triangles have, as those who go through it see them.
std::set<int> touchedBy(const TriangleRuns& runs, const TriangleGroup& group)
{
  std::set<int> touched;
  for (int i = group.first_run; i < group.end_run; ++i)
  {
    for (int lane = 0; lane < LANES; ++lane)
    {
      const kernels::TriangleRun& run = runs.runs()[i];
      touched.insert({ run.a + lane, run.b + lane, run.c + lane });
    }
  }
  for (const kernels::TriangleEnds& ends : group.ends)
  {
    for (int lane = 0; lane < LANES; ++lane)
    {
      touched.insert(
          { group.low + ends.a[lane], group.low + ends.b[lane], group.low + ends.c[lane] });
    }
  }
  return touched;
}

TEST_P(Triangles, OfAPhaseTouchNoParticleOfAnotherOfItsGroups)
{
  Cloth cloth = makeCloth(upright(sheet(1.0, 1.0, 70, 70, GetParam())), {}, vacuum().material,
                          RestShapeSource::IMPORTED, 0.0);
  TriangleRuns runs(cloth.mesh);
  for (int spring = 100; spring < 14000; spring += 900)
  {
    cloth.follow(cloth.mesh.splitSpring({ spring }));
  }
  runs.follow(cloth.mesh, cloth.rest, cloth.springs);
  const int particles = cloth.mesh.particleCount();
  int triangles = 0;
  std::vector<int> owned(particles, 0);
  EXPECT_GE(runs.phases()[1], 3) << "or there is nothing to share";
  for (int phase = 0; phase < 3; ++phase)
  {
    std::set<int> others;
    for (int g = runs.phases()[phase]; g < runs.phases()[phase + 1]; ++g)
    {
      runs.arrange(g, cloth.mesh, cloth.rest);
      const TriangleGroup& group = runs.groups()[g];
      triangles += static_cast<int>(group.loose.size());
      const std::set<int> touched = touchedBy(runs, group);
      for (int p : touched)
      {
        EXPECT_TRUE(others.insert(p).second) << "particle " << p << ", phase " << phase;
      }
      if (phase == 0)
      {
        const auto [begin, end] = runs.own(g, particles);
        EXPECT_TRUE(touched.empty() || (*touched.begin() >= begin && *touched.rbegin() < end));
        std::for_each(owned.begin() + begin, owned.begin() + end, [](int& count) { ++count; });
      }
    }
  }
  EXPECT_EQ(owned, std::vector<int>(particles, 1)) << "each particle is one group's own";
  EXPECT_EQ(triangles, static_cast<int>(runs.loose().size()));
  EXPECT_LT(runs.groups()[runs.phases()[2]].loose.size(), 200u) << "few reach far";
}

TEST_P(Triangles, FeelTheSameWindWithThreads)
{
  const Simulation simulation = torn(GetParam());
  const Cloth& cloth = simulation.cloth();
  Vec3Array alone;
  OuterForces().accelerate(cloth, cloth.mesh, simulation.params().environment, alone);
  for (int threads : { 2, 3, 7 })
  {
    WorkerPool workers(threads);
    Vec3Array shared;
    OuterForces forces;
    for (int again = 0; again < 20; ++again)
    {
      forces.accelerate(cloth, cloth.mesh, simulation.params().environment, shared, &workers);
      ASSERT_EQ(shared, alone) << threads << " threads";
    }
  }
}

TEST_P(Triangles, FeelTheWindAsOneByOne)
{
  const Simulation simulation = torn(GetParam());
  const Cloth& cloth = simulation.cloth();
  const Environment& environment = simulation.params().environment;
  std::vector<Vec3d> expected(cloth.state.size(), Vec3d::Zero());
  const auto velocity = [&cloth](ParticleId p)
  { return Vec3d(cloth.state.velocity[p.index].cast<double>()); };
  const auto position = [&cloth](ParticleId p)
  { return Vec3d(cloth.state.position[p.index].cast<double>()); };
  for (int t = 0; t < cloth.mesh.triangleCount(); ++t)
  {
    const auto& [a, b, c] = cloth.mesh.triangle({ t }).particles;
    const Vec3d normal = (position(b) - position(a)).cross(position(c) - position(a));
    const Vec3d speed = environment.wind - (velocity(a) + velocity(b) + velocity(c)) / 3.0;
    const double area = std::min(normal.norm() / 2.0, cloth.rest.area[t]);
    const Vec3d force =
        environment.wind_drag * area * speed.dot(normal.normalized()) / 3.0 * normal.normalized();
    for (ParticleId p : { a, b, c })
    {
      expected[p.index] += force / cloth.rest.mass[p.index];
    }
  }

  Environment wind = environment;
  wind.gravity.setZero();
  wind.air_friction = 0.0;
  Vec3Array acceleration;
  OuterForces().accelerate(cloth, cloth.mesh, wind, acceleration);

  for (int i = 0; i < cloth.state.size(); ++i)
  {
    EXPECT_LT((acceleration[i].cast<double>() - expected[i]).norm(),
              1e-4 * (1.0 + expected[i].norm()))
        << "particle " << i;
  }
}

}  // namespace
}  // namespace cloth
