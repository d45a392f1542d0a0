// Claims of the rest shape: lengths, areas, masses, and how they follow an edit.
#include "cloth_tearing/core/rest_shape.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cloth_tearing/core/refusal.h"
#include "small_meshes.h"

namespace cloth
{
namespace
{

constexpr double DENSITY = 0.3;  // [kg/m^2]

RestShape imported(const Mesh& mesh, const ClothModel& model)
{
  return makeRestShape(mesh, model.positions, RestShapeSource::IMPORTED, DENSITY);
}

std::string refusal(const ClothModel& model, RestShapeSource source)
{
  try
  {
    makeRestShape(meshOf(model), model.positions, source, DENSITY);
  }
  catch (const Refusal& refusal)
  {
    return refusal.what();
  }
  return "accepted";
}

/// Equations 1 to 4 of the thesis as they stand, angles and all.
double byTheThesis(double a, double b, double c, double d, double e)
{
  const double alpha = std::acos((b * b + c * c - a * a) / (2 * b * c));
  const double beta = std::acos((d * d + c * c - e * e) / (2 * d * c));
  return std::sqrt(b * b + d * d - 2 * b * d * std::cos(alpha + beta));
}

TEST(TriangleArea, IsHerons)
{
  EXPECT_DOUBLE_EQ(triangleArea(3, 4, 5), 6.0);
  EXPECT_DOUBLE_EQ(triangleArea(5, 3, 4), 6.0);
  EXPECT_DOUBLE_EQ(triangleArea(4, 5, 3), 6.0);
  EXPECT_DOUBLE_EQ(triangleArea(2, 2, 2), std::sqrt(3.0));
}

TEST(TriangleArea, IsRightForANeedle)
{
  const double height = 1e-6;
  const double side = std::sqrt(0.25 + height * height);

  EXPECT_NEAR(triangleArea(1.0, side, side) / (0.5 * height), 1.0, 1e-3);
}

TEST(TriangleArea, IsNoneWhereTheSidesDoNotClose)
{
  EXPECT_EQ(triangleArea(1, 2, 3), 0.0);
  EXPECT_EQ(triangleArea(1, 1, 5), 0.0);
}

TEST(MedianLength, RunsToTheMiddleOfTheSide)
{
  EXPECT_DOUBLE_EQ(medianLength(3, 4, 5), 2.5);  // a right angle lies on the circle over its side
  EXPECT_DOUBLE_EQ(medianLength(2, 2, 2), std::sqrt(3.0));
  EXPECT_EQ(medianLength(1, 1, 2.5), 0.0);
}

TEST(BendShearLength, IsThatOfTheEquationsOfTheThesis)
{
  int compared = 0;
  for (double c : { 0.7, 1.0, 1.6 })
  {
    for (double a : { 0.8, 1.1 })
    {
      for (double b : { 0.9, 1.2 })
      {
        for (double d : { 0.85, 1.3 })
        {
          for (double e : { 0.95, 1.05 })
          {
            EXPECT_NEAR(bendShearLength(c, a, b, e, d), byTheThesis(a, b, c, d, e), 1e-12);
            ++compared;
          }
        }
      }
    }
  }
  EXPECT_EQ(compared, 48);
}

TEST(BendShearLength, IsTheOtherDiagonalOfASquare)
{
  EXPECT_NEAR(bendShearLength(std::sqrt(2.0), 1, 1, 1, 1), std::sqrt(2.0), 1e-12);
}

TEST(BendShearLength, IsFiniteForTrianglesThatHardlyClose)
{
  EXPECT_TRUE(std::isfinite(bendShearLength(2.0, 1.0, 1.0, 1.0, 1.0)));
  EXPECT_TRUE(std::isfinite(bendShearLength(2.0, 0.9999999, 1.0, 1.0, 0.9999999)));
}

TEST(RestShape, TakesLengthsAndAreasFromTheModel)
{
  const ClothModel model = kite();
  const Mesh mesh = meshOf(model);

  const RestShape rest = imported(mesh, model);

  EXPECT_DOUBLE_EQ(rest.length[springBetween(mesh, 0, 1).index], 2.0);
  EXPECT_DOUBLE_EQ(rest.length[springBetween(mesh, 1, 2).index], std::sqrt(2.0));
  EXPECT_NEAR(rest.area[0], 1.0, 1e-15);
  EXPECT_NEAR(rest.area[1], 1.0, 1e-15);
  EXPECT_NEAR(rest.spacing[0], (2.0 + 2.0 * std::sqrt(2.0)) / 3.0, 1e-15);
}

TEST(RestShape, GivesEachCornerAThirdOfItsTrianglesMass)
{
  const ClothModel model = kite();
  const Mesh mesh = meshOf(model);

  const RestShape rest = imported(mesh, model);

  EXPECT_NEAR(rest.mass[0], DENSITY * 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(rest.mass[2], DENSITY * 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(sumOf(rest.mass), DENSITY * 2.0, 1e-15);
}

TEST(RestShape, HasABendShearLengthOnInteriorSpringsAlone)
{
  for (const NamedModel& named : everyConfiguration())
  {
    const Mesh mesh = meshOf(named.model);
    const RestShape rest = imported(mesh, named.model);
    for (int i = 0; i < mesh.springCount(); ++i)
    {
      EXPECT_EQ(rest.bend_length[i] > 0.0, !mesh.spring({ i }).border()) << named.name;
    }
  }
}

TEST(RestShape, BendsFlatEvenWhereTheModelIsFolded)
{
  ClothModel model = kite();
  const Mesh mesh = meshOf(model);
  model.positions[3] = Vec3d(0, 0, 1);  // the lower triangle stands up

  const RestShape rest = imported(mesh, model);

  EXPECT_NEAR(rest.bend_length[springBetween(mesh, 0, 1).index], 2.0, 1e-12);
}

TEST(RestShape, TakesLengthsFromTheTextureScaledToTheModelsArea)
{
  ClothModel model = kite();
  for (ModelTriangle& t : model.triangles)
  {
    for (Vec2d& uv : t.uv)
    {
      uv = 0.1 * uv;
    }
  }
  model.positions[2] = Vec3d(0.3, 1.4, 0.2);  // modelled another way than laid out
  const Mesh mesh = meshOf(model);
  const double modelled = sumOf(imported(mesh, model).area);

  const RestShape rest = makeRestShape(mesh, model.positions, RestShapeSource::UV, DENSITY);

  EXPECT_NEAR(sumOf(rest.area), modelled, 1e-12);
  EXPECT_NEAR(rest.area[0], rest.area[1], 1e-12);
  EXPECT_NEAR(
      rest.length[springBetween(mesh, 0, 1).index] / rest.length[springBetween(mesh, 1, 2).index],
      std::sqrt(2.0), 1e-12);
}

TEST(RestShape, TakesTheMeanOfBothSidesAcrossATextureSeam)
{
  ClothModel model = kite();
  for (Vec2d& uv : model.triangles[1].uv)
  {
    uv = 1.2 * uv + Vec2d(5, 5);
  }
  const Mesh mesh = meshOf(model);

  const RestShape rest = makeRestShape(mesh, model.positions, RestShapeSource::UV, DENSITY);

  const double shared = rest.length[springBetween(mesh, 0, 1).index];
  const double upper = rest.length[springBetween(mesh, 1, 2).index];
  EXPECT_NEAR(shared / upper, 2.2 / std::sqrt(2.0), 1e-12);
}

TEST(RestShape, RefusesAnEdgeWithoutLength)
{
  ClothModel model = kite();
  model.positions[2] = model.positions[1];

  const std::string message = refusal(model, RestShapeSource::IMPORTED);

  EXPECT_NE(message.find("edge between particles 1 and 2 has no rest length"), std::string::npos)
      << message;
}

TEST(RestShape, RefusesATriangleWithoutArea)
{
  ClothModel model = kite();
  model.positions[3] = Vec3d(0.25, 0, 0);

  const std::string message = refusal(model, RestShapeSource::IMPORTED);

  EXPECT_EQ(message, "triangle 1 has no rest area");
}

TEST(RestShape, RefusesATextureLayoutWithoutArea)
{
  ClothModel model = kite();
  for (ModelTriangle& t : model.triangles)
  {
    t.uv = { Vec2d(0, 0), Vec2d(0, 0), Vec2d(0, 0) };
  }

  const std::string message = refusal(model, RestShapeSource::UV);

  EXPECT_NE(message.find("texture layout has no area"), std::string::npos) << message;
}

TEST(RestShape, HalvesATornSpringAndGivesMiddleSpringsTheMedian)
{
  const ClothModel model = kite();
  Mesh mesh = meshOf(model);
  RestShape rest = imported(mesh, model);
  const SpringId s = springBetween(mesh, 0, 1);

  const Edit edit = mesh.splitSpring(s);
  rest.follow(mesh, edit);

  EXPECT_DOUBLE_EQ(rest.length[s.index], 1.0);
  EXPECT_DOUBLE_EQ(rest.length[edit.springs[0].id.index], 1.0);
  for (std::size_t i = 1; i < edit.springs.size(); ++i)
  {
    EXPECT_NEAR(rest.length[edit.springs[i].id.index], 1.0, 1e-15);
  }
  for (double area : rest.area)
  {
    EXPECT_NEAR(area, 0.5, 1e-15);
  }
}

TEST(RestShape, SplitsUnequalTrianglesIntoHalvesThatCloseWithTheirOwnSprings)
{
  const ClothModel model = sheet(6, 6, RectanglePattern::IRREGULAR);
  for (int i = 0; i < meshOf(model).springCount(); ++i)
  {
    Mesh mesh = meshOf(model);
    RestShape rest = imported(mesh, model);

    const Edit edit = mesh.splitSpring({ i });
    rest.follow(mesh, edit);

    for (TriangleId t : edit.touched)
    {
      const auto& springs = mesh.triangle(t).springs;
      const double area = triangleArea(rest.length[springs[0].index], rest.length[springs[1].index],
                                       rest.length[springs[2].index]);
      EXPECT_NEAR(area, rest.area[t.index], 1e-12) << "spring " << i;
    }
  }
}

TEST(RestShape, RemembersTheSpacingOfTheUntornMeshInEveryHalf)
{
  const ClothModel model = kite();
  Mesh mesh = meshOf(model);
  RestShape rest = imported(mesh, model);
  const double spacing = rest.spacing[0];

  for (int i = 0; i < 4; ++i)
  {
    rest.follow(mesh, mesh.splitSpring({ i }));
  }

  for (double each : rest.spacing)
  {
    EXPECT_DOUBLE_EQ(each, spacing);
  }
}

TEST(RestShape, TakesTheBendShearSpringAwayWhereTheClothIsDetached)
{
  const ClothModel model = openFan({ 0, 50, 100, 150 });
  Mesh mesh = meshOf(model);
  RestShape rest = imported(mesh, model);
  const SpringId s = springBetween(mesh, 0, 2);
  ASSERT_GT(rest.bend_length[s.index], 0.0);

  const Edit edit = mesh.detachAlong({ 0 }, s);
  rest.follow(mesh, edit);

  EXPECT_EQ(rest.bend_length[s.index], 0.0);
  EXPECT_EQ(rest.bend_length[edit.springs[0].id.index], 0.0);
  EXPECT_GT(rest.bend_length[springBetween(mesh, edit.particles[0].id, { 3 }).index], 0.0);
}

TEST(SpringTable, MovesBendShearSpringsToTheCopyOfAReplacedParticle)
{
  Cloth cloth = clothOf(sheet(5, 5, RectanglePattern::ONE_DIAGONAL));
  const ParticleId p{ 12 };  // the middle
  const Fan fan = cloth.mesh.fans(p)[0];

  const Edit edit = cloth.mesh.openAlong(p, fan.springs[0], fan.springs[3]);
  cloth.follow(edit);

  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    const SpringLaw& bend = cloth.springs.bend_shear[i];
    EXPECT_EQ(bend.active(), !cloth.mesh.spring({ i }).border());
    if (bend.active())
    {
      EXPECT_EQ(bend.a, cloth.mesh.opposite({ i }, 0).index);
      EXPECT_EQ(bend.b, cloth.mesh.opposite({ i }, 1).index);
    }
  }
}

TEST(SpringTable, GivesTwoBendShearSpringsThatJoinTheSamePairHalfEach)
{
  Cloth cloth = clothOf(kite());
  const SpringId s = springBetween(cloth.mesh, 0, 1);
  const Real whole = cloth.springs.bend_shear[s.index].stiffness;

  const Edit edit = cloth.mesh.splitSpring(s);
  cloth.follow(edit);

  const SpringLaw& one = cloth.springs.bend_shear[s.index];
  const SpringLaw& other = cloth.springs.bend_shear[edit.springs[0].id.index];
  EXPECT_EQ(std::minmax(one.a, one.b), std::minmax(other.a, other.b));
  EXPECT_NEAR(one.stiffness, 0.5 * whole, 1e-4 * whole);
  EXPECT_NEAR(other.stiffness, 0.5 * whole, 1e-4 * whole);
}

TEST(SpringTable, GivesStiffnessByAdjacentAreaOverSquaredLength)
{
  const Cloth cloth = clothOf(kite());
  const SpringId shared = springBetween(cloth.mesh, 0, 1);
  const SpringId border = springBetween(cloth.mesh, 1, 2);

  EXPECT_NEAR(cloth.springs.structural[shared.index].stiffness,
              cloth.material.stiffness * 2.0 / 4.0, 1e-4);
  EXPECT_NEAR(cloth.springs.structural[border.index].stiffness,
              cloth.material.stiffness * 1.0 / 2.0, 1e-4);
}

}  // namespace
}  // namespace cloth
