// Claims of picking: where a ray meets a cloth, and how far a point is from it.
#include "cloth_tearing/rviz/surface_picking.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <random>

namespace cloth_tearing
{
namespace
{

using cloth::Vec3d;

struct Surface
{
  std::vector<cloth::Vec3> positions;
  std::vector<std::uint32_t> triangles;
};

// One triangle in the plane z = 0:
//
//   2
//   | \       .
//   0 - 1
const Surface TRIANGLE = { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { 0, 1, 2 } };

/// A square of 1 m with its middle at the origin, rough as cloth is.
Surface sheet(int side, std::mt19937_64& random, float roughness)
{
  const auto rough = [&]
  { return roughness * (static_cast<float>(random() % 1000) / 1000 - 0.5F); };
  Surface sheet;
  for (int j = 0; j < side; ++j)
  {
    for (int i = 0; i < side; ++i)
    {
      const float step = 1.0F / static_cast<float>(side - 1);
      sheet.positions.emplace_back(static_cast<float>(i) * step - 0.5F,
                                   static_cast<float>(j) * step - 0.5F, rough());
    }
  }
  for (int j = 0; j + 1 < side; ++j)
  {
    for (int i = 0; i + 1 < side; ++i)
    {
      const auto p = static_cast<std::uint32_t>(j * side + i);
      const auto q = p + static_cast<std::uint32_t>(side);
      sheet.triangles.insert(sheet.triangles.end(), { p, p + 1, q + 1, p, q + 1, q });
    }
  }
  return sheet;
}

std::optional<double> hit(const Surface& surface, const Vec3d& from, const Vec3d& towards)
{
  return firstHit({ from, (towards - from).normalized() }, surface.positions, surface.triangles);
}

double distance(const Surface& surface, const Vec3d& from)
{
  return distanceTo(from, surface.positions, surface.triangles);
}

TEST(FirstHit, IsMeasuredAlongTheRayFromEitherSide)
{
  for (const double z : { 2.0, -2.0 })
  {
    const auto straight = hit(TRIANGLE, { 0.2, 0.3, z }, { 0.2, 0.3, 0 });
    const auto aslant = hit(TRIANGLE, { 3.2, 0.3, z }, { 0.2, 0.3, 0 });
    ASSERT_TRUE(straight && aslant);
    EXPECT_NEAR(*straight, 2.0, 1e-12);
    EXPECT_NEAR(*aslant, std::sqrt(13.0), 1e-12);
  }
}

TEST(FirstHit, IsNoneBesideTheTriangleAndBehindTheRay)
{
  EXPECT_FALSE(hit(TRIANGLE, { 0.6, 0.6, 1 }, { 0.6, 0.6, 0 }));
  EXPECT_FALSE(hit(TRIANGLE, { -0.1, 0.5, 1 }, { -0.1, 0.5, 0 }));
  EXPECT_FALSE(hit(TRIANGLE, { 0.2, 0.2, 1 }, { 0.2, 0.2, 2 }));
}

TEST(FirstHit, IsTheNearestOfSeveral)
{
  Surface two = TRIANGLE;
  for (std::uint32_t i = 0; i < 3; ++i)
  {
    two.positions.push_back(TRIANGLE.positions[i] + cloth::Vec3(0, 0, 0.5F));
    two.triangles.push_back(3 + i);
  }
  EXPECT_NEAR(*hit(two, { 0.2, 0.2, 2 }, { 0.2, 0.2, 0 }), 1.5, 1e-12);
  EXPECT_NEAR(*hit(two, { 0.2, 0.2, -2 }, { 0.2, 0.2, 0 }), 2.0, 1e-12);
}

TEST(FirstHit, PassesOverTrianglesWithoutAreaOrSeenEdgeOn)
{
  const Surface line = { { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } }, { 0, 1, 2 } };
  EXPECT_FALSE(hit(line, { 0.5, 0, 1 }, { 0.5, 0, 0 }));
  EXPECT_FALSE(hit(TRIANGLE, { -1, 0.2, 0 }, { 1, 0.2, 0 }));
  EXPECT_FALSE(hit({}, { 0, 0, 1 }, { 0, 0, 0 }));
}

// A ray aimed at an edge or a corner is a matter of the last bit, but one of the triangles there
// has to be met.
TEST(FirstHit, LetsNothingThroughBetweenTriangles)
{
  std::mt19937_64 random(3);
  const Surface cloth = sheet(12, random, 0.02F);
  const auto inside = [](const Vec3d& x)
  { return std::max(std::abs(x.x()), std::abs(x.y())) < 0.45; };
  const auto anywhere = [&random] { return static_cast<double>(random() % 2000) / 1000 - 1.0; };
  int aimed = 0;
  for (std::size_t corner = 0; corner < cloth.triangles.size(); ++corner)
  {
    const std::size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
    const Vec3d a = cloth.positions[cloth.triangles[corner]].cast<double>();
    const Vec3d b = cloth.positions[cloth.triangles[next]].cast<double>();
    for (const double part : { 0.0, 0.5, 0.3 })
    {
      const Vec3d goal = a + part * (b - a);
      if (inside(goal))
      {
        const Vec3d eye(anywhere(), anywhere(), 3.0);
        ASSERT_TRUE(hit(cloth, eye, goal)) << "towards " << goal.transpose();
        ++aimed;
      }
    }
  }
  EXPECT_GT(aimed, 1000);
}

TEST(FirstHit, OfAFineClothTakesAMomentOnly)
{
  std::mt19937_64 random(3);
  const Surface cloth = sheet(129, random, 0.01F);
  ASSERT_EQ(cloth.triangles.size() / 3, 32768u);
  std::chrono::duration<double, std::milli> best(1e9);
  for (int round = 0; round < 20; ++round)
  {
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_TRUE(hit(cloth, { 0.3, 1.0, 2.0 }, { 0.01 * round, 0.1, 0 }));
    best = std::min<decltype(best)>(best, std::chrono::steady_clock::now() - begin);
  }
  RecordProperty("milliseconds", std::to_string(best.count()));
  EXPECT_LT(best.count(), 33.0) << "more than a frame";  // about 0.1 when optimised
}

TEST(DistanceTo, IsToTheFaceTheEdgeOrTheCornerThatIsNearest)
{
  EXPECT_NEAR(distance(TRIANGLE, { 0.2, 0.2, 0.7 }), 0.7, 1e-12);
  EXPECT_NEAR(distance(TRIANGLE, { 0.2, 0.2, -0.7 }), 0.7, 1e-12);
  EXPECT_NEAR(distance(TRIANGLE, { 0.5, -0.3, 0.4 }), 0.5, 1e-12);
  EXPECT_NEAR(distance(TRIANGLE, { 1.5, 1.5, 0 }), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(distance(TRIANGLE, { -3, -4, 0 }), 5.0, 1e-12);
  EXPECT_NEAR(distance(TRIANGLE, { 0.3, 0.3, 0 }), 0.0, 1e-12);
}

TEST(DistanceTo, IsThatToTheNearestTriangleEvenWithoutArea)
{
  const Surface line = { { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } }, { 0, 1, 2 } };
  EXPECT_NEAR(distance(line, { 1.5, 0, 2 }), 2.0, 1e-12);
  EXPECT_NEAR(distance(line, { 5, 0, 4 }), 5.0, 1e-12);
  EXPECT_TRUE(std::isinf(distance({}, { 0, 0, 0 })));
}

TEST(DistanceTo, IsNeverMoreThanThatToWhatARayMeets)
{
  std::mt19937_64 random(5);
  const Surface cloth = sheet(15, random, 0.2F);
  for (int round = 0; round < 50; ++round)
  {
    const Vec3d eye(0.04 * round - 1.0, 0.3, 1.0);
    const auto seen = hit(cloth, eye, { 0.001 * round, -0.1, 0 });
    ASSERT_TRUE(seen);
    EXPECT_LE(distance(cloth, eye), *seen);
  }
}

}  // namespace
}  // namespace cloth_tearing
