// Claims of tearing: thresholds, order, what is spared, and what each tear leaves behind.
#include "cloth_tearing/core/tearing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "small_meshes.h"

namespace cloth
{
namespace
{

const RectanglePattern ALL_PATTERNS[] = { RectanglePattern::ONE_DIAGONAL,
                                          RectanglePattern::ALTERNATING,
                                          RectanglePattern::IRREGULAR };

/// Kites in a row, 10 m apart; kite i has particles 4 i to 4 i + 3.
Cloth kites(int count)
{
  ClothModel model = kite();
  for (int i = 1; i < count; ++i)
  {
    model = beside(model, kite(), 10.0 * i);
  }
  return clothOf(model);
}

/// Stretches the shared spring of kite `i` to `factor` times its length, other springs by less.
void stretchKite(Cloth& cloth, int i, double factor)
{
  cloth.state.position[4 * i] = Vec3(static_cast<Real>(10.0 * i - factor), 0, 0);
  cloth.state.position[4 * i + 1] = Vec3(static_cast<Real>(10.0 * i + factor), 0, 0);
}

SpringId sharedSpring(const Cloth& cloth, int i)
{
  return springBetween(cloth.mesh, 4 * i, 4 * i + 1);
}

/// An open fan of three whose hub is weak; its spring to rim 2 stretched, rim 4 resists, so that
/// the tear runs along the spring to rim 3.
Cloth weakFan(double stretch)
{
  Cloth cloth = clothOf(openFan({ 0, 90, 180, 270 }));
  cloth.damage.weak[0] = 1;
  pullOut(cloth, 2, stretch);
  pullOut(cloth, 4, 1.1);
  return cloth;
}

Vec3d momentum(const Cloth& cloth)
{
  Vec3d sum = Vec3d::Zero();
  for (int i = 0; i < cloth.state.size(); ++i)
  {
    sum += cloth.rest.mass[i] * cloth.state.velocity[i].cast<double>();
  }
  return sum;
}

/// Velocities that differ from particle to particle.
void stir(Cloth& cloth)
{
  for (int i = 0; i < cloth.state.size(); ++i)
  {
    cloth.state.velocity[i] = Vec3(Real(i % 7) - 3, Real(i % 5) - 1, Real(i % 3));
  }
}

void stretchAlongY(Cloth& cloth, double factor)
{
  for (auto position : cloth.state.position)
  {
    position.y() *= static_cast<Real>(factor);
  }
}

void expectAllFinite(const Cloth& cloth)
{
  for (int i = 0; i < cloth.state.size(); ++i)
  {
    ASSERT_TRUE(cloth.state.position[i].allFinite()) << "particle " << i;
    ASSERT_TRUE(cloth.state.velocity[i].allFinite()) << "particle " << i;
    ASSERT_TRUE(std::isfinite(cloth.state.inverse_mass[i])) << "particle " << i;
  }
}

Grasp graspOf(std::uint64_t id, const std::vector<int>& particles, Cloth& cloth)
{
  Grasp grasp;
  grasp.id = id;
  for (int p : particles)
  {
    grasp.held.push_back({ { p }, cloth.state.position[p].cast<double>() });
    cloth.attach({ p }, { Attachment::Kind::GRASP, id });
  }
  return grasp;
}

bool holds(const Grasp& grasp, ParticleId p)
{
  return std::any_of(grasp.held.begin(), grasp.held.end(),
                     [&](const Grasp::Held& held) { return held.particle == p; });
}

/// Thresholds of the thesis, and the floor of the defaults.
TearRules rulesWithFloor()
{
  TearRules rules = rulesOfTheThesis();
  rules.min_length = 0.4;
  rules.min_altitude = 0.2;
  return rules;
}

// -- scan ----------------------------------------------------------------------------------------

TEST(Scan, ReturnsTheLargestStrainOfASpringThatCarriesLoad)
{
  Cloth cloth = kites(3);
  stretchKite(cloth, 1, 1.3);
  stretchKite(cloth, 2, 1.4);
  Tearing tearing(rulesOfTheThesis());

  EXPECT_NEAR(tearing.scan(cloth), 0.4, 1e-6);
  cloth.springs.release(sharedSpring(cloth, 2));
  EXPECT_NEAR(tearing.scan(cloth), 0.3, 1e-6);
}

TEST(Scan, DoesNotHideAStrainThatIsNoNumber)
{
  Cloth cloth = kites(2);
  stretchKite(cloth, 1, 1.3);
  cloth.state.position[0].x() = std::numeric_limits<Real>::quiet_NaN();
  Tearing tearing(rulesOfTheThesis());

  EXPECT_TRUE(std::isnan(tearing.scan(cloth)));
}

TEST(Scan, FindsNothingWhileTearingIsSwitchedOff)
{
  Cloth cloth = kites(1);
  stretchKite(cloth, 0, 3.0);
  TearRules rules = rulesOfTheThesis();
  rules.enabled = false;

  const Pass pass = tearOnce(cloth, rules);

  EXPECT_TRUE(pass.tears.empty());
  EXPECT_NEAR(pass.max_strain, 2.0, 1e-6);
}

TEST(Scan, OfSomeSpringsReadsNoOthers)
{
  Cloth cloth = kites(3);
  stretchKite(cloth, 0, 1.55);
  stretchKite(cloth, 2, 1.6);
  Tearing tearing(rulesOfTheThesis());
  std::vector<Grasp> grasps;
  int postponed = 0;

  EXPECT_NEAR(tearing.scan(cloth, { sharedSpring(cloth, 0).index }), 0.55, 1e-6);
  const auto tears = tearing.tear(
      cloth, grasps, [](const Vec3&) { return false; }, postponed);

  ASSERT_EQ(tears.size(), 1u);
  EXPECT_EQ(tears[0].spring, sharedSpring(kites(3), 0));
}

TEST(Scan, AgreesWithTheWorstReading)
{
  const ClothModel model = sheet(8, 8, RectanglePattern::IRREGULAR);
  for (double radius : { 0.0, 0.2 })
  {
    Cloth cloth = clothOf(model);
    stretchAlongY(cloth, 1.7);
    pullOut(cloth, 27, 1.1);
    TearRules rules = rulesOfTheThesis();
    rules.tear_radius = radius;
    Tearing tearing(rules);

    const TearReading worst = tearing.worst(cloth);
    const Pass pass = tearOnce(cloth, rules);

    ASSERT_FALSE(pass.tears.empty());
    EXPECT_EQ(pass.tears[0].spring, worst.spring);
    EXPECT_EQ(pass.tears[0].strain, worst.strain);
    EXPECT_EQ(pass.tears[0].threshold, worst.threshold);
  }
}

TEST(WorstReading, IsNoneForClothThatIsNotStretched)
{
  Cloth cloth = kites(1);
  stretchKite(cloth, 0, 0.9);

  EXPECT_FALSE(Tearing(rulesOfTheThesis()).worst(cloth).spring.valid());
}

// -- order ---------------------------------------------------------------------------------------

TEST(TearOrder, IsWorstFirst)
{
  Cloth cloth = kites(3);
  stretchKite(cloth, 0, 1.52);
  stretchKite(cloth, 1, 1.60);
  stretchKite(cloth, 2, 1.56);

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 3u);
  EXPECT_EQ(pass.tears[0].spring, sharedSpring(kites(3), 1));
  EXPECT_EQ(pass.tears[1].spring, sharedSpring(kites(3), 2));
  EXPECT_EQ(pass.tears[2].spring, sharedSpring(kites(3), 0));
}

TEST(TearOrder, GoesByStrainOverThresholdNotByStrain)
{
  Cloth cloth = clothOf(beside(kite(), bowTie(2, 2), 10.0));
  const SpringId sound = springBetween(cloth.mesh, 0, 1);
  const SpringId at_a_point = springBetween(cloth.mesh, 4, 4 + 5);
  stretchKite(cloth, 0, 1.6);  // 1.2 times the threshold of sound cloth
  const Vec3 along = cloth.direction(at_a_point, { 4 });
  cloth.state.position[4 + 5] += Real(0.4) * along;  // 1.6 times that of a one-point connection

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 2u);
  EXPECT_EQ(pass.tears[0].spring, at_a_point);
  EXPECT_EQ(pass.tears[1].spring, sound);
}

TEST(TearOrder, BreaksTiesById)
{
  Cloth cloth = kites(4);
  for (int i : { 3, 1, 2, 0 })
  {
    // All in one place: the same floats, the same strain.
    cloth.state.position[4 * i] = Vec3(-1.6f, 0, 0);
    cloth.state.position[4 * i + 1] = Vec3(1.6f, 0, 0);
    cloth.state.position[4 * i + 2] = Vec3(0, 1, 0);
    cloth.state.position[4 * i + 3] = Vec3(0, -1, 0);
  }

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 4u);
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_EQ(pass.tears[i].spring, sharedSpring(kites(4), i));
  }
}

TEST(TearOrder, LetsSpringsAtATouchedParticleWait)
{
  Cloth cloth = clothOf(sheet(5, 5, RectanglePattern::ONE_DIAGONAL));
  stretchAlongY(cloth, 1.6);
  int over = 0;
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    over += cloth.strain({ i }) > 0.5 ? 1 : 0;
  }
  ASSERT_EQ(over, 20) << "the upright springs";

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  EXPECT_EQ(static_cast<int>(pass.tears.size()) + pass.postponed, over);
  EXPECT_GT(pass.postponed, 0);
  std::vector<int> taken(25, 0);
  for (const TearEvent& tear : pass.tears)
  {
    for (ParticleId end : tear.particles[0].parents)
    {
      EXPECT_EQ(taken[end.index]++, 0) << "two tears at particle " << end.index;
    }
  }
}

TEST(TearOrder, MakesAtMostTheStatedNumberAStepAndTheRestLater)
{
  Cloth cloth = kites(5);
  for (int i = 0; i < 5; ++i)
  {
    stretchKite(cloth, i, 1.52);
  }
  TearRules rules = rulesOfTheThesis();
  rules.max_tears_per_step = 2;
  rules.weak_tear_strain = rules.one_point_tear_strain = 0.5;

  const Pass first = tearOnce(cloth, rules);
  const Pass second = tearOnce(cloth, rules);
  const Pass third = tearOnce(cloth, rules);

  EXPECT_EQ(first.tears.size(), 2u);
  EXPECT_EQ(first.postponed, 3);
  EXPECT_EQ(second.tears.size(), 2u);
  EXPECT_EQ(second.postponed, 1);
  EXPECT_EQ(third.tears.size(), 1u);
  EXPECT_EQ(third.postponed, 0);
}

// -- thresholds ----------------------------------------------------------------------------------

TEST(TearThreshold, OfSoundClothIsItsOwn)
{
  Cloth below = kites(1);
  Cloth above = kites(1);
  stretchKite(below, 0, 1.49);
  stretchKite(above, 0, 1.51);

  EXPECT_TRUE(tearOnce(below, rulesOfTheThesis()).tears.empty());
  const Pass pass = tearOnce(above, rulesOfTheThesis());
  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_EQ(pass.tears[0].kind, TearKind::BASIC);
  EXPECT_NEAR(pass.tears[0].strain, 0.51, 1e-6);
  EXPECT_EQ(pass.tears[0].threshold, 0.5);
}

TEST(TearThreshold, IsLowerAtAWeakPoint)
{
  Cloth below = weakFan(1.24);
  Cloth above = weakFan(1.26);

  EXPECT_TRUE(tearOnce(below, rulesOfTheThesis()).tears.empty());
  const Pass pass = tearOnce(above, rulesOfTheThesis());
  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_EQ(pass.tears[0].kind, TearKind::WEAK_POINT);
  EXPECT_EQ(pass.tears[0].threshold, 0.25);
}

TEST(TearThreshold, OfAOnePointConnectionIsItsOwn)
{
  TearRules rules = rulesOfTheThesis();
  rules.one_point_tear_strain = 0.1;
  Cloth below = clothOf(bowTie(2, 2));
  Cloth above = clothOf(bowTie(2, 2));
  pullOut(below, 5, 1.09);
  pullOut(above, 5, 1.11);

  EXPECT_TRUE(tearOnce(below, rules).tears.empty());
  const Pass pass = tearOnce(above, rules);
  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_EQ(pass.tears[0].kind, TearKind::ONE_POINT);
  EXPECT_EQ(pass.tears[0].threshold, 0.1);
}

TEST(TearThreshold, OfAOnePointConnectionIsTheWeakOneUnlessStated)
{
  TearRules rules = rulesOfTheThesis();
  rules.one_point_tear_strain = 0.0;
  Cloth below = clothOf(bowTie(2, 2));
  Cloth above = clothOf(bowTie(2, 2));
  pullOut(below, 5, 1.24);
  pullOut(above, 5, 1.26);

  EXPECT_TRUE(tearOnce(below, rules).tears.empty());
  const Pass pass = tearOnce(above, rules);
  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_EQ(pass.tears[0].kind, TearKind::ONE_POINT);
  EXPECT_EQ(pass.tears[0].threshold, rules.weak_tear_strain);
  EXPECT_EQ(TearRules().one_point_tear_strain, 0.0);
  EXPECT_TRUE(problems(rules).empty());
}

TEST(TearThreshold, OfAOnePointConnectionHasNoCrackBand)
{
  TearRules rules = rulesOfTheThesis();
  rules.crack_length = 100.0;
  Cloth cloth = clothOf(bowTie(2, 2));
  pullOut(cloth, 5, 1.26);

  const Pass pass = tearOnce(cloth, rules);

  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_EQ(pass.tears[0].kind, TearKind::ONE_POINT);
  EXPECT_EQ(pass.tears[0].threshold, 0.25);
}

TEST(TearThreshold, OfShortSpringsAtAWeakPointGrowsWithTheCrackBand)
{
  TearRules rules = rulesOfTheThesis();
  rules.crack_length = 4.0;  // springs are 1 m long: twice the threshold
  Cloth below = weakFan(1.48);
  Cloth above = weakFan(1.52);

  EXPECT_TRUE(tearOnce(below, rules).tears.empty());
  const Pass pass = tearOnce(above, rules);
  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_NEAR(pass.tears[0].threshold, 0.5, 1e-12);
}

TEST(TearThreshold, OfLongSpringsAtAWeakPointDoesNotShrink)
{
  TearRules rules = rulesOfTheThesis();
  rules.crack_length = 0.01;
  Cloth cloth = weakFan(1.3);

  const Pass pass = tearOnce(cloth, rules);

  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_EQ(pass.tears[0].threshold, 0.25);
}

TEST(TearThreshold, OfSoundClothHasNoCrackBand)
{
  TearRules rules = rulesOfTheThesis();
  rules.crack_length = 100.0;
  Cloth cloth = kites(1);
  stretchKite(cloth, 0, 1.51);

  const Pass pass = tearOnce(cloth, rules);

  ASSERT_FALSE(pass.tears.empty());
  EXPECT_EQ(pass.tears[0].threshold, 0.5);
}

TEST(TearThreshold, IsMultipliedWithinTheHemOfAPin)
{
  TearRules rules = rulesOfTheThesis();
  rules.hem_factor = 2.0;
  const auto hemmed = [](double factor)
  {
    Cloth cloth = makeCloth(kite(), { 2 }, Material{}, RestShapeSource::IMPORTED, 1.5);
    stretchKite(cloth, 0, factor);
    return cloth;
  };
  Cloth below = hemmed(1.95);
  Cloth above = hemmed(2.05);

  EXPECT_TRUE(tearOnce(below, rules).tears.empty());
  const Pass pass = tearOnce(above, rules);
  ASSERT_FALSE(pass.tears.empty());
  EXPECT_EQ(pass.tears[0].threshold, 1.0);
}

TEST(TearThreshold, IsNotThatOfAHemOutOfItsReach)
{
  TearRules rules = rulesOfTheThesis();
  rules.hem_factor = 2.0;
  Cloth cloth = makeCloth(kite(), { 2 }, Material{}, RestShapeSource::IMPORTED, 0.5);
  stretchKite(cloth, 0, 1.6);

  const Pass pass = tearOnce(cloth, rules);

  ASSERT_FALSE(pass.tears.empty());
  EXPECT_EQ(pass.tears[0].threshold, 0.5);
}

TEST(TearThreshold, OfTheHemHoldsAtWeakPointsToo)
{
  TearRules rules = rulesOfTheThesis();
  rules.hem_factor = 2.0;
  Cloth below = weakFan(1.48);
  Cloth above = weakFan(1.52);
  for (Cloth* cloth : { &below, &above })
  {
    std::fill(cloth->damage.hem.begin(), cloth->damage.hem.end(), 1);
  }

  EXPECT_TRUE(tearOnce(below, rules).tears.empty());
  const Pass pass = tearOnce(above, rules);
  ASSERT_FALSE(pass.tears.empty());
  EXPECT_EQ(pass.tears[0].threshold, 0.5);
}

TEST(TearThreshold, IsComparedWithThePatchStrainWhereTheClothIsSound)
{
  Cloth cloth = clothOf(sheet(9, 9, RectanglePattern::ONE_DIAGONAL));
  const SpringId s = springBetween(cloth.mesh, 40, 41);
  cloth.state.position[41].x() += Real(0.08);  // one spring is long, its neighbours are short
  ASSERT_GT(cloth.strain(s), 0.5);
  TearRules rules = rulesOfTheThesis();
  Cloth to_the_letter = cloth;

  const Pass letter = tearOnce(to_the_letter, rules);
  rules.tear_radius = 0.4;
  const Pass patch = tearOnce(cloth, rules);

  ASSERT_EQ(letter.tears.size(), 1u);
  EXPECT_EQ(letter.tears[0].spring, s);
  EXPECT_NEAR(letter.tears[0].strain, 0.64, 1e-5);
  EXPECT_TRUE(patch.tears.empty());
}

TEST(TearThreshold, IsComparedWithTheSpringsOwnStrainAtAWeakPoint)
{
  TearRules rules = rulesOfTheThesis();
  rules.tear_radius = 10.0;
  Cloth cloth = weakFan(1.3);

  const Pass pass = tearOnce(cloth, rules);

  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_NEAR(pass.tears[0].strain, 0.3, 1e-6);
}

// -- basic tears ---------------------------------------------------------------------------------

TEST(BasicTear, SaysWhatItAddedAndWhere)
{
  Cloth cloth = kites(1);
  stretchKite(cloth, 0, 1.6);
  cloth.state.position[0].z() = Real(0.25);
  cloth.state.position[1].z() = Real(0.25);
  const SpringId s = sharedSpring(cloth, 0);
  const double stiffness = cloth.springs.structural[s.index].stiffness;

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 1u);
  const TearEvent& tear = pass.tears[0];
  EXPECT_EQ(tear.kind, TearKind::BASIC);
  EXPECT_EQ(tear.spring, s);
  EXPECT_FALSE(tear.path.valid());
  ASSERT_EQ(tear.particles.size(), 2u);
  EXPECT_EQ(tear.particles[0].id.index, 4);
  EXPECT_EQ(tear.particles[0].parents, (std::array<ParticleId, 2>{ { { 0 }, { 1 } } }));
  EXPECT_EQ(tear.particles[1].id.index, 5);
  EXPECT_EQ(tear.particles[1].parents, (std::array<ParticleId, 2>{ { { 1 }, { 0 } } }));
  std::vector<TriangleId> triangles = tear.triangles;
  std::sort(triangles.begin(), triangles.end());
  EXPECT_EQ(triangles, (std::vector<TriangleId>{ { 0 }, { 1 }, { 2 }, { 3 } }));
  EXPECT_NEAR((tear.position - Vec3d(0, 0, 0.25)).norm(), 0.0, 1e-6);
  EXPECT_EQ(tear.uv, Vec2d(0, 0));
  EXPECT_NEAR(tear.tension, stiffness * 0.6 * 2.0, 1e-4);
  EXPECT_EQ(tear.pieces, 1);
  EXPECT_EQ(tear.loose_area, 0.0);
  EXPECT_EQ(tear.loose_mass, 0.0);
  EXPECT_EQ(cloth.damage.tears, 1u);
  EXPECT_EQ(cloth.damage.parents[4], (std::array<int, 2>{ { 0, 1 } }));
}

TEST(BasicTear, OfABorderSpringWeakensTheOneCornerOpposite)
{
  Cloth cloth = clothOf(sheet(5, 5, RectanglePattern::ALTERNATING));
  const SpringId s = springBetween(cloth.mesh, 1, 2);  // on the upper edge
  const ParticleId corner = cloth.mesh.opposite(s, 0);
  ASSERT_FALSE(cloth.mesh.onBorder(corner));
  cloth.rest.length[s.index] *= 0.6;  // as if it had shrunk

  const Counts before = countsOf(cloth.mesh);
  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_EQ(countsOf(cloth.mesh) - before, (Counts{ 2, 3, 1 }));
  for (int i = 0; i < cloth.mesh.particleCount(); ++i)
  {
    EXPECT_EQ(cloth.damage.weak[i] != 0, i == corner.index) << "particle " << i;
  }
}

TEST(BasicTear, MakesAnOppositeCornerOnTheBorderAOnePointConnectionAndNotWeak)
{
  Cloth cloth = kites(1);
  stretchKite(cloth, 0, 1.6);

  tearOnce(cloth, rulesOfTheThesis());

  for (int corner : { 2, 3 })
  {
    EXPECT_TRUE(cloth.damage.hinge[corner]);
    EXPECT_FALSE(cloth.damage.weak[corner]);
  }
}

TEST(BasicTear, ConservesMassMomentumAndTheCentreOfMass)
{
  for (const RectanglePattern pattern : ALL_PATTERNS)
  {
    Cloth cloth = clothOf(sheet(7, 7, pattern));
    stretchAlongY(cloth, 1.7);
    stir(cloth);
    const auto centre = [](const Cloth& c)
    {
      Vec3d sum = Vec3d::Zero();
      for (int i = 0; i < c.state.size(); ++i)
      {
        sum += c.rest.mass[i] * c.state.position[i].cast<double>();
      }
      return sum;
    };
    const Vec3d momentum_before = momentum(cloth);
    const Vec3d centre_before = centre(cloth);
    const double mass_before = sumOf(cloth.rest.mass);

    const Pass pass = tearOnce(cloth, rulesOfTheThesis());

    ASSERT_GT(pass.tears.size(), 2u);
    EXPECT_NEAR(sumOf(cloth.rest.mass), mass_before, 1e-12);
    EXPECT_NEAR((momentum(cloth) - momentum_before).norm(), 0.0, 1e-6);
    EXPECT_NEAR((centre(cloth) - centre_before).norm(), 0.0, 1e-7);
  }
}

TEST(BasicTear, InterpolatesTheVelocityOfTheSplitPoints)
{
  Cloth cloth = kites(1);
  stretchKite(cloth, 0, 2.0);  // twice the length: the split points lie at a quarter
  cloth.state.velocity[0] = Vec3(0, 0, 0);
  cloth.state.velocity[1] = Vec3(4, 0, 8);

  tearOnce(cloth, rulesOfTheThesis());

  EXPECT_TRUE(cloth.state.velocity[4].isApprox(Vec3(1, 0, 2)));
  EXPECT_TRUE(cloth.state.velocity[5].isApprox(Vec3(3, 0, 6)));
}

// -- weak points ---------------------------------------------------------------------------------

TEST(WeakPointTear, SaysWhatItAddedAndWhere)
{
  Cloth cloth = weakFan(1.3);
  const SpringId path = springBetween(cloth.mesh, 0, 3);

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 1u);
  const TearEvent& tear = pass.tears[0];
  EXPECT_EQ(tear.kind, TearKind::WEAK_POINT);
  EXPECT_EQ(tear.path, path);
  ASSERT_EQ(tear.particles.size(), 1u);
  EXPECT_EQ(tear.particles[0].id.index, 5);
  EXPECT_EQ(tear.particles[0].parents, (std::array<ParticleId, 2>{ { { 0 }, { 0 } } }));
  EXPECT_TRUE(tear.position.isZero());
  EXPECT_EQ(tear.uv, Vec2d(0, 0));
  EXPECT_EQ(tear.pieces, 1);
}

TEST(WeakPointTear, DoesNotHappenWhereNothingResists)
{
  Cloth cloth = weakFan(1.8);
  pullOut(cloth, 4, 0.8);  // slack
  pullOut(cloth, 1, 0.95);
  pullOut(cloth, 3, 0.95);

  EXPECT_TRUE(tearOnce(cloth, rulesOfTheThesis()).tears.empty());
}

TEST(WeakPointTear, GivesWayToABasicTearWhereAGripperResistsAndNothingElse)
{
  Cloth cloth = weakFan(1.8);
  pullOut(cloth, 4, 0.8);  // slack
  pullOut(cloth, 1, 0.95);
  pullOut(cloth, 3, 0.95);
  std::vector<Grasp> grasps = { graspOf(3, { 0 }, cloth) };
  Tearing tearing(rulesOfTheThesis());

  const Pass pass = tearOnce(cloth, tearing, grasps);

  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_EQ(pass.tears[0].kind, TearKind::BASIC);
}

/// A weak point with nothing between the stretched and the resisting spring.
Cloth weakCorner(double stretch)
{
  Cloth cloth = clothOf(openFan({ 0, 120 }));
  cloth.damage.weak[0] = 1;
  pullOut(cloth, 1, stretch);
  pullOut(cloth, 2, 1.1);
  return cloth;
}

TEST(WeakPointTear, GivesWayToABasicTearAtTheFullThresholdWhereNothingLiesBetween)
{
  Cloth below = weakCorner(1.45);
  Cloth above = weakCorner(1.55);

  EXPECT_TRUE(tearOnce(below, rulesOfTheThesis()).tears.empty());
  const Pass pass = tearOnce(above, rulesOfTheThesis());
  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_EQ(pass.tears[0].kind, TearKind::BASIC);
  EXPECT_EQ(pass.tears[0].threshold, 0.5);
}

/// A strip of two rows whose lower row is stretched between 1 and 2, which both are weak; the
/// springs 0-1 and 2-3 hold against it.
///
///     4---5---6---7
///     | / | / | / |
///     0---1---2---3
Cloth bothEndsWeak(double left, double right)
{
  Cloth cloth = clothOf(flatModel(
      { { -1, 0 }, { 0, 0 }, { 1, 0 }, { 2, 0 }, { -1, 1 }, { 0, 1 }, { 1, 1 }, { 2, 1 } },
      { { 0, 1, 5 }, { 0, 5, 4 }, { 1, 2, 6 }, { 1, 6, 5 }, { 2, 3, 7 }, { 2, 7, 6 } }));
  cloth.damage.weak[1] = 1;
  cloth.damage.weak[2] = 1;
  auto& position = cloth.state.position;
  position[1].x() = Real(-0.25);
  position[2].x() = Real(1.25);
  position[0].x() = static_cast<Real>(-0.25 - left);
  position[3].x() = static_cast<Real>(1.25 + right);
  return cloth;
}

TEST(WeakPointTear, TakesTheEndThatResistsMore)
{
  Cloth left = bothEndsWeak(1.2, 1.1);
  Cloth right = bothEndsWeak(1.1, 1.2);

  const Pass left_pass = tearOnce(left, rulesOfTheThesis());
  const Pass right_pass = tearOnce(right, rulesOfTheThesis());

  ASSERT_FALSE(left_pass.tears.empty());
  ASSERT_FALSE(right_pass.tears.empty());
  EXPECT_EQ(left_pass.tears[0].particles[0].parents[0].index, 1);
  EXPECT_EQ(right_pass.tears[0].particles[0].parents[0].index, 2);
}

TEST(WeakPointTear, TakesTheLowerIdWhereBothEndsResistAlike)
{
  // Turned by half a turn the strip is itself: both ends have the same springs.
  Cloth cloth = clothOf(
      flatModel({ { -1.5, 0 }, { -0.5, 0 }, { 0.5, 0 }, { 1.5, 0 }, { -1, 1 }, { 0, 1 }, { 1, 1 } },
                { { 0, 1, 4 }, { 1, 5, 4 }, { 1, 2, 5 }, { 2, 6, 5 }, { 2, 3, 6 } }));
  cloth.damage.weak[1] = 1;
  cloth.damage.weak[2] = 1;
  auto& position = cloth.state.position;
  for (auto [particle, x] :
       { std::pair<int, Real>{ 0, -2.0f }, { 1, -0.75f }, { 2, 0.75f }, { 3, 2.0f } })
  {
    position[particle].x() = x;
  }
  const SpringId s = springBetween(cloth.mesh, 1, 2);
  ASSERT_EQ(resistanceAt(cloth, { 1 }, s), resistanceAt(cloth, { 2 }, s));
  ASSERT_GT(resistanceAt(cloth, { 1 }, s), 0.0);

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_FALSE(pass.tears.empty());
  EXPECT_EQ(pass.tears[0].spring, s);
  EXPECT_EQ(pass.tears[0].particles[0].parents[0].index, 1);
}

TEST(WeakPointTear, ComesAfterAOnePointTearAtTheOtherEnd)
{
  ClothModel model = flatModel({ { -1, 0 },
                                 { 0, 0 },
                                 { 1, 0 },
                                 { 2, 0 },
                                 { -1, 1 },
                                 { 0, 1 },
                                 { 1, 1 },
                                 { 2, 1 },
                                 { 0.7, -1 },
                                 { 1.3, -1 } },
                               { { 0, 1, 5 },
                                 { 0, 5, 4 },
                                 { 1, 2, 6 },
                                 { 1, 6, 5 },
                                 { 2, 3, 7 },
                                 { 2, 7, 6 },
                                 { 2, 8, 9 } });
  Cloth cloth = clothOf(model);
  ASSERT_TRUE(cloth.damage.hinge[2]);
  cloth.damage.weak[1] = 1;
  cloth.state.position[1].x() = Real(-0.4);
  cloth.state.position[0].x() = Real(-1.6);  // the weak end resists, the other does not

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_FALSE(pass.tears.empty());
  EXPECT_EQ(pass.tears[0].spring, springBetween(meshOf(model), 1, 2));
  EXPECT_EQ(pass.tears[0].kind, TearKind::ONE_POINT);
}

// -- one-point connections -----------------------------------------------------------------------

TEST(OnePointTear, DetachesOnlyTheFanOfTheStretchedSpring)
{
  Cloth cloth = clothOf(bowTie(3, 2));
  const SpringId s = springBetween(cloth.mesh, 0, 5);
  pullOut(cloth, 5, 1.3);

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_EQ(cloth.mesh.fanCount({ 0 }), 2);
  EXPECT_TRUE(cloth.damage.hinge[0]) << "the rest is a hinge still";
  const ParticleId copy = pass.tears[0].particles[0].id;
  EXPECT_TRUE(cloth.mesh.spring(s).joins(copy));
  EXPECT_FALSE(cloth.damage.hinge[copy.index]);
}

TEST(OnePointTear, ReportsAreaAndMassOfThePieceThatComesOff)
{
  Cloth cloth = clothOf(bowTie(2, 3));
  const double area = cloth.rest.area[3] + cloth.rest.area[4] + cloth.rest.area[5];
  pullOut(cloth, 6, 1.3);

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 1u);
  const TearEvent& tear = pass.tears[0];
  EXPECT_EQ(tear.kind, TearKind::ONE_POINT);
  EXPECT_EQ(tear.pieces, 2);
  EXPECT_NEAR(tear.loose_area, area, 1e-12);
  EXPECT_NEAR(tear.loose_mass, area * cloth.rest.areal_density, 1e-12);
  EXPECT_FALSE(tear.path.valid());
  EXPECT_EQ(tear.particles[0].parents, (std::array<ParticleId, 2>{ { { 0 }, { 0 } } }));
  EXPECT_EQ(countPieces(cloth.mesh), 2);
}

TEST(OnePointTear, CountsNoPieceWhereTheFansHangTogetherElsewhere)
{
  // A slit from the middle of the sheet that has run on to the border.
  Cloth cloth = clothOf(sheet(5, 5, RectanglePattern::ONE_DIAGONAL));
  const Fan middle = cloth.mesh.fans({ 12 })[0];
  const ParticleId tip = cloth.mesh.spring(middle.springs[0]).other({ 12 });
  cloth.follow(cloth.mesh.openAlong({ 12 }, middle.springs[0], middle.springs[3]));
  const Fan on = cloth.mesh.fans(tip)[0];
  const SpringId last = on.springs[on.springs.size() / 2];
  const ParticleId hinge = cloth.mesh.spring(last).other(tip);
  cloth.follow(cloth.mesh.detachAlong(tip, last));
  ASSERT_TRUE(cloth.damage.hinge[hinge.index]);
  const SpringId stretched = cloth.mesh.fans(hinge)[0].springs.front();
  const ParticleId other = cloth.mesh.spring(stretched).other(hinge);
  cloth.state.position[other.index] += Real(0.4) * cloth.direction(stretched, hinge);

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_FALSE(pass.tears.empty());
  EXPECT_EQ(pass.tears[0].kind, TearKind::ONE_POINT);
  EXPECT_EQ(pass.tears[0].pieces, 1);
  EXPECT_EQ(pass.tears[0].loose_area, 0.0);
  EXPECT_EQ(countPieces(cloth.mesh), 1);
}

TEST(OnePointTear, ShiftsItsCopyOnlyWhereTheSpringWouldTearAgain)
{
  TearRules rules = rulesOfTheThesis();
  rules.one_point_tear_strain = 0.1;
  Cloth little = clothOf(bowTie(2, 2));
  Cloth much = clothOf(bowTie(2, 2));
  pullOut(little, 5, 1.2);
  pullOut(much, 5, 1.32);

  const Pass little_pass = tearOnce(little, rules);
  const Pass much_pass = tearOnce(much, rules);

  ASSERT_EQ(little_pass.tears.size(), 1u);
  ASSERT_EQ(much_pass.tears.size(), 1u);
  EXPECT_TRUE(little.state.position.back().isZero());
  EXPECT_NEAR(much.state.position.back().norm(), 0.07, 1e-5);
  EXPECT_NEAR(much.strain(much_pass.tears[0].spring), 0.25, 1e-5);
}

TEST(OnePointTear, ShiftsItsCopyByAQuarterOfTheSpringAtMost)
{
  Cloth cloth = clothOf(bowTie(2, 2));
  pullOut(cloth, 5, 2.4);

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_FALSE(pass.tears.empty());
  EXPECT_NEAR(cloth.state.position[pass.tears[0].particles[0].id.index].norm(), 0.25, 1e-5);
}

TEST(OnePointTear, NeverShiftsItsCopyIntoAnObstacle)
{
  Cloth cloth = clothOf(bowTie(2, 2));
  pullOut(cloth, 5, 1.4);
  Tearing tearing(rulesOfTheThesis());
  std::vector<Grasp> grasps;
  int postponed = 0;
  int asked = 0;

  tearing.scan(cloth);
  const auto tears = tearing.tear(
      cloth, grasps,
      [&](const Vec3&)
      {
        ++asked;
        return true;
      },
      postponed);

  ASSERT_EQ(tears.size(), 1u);
  EXPECT_EQ(asked, 1);
  EXPECT_TRUE(cloth.state.position.back().isZero());
}

TEST(OnePointTear, ConservesMassAndMomentum)
{
  Cloth cloth = clothOf(bowTie(4, 2));
  pullOut(cloth, 5, 1.4);
  stir(cloth);
  const Vec3d before = momentum(cloth);
  const double mass = sumOf(cloth.rest.mass);

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_NEAR((momentum(cloth) - before).norm(), 0.0, 1e-6);
  EXPECT_NEAR(sumOf(cloth.rest.mass), mass, 1e-12);
}

// -- the floor -----------------------------------------------------------------------------------

TearRules rulesThatForbidSplitting()
{
  TearRules rules = rulesOfTheThesis();
  rules.min_length = 0.5;
  rules.min_altitude = 0.5;
  return rules;
}

TEST(Floor, OpensSoundClothAlongTwoSpringsInsteadOfSplitting)
{
  Cloth cloth = clothOf(wheel(8));
  pullOut(cloth, 1, 1.6);
  pullOut(cloth, 5, 1.2);
  const Counts before = countsOf(cloth.mesh);

  const Pass pass = tearOnce(cloth, rulesThatForbidSplitting());

  ASSERT_FALSE(pass.tears.empty());
  EXPECT_EQ(pass.tears[0].kind, TearKind::BASIC);
  EXPECT_EQ(countsOf(cloth.mesh) - before, (Counts{ 1, 2, 0 }));
  EXPECT_FALSE(pass.tears[0].path.valid()) << "only a weak point gives way along a path";
  EXPECT_TRUE(cloth.mesh.spring(springBetween(meshOf(wheel(8)), 0, 3)).border());
  EXPECT_TRUE(cloth.mesh.spring(springBetween(meshOf(wheel(8)), 0, 7)).border());
  EXPECT_TRUE(isSound(cloth.mesh));
}

TEST(Floor, DetachesSoundClothAlongOneSpringAtABorder)
{
  Cloth cloth = clothOf(openFan({ 0, 90, 180, 270 }));
  pullOut(cloth, 2, 1.6);
  pullOut(cloth, 4, 1.2);
  const Counts before = countsOf(cloth.mesh);

  const Pass pass = tearOnce(cloth, rulesThatForbidSplitting());

  ASSERT_FALSE(pass.tears.empty());
  EXPECT_EQ(countsOf(cloth.mesh) - before, (Counts{ 1, 1, 0 }));
  EXPECT_EQ(pass.tears[0].threshold, 0.5);
  EXPECT_TRUE(isSound(cloth.mesh));
}

TEST(Floor, ReleasesASpringThatCannotBeDetachedAndReportsItOnce)
{
  Cloth cloth = kites(1);
  stretchKite(cloth, 0, 1.6);
  const SpringId s = sharedSpring(cloth, 0);
  const Counts before = countsOf(cloth.mesh);

  const Pass pass = tearOnce(cloth, rulesThatForbidSplitting());

  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_EQ(pass.tears[0].kind, TearKind::RELEASED);
  EXPECT_EQ(pass.tears[0].spring, s);
  EXPECT_TRUE(pass.tears[0].particles.empty());
  EXPECT_NEAR(pass.tears[0].strain, 0.6, 1e-6);
  EXPECT_EQ(pass.tears[0].pieces, 1);
  EXPECT_TRUE(cloth.damage.released[s.index]);
  EXPECT_FALSE(cloth.springs.structural[s.index].active());
  EXPECT_EQ(countsOf(cloth.mesh) - before, Counts{});
  EXPECT_EQ(cloth.damage.tears, 1u);
  EXPECT_TRUE(tearOnce(cloth, rulesThatForbidSplitting()).tears.empty());
}

TEST(Floor, LetsNoSpringBeginBesideAReleasedOne)
{
  Cloth cloth = kites(1);
  stretchKite(cloth, 0, 1.6);
  cloth.release(springBetween(cloth.mesh, 0, 2));
  const Counts before = countsOf(cloth.mesh);

  const Pass pass = tearOnce(cloth, rulesOfTheThesis());

  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_EQ(pass.tears[0].kind, TearKind::RELEASED);
  EXPECT_EQ(pass.tears[0].spring, sharedSpring(cloth, 0));
  EXPECT_EQ(countsOf(cloth.mesh), before);
}

TEST(Floor, KeepsEverySpringAndTriangleAboveIt)
{
  const TearRules rules = rulesWithFloor();
  for (const RectanglePattern pattern : ALL_PATTERNS)
  {
    Cloth cloth = clothOf(sheet(8, 8, pattern));
    for (int step = 0; step < 60; ++step)
    {
      for (auto position : cloth.state.position)
      {
        position *= Real(1.05);
      }
      tearOnce(cloth, rules);
    }

    for (int i = 0; i < cloth.mesh.triangleCount(); ++i)
    {
      const auto& springs = cloth.mesh.triangle({ i }).springs;
      double longest = 0.0;
      for (SpringId s : springs)
      {
        longest = std::max(longest, cloth.rest.length[s.index]);
        EXPECT_GE(cloth.rest.length[s.index], 0.4 * cloth.rest.spacing[i] * (1 - 1e-9));
      }
      EXPECT_GE(2 * cloth.rest.area[i] / longest, 0.2 * cloth.rest.spacing[i] * (1 - 1e-9));
    }
  }
}

// -- pins and grasps -----------------------------------------------------------------------------

TEST(Pin, IsNotWeakenedByATearThatEndsThere)
{
  Cloth across = clothOf(sheet(6, 6, RectanglePattern::ONE_DIAGONAL));
  const SpringId s = springBetween(across.mesh, 14, 15);
  const ParticleId tip = across.mesh.opposite(s, 0);
  across.attach(tip, { Attachment::Kind::PIN, 0 });
  across.rest.length[s.index] *= 0.6;

  ASSERT_EQ(tearOnce(across, rulesOfTheThesis()).tears.size(), 1u);

  EXPECT_FALSE(across.damage.weak[tip.index]);
}

TEST(Pin, IsNeverDoubledAtAOnePointConnection)
{
  Cloth cloth = clothOf(bowTie(2, 2), { 0 });
  pullOut(cloth, 5, 1.4);

  EXPECT_TRUE(tearOnce(cloth, rulesOfTheThesis()).tears.empty());

  pullOut(cloth, 5, 1.6 / 1.4);
  const Pass pass = tearOnce(cloth, rulesOfTheThesis());
  ASSERT_FALSE(pass.tears.empty());
  EXPECT_EQ(pass.tears[0].kind, TearKind::BASIC) << "the load moves on to the cloth";
  EXPECT_EQ(cloth.mesh.fanCount({ 0 }), 2);
}

TEST(Pin, IsNeverDoubledOrWeakenedWhateverTears)
{
  const TearRules rules = rulesWithFloor();
  for (const RectanglePattern pattern : ALL_PATTERNS)
  {
    const std::vector<int> pins = { 0, 3, 7, 18, 27, 36, 45 };
    Cloth cloth = clothOf(sheet(8, 8, pattern), pins);
    int tears = 0;
    for (int step = 0; step < 60; ++step)
    {
      for (int i = 0; i < cloth.state.size(); ++i)
      {
        cloth.state.position[i] *= Real(cloth.attachments[i].held() ? 1 : 1.05);
      }
      for (const TearEvent& tear : tearOnce(cloth, rules).tears)
      {
        ++tears;
        for (const auto& added : tear.particles)
        {
          const bool doubled = added.parents[0] == added.parents[1] &&
                               cloth.attachments[added.parents[0].index].pinned();
          EXPECT_FALSE(doubled) << "pin " << added.parents[0].index;
        }
      }
    }
    EXPECT_GT(tears, 100);
    for (int pin : pins)
    {
      EXPECT_TRUE(cloth.attachments[pin].pinned());
      EXPECT_FALSE(cloth.damage.weak[pin]);
      EXPECT_EQ(cloth.state.inverse_mass[pin], Real(0));
    }
  }
}

TEST(Grasp, KeepsTheCopyOnItsOwnSide)
{
  Cloth cloth = clothOf(bowTie(2, 2));
  std::vector<Grasp> grasps = { graspOf(3, { 0, 4, 6 }, cloth) };  // the second fan
  pullOut(cloth, 5, 1.3);                                          // and it is pulled
  Tearing tearing(rulesOfTheThesis());

  const Pass pass = tearOnce(cloth, tearing, grasps);

  ASSERT_EQ(pass.tears.size(), 1u);
  const ParticleId copy = pass.tears[0].particles[0].id;
  EXPECT_TRUE(holds(grasps[0], copy));
  EXPECT_FALSE(holds(grasps[0], { 0 }));
  EXPECT_EQ(grasps[0].held.size(), 3u);
  EXPECT_EQ(cloth.attachments[copy.index].grasp, 3u);
  EXPECT_EQ(cloth.state.inverse_mass[copy.index], Real(0));
  EXPECT_FALSE(cloth.attachments[0].held());
  EXPECT_GT(cloth.state.inverse_mass[0], Real(0));
}

TEST(Grasp, KeepsTheOriginalWhereItHoldsTheOtherSide)
{
  Cloth cloth = clothOf(bowTie(2, 2));
  std::vector<Grasp> grasps = { graspOf(3, { 0, 1, 2 }, cloth) };  // the first fan
  pullOut(cloth, 5, 1.3);
  Tearing tearing(rulesOfTheThesis());

  const Pass pass = tearOnce(cloth, tearing, grasps);

  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_TRUE(holds(grasps[0], { 0 }));
  EXPECT_TRUE(cloth.attachments[0].held());
  EXPECT_FALSE(cloth.attachments[pass.tears[0].particles[0].id.index].held());
}

TEST(Grasp, KeepsTheSideThatThePullDoesNotTakeAwayWhereItHoldsNoOtherParticle)
{
  Cloth cloth = clothOf(bowTie(2, 2));
  std::vector<Grasp> grasps = { graspOf(3, { 0 }, cloth) };
  pullOut(cloth, 2, 1.3);  // the first fan is pulled away
  Tearing tearing(rulesOfTheThesis());

  const Pass pass = tearOnce(cloth, tearing, grasps);

  ASSERT_EQ(pass.tears.size(), 1u);
  const ParticleId copy = pass.tears[0].particles[0].id;
  EXPECT_TRUE(cloth.mesh.spring(pass.tears[0].spring).joins(copy));
  EXPECT_TRUE(holds(grasps[0], { 0 })) << "with the second fan";
}

TEST(Grasp, KeepsTheSideOfAnyNeighbourThatItHolds)
{
  for (int neighbour : { 4, 5, 6 })  // the second fan, from border to border
  {
    Cloth cloth = clothOf(bowTie(2, 2));
    std::vector<Grasp> grasps = { graspOf(3, { 0, neighbour }, cloth) };
    pullOut(cloth, 5, 1.3);
    Tearing tearing(rulesOfTheThesis());

    const Pass pass = tearOnce(cloth, tearing, grasps);

    ASSERT_EQ(pass.tears.size(), 1u);
    EXPECT_TRUE(holds(grasps[0], pass.tears[0].particles[0].id)) << "neighbour " << neighbour;
    EXPECT_FALSE(holds(grasps[0], { 0 })) << "neighbour " << neighbour;
  }
}

TEST(Grasp, KeepsBothSidesOfATearThroughItsPatch)
{
  Cloth cloth = clothOf(bowTie(2, 2));
  std::vector<Grasp> grasps = { graspOf(3, { 0, 1, 3, 5 }, cloth) };
  pullOut(cloth, 2, 1.3);
  Tearing tearing(rulesOfTheThesis());

  const Pass pass = tearOnce(cloth, tearing, grasps);

  ASSERT_EQ(pass.tears.size(), 1u);
  const ParticleId copy = pass.tears[0].particles[0].id;
  EXPECT_TRUE(holds(grasps[0], copy));
  EXPECT_TRUE(holds(grasps[0], { 0 }));
  EXPECT_EQ(grasps[0].held.size(), 5u);
  EXPECT_EQ(grasps[0].held.back().offset, grasps[0].held.front().offset);
  EXPECT_EQ(cloth.attachments[copy.index].grasp, 3u);
  EXPECT_EQ(cloth.state.inverse_mass[copy.index], Real(0));
}

TEST(Grasp, OfOneGripperTakesNothingFromAnother)
{
  Cloth cloth = clothOf(bowTie(2, 2));
  std::vector<Grasp> grasps = { graspOf(3, { 0, 4, 6 }, cloth), graspOf(4, { 1, 2, 3 }, cloth) };
  pullOut(cloth, 5, 1.3);
  Tearing tearing(rulesOfTheThesis());

  const Pass pass = tearOnce(cloth, tearing, grasps);

  ASSERT_EQ(pass.tears.size(), 1u);
  EXPECT_TRUE(holds(grasps[0], pass.tears[0].particles[0].id));
  EXPECT_EQ(grasps[1].held.size(), 3u);
  EXPECT_EQ(cloth.attachments[1].grasp, 4u);
}

// -- to the end ----------------------------------------------------------------------------------

/// Drives the particles apart, 2 % a step, until nothing tears any more.
/// @return whether it came to that, and tore at all
testing::AssertionResult endsWhenDrivenApart(Cloth& cloth, std::vector<Grasp>& grasps,
                                             const TearRules& rules)
{
  constexpr int LONG_QUIET = 60;  // steps: by then strains have more than doubled
  Tearing tearing(rules);
  std::size_t tears = 0;
  int quiet = 0;
  for (int step = 0; step < 2000; ++step)
  {
    for (auto position : cloth.state.position)
    {
      position *= Real(1.02);
    }
    const Pass pass = tearOnce(cloth, tearing, grasps);
    tears += pass.tears.size();
    quiet = pass.tears.empty() && pass.postponed == 0 ? quiet + 1 : 0;
    if (quiet == LONG_QUIET)
    {
      return tears > 50 ? testing::AssertionSuccess()
                        : testing::AssertionFailure() << "only " << tears << " tears";
    }
  }
  return testing::AssertionFailure() << "still tearing after " << tears << " tears";
}

TEST(Tearing, ComesToAnEndHoweverFarTheClothIsDrivenApart)
{
  const TearRules rules = rulesWithFloor();
  for (const RectanglePattern pattern : ALL_PATTERNS)
  {
    Cloth cloth = clothOf(sheet(8, 8, pattern));
    const double mass = sumOf(cloth.rest.mass);
    std::vector<Grasp> grasps;

    EXPECT_TRUE(endsWhenDrivenApart(cloth, grasps, rules));

    EXPECT_TRUE(isSound(cloth.mesh));
    EXPECT_NEAR(uvArea(cloth.mesh), 1.0, 1e-12);
    EXPECT_NEAR(sumOf(cloth.rest.mass), mass, 1e-12);
    EXPECT_EQ(cloth.damage.pieces, countPieces(cloth.mesh));
    EXPECT_GT(cloth.damage.pieces, 20);
    expectAllFinite(cloth);
  }
}

TEST(Tearing, EndsWhereEveryParticleIsPinned)
{
  const ClothModel model = sheet(6, 6, RectanglePattern::ALTERNATING);
  std::vector<int> all;
  for (std::size_t i = 0; i < model.positions.size(); ++i)
  {
    all.push_back(static_cast<int>(i));
  }
  Cloth cloth = clothOf(model, all);
  std::vector<Grasp> grasps;

  EXPECT_TRUE(endsWhenDrivenApart(cloth, grasps, rulesWithFloor()));

  EXPECT_TRUE(isSound(cloth.mesh));
  expectAllFinite(cloth);
  for (int i : all)
  {
    EXPECT_TRUE(cloth.attachments[i].pinned());
    EXPECT_FALSE(cloth.damage.weak[i]);
  }
}

TEST(Tearing, EndsWhereEveryParticleIsGrasped)
{
  const ClothModel model = sheet(6, 6, RectanglePattern::IRREGULAR);
  Cloth cloth = clothOf(model);
  std::vector<int> left;
  std::vector<int> right;
  for (std::size_t i = 0; i < model.positions.size(); ++i)
  {
    (model.positions[i].x() < 0 ? left : right).push_back(static_cast<int>(i));
  }
  std::vector<Grasp> grasps = { graspOf(1, left, cloth), graspOf(2, right, cloth) };

  EXPECT_TRUE(endsWhenDrivenApart(cloth, grasps, rulesWithFloor()));

  EXPECT_TRUE(isSound(cloth.mesh));
  expectAllFinite(cloth);
  EXPECT_GE(grasps[0].held.size(), left.size());
  EXPECT_GE(grasps[1].held.size(), right.size());
  for (const Grasp& grasp : grasps)
  {
    for (const Grasp::Held& held : grasp.held)
    {
      EXPECT_EQ(cloth.attachments[held.particle.index].grasp, grasp.id);
    }
  }
}

TEST(Tearing, TearsTheSameClothTwiceTheSameWay)
{
  std::array<Cloth, 2> cloths = { clothOf(sheet(9, 9, RectanglePattern::IRREGULAR)),
                                  clothOf(sheet(9, 9, RectanglePattern::IRREGULAR)) };
  std::vector<Grasp> grasps;
  for (Cloth& cloth : cloths)
  {
    ASSERT_TRUE(endsWhenDrivenApart(cloth, grasps, rulesWithFloor()));
  }

  EXPECT_TRUE(isSame(cloths[0].mesh, cloths[1].mesh));
  for (int i = 0; i < cloths[0].state.size(); ++i)
  {
    ASSERT_EQ(cloths[0].state.position[i], cloths[1].state.position[i]);
  }
}

TEST(Tearing, LeavesTheTextureOfEveryPieceWhereItWas)
{
  // At rest the sheet is its texture: a rest length is the length on the texture, torn or not.
  Cloth cloth = clothOf(sheet(8, 8, RectanglePattern::IRREGULAR));
  std::vector<Grasp> grasps;
  ASSERT_TRUE(endsWhenDrivenApart(cloth, grasps, rulesWithFloor()));

  for (int i = 0; i < cloth.mesh.triangleCount(); ++i)
  {
    const Triangle& t = cloth.mesh.triangle({ i });
    EXPECT_GT(uvArea(t), 0.0);
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_NEAR((t.uv[(k + 1) % 3] - t.uv[k]).norm(), cloth.rest.length[t.springs[k].index],
                  1e-9);
    }
  }
}

TEST(TearRules, AreHeldAgainstATearStrainOnlyIfThatIsOne)
{
  TearRules rules;
  rules.tear_strain = 0.1;
  rules.weak_tear_strain = 0.2;
  rules.one_point_tear_strain = 0.3;
  EXPECT_EQ(problems(rules).size(), 2u);
  for (const double none : { std::nan(""), -1.0, 0.0, 101.0 })
  {
    rules.tear_strain = none;
    const std::vector<std::string> found = problems(rules);
    ASSERT_EQ(found.size(), 1u) << none;
    EXPECT_EQ(found[0].find("tear_strain [-] is "), 0u) << found[0];
  }
  rules.weak_tear_strain = std::nan("");
  EXPECT_EQ(problems(rules).size(), 2u) << "which is wrong by itself";
}

}  // namespace
}  // namespace cloth
