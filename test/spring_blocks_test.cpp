// Claims about the blocks that springs are solved in, and about the loops that solve them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "cloth_tearing/core/cloth.h"
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

/// Goes over the lanes that have springs: visit(group, block, lane, link, ends, lanes).
template <class Visit>
void forEachLane(const SpringBlocks& blocks, const Visit& visit)
{
  for (std::size_t g = 0; g < blocks.groups().size(); ++g)
  {
    const SpringGroup& group = blocks.groups()[g];
    for (std::size_t i = 0; i < group.run_links.size(); ++i)
    {
      for (int lane = 0; lane < LANES; ++lane)
      {
        const kernels::RunEnds& ends = group.run_ends[i];
        if (group.run_links[i][lane] >= 0)
        {
          visit(g, 2 * i, lane, group.run_links[i][lane], sorted(ends.a + lane, ends.b + lane),
                group.run_lanes[i]);
        }
      }
    }
    for (std::size_t i = 0; i < group.loose_links.size(); ++i)
    {
      for (int lane = 0; lane < LANES; ++lane)
      {
        const kernels::RecordEnds& ends = group.loose_ends[i];
        if (group.loose_links[i][lane] >= 0)
        {
          visit(g, 2 * i + 1, lane, group.loose_links[i][lane],
                sorted(group.particles[ends.a[lane]], group.particles[ends.b[lane]]),
                group.loose_lanes[i]);
        }
      }
    }
  }
}

/// Every spring that carries something lies in one lane, that lane is what the spring is, and no
/// two springs of a block share a particle.
testing::AssertionResult areSound(const SpringBlocks& blocks, const SpringTable& springs)
{
  std::map<int, int> found;
  std::map<std::pair<std::size_t, std::size_t>, std::set<int>> touched;
  std::string wrong;
  forEachLane(blocks,
              [&](std::size_t group, std::size_t block, int lane, int link,
                  const std::array<int, 2>& ends, const kernels::Lanes& lanes)
              {
                const SpringLaw& law = lawOf(springs, link);
                ++found[link];
                const bool same = ends == sorted(law.a, law.b) && lanes.rest[lane] == law.rest &&
                                  lanes.stiffness[lane] == law.stiffness &&
                                  lanes.damping[lane] == law.damping;
                const bool inside =
                    ends[0] >= blocks.groups()[group].begin && ends[1] < blocks.groups()[group].end;
                const bool alone = touched[{ group, block }].insert(ends[0]).second &&
                                   touched[{ group, block }].insert(ends[1]).second;
                if (!same || !inside || !alone)
                {
                  wrong += " link " + std::to_string(link);
                }
              });
  for (int link = 0; link < 2 * static_cast<int>(springs.structural.size()); ++link)
  {
    if (found[link] != (lawOf(springs, link).active() ? 1 : 0))
    {
      wrong += " link " + std::to_string(link) + " lies in " + std::to_string(found[link]);
    }
  }
  return wrong.empty() ? testing::AssertionSuccess() : testing::AssertionFailure() << wrong;
}

double shareInRuns(const SpringBlocks& blocks)
{
  int runs = 0;
  int all = 0;
  forEachLane(blocks,
              [&](std::size_t, std::size_t block, int, int, const std::array<int, 2>&,
                  const kernels::Lanes&)
              {
                runs += block % 2 == 0 ? 1 : 0;
                ++all;
              });
  return double(runs) / all;
}

/// Splits and releases springs here and there; the blocks follow.
void tearAround(Cloth& cloth, SpringBlocks& blocks, int tears, std::uint64_t seed)
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
    std::vector<int> changed;
    ASSERT_TRUE(cloth.springs.changes.since(0, changed));
    blocks.follow(cloth.springs, cloth.state.size(), changed);
    cloth.springs.changes = {};
  }
}

Cloth sheetOf(int side, RectanglePattern pattern)
{
  return clothOf(sheet(side, side, pattern));
}

class Patterns : public ::testing::TestWithParam<RectanglePattern>
{
};

INSTANTIATE_TEST_SUITE_P(SpringBlocks, Patterns,
                         ::testing::Values(RectanglePattern::ONE_DIAGONAL,
                                           RectanglePattern::ALTERNATING,
                                           RectanglePattern::IRREGULAR));

TEST_P(Patterns, HoldEachSpringOnceAndNoTwoAtAParticle)
{
  for (int side : { 2, 5, 30, 100 })
  {
    const Cloth cloth = sheetOf(side, GetParam());
    const SpringBlocks blocks(cloth.springs, cloth.state.size());
    EXPECT_TRUE(areSound(blocks, cloth.springs)) << side;
  }
}

TEST_P(Patterns, StaySoundWhileTheClothIsTorn)
{
  Cloth cloth = sheetOf(70, GetParam());
  SpringBlocks blocks(cloth.springs, cloth.state.size());
  for (int i = 0; i < 20; ++i)
  {
    tearAround(cloth, blocks, 100, i);
    ASSERT_TRUE(areSound(blocks, cloth.springs)) << i;
  }
}

TEST_P(Patterns, GoOnFromTheirNumbersAsIfTheyHadNeverStopped)
{
  Cloth cloth = sheetOf(70, GetParam());
  SpringBlocks blocks(cloth.springs, cloth.state.size());
  tearAround(cloth, blocks, 300, 1);
  Cloth other_cloth = cloth;
  SpringBlocks other(cloth.springs, cloth.state.size(), blocks.toNumbers());
  ASSERT_EQ(other.toNumbers(), blocks.toNumbers());

  tearAround(cloth, blocks, 700, 2);
  tearAround(other_cloth, other, 700, 2);

  EXPECT_TRUE(areSound(other, other_cloth.springs));
  EXPECT_EQ(other.toNumbers(), blocks.toNumbers());
}

TEST_P(Patterns, AreRefusedOrSoundWhateverTheNumbersAre)
{
  Cloth cloth = sheetOf(20, GetParam());
  SpringBlocks blocks(cloth.springs, cloth.state.size());
  tearAround(cloth, blocks, 30, 1);
  const std::vector<int> numbers = blocks.toNumbers();
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
      const SpringBlocks read(cloth.springs, cloth.state.size(), changed);
      ASSERT_TRUE(areSound(read, cloth.springs)) << attempt;
    }
    catch (const Refusal&)
    {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1500);
}

TEST(SpringBlocks, LieInRunsOnAGrid)
{
  const Cloth cloth = sheetOf(100, RectanglePattern::ONE_DIAGONAL);
  EXPECT_GT(shareInRuns(SpringBlocks(cloth.springs, cloth.state.size())), 0.99);
}

TEST(SpringBlocks, OfOnePhaseTouchNoParticleInCommon)
{
  const Cloth cloth = sheetOf(150, RectanglePattern::IRREGULAR);
  const SpringBlocks blocks(cloth.springs, cloth.state.size());
  ASSERT_GT(blocks.phases()[1], 5);
  for (int phase = 0; phase < 3; ++phase)
  {
    for (int g = blocks.phases()[phase] + 1; g < blocks.phases()[phase + 1]; ++g)
    {
      EXPECT_GE(blocks.groups()[g].begin, blocks.groups()[g - 1].end);
    }
  }
}

// -- the loops
// -------------------------------------------------------------------------------------

/// Everything that a sweep over all blocks leaves behind, bit for bit.
std::vector<unsigned> sweep(const kernels::Set& loops, const SpringBlocks& blocks, Motion motion)
{
  const kernels::Particles particles = motion.particles();
  std::vector<unsigned> left;
  for (const SpringGroup& group : blocks.groups())
  {
    std::vector<kernels::Note> notes(group.run_ends.size() + group.loose_ends.size());
    int noted = loops.sweep_runs(particles, group.run_ends.data(), group.run_lanes.data(),
                                 static_cast<int>(group.run_ends.size()), 1e-3F, notes.data());
    std::vector<kernels::Record> way(group.particles.size());
    std::vector<kernels::Record> start(group.particles.size());
    for (std::size_t r = 1; r < group.particles.size(); ++r)
    {
      const int p = group.particles[r];
      way[r] = { motion.way[0][p], motion.way[1][p], motion.way[2][p], motion.inverse_mass[p] };
      start[r] = { motion.start[0][p], motion.start[1][p], motion.start[2][p], 0.0F };
    }
    noted +=
        loops.sweep_records({ way.data(), start.data(), group.particles.data() }, particles.held,
                            group.loose_ends.data(), group.loose_lanes.data(),
                            static_cast<int>(group.loose_ends.size()), 1e-3F, notes.data() + noted);
    for (std::size_t r = 1; r < group.particles.size(); ++r)
    {
      const float values[3] = { way[r].x, way[r].y, way[r].z };
      for (int k = 0; k < 3; ++k)
      {
        motion.way[k][group.particles[r]] = values[k];
      }
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

TEST_P(Patterns, AreSolvedToTheSameBitsByAllLoops)
{
  const kernels::Set* const* sets = nullptr;
  const std::size_t count = kernels::available(sets);
  for (int side : { 3, 30, 70 })
  {
    Cloth cloth = sheetOf(side, GetParam());
    SpringBlocks blocks(cloth.springs, cloth.state.size());
    tearAround(cloth, blocks, 50, 3);
    blocks.watch(cloth.springs, 1.0001F);
    const Motion motion(cloth, 11);
    const std::vector<unsigned> expected = sweep(*sets[0], blocks, motion);
    for (std::size_t i = 1; i < count; ++i)
    {
      EXPECT_EQ(sweep(*sets[i], blocks, motion), expected) << sets[i]->name << ", side " << side;
    }
  }
}

}  // namespace
}  // namespace cloth
