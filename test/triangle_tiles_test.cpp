// Triangles in lists by tile, and what a sphere finds there.
#include "cloth_tearing/core/triangle_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "cloth_tearing/core/near_triangles.h"
#include "cloth_tearing/core/pushed_springs.h"
#include "cloth_tearing/core/simulation.h"
#include "scenes.h"

namespace cloth
{
namespace
{

Cloth clothOf(RectanglePattern pattern, int side)
{
  return makeCloth(upright(sheet(1.0, 1.0, side, side, pattern)), {}, vacuum().material,
                   RestShapeSource::IMPORTED, 0.0);
}

/// In [0, 1), the same everywhere.
double next(std::mt19937_64& numbers)
{
  return static_cast<double>(numbers() >> 11) * 0x1p-53;
}

/// Parts what hangs by one point at an end of the spring, or detaches what lies beside it, or
/// splits it where there is neither.
Edit torn(Mesh& mesh, SpringId spring)
{
  for (ParticleId p : mesh.spring(spring).particles)
  {
    if (mesh.fanCount(p) > 1)
    {
      return mesh.separateFans(p);
    }
    if (!mesh.spring(spring).border() && mesh.onBorder(p))
    {
      return mesh.detachAlong(p, spring);
    }
  }
  return mesh.splitSpring(spring);
}

std::vector<int> listOf(const TriangleTiles& tiles, int tile)
{
  std::vector<int> list;
  tiles.forEach(tile, [&](TriangleId t) { list.push_back(t.index); });
  return list;
}

/// Moves all particles by chance, from where they are as well as from where they were.
void shake(Cloth& cloth, std::mt19937_64& numbers, double by)
{
  cloth.state.previous.resize(cloth.state.size());
  for (int i = 0; i < cloth.state.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Real x = cloth.state.position[i][k];
      cloth.state.previous[i][k] = x + static_cast<Real>(by * (next(numbers) - 0.5));
      cloth.state.position[i][k] = x + static_cast<Real>(by * (next(numbers) - 0.5));
    }
  }
}

class Tiles : public ::testing::TestWithParam<RectanglePattern>
{
};

INSTANTIATE_TEST_SUITE_P(Meshes, Tiles,
                         ::testing::Values(RectanglePattern::ONE_DIAGONAL,
                                           RectanglePattern::IRREGULAR));

TEST_P(Tiles, FollowAThousandTearsToTheListsOfAnybodyWhoLooksOnce)
{
  Cloth cloth = clothOf(GetParam(), 20);
  std::mt19937_64 numbers(7);
  TriangleTiles step_by_step;
  for (int tear = 0; tear < 1000; ++tear)
  {
    step_by_step.follow(cloth.mesh, cloth.springs);
    cloth.springs.changes.forget();
    const int spring = static_cast<int>(next(numbers) * cloth.mesh.springCount());
    cloth.follow(torn(cloth.mesh, { spring }));
  }
  step_by_step.follow(cloth.mesh, cloth.springs);

  TriangleTiles at_once;
  at_once.follow(cloth.mesh, cloth.springs);

  ASSERT_EQ(step_by_step.count(), at_once.count());
  int triangles = 0;
  for (int tile = 0; tile < at_once.count(); ++tile)
  {
    EXPECT_EQ(listOf(step_by_step, tile), listOf(at_once, tile)) << "tile " << tile;
    EXPECT_EQ(step_by_step.reach(tile), at_once.reach(tile)) << "tile " << tile;
    triangles += static_cast<int>(listOf(at_once, tile).size());
  }
  EXPECT_EQ(triangles, cloth.mesh.triangleCount()) << "each is in one list";
}

TEST_P(Tiles, ReachWhereverTheirTrianglesDo)
{
  const Cloth cloth = clothOf(GetParam(), 20);
  TriangleTiles tiles;
  tiles.follow(cloth.mesh, cloth.springs);
  for (int tile = 0; tile < tiles.count(); ++tile)
  {
    std::set<int> reached;
    tiles.forEach(tile,
                  [&](TriangleId t)
                  {
                    for (ParticleId p : cloth.mesh.triangle(t).particles)
                    {
                      reached.insert(TriangleTiles::tileOf(p.index));
                    }
                  });
    EXPECT_EQ(tiles.reach(tile), std::vector<int>(reached.begin(), reached.end()));
  }
}

/// Spheres of all sizes on ways across a cloth that is torn in places.
class NearSpheres : public Tiles
{
protected:
  struct Way
  {
    Vec3 start;
    Vec3 end;
    Real reach;
  };

  NearSpheres() : cloth(clothOf(GetParam(), 40))
  {
    for (int spring = 100; spring < 3000; spring += 310)
    {
      cloth.follow(cloth.mesh.splitSpring({ spring }));
    }
    shake(cloth, numbers, 0.02);
  }

  Way someWay()
  {
    Way way{};
    for (int k = 0; k < 3; ++k)
    {
      const double middle = k == 2 ? -0.5 : 0.0;
      way.start[k] = static_cast<Real>(middle + (k == 1 ? 0.4 : 1.4) * (next(numbers) - 0.5));
      way.end[k] = way.start[k] + static_cast<Real>(0.2 * (next(numbers) - 0.5));
    }
    way.reach = static_cast<Real>(0.005 + 0.2 * next(numbers) * next(numbers));
    return way;
  }

  bool boxesMeet(const Triangle& triangle, const Way& way) const
  {
    for (int k = 0; k < 3; ++k)
    {
      const Real low = std::min(way.start[k], way.end[k]) - way.reach;
      const Real high = std::max(way.start[k], way.end[k]) + way.reach;
      bool below = true;
      bool above = true;
      for (ParticleId p : triangle.particles)
      {
        const Real from = cloth.state.previous[p.index][k];
        const Real to = cloth.state.position[p.index][k];
        below = below && from < low && to < low;
        above = above && from > high && to > high;
      }
      if (below || above)
      {
        return false;
      }
    }
    return true;
  }

  /// The least distance of a corner, a side's middle or the triangle's from the centre on its way.
  Real distance(const Triangle& triangle, const Way& way) const
  {
    Real least = 100;
    const auto& p = triangle.particles;
    for (Real fraction : { Real(0), Real(0.3), Real(0.7), Real(1) })
    {
      std::array<Vec3, 3> x;
      for (int k = 0; k < 3; ++k)
      {
        const Vec3 from = cloth.state.previous[p[k].index] - way.start;
        const Vec3 to = cloth.state.position[p[k].index] - way.end;
        x[k] = from + fraction * (to - from);
      }
      for (const Vec3& at : { x[0], x[1], x[2], Vec3((x[0] + x[1]) / 2), Vec3((x[1] + x[2]) / 2),
                              Vec3((x[2] + x[0]) / 2), Vec3((x[0] + x[1] + x[2]) / 3) })
      {
        least = std::min(least, at.norm());
      }
    }
    return least;
  }

  std::mt19937_64 numbers{ 11 };
  Cloth cloth;
};

INSTANTIATE_TEST_SUITE_P(Meshes, NearSpheres,
                         ::testing::Values(RectanglePattern::ONE_DIAGONAL,
                                           RectanglePattern::IRREGULAR));

TEST_P(NearSpheres, FindAllTrianglesWhoseBoxesMeetTheirsAndNoOthers)
{
  NearTriangles near;
  int found = 0;
  for (int i = 0; i < 200; ++i)
  {
    const Way way = someWay();
    std::vector<TriangleId> expected;
    for (int t = 0; t < cloth.mesh.triangleCount(); ++t)
    {
      if (boxesMeet(cloth.mesh.triangle({ t }), way))
      {
        expected.push_back({ t });
      }
    }
    near.find(cloth, way.start, way.end, way.reach, nullptr);
    ASSERT_EQ(near.all(), expected) << "way " << i;
    found += static_cast<int>(expected.size());
  }
  EXPECT_GT(found, 2000);
}

TEST_P(NearSpheres, PassOverOnlyTrianglesThatStayOutOfReach)
{
  NearTriangles near;
  int passed_over = 0;
  int touching = 0;
  for (int i = 0; i < 200; ++i)
  {
    const Way way = someWay();
    near.find(cloth, way.start, way.end, way.reach, nullptr);
    for (TriangleId t : near.all())
    {
      const bool touches = distance(cloth.mesh.triangle(t), way) < way.reach;
      const bool looked_at = near.mayTouch(cloth.mesh.triangle(t));
      touching += touches ? 1 : 0;
      passed_over += looked_at ? 0 : 1;
      EXPECT_TRUE(looked_at || !touches) << "triangle " << t.index << " on way " << i;
    }
  }
  EXPECT_GT(touching, 1000);
  EXPECT_GT(passed_over, 1000) << "or it would be of no use";
}

TEST_P(NearSpheres, LookAgainAtWhatWasPushedAndWhenTheyGaveWay)
{
  NearTriangles near;
  for (int i = 0; i < 200; ++i)
  {
    const Way way = someWay();
    near.find(cloth, way.start, way.end, way.reach, nullptr);
    const auto far =
        std::find_if(near.all().begin(), near.all().end(),
                     [&](TriangleId t) { return !near.mayTouch(cloth.mesh.triangle(t)); });
    if (far == near.all().end())
    {
      continue;
    }
    const Triangle& triangle = cloth.mesh.triangle(*far);
    near.moved(way.end + Vec3(Real(0.005) * way.reach, 0, 0));
    EXPECT_FALSE(near.mayTouch(triangle)) << "that was within what is spared for it";
    near.forget(triangle.particles[1].index);
    EXPECT_TRUE(near.mayTouch(triangle));

    near.find(cloth, way.start, way.end, way.reach, nullptr);
    EXPECT_FALSE(near.mayTouch(triangle));
    near.moved(way.end + Vec3(0, Real(0.02) * way.reach, 0));
    EXPECT_TRUE(near.mayTouch(triangle));
    return;
  }
  FAIL() << "no triangle was far";
}

TEST_P(NearSpheres, FindTheSameWithThreads)
{
  WorkerPool workers(3);
  NearTriangles alone;
  NearTriangles shared;
  for (int i = 0; i < 50; ++i)
  {
    const Way way = someWay();
    alone.find(cloth, way.start, way.end, way.reach, nullptr);
    shared.find(cloth, way.start, way.end, way.reach, &workers);
    ASSERT_EQ(alone.all(), shared.all()) << "way " << i;
  }
}

/// Of few pushed particles and of many, with threads and without.
TEST_P(NearSpheres, MissNoStretchedSpringAtWhatTheyPushed)
{
  const double strain = 0.3;
  const std::vector<int> noted = { 5, 17 };
  WorkerPool workers(3);
  for (int step : { 1, 2, 50 })
  {
    std::vector<int> pushed;
    std::set<int> expected(noted.begin(), noted.end());
    for (int p = cloth.mesh.particleCount() - 1; p >= 0; p -= step)
    {
      pushed.push_back(p);
    }
    for (int s = 0; s < cloth.mesh.springCount(); ++s)
    {
      const auto& ends = cloth.mesh.spring({ s }).particles;
      const bool was_pushed =
          std::any_of(ends.begin(), ends.end(),
                      [&](ParticleId p)
                      { return std::find(pushed.begin(), pushed.end(), p.index) != pushed.end(); });
      if (was_pushed && cloth.strain({ s }) > strain * 1.001)
      {
        expected.insert(s);
      }
    }
    for (WorkerPool* threads : { static_cast<WorkerPool*>(nullptr), &workers })
    {
      PushedSprings springs;
      const std::vector<int>& found = springs.find(cloth, noted, pushed, strain, threads);
      EXPECT_GT(expected.size(), noted.size());
      EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
      EXPECT_TRUE(std::adjacent_find(found.begin(), found.end()) == found.end()) << "each once";
      EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
      for (int s : found)
      {
        EXPECT_TRUE(cloth.strain({ s }) > strain * 0.999 || s == noted[0] || s == noted[1]) << s;
      }
    }
  }
}

}  // namespace
}  // namespace cloth
