// Claims of pieces: what hangs together through particles is one.
#include "cloth_tearing/core/pieces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "small_meshes.h"

namespace cloth
{
namespace
{

/// A grid of particles 0 to 15 and, apart from it, a kite of 16 to 19.
ClothModel twoSheets()
{
  return beside(sheet(4, 4, RectanglePattern::ONE_DIAGONAL), kite(), 10.0);
}

TEST(Pieces, AreOneWhereverTrianglesShareAParticle)
{
  for (const NamedModel& named : everyConfiguration())
  {
    EXPECT_EQ(countPieces(meshOf(named.model)), 1) << named.name;
  }
  EXPECT_EQ(countPieces(meshOf(twoSheets())), 2);
}

TEST(Pieces, HoldAllTheirParticlesOnce)
{
  const Mesh mesh = meshOf(twoSheets());
  Pieces pieces;

  std::vector<ParticleId> grid = pieces.pieceOf(mesh, { 5 });
  std::vector<ParticleId> other = pieces.pieceOf(mesh, { 18 });

  std::sort(grid.begin(), grid.end());
  std::sort(other.begin(), other.end());
  ASSERT_EQ(grid.size(), 16u);
  ASSERT_EQ(other.size(), 4u);
  EXPECT_EQ(grid.front().index, 0);
  EXPECT_EQ(grid.back().index, 15);
  EXPECT_EQ(other.front().index, 16);
}

TEST(Pieces, PartWhereAOnePointCutLeavesNoOtherWay)
{
  Mesh mesh = meshOf(bowTie(2, 2));

  const Edit edit = mesh.separateFans({ 0 });

  Pieces pieces;
  const auto loose = pieces.parted(mesh, { 0 }, edit.particles[0].id);
  ASSERT_TRUE(loose.has_value());
  EXPECT_EQ(loose->size(), 4u);
  EXPECT_EQ(countPieces(mesh), 2);
}

TEST(Pieces, StayOneWhereTheFansHangTogetherElsewhere)
{
  Mesh mesh = meshOf(sheet(5, 5, RectanglePattern::ONE_DIAGONAL));
  const Fan fan = mesh.fans({ 12 })[0];
  const ParticleId far = mesh.spring(fan.springs[0]).other({ 12 });
  mesh.openAlong({ 12 }, fan.springs[0], fan.springs[3]);
  const Fan next = mesh.fans(far)[0];  // a slit of two edges ends here: run it on to the border
  const SpringId on = next.springs[next.springs.size() / 2];
  const ParticleId hinge = mesh.spring(on).other(far);
  mesh.detachAlong(far, on);
  ASSERT_EQ(mesh.fanCount(hinge), 2) << "the tear has come to the border";

  const Edit cut = mesh.separateFans(hinge);

  Pieces pieces;
  EXPECT_FALSE(pieces.parted(mesh, hinge, cut.particles[0].id).has_value());
  EXPECT_EQ(countPieces(mesh), 1);
}

TEST(Pieces, GiveTheSmallerOneFromEitherSide)
{
  ClothModel model = bowTie(2, 1);
  for (int i = 0; i < 8; ++i)  // the second fan grows a tail
  {
    const int last = static_cast<int>(model.positions.size()) - 1;
    model.positions.emplace_back(3.0 + i, i % 2, 0);
    model.triangles.push_back({ i % 2 == 0 ? std::array<int, 3>{ last, last - 1, last + 1 }
                                           : std::array<int, 3>{ last - 1, last, last + 1 },
                                { Vec2d(0, 0), Vec2d(1, 0), Vec2d(0, 1) } });
  }
  Mesh mesh = meshOf(model);
  const ParticleId copy = mesh.separateFans({ 0 }).particles[0].id;

  Pieces pieces;
  const auto one = pieces.parted(mesh, { 0 }, copy);
  const auto other = pieces.parted(mesh, copy, { 0 });

  ASSERT_TRUE(one && other);
  EXPECT_EQ(one->size(), 3u);
  EXPECT_EQ(other->size(), 3u);
}

}  // namespace
}  // namespace cloth
