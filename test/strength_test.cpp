// Claims of strength scatter and strength maps: where cloth is weak it tears, and repeatably.
#include "cloth_tearing/core/strength.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <set>

#include "cloth_tearing/core/refusal.h"
#include "scenes.h"

namespace cloth
{
namespace
{

Mesh meshOf(const ClothModel& model)
{
  return { static_cast<int>(model.positions.size()), model.triangles };
}

std::vector<double> strengthsOf(const ClothModel& model, const StrengthParams& params)
{
  return springStrengths(meshOf(model), model.positions, params);
}

StrengthParams scattered(double scatter, std::uint64_t seed)
{
  StrengthParams params;
  params.scatter = scatter;
  params.seed = seed;
  return params;
}

/// The springs whose strength is not 1, by the numbers of their ends.
std::set<std::set<int>> varied(const ClothModel& model, const StrengthParams& params)
{
  const Mesh mesh = meshOf(model);
  const std::vector<double> strengths = springStrengths(mesh, model.positions, params);
  std::set<std::set<int>> ends;
  for (int i = 0; i < mesh.springCount(); ++i)
  {
    if (strengths[i] != 1.0)
    {
      const auto& particles = mesh.spring({ i }).particles;
      ends.insert({ particles[0].index, particles[1].index });
    }
  }
  return ends;
}

std::string refusalOf(const ClothModel& model, const StrengthParams& params)
{
  try
  {
    strengthsOf(model, params);
  }
  catch (const Refusal& refusal)
  {
    return refusal.what();
  }
  return "";
}

// -- scatter -------------------------------------------------------------------------------------

TEST(Scatter, IsBoundedHasMeanOneAndTheSpreadOfATriangle)
{
  const std::vector<double> strengths = strengthsOf(sheet(1.0, 1.0, 60, 60), scattered(0.3, 5));

  double sum = 0.0;
  double squares = 0.0;
  for (double strength : strengths)
  {
    EXPECT_GE(strength, 0.7);
    EXPECT_LE(strength, 1.3);
    sum += strength;
    squares += (strength - 1.0) * (strength - 1.0);
  }
  const auto count = static_cast<double>(strengths.size());
  ASSERT_GT(count, 10000.0);
  EXPECT_NEAR(sum / count, 1.0, 0.005);
  EXPECT_NEAR(std::sqrt(squares / count), 0.3 / std::sqrt(6.0), 0.005);
}

TEST(Scatter, IsRareNearItsEndsSoThatTheWeakestDependsLittleOnTheMesh)
{
  const std::vector<double> strengths = strengthsOf(sheet(1.0, 1.0, 60, 60), scattered(0.5, 1));

  const auto near_end = std::count_if(strengths.begin(), strengths.end(),
                                      [](double strength) { return strength < 0.55; });
  EXPECT_LT(near_end, static_cast<int>(strengths.size()) / 100);  // flat: 5 %; triangular: 0.5 %
  EXPECT_GT(near_end, 0);
}

TEST(Scatter, IsTheSameForTheSameSeedAndAnotherForAnother)
{
  const ClothModel model = sheet(1.0, 1.0, 10, 10);

  EXPECT_EQ(strengthsOf(model, scattered(0.2, 7)), strengthsOf(model, scattered(0.2, 7)));
  EXPECT_NE(strengthsOf(model, scattered(0.2, 7)), strengthsOf(model, scattered(0.2, 8)));
}

/// The standard fixes what the generator gives, but not what its distributions make of it.
TEST(Scatter, IsDrawnByOurOwnMapping)
{
  std::mt19937_64 random(5489);
  const double first = std::ldexp(static_cast<double>(random() >> 11), -53);
  const double second = std::ldexp(static_cast<double>(random() >> 11), -53);

  const std::vector<double> strengths = strengthsOf(sheet(1.0, 1.0, 3, 3), scattered(0.25, 5489));

  EXPECT_EQ(strengths[0], 1.0 + 0.25 * (first + second - 1.0));
}

TEST(Scatter, OfNoneLeavesEverySpringAsItIs)
{
  EXPECT_EQ(strengthsOf(sheet(1.0, 1.0, 4, 4), scattered(0.0, 9)),
            std::vector<double>(meshOf(sheet(1.0, 1.0, 4, 4)).springCount(), 1.0));
}

// -- map -----------------------------------------------------------------------------------------

// 4 x 3 particles, spacing 1, diagonals 1-4, 1-6, 3-6, 4-9, 6-9, 6-11.
//
//   0  1  2  3    y =  0, x from -1.5 to 1.5
//   4  5  6  7    y = -1
//   8  9 10 11    y = -2
const ClothModel MODEL = sheet(3.0, 2.0, 4, 3);

using Springs = std::set<std::set<int>>;

TEST(StrengthSpot, HoldsEverySpringThatItTouches)
{
  StrengthParams params;
  params.spots = { { Vec3d(-1.5, -0.5, 0.0), 0.1, 0.5 } };
  EXPECT_EQ(varied(MODEL, params), (Springs{ { 0, 4 } }));

  params.spots = { { Vec3d(1.5, 0.0, 0.0), 0.1, 0.5 } };
  EXPECT_EQ(varied(MODEL, params), (Springs{ { 2, 3 }, { 3, 6 }, { 3, 7 } }));
}

TEST(StrengthLine, HoldsTheSpringsThatCrossItAndThoseWithinHalfItsWidth)
{
  StrengthParams params;
  params.lines = { { Vec3d(-1.5, -0.5, 0.0), Vec3d(-0.75, -0.5, 0.0), 0.1, 0.5 } };
  EXPECT_EQ(varied(MODEL, params), (Springs{ { 0, 4 }, { 1, 4 } }));

  params.lines[0].width = 1.0;  // just reaches the springs above and below, and the one at its end
  params.lines[0].to.x() = -1.0;
  EXPECT_EQ(varied(MODEL, params).count({ 0, 1 }), 1u);
  EXPECT_EQ(varied(MODEL, params).count({ 4, 5 }), 1u);
  EXPECT_EQ(varied(MODEL, params).count({ 1, 5 }), 1u);
  EXPECT_EQ(varied(MODEL, params).count({ 2, 6 }), 0u);
}

TEST(StrengthLine, PassesOverAndUnderWithoutTouching)
{
  StrengthParams params;
  params.lines = { { Vec3d(-1.5, -0.5, 0.2), Vec3d(1.5, -0.5, 0.2), 0.39, 0.5 } };
  EXPECT_NE(refusalOf(MODEL, params).find("lines[0] touches no spring"), std::string::npos);

  params.lines[0].width = 0.41;
  EXPECT_EQ(refusalOf(MODEL, params), "");
}

TEST(StrengthPerforation, WeakensItsDashesAndLeavesItsBridges)
{
  StrengthParams params;
  params.perforations = {
    { { Vec3d(-1.75, -0.5, 0.0), Vec3d(2.25, -0.5, 0.0), 0.1, 0.5 }, 2.0, 0.5 }
  };

  // Dashes from -1.75 to -0.75 and from 0.25 to 1.25.
  EXPECT_EQ(varied(MODEL, params), (Springs{ { 0, 4 }, { 1, 4 }, { 2, 6 }, { 3, 6 } }));
}

TEST(StrengthPerforation, BeginsWithADashAndEndsWithABridge)
{
  StrengthParams params;
  params.perforations = {
    { { Vec3d(-1.5, -0.5, 0.0), Vec3d(1.5, -0.5, 0.0), 0.1, 0.5 }, 1.0, 0.4 }
  };

  const Springs weak = varied(MODEL, params);

  EXPECT_EQ(weak.count({ 0, 4 }), 1u) << "its middle is where the line begins";
  EXPECT_EQ(weak.count({ 3, 7 }), 0u) << "its middle is where the line ends";
}

TEST(StrengthPerforation, OfDutyOneIsALine)
{
  StrengthParams line;
  line.lines = { { Vec3d(-1.5, -0.5, 0.0), Vec3d(1.5, -0.5, 0.0), 0.1, 0.5 } };
  StrengthParams perforation;
  perforation.perforations = { { line.lines[0], 0.3, 1.0 } };

  EXPECT_EQ(strengthsOf(MODEL, line), strengthsOf(MODEL, perforation));
}

TEST(StrengthMap, IsTheSameHoweverTheModelIsTurned)
{
  StrengthParams params;
  params.spots = { { Vec3d(0.5, -1.0, 0.0), 1.0, 2.0 } };
  params.lines = { { Vec3d(-1.5, -1.0, 0.0), Vec3d(1.5, -1.0, 0.0), 2.0, 0.5 } };
  params.perforations = {
    { { Vec3d(-1.5, -0.5, 0.0), Vec3d(1.5, -0.5, 0.0), 1.0, 0.7 }, 1.0, 0.5 }
  };
  Quatd rotation(0.3, -0.5, 0.7, 0.2);
  rotation.normalize();
  ClothModel model = MODEL;
  for (Vec3d& x : model.positions)
  {
    x = rotation * x;
  }

  EXPECT_EQ(strengthsOf(model, turned(params, rotation)), strengthsOf(MODEL, params));
}

TEST(StrengthMap, MultipliesWhatMeetsAndStaysWithinBounds)
{
  const StrengthParams::Spot everywhere{ Vec3d::Zero(), 10.0, 0.5 };
  StrengthParams params;
  params.spots = { everywhere, everywhere };
  EXPECT_EQ(strengthsOf(MODEL, params)[0], 0.25);

  params.spots.resize(20, everywhere);
  EXPECT_EQ(strengthsOf(MODEL, params)[0], LEAST_STRENGTH);

  params.spots.assign(4, { Vec3d::Zero(), 10.0, 10.0 });
  EXPECT_EQ(strengthsOf(MODEL, params)[0], MOST_STRENGTH);
}

TEST(StrengthBorder, HemsTheSpringsNearAllBorders)
{
  const ClothModel model = sheet(4.0, 4.0, 5, 5);  // 12 is the particle in the middle
  StrengthParams params;
  params.border_factor = 3.0;

  params.border_width = 0.5;
  for (const auto& ends : varied(model, params))
  {
    EXPECT_EQ(std::count_if(ends.begin(), ends.end(),
                            [](int p) { return p % 5 == 0 || p % 5 == 4 || p < 5 || p >= 20; }) > 0,
              true);
  }
  EXPECT_EQ(varied(model, params).count({ 11, 12 }), 0u);
  EXPECT_EQ(varied(model, params).count({ 10, 11 }), 1u);

  params.border_width = 1.0;
  EXPECT_EQ(varied(model, params).count({ 11, 12 }), 1u);

  params.border_width = 0.0;
  EXPECT_TRUE(varied(model, params).empty());
}

TEST(StrengthMap, RefusesWhatTouchesNothingAndNamesAllOfIt)
{
  StrengthParams params;
  params.spots = { { Vec3d(0.0, -1.0, 0.0), 1.0, 0.5 }, { Vec3d(-1.2, -0.3, 0.0), 0.01, 0.5 } };
  params.lines = { { Vec3d(5.0, 0.0, 0.0), Vec3d(6.0, 0.0, 0.0), 1.0, 2.0 } };
  params.perforations = { { { Vec3d(-1.5, 0.0, 9.0), Vec3d(1.5, 0.0, 9.0), 0.5, 0.5 }, 0.1, 0.5 } };

  const std::string refusal = refusalOf(MODEL, params);

  EXPECT_EQ(refusal.find("spots[0]"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("spots[1] touches no spring"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("lines[0] touches no spring"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("perforations[0] touches no spring"), std::string::npos) << refusal;
}

TEST(StrengthParams, AreRefusedByFieldValueAndLimit)
{
  StrengthParams good;
  good.spots = { { Vec3d::Zero(), 0.1, 0.5 } };
  good.lines = { { Vec3d::Zero(), Vec3d(1.0, 0.0, 0.0), 0.1, 2.0 } };
  good.perforations = { { good.lines[0], 0.02, 0.5 } };
  ASSERT_TRUE(problems(good).empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Case
  {
    std::function<void(StrengthParams&)> spoil;
    std::string expected;
  };
  const std::vector<Case> cases = {
    { [](StrengthParams& p) { p.scatter = 0.95; }, "scatter [-] is 0.95, must be" },
    { [](StrengthParams& p) { p.scatter = -0.1; }, "scatter [-] is -0.1, must be at least 0" },
    { [=](StrengthParams& p) { p.scatter = nan; }, "scatter [-] is " },
    { [=](StrengthParams& p) { p.spots[0].center.y() = nan; }, "spots[0] center [m].y is " },
    { [](StrengthParams& p) { p.spots[0].radius = 0.0; }, "spots[0] radius [m] is 0, must" },
    { [](StrengthParams& p) { p.spots[0].factor = 0.0; },
      "spots[0] factor [-] is 0, must be at least 0.05 and at most 20" },
    { [](StrengthParams& p) { p.lines[0].from.x() = 2000.0; }, "lines[0] begin [m].x is 2000" },
    { [](StrengthParams& p) { p.lines[0].to = p.lines[0].from; }, "lines[0] begins and ends at" },
    { [](StrengthParams& p) { p.lines[0].width = -1.0; }, "lines[0] width [m] is -1" },
    { [](StrengthParams& p) { p.lines[0].factor = 21.0; }, "lines[0] factor [-] is 21" },
    { [](StrengthParams& p) { p.perforations[0].line.width = 0.0; },
      "perforations[0] width [m] is 0" },
    { [](StrengthParams& p) { p.perforations[0].pitch = 0.0; }, "perforations[0] pitch [m] is 0" },
    { [](StrengthParams& p) { p.perforations[0].duty = 1.1; }, "perforations[0] duty [-] is 1.1" },
    { [](StrengthParams& p) { p.spots.resize(1001, p.spots[0]); },
      "spots has 1001 entries, must be at most 1000" },
    { [](StrengthParams& p) { p.border_factor = 0.0; }, "border_factor [-] is 0" },
    { [](StrengthParams& p) { p.border_width = -0.1; }, "border_width [m] is -0.1" },
  };
  for (const Case& c : cases)
  {
    StrengthParams params = good;
    c.spoil(params);

    const std::vector<std::string> found = problems(params);

    ASSERT_EQ(found.size(), 1u) << c.expected;
    EXPECT_NE(found[0].find(c.expected), std::string::npos) << found[0];
    SimulationParams simulation = tearable();
    simulation.strength = params;
    EXPECT_THROW(Simulation(MODEL, {}, simulation), Refusal) << c.expected;
  }
}

// -- after a tear --------------------------------------------------------------------------------

/// A sheet whose springs all differ in strength.
Cloth variedSheet()
{
  return makeCloth(sheet(1.0, 1.0, 5, 5), {}, cotton(), RestShapeSource::IMPORTED, 0.0,
                   scattered(0.9, 3));
}

/// The first spring with (without) two triangles.
SpringId springOf(const Mesh& mesh, bool border)
{
  int i = 0;
  while (mesh.spring({ i }).border() != border)
  {
    ++i;
  }
  return { i };
}

double meanOfSides(const Cloth& cloth, TriangleId t)
{
  double sum = 0.0;
  for (SpringId side : cloth.mesh.triangle(t).springs)
  {
    sum += cloth.damage.strength[side.index];
  }
  return sum / 3.0;
}

TEST(StrengthAfterASplit, IsTheParentsInHalvesAndTheMeanOfTheSidesInTheMiddle)
{
  for (bool border : { false, true })
  {
    Cloth cloth = variedSheet();
    const Cloth before = cloth;
    const SpringId torn = springOf(cloth.mesh, border);

    const Edit edit = cloth.mesh.splitSpring(torn);
    cloth.follow(edit);

    const auto& strength = cloth.damage.strength;
    ASSERT_EQ(strength.size(), static_cast<std::size_t>(cloth.mesh.springCount()));
    ASSERT_EQ(edit.springs.size(), border ? 3u : 5u);
    EXPECT_EQ(strength[edit.springs[0].id.index], before.damage.strength[torn.index]);
    for (std::size_t side = 0; side < edit.triangles.size(); ++side)
    {
      const double mean = meanOfSides(before, edit.triangles[side].parent);
      EXPECT_NEAR(strength[edit.springs[1 + 2 * side].id.index], mean, 1e-15);
      EXPECT_NEAR(strength[edit.springs[2 + 2 * side].id.index], mean, 1e-15);
    }
    for (std::size_t i = 0; i < before.damage.strength.size(); ++i)
    {
      EXPECT_EQ(strength[i], before.damage.strength[i]) << "an old spring";
    }
  }
}

TEST(StrengthAfterADetachment, IsTheParentsInTwins)
{
  Cloth cloth = variedSheet();
  const ParticleId middle{ 12 };
  const Fan fan = cloth.mesh.fans(middle)[0];
  ASSERT_TRUE(fan.closed);
  const auto expectTwins = [&](const Edit& edit, std::size_t count)
  {
    cloth.follow(edit);
    ASSERT_EQ(edit.springs.size(), count);
    ASSERT_EQ(cloth.damage.strength.size(), static_cast<std::size_t>(cloth.mesh.springCount()));
    for (const auto& twin : edit.springs)
    {
      EXPECT_EQ(cloth.damage.strength[twin.id.index], cloth.damage.strength[twin.parent.index]);
    }
  };

  expectTwins(cloth.mesh.openAlong(middle, fan.springs[0], fan.springs[3]), 2);

  const ParticleId end = cloth.mesh.spring(fan.springs[0]).other(middle);
  const Fan open = cloth.mesh.fans(end)[0];
  ASSERT_FALSE(open.closed);
  expectTwins(cloth.mesh.detachAlong(end, open.springs[1]), 1);
}

TEST(StrengthAfterAOnePointTear, IsWhatItWas)
{
  ClothModel model;  // two triangles that touch in 0
  model.positions = { Vec3d(0, 0, 0), Vec3d(1, 1, 0), Vec3d(-1, 1, 0), Vec3d(-1, -1, 0),
                      Vec3d(1, -1, 0) };
  const std::array<Vec2d, 3> uv = { Vec2d(0, 0), Vec2d(1, 0), Vec2d(0, 1) };
  model.triangles = { { { 0, 1, 2 }, uv }, { { 0, 3, 4 }, uv } };
  Cloth cloth = makeCloth(model, {}, cotton(), RestShapeSource::IMPORTED, 0.0, scattered(0.9, 3));
  const std::vector<double> before = cloth.damage.strength;

  cloth.follow(cloth.mesh.detachFan({ 0 }, { 1 }));

  EXPECT_EQ(cloth.damage.strength, before);
}

// -- the run -------------------------------------------------------------------------------------

constexpr double WIDTH = 0.24;
constexpr double HEIGHT = 0.6;

/// A strip in the x-y plane, pinned above and pulled down below by as many grippers as are
/// needed to hold all of its lower edge.
Simulation pulledStrip(const StrengthParams& strength, const std::vector<Slit>& slits = {},
                       SolverKind solver = SolverKind::XPBD)
{
  RectangleParams rectangle_params;
  rectangle_params.width = WIDTH;
  rectangle_params.height = HEIGHT;
  rectangle_params.columns = 13;
  rectangle_params.rows = 31;
  rectangle_params.pattern = RectanglePattern::ALTERNATING;
  rectangle_params.slits = slits;
  const ClothModel model = rectangle(rectangle_params);
  SimulationParams params = tearable(solver);
  params.environment.gravity = Vec3d::Zero();
  params.environment.air_friction = 5.0;
  params.strength = strength;
  Simulation simulation(model, edgeOf(model, "top"), params);
  for (int i = 0; i < 13; ++i)
  {
    GraspRequest request;
    request.point = Vec3d((i - 6) * 0.02, -HEIGHT, 0.0);
    request.frame.position = request.point;
    DragTarget target;
    target.pose.position = request.point - Vec3d(0.0, 0.5, 0.0);
    target.linear_speed = 0.1;
    simulation.drag(simulation.grasp(request).id, target);
  }
  return simulation;
}

/// Where on the untorn strip a tear happened [m].
Vec3d restPlace(const TearEvent& tear)
{
  return { (tear.uv.x() - 0.5) * WIDTH, (tear.uv.y() - 1.0) * HEIGHT, 0.0 };
}

/// Steps until there is a tear, for at most so many steps.
TearEvent firstTear(Simulation& simulation, int steps)
{
  for (int i = 0; i < steps; ++i)
  {
    const StepReport report = simulation.step();
    if (!report.tears.empty())
    {
      return report.tears.front();
    }
  }
  ADD_FAILURE() << "nothing tore";
  return {};
}

class StrengthOnBothSolvers : public WithBothSolvers
{
};

TEST_P(StrengthOnBothSolvers, APinholeIsWhereTheFirstTearIs)
{
  for (const Vec3d& place : { Vec3d(0.05, -0.2, 0.0), Vec3d(-0.06, -0.41, 0.0) })
  {
    StrengthParams strength;
    strength.spots = { { place, 0.015, 0.4 } };
    Simulation strip = pulledStrip(strength, {}, GetParam());

    const TearEvent tear = firstTear(strip, 2000);

    EXPECT_LT((restPlace(tear) - place).norm(), 0.015 + 0.02);
    EXPECT_LT(tear.strain, 0.5 * 0.2) << "long before sound cloth would tear";
    EXPECT_NEAR(tear.threshold, 0.4 * 0.2, 1e-12);
  }
}

TEST_P(StrengthOnBothSolvers, APerforationIsWhereAllTearsAre)
{
  StrengthParams strength;
  strength.perforations = {
    { { Vec3d(-0.12, -0.31, 0.0), Vec3d(0.12, -0.31, 0.0), 0.01, 0.35 }, 0.06, 0.67 }
  };
  Simulation strip = pulledStrip(strength, {}, GetParam());

  const std::vector<TearEvent> tears = run(strip, 1800);

  ASSERT_GT(tears.size(), 5u);
  for (const TearEvent& tear : tears)
  {
    EXPECT_NEAR(restPlace(tear).y(), -0.31, 0.03) << "tear " << tear.sequence;
  }
  EXPECT_GE(strip.summary().pieces, 2) << "it comes apart";
}

TEST_P(StrengthOnBothSolvers, ASeamStopsATearThatSoundClothLetsRun)
{
  const std::vector<Slit> notch = { { Vec2d(-0.12, -0.3), Vec2d(-0.06, -0.3) } };
  StrengthParams seam;
  seam.lines = { { Vec3d(0.02, 0.0, 0.0), Vec3d(0.02, -HEIGHT, 0.0), 0.04, 5.0 } };
  Simulation sound = pulledStrip({}, notch, GetParam());
  Simulation seamed = pulledStrip(seam, notch, GetParam());
  const auto tearsInBand = [](Simulation& simulation)
  {
    const std::vector<TearEvent> tears = run(simulation, 2000);
    EXPECT_GT(tears.size(), 5u) << "the tear runs from the slit";
    return std::count_if(tears.begin(), tears.end(),
                         [](const TearEvent& tear)
                         { return std::abs(restPlace(tear).x() - 0.02) <= 0.021; });
  };

  EXPECT_GT(tearsInBand(sound), 0) << "it tears through";
  EXPECT_EQ(tearsInBand(seamed), 0);
}

INSTANTIATE_TEST_SUITE_P(Both, StrengthOnBothSolvers, bothSolvers(), solverName);

TEST(StrengthRun, HasTheSameHashForTheSameSeedAndAnotherForAnother)
{
  const auto hashes = [](std::uint64_t seed)
  {
    Simulation strip = pulledStrip(scattered(0.5, seed));
    std::vector<std::uint64_t> all = { strip.stateHash() };
    run(strip, 1500);
    EXPECT_GT(strip.revision(), 0u);
    all.push_back(strip.stateHash());
    return all;
  };

  const std::vector<std::uint64_t> one = hashes(1);
  EXPECT_EQ(hashes(1), one);
  EXPECT_NE(hashes(2)[0], one[0]) << "before anything moved";
  EXPECT_NE(hashes(2)[1], one[1]);
}

TEST(StrengthRun, IsBackAsBuiltAfterAReset)
{
  Simulation strip = pulledStrip(scattered(0.5, 1));
  const std::vector<double> built = strip.cloth().damage.strength;
  run(strip, 1500);
  ASSERT_GT(strip.revision(), 0u);

  strip.reset();

  EXPECT_EQ(strip.cloth().damage.strength, built);
}

/// With every factor the same power of two, thresholds and readings are exactly those of rules that
/// were scaled: all three kinds of tear, and the springs that are looked at, count the factor.
TEST(StrengthRun, OfOneFactorEverywhereIsThatOfScaledRules)
{
  const double factor = 0.5;
  StrengthParams everywhere;
  everywhere.spots = { { Vec3d::Zero(), 10.0, factor } };
  Simulation by_map = pulledStrip(everywhere);
  Simulation by_rules = pulledStrip({});
  TearRules rules = by_rules.params().tearing;
  rules.tear_strain *= factor;
  rules.weak_tear_strain *= factor;
  rules.one_point_tear_strain *= factor;
  by_rules.setTearRules(rules);

  const std::vector<TearEvent> tears = run(by_map, 1500);
  const std::vector<TearEvent> same = run(by_rules, 1500);

  std::set<TearKind> kinds;
  ASSERT_EQ(tears.size(), same.size());
  for (std::size_t i = 0; i < tears.size(); ++i)
  {
    kinds.insert(tears[i].kind);
    EXPECT_EQ(tears[i].step, same[i].step);
    EXPECT_EQ(tears[i].threshold, same[i].threshold);
    EXPECT_EQ(tears[i].position, same[i].position);
  }
  EXPECT_EQ(by_map.cloth().state.position, by_rules.cloth().state.position);
  for (TearKind kind : { TearKind::BASIC, TearKind::WEAK_POINT, TearKind::ONE_POINT })
  {
    EXPECT_EQ(kinds.count(kind), 1u) << "no tear of kind " << static_cast<int>(kind);
  }
}

}  // namespace
}  // namespace cloth
