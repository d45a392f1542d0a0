// Claims of the mesh: what it is built from, what it refuses, fans, sides, and its own check.
#include "cloth_tearing/core/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "small_meshes.h"

namespace cloth
{
namespace
{

std::string refusal(int particles, const Faces& faces)
{
  std::vector<ModelTriangle> triangles;
  for (const auto& face : faces)
  {
    triangles.push_back({ face, { Vec2d(0, 0), Vec2d(1, 0), Vec2d(0, 1) } });
  }
  try
  {
    Mesh(particles, triangles);
  }
  catch (const TopologyError& error)
  {
    return error.what();
  }
  return "accepted";
}

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

int interiorSprings(const Mesh& mesh)
{
  int count = 0;
  for (int i = 0; i < mesh.springCount(); ++i)
  {
    count += mesh.spring({ i }).border() ? 0 : 1;
  }
  return count;
}

TEST(Mesh, OfThirtyByThirtyParticlesHasTheNumbersOfTheThesis)
{
  const Mesh mesh = meshOf(sheet(30, 30, RectanglePattern::ONE_DIAGONAL));

  EXPECT_EQ(mesh.particleCount(), 900);
  EXPECT_EQ(mesh.springCount(), 2581);
  EXPECT_EQ(interiorSprings(mesh), 2465);
  EXPECT_EQ(mesh.triangleCount(), 1682);
  EXPECT_TRUE(isSound(mesh));
}

TEST(Mesh, IsSoundInEveryConfiguration)
{
  for (const NamedModel& named : everyConfiguration())
  {
    EXPECT_TRUE(isSound(meshOf(named.model))) << named.name;
  }
}

TEST(Mesh, NumbersItsSpringsInTheOrderInWhichTrianglesNameThem)
{
  const Mesh mesh = meshOf(kite());

  EXPECT_EQ(springBetween(mesh, 0, 1).index, 0);
  EXPECT_EQ(springBetween(mesh, 1, 2).index, 1);
  EXPECT_EQ(springBetween(mesh, 2, 0).index, 2);
  EXPECT_EQ(springBetween(mesh, 0, 3).index, 3);
  EXPECT_EQ(springBetween(mesh, 3, 1).index, 4);
}

TEST(Mesh, SharesOneSpringBetweenNeighbourTriangles)
{
  const Mesh mesh = meshOf(kite());
  const SpringId shared = springBetween(mesh, 0, 1);

  EXPECT_FALSE(mesh.spring(shared).border());
  EXPECT_GE(mesh.triangle({ 0 }).sideOf(shared), 0);
  EXPECT_GE(mesh.triangle({ 1 }).sideOf(shared), 0);
  EXPECT_EQ(interiorSprings(mesh), 1);
}

TEST(Mesh, KnowsTheCornersOppositeASpring)
{
  const Mesh mesh = meshOf(kite());
  const SpringId shared = springBetween(mesh, 0, 1);
  const SpringId border = springBetween(mesh, 1, 2);

  EXPECT_EQ(mesh.opposite(shared, 0).index, 2);
  EXPECT_EQ(mesh.opposite(shared, 1).index, 3);
  EXPECT_EQ(mesh.opposite(border, 0).index, 0);
  EXPECT_FALSE(mesh.opposite(border, 1).valid());
}

TEST(Mesh, RefusesAnIndexOutOfRange)
{
  EXPECT_TRUE(contains(refusal(3, { { 0, 1, 3 } }), "triangle 0 names particle 3 of 3"));
  EXPECT_TRUE(contains(refusal(3, { { 0, 1, -1 } }), "triangle 0 names particle -1 of 3"));
}

TEST(Mesh, RefusesATriangleThatRepeatsAParticle)
{
  EXPECT_TRUE(contains(refusal(3, { { 0, 1, 2 }, { 1, 1, 2 } }), "triangle 1 repeats a particle"));
}

TEST(Mesh, RefusesAParticleWithoutATriangle)
{
  EXPECT_TRUE(contains(refusal(4, { { 0, 1, 3 } }), "particle 2 belongs to no triangle"));
}

TEST(Mesh, RefusesAnEdgeWithThreeTriangles)
{
  const std::string message = refusal(5, { { 0, 1, 2 }, { 1, 0, 3 }, { 0, 1, 4 } });

  EXPECT_TRUE(contains(message, "edge between particles 0 and 1 has 3 triangles")) << message;
}

TEST(Mesh, RefusesNeighboursWoundAgainstEachOther)
{
  const std::string message = refusal(4, { { 0, 1, 2 }, { 0, 1, 3 } });

  EXPECT_TRUE(contains(message, "wound against each other")) << message;
}

TEST(Mesh, RefusesTwoTrianglesWithTheSameCorners)
{
  const std::string message = refusal(3, { { 0, 1, 2 }, { 0, 2, 1 } });

  EXPECT_TRUE(contains(message, "have the same corners")) << message;
}

TEST(Fan, RunsCounterClockwiseFromItsClockwiseBorderWhereItIsOpen)
{
  const Mesh mesh = meshOf(openFan({ 0, 40, 90, 120, 170 }));
  const ParticleId hub{ 0 };

  const Fan fan = mesh.fanAt(hub, { 2 });

  EXPECT_FALSE(fan.closed);
  ASSERT_EQ(fan.triangles.size(), 4u);
  ASSERT_EQ(fan.springs.size(), 5u);
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_EQ(fan.triangles[i].index, i);
  }
  for (int i = 0; i < 5; ++i)
  {
    EXPECT_EQ(fan.springs[i], springBetween(mesh, 0, i + 1));
    EXPECT_EQ(fan.indexOf(fan.springs[i]), i);
  }
}

TEST(Fan, StartsAtTheTriangleAskedForWhereItIsClosed)
{
  const Mesh mesh = meshOf(wheel(5));

  const Fan fan = mesh.fanAt({ 0 }, { 3 });

  EXPECT_TRUE(fan.closed);
  ASSERT_EQ(fan.triangles.size(), 5u);
  ASSERT_EQ(fan.springs.size(), 5u);
  for (int i = 0; i < 5; ++i)
  {
    EXPECT_EQ(fan.triangles[i].index, (3 + i) % 5);
    EXPECT_EQ(fan.springs[i], springBetween(mesh, 0, 1 + (3 + i) % 5));
  }
}

TEST(Fan, HoldsOnlyWhatHangsTogetherThroughSprings)
{
  for (int fans : { 2, 3, 4 })
  {
    for (int each : { 1, 2, 3 })
    {
      const Mesh mesh = meshOf(bowTie(fans, each));

      EXPECT_EQ(mesh.fanCount({ 0 }), fans);
      ASSERT_EQ(mesh.fans({ 0 }).size(), static_cast<std::size_t>(fans));
      for (const Fan& fan : mesh.fans({ 0 }))
      {
        EXPECT_EQ(fan.triangles.size(), static_cast<std::size_t>(each));
        EXPECT_FALSE(fan.closed);
      }
      EXPECT_EQ(mesh.fanCount({ 1 }), 1);
    }
  }
}

TEST(Fan, MayBeClosedBesideAnOpenOne)
{
  const Mesh mesh = meshOf(wheelOnAPoint());

  const std::vector<Fan> fans = mesh.fans({ 0 });

  ASSERT_EQ(fans.size(), 2u);
  EXPECT_TRUE(fans[0].closed);
  EXPECT_EQ(fans[0].triangles.size(), 6u);
  EXPECT_FALSE(fans[1].closed);
  EXPECT_EQ(fans[1].triangles.size(), 2u);
}

TEST(Fan, TogetherHoldEveryTriangleOfTheParticleOnce)
{
  for (const NamedModel& named : everyConfiguration())
  {
    const Mesh mesh = meshOf(named.model);
    for (int i = 0; i < mesh.particleCount(); ++i)
    {
      std::vector<TriangleId> in_fans;
      for (const Fan& fan : mesh.fans({ i }))
      {
        in_fans.insert(in_fans.end(), fan.triangles.begin(), fan.triangles.end());
        EXPECT_EQ(fan.springs.size(), fan.triangles.size() + (fan.closed ? 0 : 1));
      }
      std::vector<TriangleId> around = mesh.trianglesAt({ i });
      std::sort(around.begin(), around.end());
      std::sort(in_fans.begin(), in_fans.end());
      EXPECT_EQ(in_fans, around) << named.name << ", particle " << i;
    }
  }
}

TEST(Mesh, KnowsWhichParticlesLieOnABorder)
{
  const Mesh mesh = meshOf(sheet(5, 4, RectanglePattern::ALTERNATING));
  for (int r = 0; r < 4; ++r)
  {
    for (int c = 0; c < 5; ++c)
    {
      const bool border = r == 0 || r == 3 || c == 0 || c == 4;
      EXPECT_EQ(mesh.onBorder({ 5 * r + c }), border) << "row " << r << ", column " << c;
    }
  }
}

TEST(Mesh, CountsABorderOfAnotherFanAsBorder)
{
  EXPECT_TRUE(meshOf(wheelOnAPoint()).onBorder({ 0 }));
  EXPECT_FALSE(meshOf(wheel(6)).onBorder({ 0 }));
}

TEST(Defects, NameATextureCornerThatIsNotFinite)
{
  ClothModel model = kite();
  model.triangles[1].uv[2].x() = std::nan("");

  const std::vector<std::string> found = defects(meshOf(model));

  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(contains(found[0], "triangle 1 has a texture corner that is not finite"));
}

}  // namespace
}  // namespace cloth
