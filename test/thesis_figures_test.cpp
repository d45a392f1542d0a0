// The figures of thesis 3.2 and 3.3 as meshes: the tear that is drawn is the tear that happens.
#include <gtest/gtest.h>

#include <algorithm>

#include "cloth_tearing/core/tear_path.h"
#include "cloth_tearing/core/tearing.h"
#include "small_meshes.h"

namespace cloth
{
namespace
{

bool sharesSpring(const Mesh& mesh, TriangleId a, TriangleId b)
{
  for (SpringId s : mesh.triangle(a).springs)
  {
    if (mesh.triangle(b).sideOf(s) >= 0)
    {
      return true;
    }
  }
  return false;
}

bool sharesParticle(const Mesh& mesh, TriangleId a, TriangleId b)
{
  for (ParticleId p : mesh.triangle(a).particles)
  {
    if (mesh.triangle(b).cornerOf(p) >= 0)
    {
      return true;
    }
  }
  return false;
}

Vec2d uvAt(const Mesh& mesh, TriangleId t, ParticleId p)
{
  return mesh.triangle(t).uv[mesh.triangle(t).cornerOf(p)];
}

/// The kite with its shared spring stretched by a half and a bit, the others by less.
Cloth stretchedKite()
{
  Cloth cloth = clothOf(kite());
  pullOut(cloth, 0, 1.6);
  pullOut(cloth, 1, 1.6);
  return cloth;
}

TEST(Figure3_8, TheTornSpringsTrianglesAreHalvedAndOppositeHalvesStayTogether)
{
  Cloth cloth = stretchedKite();

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_EQ(pass.tears[0].kind, TearKind::BASIC);
  EXPECT_EQ(pass.tears[0].spring, springBetween(meshOf(kite()), 0, 1));
  ASSERT_EQ(countsOf(cloth.mesh), (Counts{ 6, 10, 4 }));
  const TriangleId m3{ 0 };
  const TriangleId m5{ 1 };
  const TriangleId m4{ 2 };
  const TriangleId m6{ 3 };
  EXPECT_FALSE(sharesSpring(cloth.mesh, m3, m4));
  EXPECT_FALSE(sharesSpring(cloth.mesh, m5, m6));
  EXPECT_TRUE(sharesSpring(cloth.mesh, m3, m5));
  EXPECT_TRUE(sharesSpring(cloth.mesh, m4, m6));
  EXPECT_TRUE(isSound(cloth.mesh));
}

TEST(Figure3_8, TheTipsOfTheTearAreWeakWhereTheyLieInsideTheCloth)
{
  Cloth cloth = clothOf(sheet(6, 6, RectanglePattern::ONE_DIAGONAL));
  const SpringId s = springBetween(cloth.mesh, 14, 15);  // level, in the middle
  const ParticleId one = cloth.mesh.opposite(s, 0);
  const ParticleId other = cloth.mesh.opposite(s, 1);
  cloth.rest.length[s.index] *= 0.6;  // as if it had shrunk: nothing else is stretched

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 1u);
  for (int i = 0; i < cloth.mesh.particleCount(); ++i)
  {
    const bool tip = ParticleId{ i } == one || ParticleId{ i } == other;
    EXPECT_EQ(cloth.damage.weak[i] != 0, tip) << "particle " << i;
  }
}

TEST(Figure3_9, TheSplitPointsMoveToRestHalfLengthFromTheirOwnEnds)
{
  Cloth cloth = stretchedKite();
  const Vec3 left = cloth.state.position[0];
  const Vec3 right = cloth.state.position[1];

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 1u);
  const Vec3 near = cloth.state.position[pass.tears[0].particles[0].id.index];
  const Vec3 far = cloth.state.position[pass.tears[0].particles[1].id.index];
  EXPECT_NEAR((near - (left + Vec3(1, 0, 0))).norm(), 0.0, 1e-6);
  EXPECT_NEAR((far - (right - Vec3(1, 0, 0))).norm(), 0.0, 1e-6);
  EXPECT_NEAR(cloth.strain(pass.tears[0].spring), 0.0, 1e-6);
  EXPECT_NEAR(cloth.strain(springBetween(cloth.mesh, pass.tears[0].particles[1].id, { 1 })), 0.0,
              1e-6);
}

//        1 (stretched)
//    m1 /|
//      / |
//     2--p2      the mouth of the tear lies between 3 and 4
//      \ |  \.
//    m2 \|    \.
//        3     4
TEST(Figure3_12, TheTrianglesAtTheWeakPointLetGoOfEachOther)
{
  Cloth cloth = clothOf(openFan({ 0, 90, 180, 270 }));
  const ParticleId p2{ 0 };
  const TriangleId m1{ 1 };
  const TriangleId m2{ 2 };
  cloth.damage.weak[p2.index] = 1;
  pullOut(cloth, 2, 1.4);
  pullOut(cloth, 4, 1.2);
  ASSERT_TRUE(sharesSpring(cloth.mesh, m1, m2));

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_EQ(pass.tears[0].kind, TearKind::WEAK_POINT);
  EXPECT_EQ(pass.tears[0].path, springBetween(meshOf(openFan({ 0, 90, 180, 270 })), 0, 3));
  EXPECT_EQ(countsOf(cloth.mesh), (Counts{ 6, 8, 3 })) << "no triangle is added";
  EXPECT_FALSE(sharesSpring(cloth.mesh, m1, m2));
  EXPECT_GE(cloth.mesh.triangle(m1).cornerOf(p2), 0);
  EXPECT_GE(cloth.mesh.triangle(m2).cornerOf(pass.tears[0].particles[0].id), 0) << "p2'";
  EXPECT_TRUE(isSound(cloth.mesh));
}

/// Figures 3.13 to 3.17: eight springs meet in the weak point 0. The tear has come from the right
/// between the two green ones, the red one is stretched, five are left. A second ring lies around.
///
///              red 3     s1 2
///                 |     /
///      s2 4 ..    |    /   . green 1
///              .. | / .
///                 0 ------ (mouth of the tear)
///              /  |  ..  . green 8
///          s3 5   |     .. s5 7
///                 |
///              s4 6
struct WeakPoint
{
  static constexpr int SPRINGS = 8;

  WeakPoint() : cloth(clothOf(model()))
  {
    cloth.damage.weak[0] = 1;
    const std::array<double, SPRINGS> stretch = { 1.0, 1.05, 1.4, 1.05, 1.15, 1.2, 1.1, 1.0 };
    for (int i = 0; i < SPRINGS; ++i)
    {
      springs[i] = springBetween(cloth.mesh, 0, i + 1);
      pullOut(cloth, i + 1, stretch[i]);
    }
  }

  static ClothModel model()
  {
    const std::array<double, SPRINGS> degrees = { 25, 55, 90, 160, 215, 270, 350, 365 };
    std::vector<Vec2d> places = { { 0, 0 } };
    Faces faces;
    for (double radius : { 1.0, 2.0 })
    {
      for (double angle : degrees)
      {
        places.push_back(polar(radius, angle));
      }
    }
    for (int i = 1; i < SPRINGS; ++i)
    {
      faces.push_back({ 0, i, i + 1 });
      faces.push_back({ i, i + SPRINGS, i + SPRINGS + 1 });
      faces.push_back({ i, i + SPRINGS + 1, i + 1 });
    }
    return flatModel(places, faces);
  }

  /// How far a spring is from the axis perpendicular to the tension, as the cosine to the tension.
  double offPerpendicular(SpringId s) const
  {
    return std::abs(
        cloth.direction(s, { 0 }).normalized().dot(cloth.direction(red(), { 0 }).normalized()));
  }

  SpringId red() const { return springs[2]; }
  SpringId s2() const { return springs[3]; }
  SpringId s3() const { return springs[4]; }
  SpringId s4() const { return springs[5]; }
  SpringId s5() const { return springs[6]; }

  Cloth cloth;
  std::array<SpringId, SPRINGS> springs;
};

TEST(Figure3_13, OnlyTheRedSpringIsOverItsThreshold)
{
  WeakPoint figure;
  Tearing tearing(rulesOfTheThesis());

  EXPECT_NEAR(tearing.scan(figure.cloth), 0.4, 1e-6);
  EXPECT_EQ(tearing.worst(figure.cloth).spring, figure.red());
  EXPECT_EQ(tearing.worst(figure.cloth).kind, TearKind::WEAK_POINT);
  EXPECT_TRUE(isSound(figure.cloth.mesh));
}

TEST(Figure3_14, S4ResistsMost)
{
  const WeakPoint figure;
  const SpringLaw& s4 = figure.cloth.springs.structural[figure.s4().index];

  EXPECT_NEAR(resistanceAt(figure.cloth, { 0 }, figure.red()), 0.2 * s4.stiffness,
              1e-4 * s4.stiffness);
}

TEST(Figure3_15, S2IsChosenAlthoughS5OnTheOtherSideIsNearerThePerpendicular)
{
  const WeakPoint figure;
  ASSERT_LT(figure.offPerpendicular(figure.s5()), figure.offPerpendicular(figure.s2()));
  ASSERT_LT(figure.offPerpendicular(figure.s2()), figure.offPerpendicular(figure.s3()));

  const auto path = findTearPath(figure.cloth, { 0 }, figure.red());

  ASSERT_TRUE(path.has_value());
  EXPECT_EQ(path->springs, (std::vector<SpringId>{ figure.s2() }));
}

TEST(Figure3_16, TheTearRunsThroughS2)
{
  WeakPoint figure;
  Cloth& cloth = figure.cloth;

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 1u);
  const TearEvent& tear = pass.tears[0];
  EXPECT_EQ(tear.kind, TearKind::WEAK_POINT);
  EXPECT_EQ(tear.spring, figure.red());
  EXPECT_EQ(tear.path, figure.s2());
  const ParticleId p{ 0 };
  const ParticleId copy = tear.particles[0].id;
  EXPECT_TRUE(cloth.mesh.spring(figure.red()).joins(p));
  EXPECT_TRUE(cloth.mesh.spring(figure.s3()).joins(copy));
  EXPECT_TRUE(cloth.mesh.spring(figure.s4()).joins(copy));
  EXPECT_TRUE(cloth.mesh.spring(figure.s5()).joins(copy));
  EXPECT_TRUE(springBetween(cloth.mesh, p, { 4 }).valid());
  EXPECT_TRUE(springBetween(cloth.mesh, copy, { 4 }).valid());
  EXPECT_TRUE(isSound(cloth.mesh));
}

TEST(Figure3_17, TheWeakPointMovesOnToTheFarEndOfThePath)
{
  WeakPoint figure;
  Cloth& cloth = figure.cloth;

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 1u);
  for (int i = 0; i < cloth.mesh.particleCount(); ++i)
  {
    EXPECT_EQ(cloth.damage.weak[i] != 0, i == 4) << "particle " << i;
    EXPECT_FALSE(cloth.damage.hinge[i]) << "particle " << i;
  }
}

TEST(Figure3_17, ATearThatComesToTheBorderLeavesAOnePointConnection)
{
  Cloth cloth = clothOf(openFan({ 0, 90, 180, 270 }));
  cloth.damage.weak[0] = 1;
  pullOut(cloth, 2, 1.4);
  pullOut(cloth, 4, 1.2);

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 1u);
  for (int i = 0; i < cloth.mesh.particleCount(); ++i)
  {
    EXPECT_FALSE(cloth.damage.weak[i]) << "particle " << i;
    EXPECT_EQ(cloth.damage.hinge[i] != 0, i == 3) << "particle " << i;
  }
}

TEST(Figure3_17, EveryTearThatRunsOnHandsItsWeaknessToTheFarEnd)
{
  TearRules rules = rulesOfTheThesis();
  rules.max_tears_per_step = 1;
  Cloth cloth = clothOf(sheet(9, 9, RectanglePattern::IRREGULAR));
  for (auto position : cloth.state.position)
  {
    position.y() *= Real(1.45);
  }
  pullOut(cloth, 40, 1.12);  // the middle starts it
  int ran_on = 0;
  int came_to_the_border = 0;
  for (int step = 0; step < 60; ++step)
  {
    const Cloth before = cloth;
    const Pass pass = tearOnce(cloth, rules);
    ASSERT_LE(pass.tears.size(), 1u);
    if (pass.tears.empty() || pass.tears[0].kind != TearKind::WEAK_POINT)
    {
      continue;
    }
    const TearEvent& tear = pass.tears[0];
    const ParticleId p = tear.particles[0].parents[0];
    const ParticleId far = before.mesh.spring(tear.path).other(p);
    const bool border = before.mesh.onBorder(far);
    EXPECT_FALSE(cloth.damage.weak[p.index]);
    EXPECT_FALSE(cloth.damage.weak[tear.particles[0].id.index]);
    EXPECT_EQ(cloth.damage.weak[far.index] != 0, !border);
    EXPECT_EQ(cloth.damage.hinge[far.index] != 0, border);
    ++ran_on;
    came_to_the_border += border ? 1 : 0;
  }
  EXPECT_GT(ran_on, 3);
  EXPECT_GT(came_to_the_border, 0);
}

TEST(Figure3_19, TheSegmentsPartAndTheCopyMovesAlongTheTension)
{
  Cloth cloth = clothOf(bowTie(2, 2));
  const ParticleId p{ 0 };
  const SpringId red = springBetween(cloth.mesh, 0, 5);  // in the middle of the second fan
  const Vec3 direction = cloth.state.position[5].normalized();
  pullOut(cloth, 5, 1.3);

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_EQ(pass.tears[0].kind, TearKind::ONE_POINT);
  EXPECT_EQ(countsOf(cloth.mesh), (Counts{ 8, 10, 4 }));
  EXPECT_FALSE(sharesParticle(cloth.mesh, { 0 }, { 2 }));
  EXPECT_FALSE(sharesParticle(cloth.mesh, { 1 }, { 3 }));
  const ParticleId copy = pass.tears[0].particles[0].id;
  EXPECT_TRUE(cloth.mesh.spring(red).joins(copy));
  EXPECT_TRUE(cloth.state.position[p.index].isZero());
  const Vec3 shift = cloth.state.position[copy.index];
  EXPECT_NEAR(shift.dot(direction), 0.05, 1e-5);
  EXPECT_NEAR(shift.cross(direction).norm(), 0.0, 1e-6);
  EXPECT_EQ(cloth.damage.pieces, 2);
}

TEST(Figure3_20, DetachedTrianglesKeepTheirTextureCorners)
{
  Cloth cloth = clothOf(openFan({ 0, 90, 180, 270 }));
  const Mesh before = cloth.mesh;
  cloth.damage.weak[0] = 1;
  pullOut(cloth, 2, 1.4);
  pullOut(cloth, 4, 1.2);

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 1u);
  const ParticleId p3{ 0 };
  const ParticleId copy = pass.tears[0].particles[0].id;
  EXPECT_EQ(uvAt(cloth.mesh, { 1 }, p3), uvAt(before, { 1 }, p3));
  EXPECT_EQ(uvAt(cloth.mesh, { 2 }, copy), uvAt(before, { 2 }, p3));
  for (int i = 0; i < before.triangleCount(); ++i)
  {
    EXPECT_EQ(cloth.mesh.triangle({ i }).uv, before.triangle({ i }).uv);
  }
}

TEST(Figure3_21, ADividedTriangleHasTheMiddleOfTheTextureOnBothSidesOfTheTear)
{
  Cloth cloth = clothOf(flatModel({ { 0.5, 1 }, { 0, 0 }, { 1, 0.25 } }, { { 0, 1, 2 } }));
  const Vec2d p1(0.5, 1);
  const Vec2d p2(0, 0);
  const Vec2d p3(1, 0.25);
  cloth.state.position[1] += Vec3(-0.4, -0.1, 0);
  cloth.state.position[2] += Vec3(0.4, 0.1, 0);

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 1u);
  ASSERT_EQ(countsOf(cloth.mesh), (Counts{ 5, 6, 2 }));
  const Vec2d middle = 0.5 * (p2 + p3);
  const ParticleId p4 = pass.tears[0].particles[0].id;
  const ParticleId p5 = pass.tears[0].particles[1].id;
  EXPECT_EQ(uvAt(cloth.mesh, { 0 }, { 0 }), p1);
  EXPECT_EQ(uvAt(cloth.mesh, { 0 }, { 1 }), p2);
  EXPECT_EQ(uvAt(cloth.mesh, { 0 }, p4), middle);
  EXPECT_EQ(uvAt(cloth.mesh, { 1 }, { 0 }), p1);
  EXPECT_EQ(uvAt(cloth.mesh, { 1 }, p5), middle);
  EXPECT_EQ(uvAt(cloth.mesh, { 1 }, { 2 }), p3);
}

}  // namespace
}  // namespace cloth
