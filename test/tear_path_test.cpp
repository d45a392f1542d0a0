// Claims of the tear path: what resists, on which side it runs, and which spring it takes.
#include "cloth_tearing/core/tear_path.h"

#include <gtest/gtest.h>

#include "small_meshes.h"

namespace cloth
{
namespace
{

const ParticleId HUB{ 0 };

SpringId spoke(const Cloth& cloth, int rim)
{
  return springBetween(cloth.mesh, 0, rim);
}

/// An open fan at rest with springs to rim 1, 2, ... at these angles, pulled at rim 1 upwards.
///
///          1 (90, stretched)
///     2    |
///       \  |
///     3 -- 0
///       /  |
///     4    |
///          5 (270, resists)
Cloth halfCompass()
{
  Cloth cloth = clothOf(openFan({ 90, 140, 175, 220, 270 }));
  pullOut(cloth, 1, 1.4);
  pullOut(cloth, 5, 1.2);
  return cloth;
}

TEST(TearPath, RunsAlongTheSpringNearestThePerpendicular)
{
  const Cloth cloth = halfCompass();

  const auto path = findTearPath(cloth, HUB, spoke(cloth, 1));

  ASSERT_TRUE(path.has_value());
  EXPECT_EQ(path->springs, (std::vector<SpringId>{ spoke(cloth, 3) }));
}

TEST(TearPath, KnowsHowMuchIsHeldAgainstThePull)
{
  const Cloth cloth = halfCompass();
  const SpringLaw& held = cloth.springs.structural[spoke(cloth, 5).index];

  const auto path = findTearPath(cloth, HUB, spoke(cloth, 1));

  ASSERT_TRUE(path.has_value());
  EXPECT_NEAR(path->resistance, 0.2 * held.stiffness, 1e-4 * held.stiffness);
  EXPECT_EQ(path->resistance, resistanceAt(cloth, HUB, spoke(cloth, 1)));
}

TEST(TearPath, TakesTheProjectionOfTheTensionForResistance)
{
  Cloth cloth = halfCompass();
  pullOut(cloth, 4, 1.9);  // more tension than 5, and still more of it against the pull

  const auto path = findTearPath(cloth, HUB, spoke(cloth, 1));

  const SpringLaw& held = cloth.springs.structural[spoke(cloth, 4).index];
  ASSERT_TRUE(path.has_value());
  EXPECT_NEAR(path->resistance, 0.9 * held.stiffness * std::cos(50 * M_PI / 180),
              1e-4 * held.stiffness);
  EXPECT_EQ(path->springs.front(), spoke(cloth, 3));
}

TEST(TearPath, StaysOnTheSideWhereBothHangTogether)
{
  // Rim 1 and 6 lie on the other side of the pull, and 1 nearest of all to the perpendicular.
  Cloth cloth = clothOf(openFan({ 2, 50, 90, 150, 210, 270 }));
  pullOut(cloth, 3, 1.4);
  pullOut(cloth, 6, 1.2);

  const auto path = findTearPath(cloth, HUB, spoke(cloth, 3));

  ASSERT_TRUE(path.has_value());
  EXPECT_EQ(path->springs, (std::vector<SpringId>{ spoke(cloth, 4) }));
}

TEST(TearPath, DoesNotCountCompressedSpringsAsResistance)
{
  Cloth cloth = halfCompass();
  pullOut(cloth, 5, 0.5);   // now at 0.6 of its length
  pullOut(cloth, 4, 1.05);  // hardly stretched

  const auto path = findTearPath(cloth, HUB, spoke(cloth, 1));

  const SpringLaw& held = cloth.springs.structural[spoke(cloth, 4).index];
  ASSERT_TRUE(path.has_value());
  EXPECT_NEAR(path->resistance, 0.05 * held.stiffness * std::cos(50 * M_PI / 180),
              1e-4 * held.stiffness);
}

TEST(TearPath, DoesNotCountReleasedSpringsAsResistance)
{
  Cloth cloth = halfCompass();
  pullOut(cloth, 4, 0.99);
  cloth.springs.release(spoke(cloth, 5));

  EXPECT_EQ(resistanceAt(cloth, HUB, spoke(cloth, 1)), 0.0);
}

TEST(TearPath, IsNoneWhereNothingResists)
{
  Cloth cloth = halfCompass();
  pullOut(cloth, 4, 0.99);
  pullOut(cloth, 5, 0.8);  // both slack now

  EXPECT_FALSE(findTearPath(cloth, HUB, spoke(cloth, 1)).has_value());
  EXPECT_EQ(resistanceAt(cloth, HUB, spoke(cloth, 1)), 0.0);
}

TEST(TearPath, LooksAtTheNextMostResistingWhereNothingLiesBetween)
{
  Cloth cloth = clothOf(openFan({ 20, 90, 185, 270 }));
  pullOut(cloth, 2, 1.4);
  pullOut(cloth, 3, 1.8);  // resists most, and is a neighbour of the pull
  pullOut(cloth, 4, 1.05);
  ASSERT_NEAR(
      resistanceAt(cloth, HUB, spoke(cloth, 2)),
      0.8 * cloth.springs.structural[spoke(cloth, 3).index].stiffness * std::cos(85 * M_PI / 180),
      1e-4);

  const auto path = findTearPath(cloth, HUB, spoke(cloth, 2));

  ASSERT_TRUE(path.has_value());
  EXPECT_EQ(path->springs.front(), spoke(cloth, 3));
}

TEST(TearPath, IsNoneWhereNothingLiesBetween)
{
  Cloth cloth = clothOf(openFan({ 90, 230 }));
  pullOut(cloth, 1, 1.4);
  pullOut(cloth, 2, 1.2);

  EXPECT_GT(resistanceAt(cloth, HUB, spoke(cloth, 1)), 0.0);
  EXPECT_FALSE(findTearPath(cloth, HUB, spoke(cloth, 1)).has_value());
}

TEST(TearPath, NeverTakesABorderSpring)
{
  // The border to rim 1 is square to the pull, the only spring between is far from it.
  Cloth cloth = clothOf(openFan({ 0, 90, 110, 250 }));
  pullOut(cloth, 2, 1.4);
  pullOut(cloth, 4, 1.2);

  const auto path = findTearPath(cloth, HUB, spoke(cloth, 2));

  ASSERT_TRUE(path.has_value());
  EXPECT_EQ(path->springs, (std::vector<SpringId>{ spoke(cloth, 3) }));
}

TEST(TearPath, OpensAClosedFanOnBothSidesOfThePull)
{
  Cloth cloth = clothOf(wheel(8));
  pullOut(cloth, 1, 1.4);
  pullOut(cloth, 5, 1.2);

  const auto path = findTearPath(cloth, HUB, spoke(cloth, 1));

  ASSERT_TRUE(path.has_value());
  EXPECT_EQ(path->springs, (std::vector<SpringId>{ spoke(cloth, 3), spoke(cloth, 7) }));
}

TEST(TearPath, BreaksTiesById)
{
  // Two springs at the same angle to the pull on either side of the perpendicular.
  Cloth cloth = clothOf(flatModel({ { 0, 0 }, { 0, 1 }, { -1, 0.5 }, { -1, -0.5 }, { 0, -1 } },
                                  { { 0, 3, 4 }, { 0, 2, 3 }, { 0, 1, 2 } }));
  pullOut(cloth, 1, 1.5);
  pullOut(cloth, 4, 1.25);
  const SpringId lower = std::min(spoke(cloth, 2), spoke(cloth, 3));

  const auto path = findTearPath(cloth, HUB, spoke(cloth, 1));

  ASSERT_TRUE(path.has_value());
  EXPECT_EQ(path->springs.front(), lower);
  EXPECT_EQ(lower, spoke(cloth, 3)) << "the one that comes later round the fan";
}

TEST(TearPath, HeedsOnlyTheFanOfTheStretchedSpring)
{
  ClothModel model = openFan({ 60, 90, 120 });
  const std::vector<Vec2d> below = { { -0.4, -1 }, { 0, -1 }, { 0.4, -1 } };
  for (const Vec2d& place : below)
  {
    model.positions.emplace_back(place.x(), place.y(), 0);
  }
  model.triangles.push_back({ { 0, 4, 5 }, { Vec2d(0, 0), below[0], below[1] } });
  model.triangles.push_back({ { 0, 5, 6 }, { Vec2d(0, 0), below[1], below[2] } });
  Cloth cloth = clothOf(model);
  pullOut(cloth, 2, 1.4);
  pullOut(cloth, 5, 1.4);

  EXPECT_EQ(resistanceAt(cloth, HUB, spoke(cloth, 2)), 0.0);
}

}  // namespace
}  // namespace cloth
