// Claims of determinism: the same bits in every run, on any number of threads, with registers of
// any width, by any compiler, at every level of optimisation, and on any day.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "child_process.h"
#include "cloth_tearing/core/kernels.h"
#include "cloth_tearing/core/worker_pool.h"
#include "determinism_scenes.h"

namespace cloth
{
namespace
{

using Lines = std::vector<std::string>;

Lines linesOf(const std::vector<SceneMoment>& moments)
{
  Lines lines;
  for (const SceneMoment& moment : moments)
  {
    lines.push_back(moment.line());
  }
  return lines;
}

/// Played once, as all here on one thread.
const Lines& smallScenes()
{
  static const Lines lines = linesOf(playScenes());
  return lines;
}

const Lines& largeScenes()
{
  static const Lines lines = linesOf(playLargeScenes(1));
  return lines;
}

Lines allScenes()
{
  Lines lines = smallScenes();
  lines.insert(lines.end(), largeScenes().begin(), largeScenes().end());
  return lines;
}

/// What a program says that plays the scenes, but for its first line, which names its loops.
Lines scenesOf(const Lines& command, const std::string& loops)
{
  ChildProcess program(command, 200);
  Lines lines = program.lines();
  EXPECT_EQ(program.exitStatus(), 0) << command.back();
  if (lines.empty())
  {
    ADD_FAILURE() << command.back() << " says nothing";
    return lines;
  }
  EXPECT_EQ(lines.front(), "loops: " + loops);
  lines.erase(lines.begin());
  return lines;
}

bool runsHere(const std::string& loops)
{
  const kernels::Set* const* sets = nullptr;
  const std::size_t count = kernels::available(sets);
  return std::any_of(sets, sets + count,
                     [&](const kernels::Set* set) { return set->name == loops; });
}

TEST(Determinism, GivesTheSameBitsInEveryRun)
{
  EXPECT_EQ(smallScenes().size(), 45u);
  EXPECT_EQ(linesOf(playScenes()), smallScenes());
}

/// How four scenes end: one of each solver, and one that threads share.
const char* const GOLDEN = CLOTH_TEARING_SOURCE_DIR "/test/golden_hashes.txt";

bool isGolden(const std::string& line)
{
  const Lines ends = { "xpbd shoot step 500", "force_springs drag step 500",
                       "xpbd_lines drape step 500", "large xpbd irregular step 120" };
  return std::any_of(ends.begin(), ends.end(),
                     [&line](const std::string& end) { return line.rfind(end + " ", 0) == 0; });
}

/// Renewed with CLOTH_TEARING_RENEW_GOLDEN_HASHES=1: only when cloth is meant to move otherwise.
TEST(Determinism, GivesTheBitsInStore)
{
  Lines now = allScenes();
  now.erase(std::remove_if(now.begin(), now.end(),
                           [](const std::string& line) { return !isGolden(line); }),
            now.end());
  ASSERT_EQ(now.size(), 4u);
  if (std::getenv("CLOTH_TEARING_RENEW_GOLDEN_HASHES") != nullptr)
  {
    std::ofstream file(GOLDEN);
    file << "# How four scenes end, written by determinism_test.\n";
    for (const std::string& line : now)
    {
      file << line << "\n";
    }
    GTEST_SKIP() << "wrote " << GOLDEN;
  }
  std::ifstream file(GOLDEN);
  Lines stored;
  for (std::string line; std::getline(file, line);)
  {
    if (isGolden(line))
    {
      stored.push_back(line);
    }
  }
  EXPECT_EQ(now, stored);
}

TEST(Determinism, IsTestedOnScenesThatTear)
{
  std::vector<SceneMoment> moments = playScenes();
  for (const SceneMoment& moment : playLargeScenes(0))
  {
    moments.push_back(moment);
  }
  for (const SceneMoment& moment : moments)
  {
    const bool tears = moment.name.find("drape") == std::string::npos;
    const bool large = moment.name.find("large") != std::string::npos;
    if (tears && moment.name.find(large ? "step 120" : "step 500") != std::string::npos)
    {
      EXPECT_GT(moment.tears, large ? 100u : 3u) << moment.name;
    }
  }
}

TEST(Determinism, IsTestedOnClothThatAllThreadsShare)
{
  const Simulation cloth =
      determinism::largeCurtain(SolverKind::XPBD, RectanglePattern::ALTERNATING, 1);
  EXPECT_EQ(threadsFor(MOST_SCENE_THREADS, cloth.cloth().state.size()), MOST_SCENE_THREADS);
}

TEST(Determinism, GivesTheSameBitsOnAnyNumberOfThreads)
{
  for (int threads : { 2, 3, MOST_SCENE_THREADS })
  {
    EXPECT_EQ(linesOf(playLargeScenes(threads)), largeScenes()) << threads << " threads";
  }
}

/// By a program that another compiler has made, or ours at another level of optimisation.
void expectSameBits(const std::string& name)
{
  const std::string program = CLOTH_TEARING_SCENES_FOLDER + ("/" + name + "/" + name);
  const bool slow = name.find("O0") != std::string::npos;
  const std::string loops = kernels::best().name;
  SCOPED_TRACE(name);
  EXPECT_EQ(slow ? scenesOf({ program, "--small" }, loops) : scenesOf({ program }, loops),
            slow ? smallScenes() : allScenes());
}

TEST(Determinism, GivesTheSameBitsByAnotherCompilerAndWithLessOptimisation)
{
  expectSameBits("gcc_O2");
  if (!std::ifstream(CLOTH_TEARING_SCENES_FOLDER "/clang_O0/clang_O0").good())
  {
    GTEST_SKIP() << "clang++ was not found: its bits are not compared with those of "
                 << CLOTH_TEARING_COMPILER;
  }
  expectSameBits("clang_O0");
}

TEST(Determinism, GivesTheSameBitsByAllCompilersAtAllLevels)
{
  if (std::getenv("CLOTH_TEARING_THOROUGH") == nullptr)
  {
    GTEST_SKIP() << "the whole matrix is for scripts/test --thorough";
  }
  for (const char* compiler : { "gcc", "clang" })
  {
    for (const char* level : { "_O0", "_O1", "_O2", "_O3" })
    {
      expectSameBits(std::string(compiler) + level);
    }
  }
}

class DeterminismOfLoops : public testing::TestWithParam<const char*>
{
};

TEST_P(DeterminismOfLoops, GiveTheSameBitsAsTheWidest)
{
  const std::string loops = GetParam();
  if (!runsHere(loops))
  {
    GTEST_SKIP() << "this processor has no " << loops << ": its bits are not compared";
  }
  EXPECT_EQ(scenesOf({ "env", "CLOTH_TEARING_SIMD=" + loops, CLOTH_TEARING_SCENES }, loops),
            allScenes());
}

INSTANTIATE_TEST_SUITE_P(All, DeterminismOfLoops, testing::Values("plain", "avx2", "avx512"),
                         [](const auto& loops) { return std::string(loops.param); });

}  // namespace
}  // namespace cloth
