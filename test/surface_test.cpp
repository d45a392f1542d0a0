// Claims of the snapshot that leaves the core.
#include "cloth_tearing/core/surface.h"

#include <gtest/gtest.h>

#include <set>

#include "scenes.h"

namespace cloth
{
namespace
{

std::vector<Vec3> normals(const Surface& surface)
{
  std::vector<Vec3> found;
  findNormals(surface, found);
  return found;
}

std::vector<Real> particleStrains(const Surface& surface)
{
  std::vector<Real> found;
  findParticleStrains(surface, found);
  return found;
}

std::vector<Real> springStrains(const Surface& surface)
{
  std::vector<Real> found;
  findSpringStrains(surface, found);
  return found;
}

TEST(Surface, HasTheClothAsItIs)
{
  const ClothModel model = sheet(1.0, 1.0, 5, 4);
  Simulation simulation(model, { 0, 4 }, vacuum());

  const Surface surface = simulation.snapshot().surface;

  EXPECT_EQ(surface.position.size(), 20u);
  ASSERT_EQ(surface.topology->triangles.size(), model.triangles.size());
  for (std::size_t i = 0; i < model.triangles.size(); ++i)
  {
    EXPECT_EQ(surface.topology->triangles[i].particles, model.triangles[i].vertices);
    EXPECT_EQ(surface.topology->triangles[i].uv, model.triangles[i].uv);
  }
  for (int i = 0; i < 20; ++i)
  {
    EXPECT_LT((normals(surface)[i] - Vec3::UnitZ()).norm(), 1e-6);
    EXPECT_EQ(surface.topology->parents[i], (std::array<int, 2>{ i, i }));
    EXPECT_NEAR(particleStrains(surface)[i], 0.0, 1e-6);
  }
  const int springs = simulation.cloth().mesh.springCount();
  ASSERT_EQ(surface.topology->springs.size(), static_cast<std::size_t>(springs));
  for (const Real strain : springStrains(surface))
  {
    EXPECT_NEAR(strain, 0.0, 1e-6);
  }
  EXPECT_TRUE(surface.topology->torn_edges.empty());
  EXPECT_TRUE(surface.topology->weak_points.empty());
  ASSERT_EQ(surface.held.size(), 2u);
  EXPECT_EQ(surface.held[1].particle, 4);
  EXPECT_EQ(surface.held[1].grasp, 0u);
  EXPECT_EQ(surface.topology->revision, 0u);
}

TEST(Surface, TellsTimeStepEpochAndWhoHolds)
{
  Simulation simulation(sheet(1.0, 1.0, 5, 4), { 0 }, vacuum());
  simulation.reset();
  GraspRequest request;
  request.point = Vec3d(0.5, -1.0, 0.0);
  const std::uint64_t id = simulation.grasp(request).id;
  simulation.throwSphere(ThrowRequest());
  run(simulation, 3);

  const Snapshot snapshot = simulation.snapshot();

  EXPECT_EQ(snapshot.surface.step, 3u);
  EXPECT_EQ(snapshot.surface.epoch, 1u);
  EXPECT_NEAR(snapshot.surface.time, 0.003, 1e-12);
  ASSERT_EQ(snapshot.surface.held.size(), 2u);
  EXPECT_EQ(snapshot.surface.held[1].particle, 19);
  EXPECT_EQ(snapshot.surface.held[1].grasp, id);
  EXPECT_EQ(snapshot.grasps.size(), 1u);
  EXPECT_EQ(snapshot.spheres.size(), 1u);
}

TEST(Surface, HasTheLargestStrainAtEachParticle)
{
  Cloth cloth = makeCloth(sheet(1.0, 1.0, 3, 3, RectanglePattern::ONE_DIAGONAL), {}, cotton(),
                          RestShapeSource::IMPORTED, 0.0);
  cloth.state.position[0].x() -= Real(0.05);  // 10 % of the cell, to its only right neighbour

  const Surface surface = makeSurface(cloth);

  const std::vector<Real> strains = particleStrains(surface);
  EXPECT_NEAR(strains[0], 0.1, 1e-5);
  EXPECT_NEAR(strains[1], 0.1, 1e-5);
  EXPECT_NEAR(strains[8], 0.0, 1e-6);
}

TEST(Surface, HasTheStrainOfEachSpring)
{
  Cloth cloth = makeCloth(sheet(1.0, 1.0, 3, 3, RectanglePattern::ONE_DIAGONAL), {}, cotton(),
                          RestShapeSource::IMPORTED, 0.0);
  cloth.state.position[0].x() -= Real(0.05);  // 10 % of the cell, to its only right neighbour

  const Surface surface = makeSurface(cloth);

  const std::vector<Real> strains = springStrains(surface);
  ASSERT_EQ(strains.size(), surface.topology->springs.size());
  int stretched = 0;
  for (std::size_t i = 0; i < strains.size(); ++i)
  {
    const std::array<int, 2>& ends = surface.topology->springs[i].particles;
    EXPECT_TRUE(ends[0] == 0 || ends[1] == 0 || std::abs(strains[i]) < 1e-6);
    stretched += std::abs(strains[i] - 0.1) < 1e-5 && ends[0] + ends[1] == 1;
  }
  EXPECT_EQ(stretched, 1) << "the spring between 0 and 1";
}

TEST(Surface, LeavesOutSpringsThatWereReleased)
{
  Cloth cloth = makeCloth(sheet(1.0, 1.0, 3, 3), {}, cotton(), RestShapeSource::IMPORTED, 0.0);
  const auto& ends = cloth.mesh.spring({ 2 }).particles;
  cloth.springs.release({ 2 });

  const Surface surface = makeSurface(cloth);

  EXPECT_EQ(surface.topology->springs.size(),
            static_cast<std::size_t>(cloth.mesh.springCount() - 1));
  const std::array<int, 2> released = { ends[0].index, ends[1].index };
  for (const SurfaceSpring& spring : surface.topology->springs)
  {
    EXPECT_NE(spring.particles, released);
  }
}

TEST(Surface, LeavesOutTrianglesThatLostTwoOfTheirSprings)
{
  Cloth cloth = makeCloth(sheet(1.0, 1.0, 4, 4), {}, cotton(), RestShapeSource::IMPORTED, 0.0);
  const Triangle rag = cloth.mesh.triangle({ 8 });  // amidst others
  cloth.springs.release(rag.springs[0]);
  ASSERT_EQ(makeSurface(cloth).topology->triangles.size(), 18u) << "one spring keeps it in shape";
  cloth.springs.release(rag.springs[1]);
  const auto indexOf = [](ParticleId p) { return p.index; };
  std::array<int, 3> corners{};
  std::transform(rag.particles.begin(), rag.particles.end(), corners.begin(), indexOf);

  const Surface surface = makeSurface(cloth);

  EXPECT_EQ(surface.topology->triangles.size(), 17u);
  for (const SurfaceTriangle& t : surface.topology->triangles)
  {
    EXPECT_NE(t.particles, corners);
  }
  EXPECT_EQ(surface.topology->torn_edges.size(), 3u) << "the cloth around it ends there";
}

TEST(Surface, HasNoTornEdgeOfATriangleThatItLeavesOut)
{
  Cloth cloth = makeCloth(sheet(1.0, 1.0, 4, 4), {}, cotton(), RestShapeSource::IMPORTED, 0.0);
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    cloth.springs.release({ i });
  }

  const Surface surface = makeSurface(cloth);

  EXPECT_TRUE(surface.topology->triangles.empty());
  EXPECT_TRUE(surface.topology->torn_edges.empty());
}

/// A hanging sheet with a ball thrown through it.
Simulation torn()
{
  SimulationParams params = tearable();
  const ClothModel flat = sheet(1.0, 1.0, 12, 12);
  Simulation simulation(upright(flat), edgeOf(flat, "top"), params);
  ThrowRequest thrown;
  thrown.center = Vec3d(0.02, -0.4, -0.4);
  thrown.velocity = Vec3d(0, 8, 0);
  thrown.radius = 0.12;
  simulation.throwSphere(thrown);
  EXPECT_GT(run(simulation, 250).size(), 5u);
  return simulation;
}

TEST(Surface, ShowsWhereTheClothIsTorn)
{
  const Simulation simulation = torn();
  const Surface surface = simulation.snapshot().surface;
  const Mesh& mesh = simulation.cloth().mesh;

  EXPECT_EQ(surface.topology->revision, simulation.revision());
  EXPECT_EQ(surface.position.size(), static_cast<std::size_t>(mesh.particleCount()));
  EXPECT_EQ(surface.topology->parents.size(), surface.position.size());
  int borders = 0;
  for (int i = 0; i < mesh.springCount(); ++i)
  {
    borders += mesh.spring({ i }).border();
  }
  EXPECT_EQ(static_cast<int>(surface.topology->torn_edges.size()), borders - 4 * 11)
      << "the rest is hem";
  for (std::size_t i = 144; i < surface.topology->parents.size(); ++i)
  {
    EXPECT_LT(surface.topology->parents[i][0], static_cast<int>(i)) << "torn from something older";
  }
  for (const Vec3& position : surface.position)
  {
    EXPECT_TRUE(position.allFinite());
  }
  for (const Vec3& normal : normals(surface))
  {
    EXPECT_NEAR(normal.norm(), 1.0, 1e-5);
  }
}

TEST(Surface, DoesNotDrawPiecesAtRest)
{
  SimulationParams params = untearable();
  params.contact.bounds_min = Vec3d::Constant(-2.0);
  Simulation simulation(sheet(1.0, 1.0, 5, 4), {}, params);
  run(simulation, 1500);
  ASSERT_EQ(simulation.summary().pieces_at_rest, 1);

  const Surface surface = simulation.snapshot().surface;

  EXPECT_TRUE(surface.topology->triangles.empty());
  EXPECT_TRUE(surface.topology->springs.empty());
  EXPECT_EQ(surface.position.size(), 20u) << "indices are particle ids";
}

}  // namespace
}  // namespace cloth
