// The markers show all of the cloth, lit and coloured, and never what rviz cannot draw.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <set>

#include "cloth_tearing/node/cloth_markers.h"
#include "message_bytes.h"

using namespace cloth_tearing;  // NOLINT: the subject of every line below
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

namespace
{

const Placement PLACEMENT{ "map", cloth::Vec3d(0.0, 0.0, 2.0) };

template <class Change>
void change(cloth::Snapshot& snapshot, Change change)
{
  cloth::SurfaceTopology topology = *snapshot.surface.topology;
  change(topology);
  snapshot.surface.topology = std::make_shared<const cloth::SurfaceTopology>(topology);
}

/// Gives the square's four sides and its diagonal these strains.
void stretch(cloth::Snapshot& square, const std::array<double, 5>& strains)
{
  change(square,
         [&](cloth::SurfaceTopology& topology)
         {
           topology.springs = { { { 0, 1 }, 1.0 / (1.0 + strains[0]) },
                                { { 1, 2 }, 1.0 / (1.0 + strains[1]) },
                                { { 2, 3 }, 1.0 / (1.0 + strains[2]) },
                                { { 3, 0 }, 1.0 / (1.0 + strains[3]) },
                                { { 0, 2 }, std::sqrt(2.0) / (1.0 + strains[4]) } };
         });
}

/// A square of side 1 in x-z, two triangles, its texture filled once.
cloth::Snapshot square()
{
  cloth::Snapshot snapshot;
  snapshot.surface.position = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 1 }, { 0, 0, 1 } };
  change(snapshot,
         [](cloth::SurfaceTopology& topology)
         {
           topology.parents = { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 3, 3 } };
           topology.triangles = { { { 0, 1, 2 }, { { { 0, 0 }, { 1, 0 }, { 1, 1 } } } },
                                  { { 0, 2, 3 }, { { { 0, 0 }, { 1, 1 }, { 0, 1 } } } } };
         });
  stretch(snapshot, { -0.1, 0.1, 0.3, 0.0, 0.2 });
  return snapshot;
}

cloth::Sphere sphere(std::uint64_t id, cloth::SphereSource source)
{
  cloth::Sphere s;
  s.id = id;
  s.source = source;
  s.radius = 0.25;
  return s;
}

const Marker* find(const MarkerArray& markers, const std::string& ns, int id)
{
  for (const Marker& m : markers.markers)
  {
    if (m.ns == ns && m.id == id)
    {
      return &m;
    }
  }
  return nullptr;
}

std::set<int> shownSpheres(const MarkerArray& markers)
{
  std::set<int> ids;
  for (const Marker& m : markers.markers)
  {
    if (m.ns == "spheres" && m.action == Marker::ADD)
    {
      ids.insert(m.id);
    }
  }
  return ids;
}

double areaOf(const Marker& list)
{
  double area = 0.0;
  for (std::size_t i = 0; i + 3 <= list.points.size(); i += 3)
  {
    const auto at = [&](std::size_t k)
    { return cloth::Vec3d(list.points[i + k].x, list.points[i + k].y, list.points[i + k].z); };
    area += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
  }
  return area;
}

}  // namespace

TEST(Checker, CutsATriangleIntoPartsThatFillIt)
{
  const std::array<cloth::Vec2d, 3> uv = { { { 0.03, 0.07 }, { 0.91, 0.22 }, { 0.35, 0.88 } } };

  const std::vector<PaintedCorner> corners = cutByChecks(uv, 10);

  ASSERT_EQ(corners.size() % 3, 0u);
  double area = 0.0;  // in weights: the whole triangle has 1/2
  for (std::size_t i = 0; i < corners.size(); i += 3)
  {
    const auto at = [&](std::size_t k)
    { return cloth::Vec2d(corners[i + k].weights[1], corners[i + k].weights[2]); };
    const cloth::Vec2d a = at(1) - at(0);
    const cloth::Vec2d b = at(2) - at(0);
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  EXPECT_NEAR(area, 0.5, 1e-5);
}

TEST(Checker, GivesEachPartTheColourOfItsCheck)
{
  const std::array<cloth::Vec2d, 3> uv = { { { -0.4, -0.3 }, { 0.8, 0.1 }, { 0.2, 0.9 } } };
  const int checks = 7;

  const std::vector<PaintedCorner> corners = cutByChecks(uv, checks);

  ASSERT_GT(corners.size(), 60u);
  for (std::size_t i = 0; i < corners.size(); i += 3)
  {
    cloth::Vec2d middle = cloth::Vec2d::Zero();
    for (std::size_t k = i; k < i + 3; ++k)
    {
      for (int c = 0; c < 3; ++c)
      {
        middle += corners[k].weights[c] / 3.0 * uv[c];
      }
    }
    const int column = static_cast<int>(std::floor(checks * middle.x()));
    const int row = static_cast<int>(std::floor(checks * middle.y()));
    EXPECT_EQ(corners[i].color, checkColor(column, row));
  }
}

TEST(Checker, KeepsATriangleWholeThatItCannotCut)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::array<cloth::Vec2d, 3>> uvs = {
    { { { 0.5, 0.5 }, { 0.5, 0.5 }, { 0.5, 0.5 } } },  // no area
    { { { 0, 0 }, { 1e4, 0 }, { 0, 1e4 } } },          // too many checks
    { { { 0, 0 }, { 1e300, 0 }, { 0, 1e300 } } },      // beyond counting
    { { { 0, 0 }, { nan, 0 }, { 0, 1 } } },
  };
  for (const auto& uv : uvs)
  {
    EXPECT_EQ(cutByChecks(uv, 16).size(), 3u);
  }
}

TEST(ClothMarkers, DrawTheWholeClothInEveryColoring)
{
  for (const Coloring coloring : { Coloring::TEXTURE, Coloring::STRAIN, Coloring::PLAIN })
  {
    MarkerStyle style;
    style.coloring = coloring;
    ClothMarkers painter(style, PLACEMENT);

    const MarkerArray markers = painter.draw(square());

    const Marker* list = find(markers, "cloth", 0);
    ASSERT_NE(list, nullptr);
    EXPECT_EQ(list->header.frame_id, "map");
    EXPECT_EQ(list->type, Marker::TRIANGLE_LIST);
    EXPECT_EQ(list->action, Marker::ADD);
    EXPECT_EQ(list->points.size(), list->colors.size());
    EXPECT_NEAR(areaOf(*list), 1.0, 1e-5);
    EXPECT_GE(list->points[0].z, 2.0) << "placed in frame_id";
  }
}

TEST(ClothMarkers, ShowStrainFromBlueOverWhiteToRed)
{
  MarkerStyle style;
  style.coloring = Coloring::STRAIN;
  style.strain_range = { 0.0, 0.5 };
  ClothMarkers painter(style, PLACEMENT);
  cloth::Snapshot snapshot = square();
  stretch(snapshot, { -0.1, 0.25, 0.6, 0.0, -0.1 });

  const MarkerArray markers = painter.draw(snapshot);

  const Marker& list = *find(markers, "cloth", 0);
  EXPECT_GT(list.colors[0].b, list.colors[0].r) << "strain 0 is blue";
  EXPECT_NEAR(list.colors[1].b, list.colors[1].r, 1e-6) << "the middle is white";
  EXPECT_GT(list.colors[2].r, list.colors[2].b) << "the end of the range is red";
}

TEST(ClothMarkers, DrawSpringsInPlaceOfTrianglesWhenToldTo)
{
  MarkerStyle style;
  style.coloring = Coloring::WIREFRAME;
  ClothMarkers painter(style, PLACEMENT);

  const MarkerArray markers = painter.draw(square());

  EXPECT_EQ(find(markers, "cloth", 0)->action, Marker::DELETE) << "the triangles";
  const Marker& springs = *find(markers, "cloth", 1);
  EXPECT_EQ(springs.action, Marker::ADD);
  EXPECT_EQ(springs.type, Marker::LINE_LIST);
  EXPECT_GT(springs.scale.x, 0.0);
  ASSERT_EQ(springs.points.size(), 10u) << "two ends of each spring";
  ASSERT_EQ(springs.colors.size(), 10u);
  EXPECT_EQ(springs.points[3].x, 1.0);
  EXPECT_EQ(springs.points[3].z, 3.0) << "placed in frame_id";
}

TEST(ClothMarkers, DeleteTheSpringsInEveryOtherColoring)
{
  for (const Coloring coloring : { Coloring::TEXTURE, Coloring::STRAIN, Coloring::PLAIN })
  {
    MarkerStyle style;
    style.coloring = coloring;

    const MarkerArray markers = ClothMarkers(style, PLACEMENT).draw(square());

    ASSERT_NE(find(markers, "cloth", 1), nullptr);
    EXPECT_EQ(find(markers, "cloth", 1)->action, Marker::DELETE);
  }
}

TEST(ClothMarkers, ColorSpringsByTheirStrainWithinTheRange)
{
  MarkerStyle style;
  style.coloring = Coloring::WIREFRAME;
  style.strain_range = { 0.0, 0.2 };

  const MarkerArray markers = ClothMarkers(style, PLACEMENT).draw(square());

  const auto& colors = find(markers, "cloth", 1)->colors;
  for (std::size_t i = 0; i < colors.size(); i += 2)
  {
    EXPECT_EQ(colors[i].r, colors[i + 1].r) << "one colour a spring";
  }
  EXPECT_GT(colors[0].b, colors[0].r) << "slack is blue";
  EXPECT_EQ(colors[0].b, colors[6].b) << "and no bluer than the range's lower end";
  EXPECT_GT(colors[2].g, colors[2].b) << "the middle is orange";
  EXPECT_GT(colors[2].g, colors[8].g);
  EXPECT_GT(colors[8].r, colors[8].b + colors[8].g) << "the upper end is red";
  EXPECT_NEAR(colors[4].r, colors[8].r, 1e-6) << "and nothing redder";
}

TEST(ClothMarkers, LightBothSidesAlike)
{
  MarkerStyle style;
  style.coloring = Coloring::PLAIN;
  ClothMarkers painter(style, PLACEMENT);
  cloth::Snapshot turned = square();
  change(turned,
         [](cloth::SurfaceTopology& topology)
         {
           for (cloth::SurfaceTriangle& t : topology.triangles)
           {
             std::swap(t.particles[1], t.particles[2]);
           }
         });
  cloth::Snapshot aside = square();
  for (cloth::Vec3& x : aside.surface.position)
  {
    std::swap(x.y(), x.z());
  }

  const float front = find(painter.draw(square()), "cloth", 0)->colors[0].r;

  EXPECT_EQ(front, find(painter.draw(turned), "cloth", 0)->colors[0].r);
  EXPECT_NE(front, find(painter.draw(aside), "cloth", 0)->colors[0].r);
}

TEST(ClothMarkers, FollowATearInTheTexture)
{
  ClothMarkers painter(MarkerStyle(), PLACEMENT);
  painter.draw(square());
  cloth::Snapshot torn = square();
  change(torn,
         [](cloth::SurfaceTopology& topology)
         {
           topology.triangles[0].uv = { { { 0, 0 }, { 0.01, 0 }, { 0.01, 0.01 } } };  // one check
         });

  const MarkerArray markers = painter.draw(torn);

  const Marker& list = *find(markers, "cloth", 0);
  for (int k = 1; k < 3; ++k)
  {
    EXPECT_EQ(list.colors[0].r, list.colors[k].r);
  }
  EXPECT_NEAR(areaOf(list), 1.0, 1e-5);
}

TEST(ClothMarkers, DeleteWhatIsNotThere)
{
  ClothMarkers painter(MarkerStyle(), PLACEMENT);
  cloth::Snapshot nothing;

  const MarkerArray markers = painter.draw(nothing);

  for (const char* ns : { "cloth", "torn_edges", "weak_points", "grasps" })
  {
    const Marker* m = find(markers, ns, 0);
    ASSERT_NE(m, nullptr) << ns;
    EXPECT_EQ(m->action, Marker::DELETE) << ns;
  }
}

TEST(ClothMarkers, LeaveOutWhatCannotBeDrawn)
{
  for (const Coloring coloring : { Coloring::TEXTURE, Coloring::PLAIN })
  {
    MarkerStyle style;
    style.coloring = coloring;
    ClothMarkers painter(style, PLACEMENT);
    cloth::Snapshot snapshot = square();
    snapshot.surface.position[1] = snapshot.surface.position[0];  // a triangle without area
    snapshot.surface.position[3].x() = std::numeric_limits<float>::quiet_NaN();

    EXPECT_EQ(find(painter.draw(snapshot), "cloth", 0)->action, Marker::DELETE);
  }
}

TEST(ClothMarkers, LeaveOutSpringsThatCannotBeDrawn)
{
  MarkerStyle style;
  style.coloring = Coloring::WIREFRAME;
  cloth::Snapshot snapshot = square();
  snapshot.surface.position[1] = snapshot.surface.position[0];
  snapshot.surface.position[3].x() = std::numeric_limits<float>::quiet_NaN();

  const MarkerArray markers = ClothMarkers(style, PLACEMENT).draw(snapshot);

  EXPECT_EQ(find(markers, "cloth", 1)->points.size(), 4u) << "1-2 and 0-2 are left";
}

TEST(ClothMarkers, ShowTornEdgesWeakPointsAndGrasps)
{
  ClothMarkers painter(MarkerStyle(), PLACEMENT);
  cloth::Snapshot snapshot = square();
  change(snapshot,
         [](cloth::SurfaceTopology& topology)
         {
           topology.torn_edges = { { 0, 1 }, { 1, 2 } };
           topology.weak_points = { 3 };
         });
  cloth::Grasp grasp;
  grasp.id = 1;
  grasp.held = { { cloth::ParticleId{ 2 }, cloth::Vec3d::Zero() } };
  snapshot.grasps = { grasp };

  const MarkerArray markers = painter.draw(snapshot);

  EXPECT_EQ(find(markers, "torn_edges", 0)->points.size(), 4u);
  EXPECT_EQ(find(markers, "torn_edges", 0)->type, Marker::LINE_LIST);
  EXPECT_EQ(find(markers, "weak_points", 0)->points.size(), 1u);
  EXPECT_EQ(find(markers, "grasps", 0)->points.size(), 1u);
  EXPECT_EQ(find(markers, "grasps", 1)->points.size(), 6u) << "three axes";
}

TEST(ClothMarkers, AreTheSameWhenOthersAreWrittenOver)
{
  cloth::Snapshot full = square();
  change(full,
         [](cloth::SurfaceTopology& topology)
         {
           topology.torn_edges = { { 0, 1 } };
           topology.weak_points = { 3 };
         });
  full.grasps.resize(1);
  full.grasps[0].held = { { cloth::ParticleId{ 2 }, cloth::Vec3d::Zero() } };
  full.spheres = { sphere(7, cloth::SphereSource::THROWN) };
  cloth::Snapshot bad = square();
  bad.surface.position[1].x() = std::numeric_limits<float>::infinity();
  for (const Coloring coloring :
       { Coloring::TEXTURE, Coloring::STRAIN, Coloring::PLAIN, Coloring::WIREFRAME })
  {
    MarkerStyle style;
    style.coloring = coloring;
    ClothMarkers painter(style, PLACEMENT);
    ClothMarkers other(style, PLACEMENT);
    MarkerArray written_over;
    for (const cloth::Snapshot& snapshot : { full, square(), bad, full, cloth::Snapshot() })
    {
      painter.draw(snapshot, written_over);
      EXPECT_TRUE(sameBytes(written_over, other.draw(snapshot)));
    }
  }
}

TEST(ClothMarkers, KeepTheIdOfASphereAndDeleteTheOnesThatAreGone)
{
  using cloth::SphereSource;
  ClothMarkers painter(MarkerStyle(), PLACEMENT);
  cloth::Snapshot snapshot = square();
  snapshot.spheres = { sphere(7, SphereSource::STREAMED), sphere(7, SphereSource::THROWN) };
  const std::set<int> both = shownSpheres(painter.draw(snapshot));
  ASSERT_EQ(both.size(), 2u) << "same number, other source";

  snapshot.spheres.erase(snapshot.spheres.begin());
  const MarkerArray one = painter.draw(snapshot);
  const std::set<int> left = shownSpheres(one);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(both.count(*left.begin()), 1u);
  int deleted = 0;
  for (const Marker& m : one.markers)
  {
    deleted += m.ns == "spheres" && m.action == Marker::DELETE ? 1 : 0;
  }
  EXPECT_EQ(deleted, 1);

  snapshot.spheres.push_back(sphere(8, SphereSource::STREAMED));
  EXPECT_EQ(shownSpheres(painter.draw(snapshot)), both) << "a free number is used again";
  for (const Marker& m : painter.draw(snapshot).markers)
  {
    EXPECT_FALSE(m.ns == "spheres" && m.action == Marker::DELETE) << "and deleted no more";
  }
}
