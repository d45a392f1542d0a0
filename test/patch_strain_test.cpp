// Claims of the patch strain: the same on any mesh, bounded by the spring's own, never over a tear.
#include "cloth_tearing/core/patch_strain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "small_meshes.h"

namespace cloth
{
namespace
{

const RectanglePattern ALL_PATTERNS[] = { RectanglePattern::ONE_DIAGONAL,
                                          RectanglePattern::ALTERNATING,
                                          RectanglePattern::IRREGULAR };

/// Moves every particle to where `map` sends its place on the model.
void deform(Cloth& cloth, const ClothModel& model, const std::function<Vec3d(const Vec3d&)>& map)
{
  for (std::size_t i = 0; i < model.positions.size(); ++i)
  {
    cloth.state.position[i] = map(model.positions[i]).cast<Real>();
  }
}

/// The interior spring whose middle is nearest to `place`.
SpringId springNear(const Cloth& cloth, const ClothModel& model, const Vec3d& place)
{
  SpringId nearest;
  double least = 1e30;
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    const auto& ends = cloth.mesh.spring({ i }).particles;
    const Vec3d middle =
        0.5 * (model.positions[ends[0].index] + model.positions[ends[1].index]) - place;
    if (!cloth.mesh.spring({ i }).border() && middle.norm() < least)
    {
      least = middle.norm();
      nearest = { i };
    }
  }
  return nearest;
}

TEST(PatchStrain, EqualsUniformStrainOnAnyMesh)
{
  for (const RectanglePattern pattern : ALL_PATTERNS)
  {
    // Large enough a mesh that floats hold its places to better than the tolerance.
    const ClothModel model = sheet(9, 9, pattern, 2.0, 4);
    Cloth cloth = clothOf(model);
    deform(cloth, model,
           [](const Vec3d& x) { return Vec3d(1.25 * x.x(), 1.125 * x.y(), 0.25 * x.x()); });

    PatchStrain patch;
    for (int i = 0; i < cloth.mesh.springCount(); ++i)
    {
      const auto& ends = cloth.mesh.spring({ i }).particles;
      const Vec3d along = model.positions[ends[1].index] - model.positions[ends[0].index];
      const Vec3d stretched(1.25 * along.x(), 1.125 * along.y(), 0.25 * along.x());
      const double exact = stretched.norm() / along.norm() - 1.0;
      EXPECT_NEAR(patch.read(cloth, { i }, 0.5), exact, 1e-6) << "spring " << i;
    }
  }
}

TEST(PatchStrain, IsNeverMoreThanTheSpringsOwn)
{
  const ClothModel model = sheet(12, 12, RectanglePattern::IRREGULAR);
  Cloth cloth = clothOf(model);
  deform(cloth, model,
         [](const Vec3d& x)
         {
           return Vec3d(x.x() + 0.1 * std::sin(9 * x.y()), 1.3 * x.y() + 0.1 * std::sin(17 * x.x()),
                        0.2 * std::sin(13 * x.x()));
         });

  PatchStrain patch;
  int less = 0;
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    const double own = cloth.strain({ i });
    for (double radius : { 0.01, 0.1, 0.3, 5.0 })
    {
      const double read = patch.read(cloth, { i }, radius);
      EXPECT_LE(read, own);
      less += read < own - 1e-6 ? 1 : 0;
    }
  }
  EXPECT_GT(less, 100);
}

/// The definition of the patch strain on a flat, convex sheet, triangle by triangle.
double byDefinition(const Cloth& cloth, const ClothModel& model, SpringId s, double radius)
{
  const auto& ends = cloth.mesh.spring(s).particles;
  const Vec3d from = model.positions[ends[0].index];
  const Vec3d to = model.positions[ends[1].index];
  const Vec3d along = (to - from).normalized();
  double weights = 0.0;
  double sum = 0.0;
  for (int i = 0; i < cloth.mesh.triangleCount(); ++i)
  {
    const auto& corners = cloth.mesh.triangle({ i }).particles;
    std::array<Vec3d, 3> flat;
    std::array<Vec3d, 3> now;
    for (int k = 0; k < 3; ++k)
    {
      flat[k] = model.positions[corners[k].index];
      now[k] = cloth.state.position[corners[k].index].cast<double>();
    }
    const double r = ((flat[0] + flat[1] + flat[2]) / 3.0 - 0.5 * (from + to)).norm();
    Eigen::Matrix2d rest;
    rest << (flat[1] - flat[0]).head<2>(), (flat[2] - flat[0]).head<2>();
    Eigen::Matrix<double, 3, 2> sides;
    sides << now[1] - now[0], now[2] - now[0];
    if (r < radius)
    {
      const double weight = 0.5 * rest.determinant() * (1.0 - r * r / (radius * radius));
      const Eigen::Matrix2d inverse{ rest.inverse() };
      weights += weight;
      sum += weight * (sides * (inverse * along.head<2>())).squaredNorm();
    }
  }
  return std::sqrt(sum / weights) - 1.0;
}

TEST(PatchStrain, IsTheWeightedMeanOverTheTrianglesOfTheDisc)
{
  const ClothModel model = sheet(12, 12, RectanglePattern::IRREGULAR, 2.0);
  Cloth cloth = clothOf(model);
  deform(cloth, model,
         [](const Vec3d& x)
         {
           return Vec3d(x.x() + 0.3 * x.x() * x.y(), 1.2 * x.y() - 0.2 * x.x() * x.x(),
                        0.2 * x.y() * x.y());
         });

  PatchStrain patch;
  int compared = 0;
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    const double expected = byDefinition(cloth, model, { i }, 0.5);
    const double own = cloth.strain({ i });
    EXPECT_NEAR(patch.read(cloth, { i }, 0.5), std::min(own, expected), 1e-5) << "spring " << i;
    compared += expected < own ? 1 : 0;
  }
  EXPECT_GT(compared, 50);
}

TEST(PatchStrain, IsTheSpringsOwnWithoutARadius)
{
  const ClothModel model = sheet(6, 6, RectanglePattern::IRREGULAR);
  Cloth cloth = clothOf(model);
  deform(cloth, model, [](const Vec3d& x) { return Vec3d(x.x() * x.x() + x.x(), 2 * x.y(), 0); });

  PatchStrain patch;
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    EXPECT_EQ(patch.read(cloth, { i }, 0.0), cloth.strain({ i }));
    EXPECT_EQ(patch.read(cloth, { i }, 1e-6), cloth.strain({ i })) << "no triangle's centre inside";
  }
}

/// The mean stretch along y that the patch reads where stretch falls off from a place of greatest
/// strain, as round the tip of a crack.
double readOnMesh(int resolution, RectanglePattern pattern, std::uint64_t seed)
{
  const ClothModel model = sheet(resolution, resolution, pattern, 1.0, seed);
  Cloth cloth = clothOf(model);
  const Vec3d peak(0.0, -0.5, 0.0);
  deform(cloth, model,
         [&](const Vec3d& x)
         {
           const double r2 = (x - peak).squaredNorm();
           return Vec3d(x + (0.2 + 0.4 * std::exp(-r2 / 0.09)) * (x - peak));
         });
  PatchStrain patch;
  return patch.read(cloth, springNear(cloth, model, peak), 0.25);
}

TEST(PatchStrain, IsTheSameOnFineCoarseAndIrregularMeshes)
{
  const double fine = readOnMesh(81, RectanglePattern::IRREGULAR, 1);
  for (const RectanglePattern pattern : ALL_PATTERNS)
  {
    for (int resolution : { 21, 41 })
    {
      for (std::uint64_t seed : { 2u, 3u })
      {
        EXPECT_NEAR(readOnMesh(resolution, pattern, seed), fine, 0.05 * fine) << resolution;
      }
    }
  }
}

TEST(PatchStrain, DoesNotSeeAcrossABorder)
{
  // A slit along x = 0 from the lower edge up: only what is left of it is stretched.
  RectangleParams params;
  params.columns = 11;
  params.rows = 11;
  params.slits = { { Vec2d(0, -1), Vec2d(0, 0) } };
  const ClothModel model = rectangle(params);
  ASSERT_EQ(model.positions.size(), 132u) << "the slit parts the sheet";
  Cloth cloth = clothOf(model);
  std::vector<char> left(model.positions.size(), 0);
  for (const ModelTriangle& t : model.triangles)
  {
    for (int v : t.vertices)
    {
      const Vec3d centre = (model.positions[t.vertices[0]] + model.positions[t.vertices[1]] +
                            model.positions[t.vertices[2]]) /
                           3.0;
      left[v] = centre.x() < 0 ? 1 : left[v];
    }
  }
  for (std::size_t i = 0; i < model.positions.size(); ++i)
  {
    const double stretch = left[i] ? 3.0 : 1.25;
    cloth.state.position[i].y() = static_cast<Real>(stretch * model.positions[i].y());
  }

  PatchStrain patch;
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    const auto& ends = cloth.mesh.spring({ i }).particles;
    const Vec3d along = model.positions[ends[1].index] - model.positions[ends[0].index];
    if (!left[ends[0].index] && !left[ends[1].index] && std::abs(along.x()) < 1e-9)
    {
      EXPECT_NEAR(patch.read(cloth, { i }, 0.4), 0.25, 1e-5) << "spring " << i;
    }
  }
}

TEST(PatchStrain, DoesNotSeeThroughAOnePointConnection)
{
  const ClothModel model = bowTie(2, 2);
  Cloth cloth = clothOf(model);
  for (int i = 4; i <= 6; ++i)  // the second fan
  {
    cloth.state.position[i] *= Real(5);
  }

  PatchStrain patch;
  EXPECT_NEAR(patch.read(cloth, springBetween(cloth.mesh, 0, 2), 3.0), 0.0, 1e-6);
}

TEST(PatchStrain, ReadsTheStretchAlongTheSpringOnly)
{
  const ClothModel model = sheet(9, 9, RectanglePattern::ONE_DIAGONAL, 2.0);
  Cloth cloth = clothOf(model);
  deform(cloth, model, [](const Vec3d& x) { return Vec3d(2 * x.x(), x.y(), 0); });

  PatchStrain patch;
  const SpringId upright = springBetween(cloth.mesh, 40, 49);
  const SpringId level = springBetween(cloth.mesh, 40, 41);
  EXPECT_NEAR(patch.read(cloth, upright, 0.6), 0.0, 1e-6);
  EXPECT_NEAR(patch.read(cloth, level, 0.6), 1.0, 1e-6);
}

TEST(PatchStrain, EqualsUniformStrainStillAfterTheMeshHasGrown)
{
  const ClothModel model = sheet(5, 5, RectanglePattern::ONE_DIAGONAL, 2.0);
  Cloth cloth = clothOf(model);
  deform(cloth, model, [](const Vec3d& x) { return Vec3d(1.25 * x); });
  PatchStrain patch;
  EXPECT_NEAR(patch.read(cloth, { 0 }, 0.8), 0.25, 1e-6);

  for (int i = 0; i < 40; ++i)
  {
    const Edit edit = cloth.mesh.splitSpring({ 2 * i });
    cloth.follow(edit);
    const auto& ends = edit.particles[0].parents;
    const Vec3 middle =
        Real(0.5) * (cloth.state.position[ends[0].index] + cloth.state.position[ends[1].index]);
    cloth.state.position[edit.particles[0].id.index] = middle;
    cloth.state.position[edit.particles[1].id.index] = middle;
  }

  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    EXPECT_NEAR(patch.read(cloth, { i }, 0.8), 0.25, 2e-6) << "spring " << i;
  }
}

TEST(PatchStrain, ReadsTheSameAfterFollowingTearsAsOneThatBeginsAnew)
{
  const ClothModel model = sheet(8, 8, RectanglePattern::IRREGULAR, 2.0, 3);
  Cloth cloth = clothOf(model);
  deform(cloth, model,
         [](const Vec3d& x) { return Vec3d(x.x() + 0.3 * x.x() * x.y(), 1.2 * x.y(), x.x()); });
  PatchStrain follows;
  for (int tear = 0; tear < 30; ++tear)
  {
    for (int i = 0; i < cloth.mesh.springCount(); ++i)
    {
      ASSERT_EQ(follows.readStill(cloth, { i }, 0.6), PatchStrain().read(cloth, { i }, 0.6))
          << "spring " << i << " after " << tear << " tears";
    }
    const Edit edit = cloth.mesh.splitSpring({ 5 * tear });
    cloth.follow(edit);
    follows.follow(cloth, edit.touched);
    cloth.state.position[edit.particles[0].id.index] += Vec3(Real(0.01), 0, 0);
    follows.moved();
  }
}

}  // namespace
}  // namespace cloth
