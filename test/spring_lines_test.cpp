// Claims about lines of springs side by side, and about the loop that solves them.
#include "cloth_tearing/core/spring_lines.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/core/spring_blocks.h"
#include "small_meshes.h"
#include "sweep_motion.h"

namespace cloth
{
namespace
{

using kernels::LANES;

std::array<int, 2> sorted(int a, int b)
{
  return { std::min(a, b), std::max(a, b) };
}

/// Goes over the lanes that have springs: visit(ladder, rung, lane, link).
template <class Visit>
void forEachLane(const SpringLines& lines, const Visit& visit)
{
  for (const SpringLadder& ladder : lines.ladders())
  {
    for (int rung = 0; rung < ladder.rungs(); ++rung)
    {
      for (int lane = 0; lane < LANES; ++lane)
      {
        if (ladder.links[rung][lane] >= 0)
        {
          visit(ladder, rung, lane, ladder.links[rung][lane]);
        }
      }
    }
  }
}

int springsIn(const SpringLines& lines)
{
  int count = 0;
  forEachLane(lines, [&](const SpringLadder&, int, int, int) { ++count; });
  return count;
}

/// No particle is twice in a phase.
std::string sharedParticles(const SpringLines& lines)
{
  for (std::size_t phase = 0; phase + 1 < lines.phases().size(); ++phase)
  {
    std::set<int> touched;
    for (int i = lines.phases()[phase]; i < lines.phases()[phase + 1]; ++i)
    {
      const SpringLadder& ladder = lines.ladders()[i];
      for (int k = 0; k < LANES * ladder.nodes(); ++k)
      {
        const int particle = ladder.particle(k / LANES, k % LANES);
        if (particle >= 0 && !touched.insert(particle).second)
        {
          return " particle " + std::to_string(particle) + " twice in a phase";
        }
      }
    }
  }
  return "";
}

/// Lanes without a spring that pull all the same.
std::string strayLanes(const SpringLines& lines)
{
  std::string stray;
  for (const SpringLadder& ladder : lines.ladders())
  {
    for (int k = 0; k < LANES * ladder.rungs(); ++k)
    {
      const int rung = k / LANES;
      const int lane = k % LANES;
      const bool pulls =
          ladder.lanes[rung].stiffness[lane] != 0 || ladder.lanes[rung].damping[lane] != 0;
      stray += ladder.links[rung][lane] < 0 && pulls ? " a lane pulls that has no spring" : "";
    }
  }
  return stray;
}

/// Every spring lies in one lane of the lines or in the blocks, that lane is what the spring is and
/// joins its ends, the others pull nothing, and no particle is twice in a phase.
testing::AssertionResult areSound(const SpringLines& lines, const SpringBlocks& blocks,
                                  const SpringTable& springs)
{
  std::string wrong = sharedParticles(lines) + strayLanes(lines);
  std::map<int, int> found;
  forEachLane(lines,
              [&](const SpringLadder& ladder, int rung, int lane, int link)
              {
                ++found[link];
                const SpringLaw& law = lawOf(springs, link);
                const kernels::Lanes& lanes = ladder.lanes[rung];
                const bool same = sorted(ladder.particle(rung, lane),
                                         ladder.particle(rung + 1, lane)) == sorted(law.a, law.b) &&
                                  law.active() && lanes.rest[lane] == law.rest &&
                                  lanes.stiffness[lane] == law.stiffness &&
                                  lanes.damping[lane] == law.damping;
                wrong += same && lines.has(link) ? "" : " link " + std::to_string(link);
              });
  for (const SpringGroup& group : blocks.groups())
  {
    for (const auto* all : { &group.run_links, &group.loose_links })
    {
      for (const Links& links : *all)
      {
        for (int link : links)
        {
          found[link] += link >= 0 ? 1 : 0;
        }
      }
    }
  }
  for (int link = 0; link < 2 * static_cast<int>(springs.structural.size()); ++link)
  {
    if (found[link] != (lawOf(springs, link).active() ? 1 : 0))
    {
      wrong += " link " + std::to_string(link) + " lies in " + std::to_string(found[link]);
    }
  }
  return wrong.empty() ? testing::AssertionSuccess() : testing::AssertionFailure() << wrong;
}

/// Lines and the blocks of all other springs.
struct Arrangement
{
  SpringLines lines;
  SpringBlocks blocks;

  explicit Arrangement(const Cloth& cloth)
      : lines(cloth.springs, cloth.state.position), blocks(cloth.springs, cloth.state.size(), lines)
  {
  }

  Arrangement(const Cloth& cloth, const Arrangement& saved)
      : lines(cloth.springs, cloth.state.size(), saved.lines.toNumbers())
      , blocks(cloth.springs, cloth.state.size(), saved.blocks.toNumbers(), lines)
  {
  }

  void follow(Cloth& cloth)
  {
    std::vector<int> changed;
    ASSERT_TRUE(cloth.springs.changes.since(0, changed));
    lines.follow(cloth.springs, changed);
    blocks.follow(cloth.springs, cloth.state.size(), changed, lines);
    cloth.springs.changes = {};
  }
};

/// Splits and releases springs here and there; lines and blocks follow.
void tearAround(Cloth& cloth, Arrangement& arrangement, int tears, std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  for (int tear = 0; tear < tears; ++tear)
  {
    const SpringId s{ static_cast<int>(random() % cloth.mesh.springCount()) };
    if (random() % 8 == 0)
    {
      cloth.springs.release(s);
    }
    else
    {
      cloth.follow(cloth.mesh.splitSpring(s));
    }
    arrangement.follow(cloth);
  }
}

Cloth sheetOf(int side, RectanglePattern pattern)
{
  return clothOf(sheet(side, side, pattern));
}

class Lines : public ::testing::TestWithParam<RectanglePattern>
{
};

INSTANTIATE_TEST_SUITE_P(OfSprings, Lines,
                         ::testing::Values(RectanglePattern::ONE_DIAGONAL,
                                           RectanglePattern::ALTERNATING,
                                           RectanglePattern::IRREGULAR));

TEST_P(Lines, AndBlocksHoldEachSpringOnce)
{
  for (int side : { 2, 5, 17, 30, 100 })
  {
    const Cloth cloth = sheetOf(side, GetParam());
    const Arrangement arrangement(cloth);
    EXPECT_TRUE(areSound(arrangement.lines, arrangement.blocks, cloth.springs)) << side;
  }
}

TEST_P(Lines, HoldMostSprings)
{
  const Cloth cloth = sheetOf(60, GetParam());
  const double share = double(springsIn(Arrangement(cloth).lines)) / cloth.mesh.springCount();
  EXPECT_GT(share, GetParam() == RectanglePattern::IRREGULAR ? 0.9 : 0.999);
}

TEST_P(Lines, StaySoundWhileTheClothIsTorn)
{
  Cloth cloth = sheetOf(60, GetParam());
  Arrangement arrangement(cloth);
  const int before = springsIn(arrangement.lines);
  for (int i = 0; i < 10; ++i)
  {
    tearAround(cloth, arrangement, 60, i);
    ASSERT_TRUE(areSound(arrangement.lines, arrangement.blocks, cloth.springs)) << i;
  }
  EXPECT_LT(springsIn(arrangement.lines), before - 300) << "what was torn has left";
}

TEST_P(Lines, GoOnFromTheirNumbersAsIfTheyHadNeverStopped)
{
  Cloth cloth = sheetOf(60, GetParam());
  Arrangement arrangement(cloth);
  tearAround(cloth, arrangement, 100, 1);
  Cloth other_cloth = cloth;
  Arrangement other(cloth, arrangement);
  ASSERT_EQ(other.lines.toNumbers(), arrangement.lines.toNumbers());

  tearAround(cloth, arrangement, 200, 2);
  tearAround(other_cloth, other, 200, 2);

  EXPECT_TRUE(areSound(other.lines, other.blocks, other_cloth.springs));
  EXPECT_EQ(other.lines.toNumbers(), arrangement.lines.toNumbers());
  EXPECT_EQ(other.blocks.toNumbers(), arrangement.blocks.toNumbers());
}

TEST_P(Lines, AreRefusedOrSoundWhateverTheNumbersAre)
{
  Cloth cloth = sheetOf(20, GetParam());
  Arrangement arrangement(cloth);
  tearAround(cloth, arrangement, 30, 1);
  const std::vector<int> numbers = arrangement.lines.toNumbers();
  const int particles = cloth.state.size();
  std::mt19937_64 random(7);
  int refused = 0;
  for (int attempt = 0; attempt < 2000; ++attempt)
  {
    std::vector<int> changed = numbers;
    changed[random() % changed.size()] = static_cast<int>(random() % 3000) - 100;
    if (attempt % 10 == 0)
    {
      changed.resize(random() % changed.size());
    }
    try
    {
      const SpringLines read(cloth.springs, particles, changed);
      const SpringBlocks blocks(cloth.springs, particles, read);
      ASSERT_TRUE(areSound(read, blocks, cloth.springs)) << attempt;
    }
    catch (const Refusal&)
    {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1500);
}

TEST(SpringLines, AreRefusedWhenBlocksHaveTheirSpringsAsWell)
{
  const Cloth cloth = sheetOf(20, RectanglePattern::ONE_DIAGONAL);
  const SpringLines lines(cloth.springs, cloth.state.position);
  const std::vector<int> all = SpringBlocks(cloth.springs, cloth.state.size()).toNumbers();
  try
  {
    SpringBlocks(cloth.springs, cloth.state.size(), all, lines);
    FAIL() << "must be refused";
  }
  catch (const Refusal& refusal)
  {
    EXPECT_NE(std::string(refusal.what()).find("lies in a line as well"), std::string::npos);
  }
}

TEST(SpringLines, AreSharedOutToManyLaddersAtATime)
{
  const Cloth cloth = sheetOf(100, RectanglePattern::ONE_DIAGONAL);
  const SpringLines lines(cloth.springs, cloth.state.position);
  int most = 0;
  int side_by_side = 0;
  for (std::size_t phase = 0; phase + 1 < lines.phases().size(); ++phase)
  {
    most = std::max(most, lines.phases()[phase + 1] - lines.phases()[phase]);
  }
  for (const SpringLadder& ladder : lines.ladders())
  {
    side_by_side += ladder.sideBySide() ? ladder.rungs() : 0;
  }
  EXPECT_LE(lines.phases().size(), 6u);
  EXPECT_GE(most, 6);
  EXPECT_GE(side_by_side, 6 * 99 + 6 * 99) << "columns and diagonals lie side by side in memory";
}

TEST(SpringLines, RunStraightThroughAGrid)
{
  const Cloth cloth = sheetOf(12, RectanglePattern::ONE_DIAGONAL);
  const std::vector<SpringLine> lines = findLines(cloth.springs, cloth.state.position);
  ASSERT_EQ(lines.size(), 12u + 12u + 17u) << "rows, columns, diagonals of three springs and more";
  EXPECT_LT(unbraced(lines, cloth.springs, cloth.state.position), 0.02);
}

TEST(SpringLines, RoundATubeAreCutOnce)
{
  SpringTable springs;
  Vec3Array places;
  const int count = 30;
  for (int i = 0; i < count; ++i)
  {
    const double angle = 2.0 * M_PI * i / count;
    places.push_back(
        Vec3(static_cast<Real>(std::cos(angle)), static_cast<Real>(std::sin(angle)), 0));
    springs.structural.push_back({ i, (i + 1) % count, Real(0.2), Real(1), 0 });
  }
  springs.bend_shear.resize(count);

  const std::vector<SpringLine> lines = findLines(springs, places);

  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].springs.size(), count - 1u) << "no particle is twice in a line";
}

// -- the loop -------------------------------------------------------------------------------------

/// Everything that solving all ladders leaves behind, bit for bit.
std::vector<unsigned> sweep(const kernels::Set& loops, const SpringLines& lines, Motion motion)
{
  const kernels::Particles particles = motion.particles();
  std::vector<unsigned> left;
  for (const SpringLadder& ladder : lines.ladders())
  {
    std::vector<kernels::Note> notes(ladder.rungs());
    std::vector<kernels::Rung> rungs(ladder.rungs());
    std::vector<kernels::Node> nodes(ladder.nodes());
    int noted = 0;
    if (ladder.sideBySide())
    {
      noted = loops.sweep_ladder(
          { ladder.first, ladder.step, ladder.rungs(), ladder.lanes.data(), nullptr }, particles,
          1e-2F, rungs.data(), notes.data());
    }
    else
    {
      kernels::Particles copies = particles;
      for (int k = 0; k < 3; ++k)
      {
        copies.way[k] = nodes[0].way[k];
        copies.start[k] = nodes[0].start[k];
      }
      copies.inverse_mass = nodes[0].inverse_mass;
      loops.pack_nodes(particles, ladder.nodeList(), nodes.data());
      noted = loops.sweep_ladder({ 0, sizeof(kernels::Node) / sizeof(float), ladder.rungs(),
                                   ladder.lanes.data(), ladder.particles.data() },
                                 copies, 1e-2F, rungs.data(), notes.data());
      loops.unpack_nodes(particles, ladder.nodeList(), nodes.data());
    }
    for (int i = 0; i < noted; ++i)
    {
      left.push_back(notes[i].block);
      left.push_back(notes[i].lanes);
    }
  }
  motion.appendTo(left);
  return left;
}

TEST_P(Lines, AreSolvedToTheSameBitsByAllLoops)
{
  const kernels::Set* const* sets = nullptr;
  const std::size_t count = kernels::available(sets);
  for (int side : { 5, 30, 70 })
  {
    Cloth cloth = sheetOf(side, GetParam());
    Arrangement arrangement(cloth);
    tearAround(cloth, arrangement, 20, 3);
    arrangement.lines.watch(cloth.springs, 1.0001F);
    const Motion motion(cloth, 11);
    const std::vector<unsigned> expected = sweep(*sets[0], arrangement.lines, motion);
    for (std::size_t i = 1; i < count; ++i)
    {
      EXPECT_EQ(sweep(*sets[i], arrangement.lines, motion), expected)
          << sets[i]->name << ", side " << side;
    }
  }
}

}  // namespace
}  // namespace cloth
