// Claims of determinism: the same bits in every run and at every level of optimisation.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstring>

#include "determinism_scenes.h"

namespace cloth
{
namespace
{

/// What a program prints, line by line.
std::vector<std::string> linesOf(const std::string& program)
{
  std::vector<std::string> lines;
  FILE* pipe = popen(("'" + program + "'").c_str(), "r");
  if (pipe == nullptr)
  {
    return lines;
  }
  std::array<char, 512> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr)
  {
    lines.emplace_back(buffer.data(), std::strcspn(buffer.data(), "\n"));
  }
  EXPECT_EQ(pclose(pipe), 0) << program;
  return lines;
}

TEST(Determinism, GivesTheSameBitsInEveryRun)
{
  const std::vector<SceneMoment> first = playScenes();
  const std::vector<SceneMoment> second = playScenes();
  ASSERT_EQ(first.size(), 30u);
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    EXPECT_EQ(first[i].line(), second[i].line());
  }
}

TEST(Determinism, IsTestedOnScenesThatTear)
{
  for (const SceneMoment& moment : playScenes())
  {
    const bool tears = moment.name.find("drape") == std::string::npos;
    if (tears && moment.name.find("step 500") != std::string::npos)
    {
      EXPECT_GT(moment.tears, 5u) << moment.name;
    }
  }
}

TEST(Determinism, GivesTheSameBitsWithoutOptimisation)
{
  const std::vector<std::string> unoptimised = linesOf(CLOTH_TEARING_UNOPTIMISED_SCENES);
  const std::vector<SceneMoment> here = playScenes();
  ASSERT_EQ(unoptimised.size(), here.size());
  for (std::size_t i = 0; i < here.size(); ++i)
  {
    EXPECT_EQ(unoptimised[i], here[i].line());
  }
}

}  // namespace
}  // namespace cloth
