// Claims of the edits: what each adds, keeps and refuses, in every configuration.
#include <gtest/gtest.h>

#include <functional>

#include "cloth_tearing/core/mesh.h"
#include "small_meshes.h"

namespace cloth
{
namespace
{

/// Runs `act` for every spring of every configuration, on a fresh mesh each time.
void forEverySpring(const std::function<void(Mesh&, SpringId, const std::string&)>& act)
{
  for (const NamedModel& named : everyConfiguration())
  {
    const Mesh mesh = meshOf(named.model);
    for (int i = 0; i < mesh.springCount(); ++i)
    {
      Mesh edited = mesh;
      act(edited, { i }, named.name + ", spring " + std::to_string(i));
    }
  }
}

/// Runs `act` for every particle of every configuration.
void forEveryParticle(const std::function<void(const Mesh&, ParticleId, const std::string&)>& act)
{
  for (const NamedModel& named : everyConfiguration())
  {
    const Mesh mesh = meshOf(named.model);
    for (int i = 0; i < mesh.particleCount(); ++i)
    {
      act(mesh, { i }, named.name + ", particle " + std::to_string(i));
    }
  }
}

/// What a refused edit says; empty if it was made.
std::string refusal(const std::function<void()>& edit)
{
  try
  {
    edit();
  }
  catch (const TopologyError& error)
  {
    return error.what();
  }
  return {};
}

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/// The texture position of `p` in `t`.
Vec2d uvAt(const Mesh& mesh, TriangleId t, ParticleId p)
{
  return mesh.triangle(t).uv[mesh.triangle(t).cornerOf(p)];
}

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

// -- splitSpring ---------------------------------------------------------------------------------

TEST(SplitSpring, AddsTheCountsOfTheTableOnEverySpring)
{
  forEverySpring(
      [](Mesh& mesh, SpringId s, const std::string& where)
      {
        const Mesh before = mesh;
        const bool border = mesh.spring(s).border();

        const Edit edit = mesh.splitSpring(s);

        const Counts expected = border ? Counts{ 2, 3, 1 } : Counts{ 2, 5, 2 };
        EXPECT_EQ(countsOf(mesh) - countsOf(before), expected) << where;
        EXPECT_EQ(edit.particles.size(), 2u) << where;
        EXPECT_EQ(edit.springs.size(), border ? 3u : 5u) << where;
        EXPECT_EQ(edit.triangles.size(), border ? 1u : 2u) << where;
        EXPECT_TRUE(isSound(mesh)) << where;
        EXPECT_TRUE(touchesAllThatChanged(before, mesh, edit.touched)) << where;
        EXPECT_NEAR(uvArea(mesh), uvArea(before), 1e-12 * uvArea(before)) << where;
      });
}

TEST(SplitSpring, EndsItsHalvesInSplitPointsOfTheirOwn)
{
  forEverySpring(
      [](Mesh& mesh, SpringId s, const std::string& where)
      {
        const auto ends = mesh.spring(s).particles;

        const Edit edit = mesh.splitSpring(s);

        const ParticleId first = edit.particles[0].id;
        const ParticleId second = edit.particles[1].id;
        const SpringId half = edit.springs[0].id;
        EXPECT_EQ(edit.springs[0].parent, s) << where;
        EXPECT_TRUE(mesh.spring(s).joins(ends[0]) && mesh.spring(s).joins(first)) << where;
        EXPECT_TRUE(mesh.spring(half).joins(ends[1]) && mesh.spring(half).joins(second)) << where;
        EXPECT_EQ(edit.particles[0].parents[0], ends[0]) << where;
        EXPECT_EQ(edit.particles[0].parents[1], ends[1]) << where;
        EXPECT_EQ(edit.particles[1].parents[0], ends[1]) << where;
        EXPECT_EQ(edit.particles[1].parents[1], ends[0]) << where;
      });
}

TEST(SplitSpring, JoinsEachSplitPointToEachOppositeCornerByAMiddleSpring)
{
  forEverySpring(
      [](Mesh& mesh, SpringId s, const std::string& where)
      {
        const std::array<ParticleId, 2> corners = { mesh.opposite(s, 0), mesh.opposite(s, 1) };

        const Edit edit = mesh.splitSpring(s);

        for (ParticleId corner : corners)
        {
          if (!corner.valid())
          {
            continue;
          }
          for (const auto& added : edit.particles)
          {
            const SpringId middle = springBetween(mesh, added.id, corner);
            ASSERT_TRUE(middle.valid()) << where;
            EXPECT_TRUE(mesh.spring(middle).border()) << where;
          }
        }
      });
}

TEST(SplitSpring, KeepsTheHalvesOfATriangleApartAndOppositeOnesTogether)
{
  Mesh mesh = meshOf(kite());  // figure 3.8: m1 = 0 above, m2 = 1 below

  const Edit edit = mesh.splitSpring(springBetween(mesh, 0, 1));

  const TriangleId m3{ 0 };
  const TriangleId m5{ 1 };
  const TriangleId m4 = edit.triangles[0].id;
  const TriangleId m6 = edit.triangles[1].id;
  EXPECT_FALSE(sharesSpring(mesh, m3, m4));
  EXPECT_FALSE(sharesSpring(mesh, m5, m6));
  EXPECT_TRUE(sharesSpring(mesh, m3, m5));
  EXPECT_TRUE(sharesSpring(mesh, m4, m6));
}

TEST(SplitSpring, HalvesTheTextureOfEachTriangleExactly)
{
  forEverySpring(
      [](Mesh& mesh, SpringId s, const std::string& where)
      {
        const Mesh before = mesh;
        const auto ends = mesh.spring(s).particles;

        const Edit edit = mesh.splitSpring(s);

        for (const auto& added : edit.triangles)
        {
          const TriangleId t = added.parent;
          const Vec2d middle = 0.5 * (uvAt(before, t, ends[0]) + uvAt(before, t, ends[1]));
          EXPECT_EQ(uvAt(mesh, t, edit.particles[0].id), middle) << where;
          EXPECT_EQ(uvAt(mesh, added.id, edit.particles[1].id), middle) << where;
          EXPECT_EQ(uvAt(mesh, t, ends[0]), uvAt(before, t, ends[0])) << where;
          EXPECT_EQ(uvAt(mesh, added.id, ends[1]), uvAt(before, t, ends[1])) << where;
          EXPECT_NEAR(uvArea(mesh.triangle(t)), 0.5 * uvArea(before.triangle(t)), 1e-14) << where;
          EXPECT_NEAR(uvArea(mesh.triangle(added.id)), 0.5 * uvArea(before.triangle(t)), 1e-14)
              << where;
        }
      });
}

TEST(SplitSpring, KeepsTheTextureOfEachSideAcrossASeam)
{
  ClothModel model = kite();
  for (Vec2d& uv : model.triangles[1].uv)
  {
    uv += Vec2d(10.0, 0.25);
  }
  Mesh mesh = meshOf(model);

  const Edit edit = mesh.splitSpring(springBetween(mesh, 0, 1));

  for (const auto& added : edit.particles)
  {
    mesh.forEachTriangleAt(added.id,
                           [&](TriangleId t)
                           {
                             const bool upper = t.index == 0 || t == edit.triangles[0].id;
                             const Vec2d expected = upper ? Vec2d(0, 0) : Vec2d(10.0, 0.25);
                             EXPECT_EQ(uvAt(mesh, t, added.id), expected);
                           });
  }
}

TEST(SplitSpring, MakesAnOppositeCornerOnTheBorderAOnePointConnection)
{
  Mesh mesh = meshOf(kite());

  mesh.splitSpring(springBetween(mesh, 0, 1));

  EXPECT_EQ(mesh.fanCount({ 2 }), 2);
  EXPECT_EQ(mesh.fanCount({ 3 }), 2);
}

TEST(SplitSpring, OpensTheFanOfAnInteriorOppositeCorner)
{
  Mesh mesh = meshOf(wheel(6));  // the spring on the rim between 1 and 2 has the hub opposite

  mesh.splitSpring(springBetween(mesh, 1, 2));

  ASSERT_EQ(mesh.fanCount({ 0 }), 1);
  EXPECT_FALSE(mesh.fans({ 0 })[0].closed);
  EXPECT_EQ(mesh.fans({ 0 })[0].triangles.size(), 7u);
}

TEST(SplitSpring, MayCutEveryHalfAgain)
{
  Mesh mesh = meshOf(singleTriangle());
  for (int i = 0; i < 40; ++i)
  {
    mesh.splitSpring({ mesh.springCount() / 2 });
    ASSERT_TRUE(isSound(mesh)) << "after cut " << i;
  }
}

// -- detachAlong ---------------------------------------------------------------------------------

TEST(DetachAlong, AddsOneParticleAndOneSpringWhereverTheFanIsOpen)
{
  int made = 0;
  forEverySpring(
      [&](Mesh& mesh, SpringId s, const std::string& where)
      {
        const Mesh before = mesh;
        for (ParticleId p : before.spring(s).particles)
        {
          if (before.spring(s).border() || before.fanAt(p, before.spring(s).triangles[0]).closed)
          {
            continue;
          }
          mesh = before;

          const Edit edit = mesh.detachAlong(p, s);

          ++made;
          EXPECT_EQ(countsOf(mesh) - countsOf(before), (Counts{ 1, 1, 0 })) << where;
          EXPECT_TRUE(isSound(mesh)) << where;
          EXPECT_TRUE(touchesAllThatChanged(before, mesh, edit.touched)) << where;
          EXPECT_EQ(edit.particles[0].parents[0], p) << where;
          EXPECT_EQ(edit.particles[0].parents[1], p) << where;
          EXPECT_EQ(edit.springs[0].parent, s) << where;
        }
      });
  EXPECT_GT(made, 100);
}

TEST(DetachAlong, MovesTheTrianglesCounterClockwiseOfTheSpringToTheCopy)
{
  Mesh mesh = meshOf(openFan({ 0, 40, 90, 120, 170 }));
  const ParticleId hub{ 0 };
  const SpringId s = springBetween(mesh, 0, 3);  // triangles 0 and 1 clockwise, 2 and 3 beyond

  const Edit edit = mesh.detachAlong(hub, s);

  const ParticleId copy = edit.particles[0].id;
  const SpringId twin = edit.springs[0].id;
  EXPECT_EQ(mesh.fanAt(hub, { 0 }).triangles, (std::vector<TriangleId>{ { 0 }, { 1 } }));
  EXPECT_EQ(mesh.fanAt(copy, { 2 }).triangles, (std::vector<TriangleId>{ { 2 }, { 3 } }));
  EXPECT_TRUE(mesh.spring(s).joins(hub) && mesh.spring(s).joins({ 3 }));
  EXPECT_TRUE(mesh.spring(twin).joins(copy) && mesh.spring(twin).joins({ 3 }));
  EXPECT_TRUE(mesh.spring(s).border());
  EXPECT_TRUE(mesh.spring(twin).border());
}

TEST(DetachAlong, LeavesTheTextureWhereItIs)
{
  forEverySpring(
      [](Mesh& mesh, SpringId s, const std::string& where)
      {
        const Mesh before = mesh;
        const ParticleId p = mesh.spring(s).particles[0];
        if (!refusal([&] { mesh.detachAlong(p, s); }).empty())
        {
          return;
        }
        for (int i = 0; i < mesh.triangleCount(); ++i)
        {
          EXPECT_EQ(mesh.triangle({ i }).uv, before.triangle({ i }).uv) << where;
        }
      });
}

TEST(DetachAlong, LeavesTheOtherFansOfAOnePointConnectionTogether)
{
  Mesh mesh = meshOf(bowTie(3, 2));
  const SpringId inner = springBetween(mesh, 0, 2);

  mesh.detachAlong({ 0 }, inner);

  EXPECT_EQ(mesh.fanCount({ 0 }), 3);
  EXPECT_EQ(mesh.fanCount({ mesh.particleCount() - 1 }), 1);
}

TEST(DetachAlong, RefusesABorderSpringAndChangesNothing)
{
  Mesh mesh = meshOf(kite());
  const Mesh before = mesh;
  const SpringId border = springBetween(mesh, 1, 2);

  const std::string message = refusal([&] { mesh.detachAlong({ 1 }, border); });

  EXPECT_TRUE(contains(message, "spring 1 is a border")) << message;
  EXPECT_TRUE(isSame(mesh, before));
}

TEST(DetachAlong, RefusesASpringThatEndsElsewhereAndChangesNothing)
{
  Mesh mesh = meshOf(kite());
  const Mesh before = mesh;

  const std::string message = refusal([&] { mesh.detachAlong({ 2 }, springBetween(mesh, 0, 1)); });

  EXPECT_TRUE(contains(message, "spring 0 does not end at particle 2")) << message;
  EXPECT_TRUE(isSame(mesh, before));
}

TEST(DetachAlong, RefusesAClosedFanAndChangesNothing)
{
  Mesh mesh = meshOf(wheel(6));
  const Mesh before = mesh;

  const std::string message = refusal([&] { mesh.detachAlong({ 0 }, springBetween(mesh, 0, 3)); });

  EXPECT_TRUE(contains(message, "the triangles around particle 0 close round it")) << message;
  EXPECT_TRUE(isSame(mesh, before));
}

// -- openAlong -----------------------------------------------------------------------------------

TEST(OpenAlong, AddsOneParticleAndTwoSpringsAtEveryPairOfAClosedFan)
{
  int made = 0;
  forEveryParticle(
      [&](const Mesh& before, ParticleId p, const std::string& where)
      {
        for (const Fan& fan : before.fans(p))
        {
          for (SpringId from : fan.springs)
          {
            for (SpringId to : fan.springs)
            {
              if (!fan.closed || from == to)
              {
                continue;
              }
              Mesh mesh = before;

              const Edit edit = mesh.openAlong(p, from, to);

              ++made;
              EXPECT_EQ(countsOf(mesh) - countsOf(before), (Counts{ 1, 2, 0 })) << where;
              EXPECT_TRUE(isSound(mesh)) << where;
              EXPECT_TRUE(touchesAllThatChanged(before, mesh, edit.touched)) << where;
              EXPECT_EQ(mesh.fanCount(p), before.fanCount(p)) << where;
              EXPECT_EQ(edit.springs[0].parent, from) << where;
              EXPECT_EQ(edit.springs[1].parent, to) << where;
            }
          }
        }
      });
  EXPECT_GT(made, 300);
}

TEST(OpenAlong, MovesTheTrianglesFromTheFirstSpringRoundToTheSecond)
{
  Mesh mesh = meshOf(wheel(6));  // triangle i lies between spokes 1 + i and 2 + i
  const SpringId from = springBetween(mesh, 0, 5);
  const SpringId to = springBetween(mesh, 0, 2);

  const Edit edit = mesh.openAlong({ 0 }, from, to);

  const ParticleId copy = edit.particles[0].id;
  EXPECT_EQ(mesh.fanAt(copy, { 4 }).triangles, (std::vector<TriangleId>{ { 4 }, { 5 }, { 0 } }));
  EXPECT_EQ(mesh.fanAt({ 0 }, { 1 }).triangles, (std::vector<TriangleId>{ { 1 }, { 2 }, { 3 } }));
  for (SpringId s : { from, to, edit.springs[0].id, edit.springs[1].id })
  {
    EXPECT_TRUE(mesh.spring(s).border());
  }
}

TEST(OpenAlong, RefusesTheSameSpringTwiceAndChangesNothing)
{
  Mesh mesh = meshOf(wheel(6));
  const Mesh before = mesh;
  const SpringId s = springBetween(mesh, 0, 3);

  const std::string message = refusal([&] { mesh.openAlong({ 0 }, s, s); });

  EXPECT_TRUE(contains(message, "are not two springs of a closed fan")) << message;
  EXPECT_TRUE(isSame(mesh, before));
}

TEST(OpenAlong, RefusesAnOpenFanAndChangesNothing)
{
  Mesh mesh = meshOf(openFan({ 0, 40, 90, 120, 170 }));
  const Mesh before = mesh;

  const std::string message =
      refusal([&] { mesh.openAlong({ 0 }, springBetween(mesh, 0, 2), springBetween(mesh, 0, 4)); });

  EXPECT_TRUE(contains(message, "are not two springs of a closed fan around particle 0"));
  EXPECT_TRUE(isSame(mesh, before));
}

TEST(OpenAlong, RefusesASpringOfAnotherFanAndChangesNothing)
{
  Mesh mesh = meshOf(wheelOnAPoint());
  const Mesh before = mesh;

  const std::string message =
      refusal([&] { mesh.openAlong({ 0 }, springBetween(mesh, 0, 2), springBetween(mesh, 0, 8)); });

  EXPECT_TRUE(contains(message, "are not two springs of a closed fan around particle 0"));
  EXPECT_TRUE(isSame(mesh, before));
}

TEST(OpenAlong, RefusesASpringThatEndsElsewhereAndChangesNothing)
{
  Mesh mesh = meshOf(wheel(6));
  const Mesh before = mesh;
  const SpringId rim = springBetween(mesh, 1, 2);

  const std::string message =
      refusal([&] { mesh.openAlong({ 0 }, springBetween(mesh, 0, 3), rim); });

  EXPECT_TRUE(contains(message, "does not end at particle 0")) << message;
  EXPECT_TRUE(isSame(mesh, before));
}

// -- detachFan, separateFans ---------------------------------------------------------------------

TEST(OnePointConnection, DetachesOneFanAndStaysAHingeWhileTwoAreLeft)
{
  for (int fans : { 2, 3, 4 })
  {
    const Mesh before = meshOf(bowTie(fans, 2));
    for (int i = 0; i < before.triangleCount(); ++i)
    {
      Mesh mesh = before;

      const Edit edit = mesh.detachFan({ 0 }, { i });

      EXPECT_EQ(countsOf(mesh) - countsOf(before), (Counts{ 1, 0, 0 }));
      EXPECT_EQ(mesh.fanCount({ 0 }), fans - 1);
      EXPECT_EQ(mesh.fanCount(edit.particles[0].id), 1);
      EXPECT_GE(mesh.triangle({ i }).cornerOf(edit.particles[0].id), 0);
      EXPECT_TRUE(touchesAllThatChanged(before, mesh, edit.touched));
      EXPECT_TRUE(isSound(mesh));
    }
  }
}

TEST(OnePointConnection, DetachesAClosedFanToo)
{
  Mesh mesh = meshOf(wheelOnAPoint());

  const Edit edit = mesh.detachFan({ 0 }, { 2 });

  EXPECT_TRUE(mesh.fanAt(edit.particles[0].id, { 2 }).closed);
  EXPECT_EQ(mesh.fanCount({ 0 }), 1);
  EXPECT_TRUE(isSound(mesh));
}

TEST(OnePointConnection, SeparatesIntoOneParticlePerFan)
{
  for (int fans : { 2, 3, 4 })
  {
    Mesh mesh = meshOf(bowTie(fans, 2));
    const Mesh before = mesh;

    const Edit edit = mesh.separateFans({ 0 });

    EXPECT_EQ(countsOf(mesh) - countsOf(before), (Counts{ fans - 1, 0, 0 }));
    ASSERT_EQ(edit.particles.size(), static_cast<std::size_t>(fans - 1));
    EXPECT_EQ(mesh.fanCount({ 0 }), 1);
    for (const auto& added : edit.particles)
    {
      EXPECT_EQ(mesh.fanCount(added.id), 1);
      EXPECT_EQ(added.parents[0].index, 0);
    }
    EXPECT_EQ(mesh.triangle({ 0 }).cornerOf({ 0 }), before.triangle({ 0 }).cornerOf({ 0 }));
    EXPECT_TRUE(touchesAllThatChanged(before, mesh, edit.touched));
    EXPECT_TRUE(isSound(mesh));
  }
}

TEST(OnePointConnection, RefusesAParticleThatJoinsOnlyOneFanAndChangesNothing)
{
  for (const ClothModel& model : { wheel(6), kite(), openFan({ 0, 50, 100 }) })
  {
    Mesh mesh = meshOf(model);
    const Mesh before = mesh;

    const std::string separate = refusal([&] { mesh.separateFans({ 0 }); });
    const std::string detach = refusal([&] { mesh.detachFan({ 0 }, { 0 }); });

    EXPECT_EQ(separate, "separateFans: particle 0 joins only one fan");
    EXPECT_EQ(detach, "detachFan: particle 0 joins only one fan");
    EXPECT_TRUE(isSame(mesh, before));
  }
}

TEST(OnePointConnection, RefusesAFanOfAnotherParticleAndChangesNothing)
{
  Mesh mesh = meshOf(bowTie(2, 2));
  const Mesh before = mesh;

  const std::string message = refusal([&] { mesh.detachFan({ 1 }, { 3 }); });

  EXPECT_EQ(message, "detachFan: triangle 3 is not at particle 1");
  EXPECT_TRUE(isSame(mesh, before));
}

TEST(OnePointConnection, RefusesEveryParticleThatIsNone)
{
  forEveryParticle(
      [](const Mesh& before, ParticleId p, const std::string& where)
      {
        Mesh mesh = before;
        const bool refused = !refusal([&] { mesh.separateFans(p); }).empty();
        EXPECT_EQ(refused, before.fans(p).size() < 2) << where;
      });
}

// -- what follows the mesh -----------------------------------------------------------------------

/// Every edit that a mesh allows at its particles, one of each kind at each particle.
std::vector<std::function<Edit(Mesh&)>> editsOf(const Mesh& mesh)
{
  std::vector<std::function<Edit(Mesh&)>> edits;
  for (int i = 0; i < mesh.springCount(); ++i)
  {
    const SpringId s{ i };
    edits.push_back([s](Mesh& m) { return m.splitSpring(s); });
  }
  for (int i = 0; i < mesh.particleCount(); ++i)
  {
    const ParticleId p{ i };
    const std::vector<Fan> fans = mesh.fans(p);
    if (fans.size() > 1)
    {
      const TriangleId t = fans.back().triangles.front();
      edits.push_back([p](Mesh& m) { return m.separateFans(p); });
      edits.push_back([p, t](Mesh& m) { return m.detachFan(p, t); });
    }
    for (const Fan& fan : fans)
    {
      const SpringId one = fan.springs[1];
      const SpringId last = fan.springs.back();
      if (fan.closed)
      {
        edits.push_back([p, one, last](Mesh& m) { return m.openAlong(p, one, last); });
      }
      else if (fan.triangles.size() > 1)
      {
        edits.push_back([p, one](Mesh& m) { return m.detachAlong(p, one); });
      }
    }
  }
  return edits;
}

TEST(EditedCloth, KeepsMassRestAreaAndTheSizeOfEveryArray)
{
  for (const NamedModel& named : everyConfiguration())
  {
    const Cloth before = clothOf(named.model);
    const double mass = sumOf(before.rest.mass);
    for (const auto& edit : editsOf(before.mesh))
    {
      Cloth cloth = before;

      cloth.follow(edit(cloth.mesh));

      const std::size_t particles = cloth.mesh.particleCount();
      const std::size_t springs = cloth.mesh.springCount();
      EXPECT_NEAR(sumOf(cloth.rest.mass), mass, 1e-12 * mass) << named.name;
      EXPECT_NEAR(sumOf(cloth.rest.area), sumOf(before.rest.area), 1e-12) << named.name;
      EXPECT_EQ(cloth.rest.mass.size(), particles);
      EXPECT_EQ(cloth.rest.length.size(), springs);
      EXPECT_EQ(cloth.rest.bend_length.size(), springs);
      EXPECT_EQ(cloth.rest.area.size(), static_cast<std::size_t>(cloth.mesh.triangleCount()));
      EXPECT_EQ(cloth.rest.spacing.size(), cloth.rest.area.size());
      EXPECT_EQ(cloth.springs.structural.size(), springs);
      EXPECT_EQ(cloth.springs.bend_shear.size(), springs);
      EXPECT_EQ(cloth.state.position.size(), particles);
      EXPECT_EQ(cloth.state.velocity.size(), particles);
      EXPECT_EQ(cloth.state.previous.size(), particles);
      EXPECT_EQ(cloth.state.inverse_mass.size(), particles);
      EXPECT_EQ(cloth.attachments.size(), particles);
      EXPECT_EQ(cloth.damage.weak.size(), particles);
      EXPECT_EQ(cloth.damage.hinge.size(), particles);
      EXPECT_EQ(cloth.damage.hem.size(), particles);
      EXPECT_EQ(cloth.damage.at_rest.size(), particles);
      EXPECT_EQ(cloth.damage.parents.size(), particles);
      EXPECT_EQ(cloth.damage.outer.size(), springs);
      EXPECT_EQ(cloth.damage.released.size(), springs);
      EXPECT_EQ(cloth.damage.strength.size(), springs);
    }
  }
}

TEST(EditedCloth, KnowsItsOnePointConnections)
{
  for (const NamedModel& named : everyConfiguration())
  {
    const Cloth before = clothOf(named.model);
    for (const auto& edit : editsOf(before.mesh))
    {
      Cloth cloth = before;

      cloth.follow(edit(cloth.mesh));

      for (int i = 0; i < cloth.mesh.particleCount(); ++i)
      {
        EXPECT_EQ(cloth.damage.hinge[i] != 0, cloth.mesh.fans({ i }).size() > 1) << named.name;
      }
    }
  }
}

TEST(EditedCloth, HoldsTheOriginalAndNotTheCopyWhetherPinnedOrGrasped)
{
  for (const Attachment::Kind kind : { Attachment::Kind::PIN, Attachment::Kind::GRASP })
  {
    for (const NamedModel& named : everyConfiguration())
    {
      Cloth before = clothOf(named.model);
      for (int i = 0; i < before.mesh.particleCount(); ++i)
      {
        before.attach({ i }, { kind, 7 });
      }
      for (const auto& edit : editsOf(before.mesh))
      {
        Cloth cloth = before;

        cloth.follow(edit(cloth.mesh));

        EXPECT_TRUE(isSound(cloth.mesh)) << named.name;
        for (int i = 0; i < cloth.mesh.particleCount(); ++i)
        {
          const bool original = i < before.mesh.particleCount();
          EXPECT_EQ(cloth.attachments[i].held(), original) << named.name;
          EXPECT_EQ(cloth.state.inverse_mass[i] == 0, original) << named.name;
        }
      }
    }
  }
}

TEST(EditedCloth, GivesAReleasedSpringATwinThatIsReleasedToo)
{
  Cloth cloth = clothOf(openFan({ 0, 40, 90, 120, 170 }));
  const SpringId s = springBetween(cloth.mesh, 0, 3);
  cloth.release(s);

  const Edit edit = cloth.mesh.detachAlong({ 0 }, s);
  cloth.follow(edit);

  const int twin = edit.springs[0].id.index;
  EXPECT_TRUE(cloth.damage.released[twin]);
  EXPECT_FALSE(cloth.springs.structural[twin].active());
  EXPECT_FALSE(cloth.springs.structural[s.index].active());
}

TEST(EditedCloth, HasNoBendShearSpringAcrossATriangleThatMayBeDrawnOutToAnyLength)
{
  Cloth cloth = clothOf(openFan({ 0, 40, 90 }));
  const SpringId between = springBetween(cloth.mesh, 0, 2);  // 1 and 3 lie opposite

  cloth.release(springBetween(cloth.mesh, 0, 1));
  EXPECT_TRUE(cloth.springs.bend_shear[between.index].active()) << "2 still holds 1";
  cloth.release(springBetween(cloth.mesh, 1, 2));
  EXPECT_FALSE(cloth.springs.bend_shear[between.index].active()) << "nothing holds 1 any more";

  Material other = cloth.material;
  other.stiffness *= 2.0;
  cloth.setMaterial(other);
  EXPECT_FALSE(cloth.springs.bend_shear[between.index].active()) << "nor with other stiffness";
}

TEST(EditedCloth, KnowsWhichBordersATearHasOpened)
{
  Cloth cloth = clothOf(openFan({ 0, 40, 90, 120, 170 }));

  const Edit edit = cloth.mesh.detachAlong({ 0 }, springBetween(cloth.mesh, 0, 3));
  cloth.follow(edit);

  EXPECT_FALSE(cloth.damage.outer[springBetween(cloth.mesh, 0, 3).index]);
  EXPECT_FALSE(cloth.damage.outer[edit.springs[0].id.index]);
  EXPECT_TRUE(cloth.damage.outer[springBetween(cloth.mesh, 0, 1).index]);
}

}  // namespace
}  // namespace cloth
