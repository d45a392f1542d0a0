// What thesis_experiments is told, and what it writes: refusals name the option; files read back.
#include "experiment_options.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "cloth_tearing/core/obj_reader.h"
#include "experiment_output.h"

namespace cloth
{
namespace
{

struct BadInput
{
  std::vector<std::string> arguments;
  std::vector<std::string> words;  ///< that the refusal has to say
};

TEST(Options, RefuseNonsenseUnderTheOptionsName)
{
  const std::vector<BadInput> all = {
    { { "--mesh", "foo" }, { "--mesh", "\"foo\"", "one_diagonal", "all" } },
    { { "--mesh", "all,irregular" }, { "--mesh", "\"all\"" } },
    { { "--grading", "9" }, { "--grading", "9", "0.2 to 5" } },
    { { "--grading", "nan" }, { "--grading", "nan" } },
    { { "--time-step", "0" }, { "--time-step", "0", "1e-05 to 0.1" } },
    { { "--time-step", "0.001,inf" }, { "--time-step", "inf" } },
    { { "--resolution", "3" }, { "--resolution", "3", "4 to 500" } },
    { { "--resolution", "30.5" }, { "--resolution", "30.5" } },
    { { "--resolution", "30,," }, { "--resolution", "\"\"" } },
    { { "--resolution", "thirty" }, { "--resolution", "\"thirty\"", "number" } },
    { { "--seed", "-1" }, { "--seed", "-1" } },
    { { "--solver", "pbd" }, { "--solver", "\"pbd\"", "xpbd", "xpbd_lines", "force_springs" } },
    { { "--sead", "1" }, { "--sead" } },
    { { "--output" }, { "--output", "needs a value" } },
    { { "balls", "map" }, { "one experiment", "balls", "map" } },
  };
  for (const BadInput& bad : all)
  {
    try
    {
      parseOptions(bad.arguments);
      ADD_FAILURE() << bad.arguments.front() << " " << bad.arguments.back() << " passes";
    }
    catch (const UsageError& refusal)
    {
      for (const std::string& word : bad.words)
      {
        EXPECT_NE(std::string(refusal.what()).find(word), std::string::npos)
            << refusal.what() << ": says nothing of " << word;
      }
    }
  }
}

TEST(Options, CombineAllThatIsListed)
{
  const Options options = parseOptions({ "balls", "--resolution", "20,30", "--mesh", "all",
                                         "--seed", "4,5", "--time-step", "0.001,0.002" });

  const std::vector<Setting> settings = options.settings({ 40 }, {}, { 1 });

  // Per resolution and time step: two meshes that have no seed, and two irregular ones.
  ASSERT_EQ(settings.size(), 2u * 2u * 4u);
  std::set<std::string> files;
  for (const Setting& setting : settings)
  {
    files.insert(fileName(setting));
    EXPECT_EQ(setting.grading, 1.0);
  }
  EXPECT_EQ(files.size(), settings.size()) << "each has a file name of its own";
}

TEST(FileName, TellsApartAllThatCanDiffer)
{
  Setting graded;
  graded.grading = 2.0;
  Setting other_solver;
  other_solver.solver = SolverKind::FORCE_SPRINGS;
  Setting other_step;
  other_step.time_step = 0.0005;
  Setting other_seed;
  other_seed.seed = 2;

  EXPECT_EQ(fileName(Setting()), "one_diagonal_30_1");
  EXPECT_EQ(fileName(graded), "one_diagonal_30_1_grading_2");
  EXPECT_EQ(fileName(other_solver), "one_diagonal_30_1_force_springs");
  EXPECT_EQ(fileName(other_step), "one_diagonal_30_1_dt_0.0005");
  EXPECT_EQ(fileName(other_seed), "one_diagonal_30_2");
}

/// A folder of its own that goes with it.
class Folder : public ::testing::Test
{
protected:
  void TearDown() override { std::filesystem::remove_all(path_); }

  const std::filesystem::path path_ =
      std::filesystem::path(::testing::TempDir()) /
      ("experiment_options_test_" +
       std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
};

using OutputFolder = Folder;

TEST_F(OutputFolder, HasATableThatReadsBack)
{
  {
    Output output(path_.string(), "table.csv");
    output.row({ { "mesh", "irregular" }, { "angle", text(37.5) } });
    output.row({ { "mesh", "alternating" }, { "angle", "" } });
  }

  std::ifstream file(path_ / "table.csv");
  std::stringstream all;
  all << file.rdbuf();
  EXPECT_EQ(all.str(), "mesh,angle\nirregular,37.5\nalternating,\n");
}

TEST_F(OutputFolder, HasClothsWithTheirTexture)
{
  Setting setting;
  setting.resolution = 6;
  const Simulation simulation = hungSheet(thesisSheet(setting), thesisParams(setting));

  Output(path_.string(), "table.csv").snapshot("cloth.obj", simulation);

  std::ifstream file(path_ / "cloth.obj");
  const ClothModel model = readObj(file, "cloth.obj").model;
  ASSERT_EQ(model.positions.size(), 36u);
  const Mesh& mesh = simulation.cloth().mesh;
  ASSERT_EQ(model.triangles.size(), static_cast<std::size_t>(mesh.triangleCount()));
  for (int t = 0; t < mesh.triangleCount(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_LT((model.triangles[t].uv[k] - mesh.triangle({ t }).uv[k]).norm(), 1e-6) << t;
    }
  }
}

TEST_F(OutputFolder, IsRefusedWhereAFileIs)
{
  std::ofstream(path_) << "a file";

  try
  {
    Output output(path_.string(), "table.csv");
    ADD_FAILURE() << "a file passes for a folder";
  }
  catch (const UsageError& refusal)
  {
    EXPECT_NE(std::string(refusal.what()).find("--output is " + path_.string()), std::string::npos)
        << refusal.what();
  }
}

}  // namespace
}  // namespace cloth
