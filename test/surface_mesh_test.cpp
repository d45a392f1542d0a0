// Claims of the mesh that the rviz display draws: what it makes of a message, and what it refuses.
#include "cloth_tearing/rviz/surface_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "cloth_tearing/core/refusal.h"

namespace cloth_tearing
{
namespace
{

constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();
constexpr float ENDLESS = std::numeric_limits<float>::infinity();

// Two triangles in the plane z = 0, of one square:
//
//   3 --- 2
//   |   / |
//   | /   |
//   0 --- 1
ClothSurface square()
{
  ClothSurface message;
  message.header.frame_id = "world";
  message.positions = { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 };
  message.strain = { 0, 0, 0, 0 };
  message.parents = { 0, 0, 1, 1, 2, 2, 3, 3 };
  message.triangles = { 0, 1, 2, 0, 2, 3 };
  message.uv = { 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1 };
  return message;
}

HeldParticle held(std::uint32_t particle)
{
  HeldParticle message;
  message.particle = particle;
  return message;
}

TEST(SurfaceMesh, SharesAVertexBetweenTrianglesThatAgreeOnItsTexture)
{
  SurfaceMesh mesh;
  EXPECT_TRUE(mesh.take(square()));

  EXPECT_EQ(mesh.vertices().size(), 4u);
  ASSERT_EQ(mesh.indices().size(), 6u);
  EXPECT_EQ(mesh.indices()[0], mesh.indices()[3]);
  EXPECT_EQ(mesh.indices()[2], mesh.indices()[4]);
}

TEST(SurfaceMesh, GivesEachSideOfASeamItsOwnTexture)
{
  ClothSurface message = square();
  message.uv[6] = 0.5F;  // particle 0 in the second triangle

  SurfaceMesh mesh;
  mesh.take(message);

  EXPECT_EQ(mesh.vertices().size(), 5u);
  for (std::size_t corner = 0; corner < message.triangles.size(); ++corner)
  {
    const MeshVertex& vertex = mesh.vertices()[mesh.indices()[corner]];
    EXPECT_EQ(vertex.particle, message.triangles[corner]);
    EXPECT_EQ(vertex.u, message.uv[2 * corner]);
    EXPECT_EQ(vertex.v, message.uv[2 * corner + 1]);
  }
}

TEST(SurfaceMesh, KeepsEveryCornerWhenVeryManyPlacesMeetInAParticle)
{
  ClothSurface message = square();
  for (int i = 0; i < 1000; ++i)
  {
    message.triangles.insert(message.triangles.end(), { 0, 1, 2 });
    const auto u = static_cast<float>(i % 100);
    message.uv.insert(message.uv.end(), { u, 0, u, 1, u, 2 });
  }

  SurfaceMesh mesh;
  mesh.take(message);

  for (std::size_t corner = 0; corner < message.triangles.size(); ++corner)
  {
    const MeshVertex& vertex = mesh.vertices()[mesh.indices()[corner]];
    ASSERT_EQ(vertex.particle, message.triangles[corner]);
    ASSERT_EQ(vertex.u, message.uv[2 * corner]);
    ASSERT_EQ(vertex.v, message.uv[2 * corner + 1]);
  }
}

TEST(SurfaceMesh, StaysWhenOnlyPositionsChange)
{
  SurfaceMesh mesh;
  mesh.take(square());
  ClothSurface message = square();
  message.revision = 1;
  message.positions[2] = 0.5F;

  EXPECT_FALSE(mesh.take(message));

  EXPECT_EQ(mesh.positions()[0], cloth::Vec3(0, 0, 0.5F));
}

TEST(SurfaceMesh, IsMadeAnewForOtherTrianglesOfTheSameRevision)
{
  SurfaceMesh mesh;
  mesh.take(square());
  ClothSurface other_diagonal = square();
  other_diagonal.triangles = { 0, 1, 3, 1, 2, 3 };

  EXPECT_TRUE(mesh.take(other_diagonal));

  EXPECT_EQ(mesh.vertices()[mesh.indices()[2]].particle, 3u);
}

TEST(SurfaceMesh, WeighsNormalsByArea)
{
  ClothSurface message = square();
  message.positions[11] = 1.0F;  // particle 3 up: its triangle has the normal (1, -1, 1), longer
  const cloth::Vec3 flat(0, 0, 1);
  const cloth::Vec3 tilted = cloth::Vec3(1, 1, 0).cross(cloth::Vec3(0, 1, 1));

  SurfaceMesh mesh;
  mesh.take(message);

  EXPECT_TRUE(mesh.normals()[1].isApprox(flat));
  EXPECT_TRUE(mesh.normals()[3].isApprox(tilted.normalized()));
  EXPECT_TRUE(mesh.normals()[0].isApprox((flat + tilted).normalized()));
  EXPECT_EQ(mesh.normals()[0], mesh.normals()[2]);
}

TEST(SurfaceMesh, HasNormalsOfLengthOneWhereTrianglesHaveNoArea)
{
  ClothSurface message = square();
  message.positions.assign(12, 1.0F);

  SurfaceMesh mesh;
  mesh.take(message);

  for (const cloth::Vec3& normal : mesh.normals())
  {
    EXPECT_FLOAT_EQ(normal.norm(), 1.0F);
  }
}

TEST(SurfaceMesh, TakesAClothThatIsGone)
{
  SurfaceMesh mesh;
  mesh.take(square());

  ClothSurface nothing;
  nothing.header.frame_id = "world";
  EXPECT_TRUE(mesh.take(nothing));

  EXPECT_TRUE(mesh.indices().empty());
}

// One way to spoil a message, and a part of the sentence that has to name it.
struct Malformed
{
  std::function<void(ClothSurface&)> spoil;
  std::string reason;
};

const std::vector<Malformed> MALFORMED = {
  { [](ClothSurface& m) { m.header.frame_id.clear(); }, "header.frame_id is empty, must name" },
  { [](ClothSurface& m) { m.positions.pop_back(); }, "positions has 11 elements, must have a mul" },
  { [](ClothSurface& m) { m.positions.resize(9); }, "triangles[5] is 3, must be below 3" },
  { [](ClothSurface& m) { m.positions.clear(); }, "triangles[0] is 0, must be below 0" },
  { [](ClothSurface& m) { m.positions[4] = NOT_A_NUMBER; }, "positions[4] is nan" },
  { [](ClothSurface& m) { m.positions[4] = -ENDLESS; }, "positions[4] is -inf" },
  { [](ClothSurface& m) { m.positions[4] = 3e30F; },
    "positions[4] is 3e+30, must be at least -1e+" },
  { [](ClothSurface& m) { m.strain.pop_back(); }, "strain has 3 elements, must have 4" },
  { [](ClothSurface& m) { m.strain.push_back(0); }, "strain has 5 elements, must have 4" },
  { [](ClothSurface& m) { m.strain[2] = NOT_A_NUMBER; }, "strain[2] is nan" },
  { [](ClothSurface& m) { m.strain[2] = ENDLESS; }, "strain[2] is inf" },
  { [](ClothSurface& m) { m.parents.pop_back(); }, "parents has 7 elements, must have 8" },
  { [](ClothSurface& m) { m.parents[7] = 4; }, "parents[7] is 4, must be below 4" },
  { [](ClothSurface& m) { m.triangles.pop_back(); }, "triangles has 5 elements, must have a mul" },
  { [](ClothSurface& m) { m.triangles[1] = 4; }, "triangles[1] is 4, must be below 4" },
  { [](ClothSurface& m) { m.triangles[1] = 0xFFFFFFFF; }, "triangles[1] is 4294967295" },
  { [](ClothSurface& m) { m.triangles.clear(); }, "uv has 12 elements, must have 0" },
  { [](ClothSurface& m) { m.uv.pop_back(); }, "uv has 11 elements, must have 12" },
  { [](ClothSurface& m) { m.uv.clear(); }, "uv has 0 elements, must have 12" },
  { [](ClothSurface& m) { m.uv[3] = NOT_A_NUMBER; }, "uv[3] is nan" },
  { [](ClothSurface& m) { m.uv[3] = 1e30F; }, "uv[3] is 1e+30" },
  { [](ClothSurface& m) { m.torn_edges = { 0 }; }, "torn_edges has 1 elements, must have a mul" },
  { [](ClothSurface& m) {
     m.torn_edges = { 0, 9 };
   },
    "torn_edges[1] is 9, must be below 4" },
  { [](ClothSurface& m) {
     m.weak_points = { 1, 4 };
   },
    "weak_points[1] is 4, must be below 4" },
  { [](ClothSurface& m) {
     m.held = { held(0), held(5) };
   },
    "held[1].particle is 5, must be below" },
  { [](ClothSurface& m) { m.origin.z = std::nan(""); }, "origin.z is nan" },
  { [](ClothSurface& m) { m.origin.x = 1e300; }, "origin.x is 1e+300" },
};

class MalformedSurface : public testing::TestWithParam<std::size_t>
{
};

TEST_P(MalformedSurface, IsRefusedWithItsReasonAndChangesNothing)
{
  const Malformed& malformed = MALFORMED[GetParam()];
  SurfaceMesh mesh;
  mesh.take(square());
  ClothSurface message = square();
  message.positions[3] = 2.0F;  // it would be seen
  malformed.spoil(message);

  try
  {
    mesh.take(message);
    ADD_FAILURE() << "accepted, should say: " << malformed.reason;
  }
  catch (const cloth::Refusal& refusal)
  {
    EXPECT_NE(std::string(refusal.what()).find(malformed.reason), std::string::npos)
        << refusal.what();
  }

  EXPECT_EQ(mesh.positions()[1], cloth::Vec3(1, 0, 0));
  EXPECT_FALSE(mesh.take(square()));
}

INSTANTIATE_TEST_SUITE_P(Each, MalformedSurface, testing::Range(std::size_t(0), MALFORMED.size()));

TEST(MalformedSurface, OfAnyKindIsRefusedOrSafeToDraw)
{
  std::mt19937_64 random(7);
  const auto below = [&random](std::size_t limit) { return random() % limit; };
  const float values[] = { 0.0F, -1.0F, 1e20F, NOT_A_NUMBER, ENDLESS, 1e-40F, 0.5F };
  SurfaceMesh mesh;
  for (int round = 0; round < 20000; ++round)
  {
    ClothSurface m = square();
    std::vector<float>* numbers[] = { &m.positions, &m.strain, &m.uv };
    std::vector<std::uint32_t>* ids[] = { &m.parents, &m.triangles, &m.torn_edges, &m.weak_points };
    std::vector<float>& some_numbers = *numbers[below(3)];
    std::vector<std::uint32_t>& some_ids = *ids[below(4)];
    some_numbers.resize(below(14), values[below(7)]);
    some_ids.resize(below(14), static_cast<std::uint32_t>(below(6)));
    try
    {
      mesh.take(m);
    }
    catch (const cloth::Refusal&)
    {
      continue;
    }
    for (const std::uint32_t vertex : mesh.indices())
    {
      ASSERT_LT(vertex, mesh.vertices().size());
      ASSERT_LT(mesh.vertices()[vertex].particle, mesh.positions().size());
      ASSERT_TRUE(mesh.normals()[mesh.vertices()[vertex].particle].allFinite());
    }
  }
}

}  // namespace
}  // namespace cloth_tearing
