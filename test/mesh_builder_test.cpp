// Claims of the rectangle builder: counts, places, texture, patterns, slits and refusals.
#include "cloth_tearing/core/mesh_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <set>
#include <stdexcept>

#include "cloth_tearing/core/mesh.h"

namespace cloth
{
namespace
{

const RectanglePattern ALL_PATTERNS[] = { RectanglePattern::ONE_DIAGONAL,
                                          RectanglePattern::ALTERNATING,
                                          RectanglePattern::IRREGULAR };

RectangleParams sheet(int columns, int rows,
                      RectanglePattern pattern = RectanglePattern::ONE_DIAGONAL)
{
  RectangleParams params;
  params.columns = columns;
  params.rows = rows;
  params.pattern = pattern;
  return params;
}

// 5 x 5 particles a metre apart: x from -2 to 2, y from -4 to 0.
//
//   0  1  2  3  4     y =  0
//   5  6  7  8  9
//  10 11 12 13 14     y = -2
//  15 16 17 18 19
//  20 21 22 23 24     y = -4
RectangleParams metreSheet()
{
  RectangleParams params = sheet(5, 5);
  params.width = 4;
  params.height = 4;
  return params;
}

RectangleParams slitSheet(std::initializer_list<Slit> slits)
{
  RectangleParams params = metreSheet();
  params.slits = slits;
  return params;
}

Mesh meshOf(const ClothModel& model)
{
  return Mesh(static_cast<int>(model.positions.size()), model.triangles);
}

int borderSprings(const Mesh& mesh)
{
  int count = 0;
  for (int s = 0; s < mesh.springCount(); ++s)
  {
    count += mesh.spring(SpringId{ s }).border() ? 1 : 0;
  }
  return count;
}

int pieces(const ClothModel& model)
{
  std::vector<int> piece(model.positions.size());
  for (std::size_t i = 0; i < piece.size(); ++i)
  {
    piece[i] = static_cast<int>(i);
  }
  for (std::size_t pass = 0; pass < piece.size(); ++pass)
  {
    for (const ModelTriangle& t : model.triangles)
    {
      const int least =
          std::min({ piece[t.vertices[0]], piece[t.vertices[1]], piece[t.vertices[2]] });
      for (const int v : t.vertices)
      {
        piece[v] = least;
      }
    }
  }
  return static_cast<int>(std::set<int>(piece.begin(), piece.end()).size());
}

double uvArea(const ClothModel& model)
{
  double area = 0;
  for (const ModelTriangle& t : model.triangles)
  {
    const Vec2d u = t.uv[1] - t.uv[0];
    const Vec2d v = t.uv[2] - t.uv[0];
    area += (u.x() * v.y() - u.y() * v.x()) / 2;
  }
  return area;
}

double smallestAngle(const ClothModel& model)  // [degrees]
{
  double least = 180;
  for (const ModelTriangle& t : model.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Vec3d u = model.positions[t.vertices[(k + 1) % 3]] - model.positions[t.vertices[k]];
      const Vec3d v = model.positions[t.vertices[(k + 2) % 3]] - model.positions[t.vertices[k]];
      least = std::min(least, std::atan2(u.cross(v).z(), u.dot(v)) * 180 / M_PI);
    }
  }
  return least;
}

// |mean exp(i n angle)| over inner springs: 0 if no direction is preferred, 1 if there is but one
// (n = 2), or but two at right angles (n = 4).
double directionBias(const ClothModel& model, double n)
{
  const Mesh mesh = meshOf(model);
  std::complex<double> sum = 0;
  int count = 0;
  for (int s = 0; s < mesh.springCount(); ++s)
  {
    const Spring& spring = mesh.spring(SpringId{ s });
    if (!spring.border())
    {
      const Vec3d d =
          model.positions[spring.particles[1].index] - model.positions[spring.particles[0].index];
      sum += std::polar(1.0, n * std::atan2(d.y(), d.x()));
      ++count;
    }
  }
  return std::abs(sum) / count;
}

std::string refusal(const RectangleParams& params)
{
  try
  {
    rectangle(params);
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return "accepted";
}

TEST(Rectangle, HasTheNumbersOfTheThesisInEveryPattern)
{
  for (const RectanglePattern pattern : ALL_PATTERNS)
  {
    const ClothModel model = rectangle(sheet(30, 30, pattern));
    const Mesh mesh = meshOf(model);

    EXPECT_EQ(mesh.particleCount(), 900);
    EXPECT_EQ(mesh.springCount(), 2581);
    EXPECT_EQ(mesh.springCount() - borderSprings(mesh), 2465);
    EXPECT_EQ(mesh.triangleCount(), 1682);
    EXPECT_TRUE(defects(mesh).empty());
  }
}

TEST(Rectangle, HangsDownFromItsUpperEdgeInReadingOrder)
{
  RectangleParams params = sheet(4, 3);
  params.width = 3;
  params.height = 5;

  const ClothModel model = rectangle(params);

  EXPECT_EQ(model.positions[0], Vec3d(-1.5, 0, 0));
  EXPECT_EQ(model.positions[3], Vec3d(1.5, 0, 0));
  EXPECT_EQ(model.positions[5], Vec3d(-0.5, -2.5, 0));
  EXPECT_EQ(model.positions[11], Vec3d(1.5, -5, 0));
}

TEST(Rectangle, FacesTowardsPositiveZWithItsWholeArea)
{
  for (const RectanglePattern pattern : ALL_PATTERNS)
  {
    RectangleParams params = sheet(9, 14, pattern);
    params.width = 6;
    params.height = 8;
    const ClothModel model = rectangle(params);

    double area = 0;
    for (const ModelTriangle& t : model.triangles)
    {
      const Vec3d& a = model.positions[t.vertices[0]];
      const double part =
          (model.positions[t.vertices[1]] - a).cross(model.positions[t.vertices[2]] - a).z() / 2;
      EXPECT_GT(part, 0);
      area += part;
    }
    EXPECT_NEAR(area, 48, 1e-9);
  }
}

TEST(Rectangle, SpansTheWholeTextureWithVOneAtTheTop)
{
  for (const RectanglePattern pattern : ALL_PATTERNS)
  {
    RectangleParams params = sheet(7, 5, pattern);
    params.width = 2;
    const ClothModel model = rectangle(params);

    EXPECT_NEAR(uvArea(model), 1, 1e-12);
    for (const ModelTriangle& t : model.triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        const Vec3d& place = model.positions[t.vertices[k]];
        EXPECT_EQ(t.uv[k], Vec2d(place.x() / 2 + 0.5, 1 + place.y()));
      }
    }
  }
}

TEST(Rectangle, CutsEveryCellAlongTheSameDiagonalOrInTurns)
{
  for (const bool alternating : { false, true })
  {
    const Mesh mesh = meshOf(rectangle(
        sheet(3, 2, alternating ? RectanglePattern::ALTERNATING : RectanglePattern::ONE_DIAGONAL)));
    int rising = 0;
    int falling = 0;
    for (int s = 0; s < mesh.springCount(); ++s)
    {
      const Spring& spring = mesh.spring(SpringId{ s });
      const int step = std::abs(spring.particles[0].index - spring.particles[1].index);
      rising += step == 2 ? 1 : 0;   // from lower left to upper right in rows of three
      falling += step == 4 ? 1 : 0;  // from upper left to lower right
    }
    EXPECT_EQ(rising, alternating ? 1 : 2);
    EXPECT_EQ(falling, alternating ? 1 : 0);
  }
}

TEST(Rectangle, GradesItsSpacingFromTheMiddleToTheBorder)
{
  RectangleParams params = sheet(101, 2);
  params.grading = 3;
  const ClothModel model = rectangle(params);

  const double at_border = model.positions[1].x() - model.positions[0].x();
  const double in_middle = model.positions[51].x() - model.positions[50].x();

  EXPECT_NEAR(at_border / in_middle, 3, 0.05);
  EXPECT_EQ(model.positions[100].x(), 0.5);
}

TEST(IrregularRectangle, HasNoSlivers)
{
  for (const std::uint64_t seed : { 1u, 2u, 3u, 4u, 5u })
  {
    for (const int n : { 2, 3, 4, 10, 60 })
    {
      RectangleParams params = sheet(n, n, RectanglePattern::IRREGULAR);
      params.seed = seed;
      params.jitter = 0.5;
      EXPECT_GT(smallestAngle(rectangle(params)), 20) << "seed " << seed << ", n " << n;
    }
  }
}

TEST(IrregularRectangle, TurnsNoTriangleOverWhereItsCellsAreLongAndUneven)
{
  RectangleParams params = sheet(40, 40, RectanglePattern::IRREGULAR);
  params.width = 3;
  params.grading = 0.2;
  params.jitter = 0.5;
  for (params.seed = 1; params.seed < 6; ++params.seed)
  {
    EXPECT_GT(smallestAngle(rectangle(params)), 4);
  }
}

TEST(IrregularRectangle, PrefersNoDirection)
{
  const ClothModel grid = rectangle(sheet(40, 40));
  const ClothModel irregular = rectangle(sheet(40, 40, RectanglePattern::IRREGULAR));

  EXPECT_GT(std::max(directionBias(grid, 2), directionBias(grid, 4)), 0.3);
  EXPECT_LT(directionBias(irregular, 2), 0.06);
  EXPECT_LT(directionBias(irregular, 4), 0.06);
}

TEST(IrregularRectangle, KeepsABorderOfEvenlySpacedParticles)
{
  const ClothModel grid = rectangle(sheet(12, 9));
  const ClothModel irregular = rectangle(sheet(12, 9, RectanglePattern::IRREGULAR));

  int moved = 0;
  for (int i = 0; i < 12 * 9; ++i)
  {
    const bool on_border = i < 12 || i >= 12 * 8 || i % 12 == 0 || i % 12 == 11;
    if (on_border)
    {
      EXPECT_EQ(irregular.positions[i], grid.positions[i]);
    }
    moved += irregular.positions[i] == grid.positions[i] ? 0 : 1;
  }
  EXPECT_GT(moved, 10 * 7 / 2);
}

TEST(IrregularRectangle, DependsOnNothingButItsSeed)
{
  RectangleParams params = sheet(20, 20, RectanglePattern::IRREGULAR);
  const ClothModel first = rectangle(params);
  const ClothModel again = rectangle(params);
  params.seed = 2;
  const ClothModel other = rectangle(params);

  EXPECT_EQ(first.positions, again.positions);
  EXPECT_NE(first.positions, other.positions);
}

TEST(IrregularRectangle, IsReadyInSecondsAtThreeHundredByThreeHundred)
{
  const Mesh mesh = meshOf(rectangle(sheet(300, 300, RectanglePattern::IRREGULAR)));

  EXPECT_EQ(mesh.particleCount(), 90000);
  EXPECT_EQ(mesh.triangleCount(), 2 * 299 * 299);
}

TEST(Slit, InsideTheClothCopiesAllItsParticlesButTheEnds)
{
  const ClothModel model = rectangle(slitSheet({ { Vec2d(-1, -2), Vec2d(1, -2) } }));
  const Mesh mesh = meshOf(model);

  ASSERT_EQ(mesh.particleCount(), 26);
  EXPECT_EQ(model.positions[25], model.positions[12]);
  EXPECT_EQ(borderSprings(mesh), 16 + 4);
  EXPECT_EQ(pieces(model), 1);
  EXPECT_NEAR(uvArea(model), 1, 1e-12);
  EXPECT_TRUE(defects(mesh).empty());
}

TEST(Slit, OpensTheBorderItReaches)
{
  const Mesh mesh = meshOf(rectangle(slitSheet({ { Vec2d(-2, -2), Vec2d(0, -2) } })));

  EXPECT_EQ(mesh.particleCount(), 25 + 2);  // one on the border, one inside
  EXPECT_EQ(borderSprings(mesh), 16 + 4);
}

TEST(Slit, FromBorderToBorderMakesTwoPieces)
{
  const ClothModel model = rectangle(slitSheet({ { Vec2d(-2, -1), Vec2d(2, -1) } }));

  EXPECT_EQ(model.positions.size(), 25u + 5u);
  EXPECT_EQ(pieces(model), 2);
}

TEST(Slit, CrossingAnotherOneLeavesFourCornersThere)
{
  const ClothModel model =
      rectangle(slitSheet({ { Vec2d(-1, -2), Vec2d(1, -2) }, { Vec2d(0, -1), Vec2d(0, -3) } }));
  const Mesh mesh = meshOf(model);

  EXPECT_EQ(mesh.particleCount(), 25 + 3);
  EXPECT_EQ(std::count(model.positions.begin(), model.positions.end(), Vec3d(0, -2, 0)), 4);
  EXPECT_EQ(borderSprings(mesh), 16 + 8);
  EXPECT_TRUE(defects(mesh).empty());
}

TEST(Slit, MayStandTwiceInTheListLikeOnce)
{
  const Slit slit = { Vec2d(-1, -2), Vec2d(1, -2) };

  EXPECT_EQ(rectangle(slitSheet({ slit, slit })).positions,
            rectangle(slitSheet({ slit })).positions);
}

TEST(Slit, SnapsToTheEdgesNearestToItsLine)
{
  const ClothModel exact = rectangle(slitSheet({ { Vec2d(-1, -2), Vec2d(1, -2) } }));
  const ClothModel near = rectangle(slitSheet({ { Vec2d(-1.2, -2.3), Vec2d(0.7, -1.8) } }));

  EXPECT_EQ(near.positions, exact.positions);
}

TEST(Slit, RunsAlongADiagonalWhereOneIsThere)
{
  const ClothModel model = rectangle(slitSheet({ { Vec2d(-1, -3), Vec2d(1, -1) } }));

  ASSERT_EQ(model.positions.size(), 26u);
  EXPECT_EQ(model.positions[25], Vec3d(0, -2, 0));
}

TEST(Slit, StaysNearItsLineWhereSeveralPathsAreEquallyShort)
{
  // Two steps to the right and two along diagonals, in any order, lead from one end to the other.
  const ClothModel model = rectangle(slitSheet({ { Vec2d(-2, -4), Vec2d(2, -2) } }));
  const ClothModel other = rectangle(slitSheet({ { Vec2d(2, 0), Vec2d(-2, -2) } }));

  EXPECT_EQ(std::count(model.positions.begin(), model.positions.end(), Vec3d(0, -3, 0)), 2);
  EXPECT_EQ(std::count(other.positions.begin(), other.positions.end(), Vec3d(0, -1, 0)), 2);
}

TEST(Slit, CutsIrregularClothCleanly)
{
  RectangleParams params = sheet(30, 30, RectanglePattern::IRREGULAR);
  params.slits = { { Vec2d(-0.4, -0.1), Vec2d(0.4, -0.9) },
                   { Vec2d(-0.5, -0.8), Vec2d(0.3, -0.2) } };

  const ClothModel model = rectangle(params);

  EXPECT_TRUE(defects(meshOf(model)).empty());
  EXPECT_GT(model.positions.size(), 900u + 40u);
  EXPECT_NEAR(uvArea(model), 1, 1e-12);
}

TEST(Slit, ThatOpensNothingIsRefused)
{
  const Slit too_short = { Vec2d(-1, -2), Vec2d(0, -2) };
  const Slit on_border = { Vec2d(-2, 0), Vec2d(2, 0) };
  const Slit a_point = { Vec2d(0, -2), Vec2d(0, -2) };

  for (const Slit& slit : { too_short, on_border, a_point })
  {
    EXPECT_NE(refusal(slitSheet({ slit })).find("slits[0] opens nothing"), std::string::npos);
  }
}

TEST(RectangleProblems, NameFieldValueAndLimit)
{
  struct Case
  {
    void (*spoil)(RectangleParams&);
    const char* sentence;
  };
  const Case cases[] = {
    { [](RectangleParams& p) { p.width = 0; }, "width is 0" },
    { [](RectangleParams& p) { p.width = std::nan(""); }, "width is nan" },
    { [](RectangleParams& p) { p.height = -1; }, "height is -1" },
    { [](RectangleParams& p) { p.height = std::numeric_limits<double>::infinity(); },
      "height is inf" },
    { [](RectangleParams& p) { p.columns = 1; }, "columns is 1" },
    { [](RectangleParams& p) { p.rows = -7; }, "rows is -7" },
    { [](RectangleParams& p) { p.columns = p.rows = 1001; },
      "columns x rows is 1002001, must be at most 1000000" },
    { [](RectangleParams& p) { p.columns = p.rows = std::numeric_limits<int>::max(); },
      "columns is 2.14748e+09" },
    { [](RectangleParams& p) { p.grading = 0; }, "grading is 0" },
    { [](RectangleParams& p) { p.jitter = 0.6; }, "jitter is 0.6" },
    { [](RectangleParams& p) {
       p.slits = { { Vec2d(3, -1), Vec2d(0, -1) } };
     },
      "slits[0].start.x is 3" },
    { [](RectangleParams& p) {
       p.slits = { { Vec2d(0, -1), Vec2d(0, std::nan("")) } };
     },
      "slits[0].end.y is nan" },
  };
  for (const Case& c : cases)
  {
    RectangleParams params = metreSheet();
    c.spoil(params);
    EXPECT_GE(problems(params).size(), 1u) << c.sentence;
    EXPECT_NE(refusal(params).find(c.sentence), std::string::npos) << refusal(params);
  }
}

TEST(RectangleProblems, AreListedAllAtOnce)
{
  RectangleParams params;
  EXPECT_TRUE(problems(params).empty());

  params.width = 0;
  params.rows = 0;
  params.jitter = 9;

  EXPECT_EQ(problems(params).size(), 3u);
}

TEST(RectanglePattern, IsKnownByItsName)
{
  EXPECT_EQ(rectanglePattern("one_diagonal"), RectanglePattern::ONE_DIAGONAL);
  EXPECT_EQ(rectanglePattern("alternating"), RectanglePattern::ALTERNATING);
  EXPECT_EQ(rectanglePattern("irregular"), RectanglePattern::IRREGULAR);
  EXPECT_THROW(rectanglePattern("Irregular"), std::invalid_argument);
}

}  // namespace
}  // namespace cloth
