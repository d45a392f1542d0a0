// Bad files and names of files: models, exports and saved states, each beside a good one.
#include <cloth_tearing/Export.h>
#include <cloth_tearing/LoadModel.h>
#include <cloth_tearing/NamedState.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "bad_inputs.h"

using namespace cloth_tearing;  // NOLINT: the messages are what all of this is about
namespace fs = std::filesystem;

namespace
{

const std::string SQUARE =
    "v 0 0 0\nv 0.1 0 0\nv 0.1 -0.1 0\nv 0 -0.1 0\nvt 0 1\nvt 1 1\nvt 1 0\nvt 0 0\n"
    "f 4/4 3/3 2/2 1/1\n";

void put(const fs::path& path, const std::string& bytes)
{
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string contentOf(const fs::path& path)
{
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

/// Puts what cannot be read as a file into a folder. Root may read everything: a file without
/// permission is only for others. @return their names, without the ending
std::vector<std::string> putObstacles(const fs::path& folder, const std::string& ending)
{
  fs::create_directories(folder / ("folder" + ending));
  mkfifo((folder / ("pipe" + ending)).c_str(), 0600);
  fs::create_symlink("nowhere", folder / ("dangling" + ending));
  fs::create_symlink("loop" + ending, folder / ("loop" + ending));
  std::vector<std::string> obstacles = { "folder", "pipe", "dangling", "loop", "missing" };
  if (geteuid() != 0)
  {
    put(folder / ("secret" + ending), SQUARE);
    chmod((folder / ("secret" + ending)).c_str(), 0);
    obstacles.emplace_back("secret");
  }
  return obstacles;
}

class BadFiles : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    root = ros::NodeHandle("~").param<std::string>("folder", "");
    ASSERT_FALSE(root.empty());
    fs::create_directories(root / "models");
    fs::create_directories(root / "exports");
    put(root / "outside.obj", SQUARE);
  }
  static void TearDownTestSuite() { fs::remove_all(root); }
  void SetUp() override { resetCloth(); }

  static fs::path root;
};

fs::path BadFiles::root;  // NOLINT: known once the test has begun

LoadModel::Request model(const std::string& name)
{
  LoadModel::Request request;
  request.model = name;
  request.weld_distance = -1.0;
  return request;
}

BadInput badModel(const std::string& what, const LoadModel::Request& request,
                  std::vector<std::string> words)
{
  return { "load_model: " + what.substr(0, 40),
           [request] { return refusalOf<LoadModel>("load_model", request); }, std::move(words) };
}

NamedState::Request state(const std::string& name, bool file)
{
  NamedState::Request request;
  request.name = name;
  request.file = file;
  return request;
}

BadInput badState(const std::string& service, const std::string& name, bool file,
                  const std::vector<std::string>& words)
{
  return { service + ": " + name.substr(0, 40) + (file ? " as a file" : ""),
           [=] { return refusalOf<NamedState>(service, state(name, file)); }, words };
}

}  // namespace

// -- models ---------------------------------------------------------------------------------------

TEST_F(BadFiles, OfModels)
{
  put(root / "models/square.obj", SQUARE);
  fs::create_symlink(root / "outside.obj", root / "models/out.obj");
  fs::create_directory_symlink(root, root / "models/up");
  BadInputs inputs;
  for (const std::string& path :
       { std::string("../outside.obj"), std::string("/etc/passwd"), std::string("./square.obj"),
         std::string("a//square.obj"), std::string("up/../square.obj"), std::string("square.obj/"),
         std::string("."), std::string(".."), std::string(1001, 'm'),
         std::string("square.obj\0.png", 15) })
  {
    inputs.push_back(badModel(path, model(path), { "model: ", "must" }));
  }
  inputs.push_back(badModel("link", model("out.obj"), { "model out.obj leads out of" }));
  inputs.push_back(
      badModel("link", model("up/outside.obj"), { "model up/outside.obj leads out of" }));
  for (const std::string& obstacle : putObstacles(root / "models", ".obj"))
  {
    inputs.push_back(badModel(obstacle, model(obstacle + ".obj"), { obstacle + ".obj" }));
  }
  const std::string corner = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  const std::vector<std::pair<std::string, std::string>> contents = {
    { "", "" },
    { std::string(1000, '\0'), "" },
    { "\xff\xfe\x00\x01 garbage", "" },
    { corner, "" },
    { corner + "f 1 2\n", "line 4" },
    { corner + "f 1 2 2\n", "line 4" },
    { corner + "f 1 2 4\n", "line 4" },
    { corner + "f 1 2 -4\n", "line 4" },
    { corner + "f 0 1 2\n", "line 4" },
    { corner + "f 1 2 99999999999999999999\n", "line 4" },
    { corner + "f 1 2 3\nf 1 2 3\n", "line" },
    { "v nan 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "line 1" },
    { "v 0 inf 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "line 1" },
    { "v 0 0 1e308\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "line 1" },
    { "v 0 0 1e999\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "line 1" },
    { "v 0 0 2000\nv 1 0 2000\nv 1 1 2000\nf 1 2 3\n", "must be at most 1000" },
    { "v 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "line 1" },
    { "v a b c\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "line 1" },
    { "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n", "" },
    { "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "" },
    { corner + "vt nan 0\nvt 0 0\nvt 1 1\nf 1/1 2/2 3/3\n", "line 4" },
    { corner + "v 0 1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n", "line" },
    { std::string(20000, '#'), "its length [MB] is 0.02, must be at least 0 and at most 0.01" },
  };
  for (std::size_t i = 0; i < contents.size(); ++i)
  {
    const std::string name = "bad_" + std::to_string(i) + ".obj";
    put(root / "models" / name, contents[i].first);
    inputs.push_back(badModel(name, model(name), { name, contents[i].second }));
  }

  const auto send = [](const LoadModel::Request& request)
  { return refusalOf<LoadModel>("load_model", request); };
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double value :
       { std::numeric_limits<double>::quiet_NaN(), infinite, -infinite, -1.0, -1e308, 1e308,
         std::numeric_limits<double>::denorm_min(), -std::numeric_limits<double>::denorm_min() })
  {
    LoadModel::Request request = model("square.obj");
    request.scale = value;
    const bool by_itself = !(value > 0.0) || value == infinite;
    inputs.push_back(badModel(
        "scale " + cloth::text(value), request,
        by_itself ? std::vector<std::string>{ "scale [m] is " + cloth::text(value) + ", must be" }
                  : std::vector<std::string>{ "square.obj" }));
  }
  for (const double value :
       { std::numeric_limits<double>::quiet_NaN(), infinite, -infinite, 1e308 })
  {
    LoadModel::Request request = model("square.obj");
    request.weld_distance = value;
    inputs.push_back(badModel("weld_distance " + cloth::text(value), request,
                              std::isfinite(value)
                                  ? std::vector<std::string>{ "square.obj" }
                                  : std::vector<std::string>{ "weld_distance [m] is " +
                                                              cloth::text(value) + ", must be" }));
  }
  LoadModel::Request none = model("");
  none.scale = 2.0;
  inputs.push_back(badModel("scale of none", none, { "scale is 2, must be 0 without a model" }));
  none = model("");
  none.weld_distance = 0.1;
  inputs.push_back(
      badModel("weld_distance of none", none, { "weld_distance is 0.1, must be 0 or less" }));

  expectRefused(inputs);

  EXPECT_EQ(send(model("square.obj")), "") << "the good one";
  EXPECT_EQ(send(model("")), "") << "and back";
}

// -- exports --------------------------------------------------------------------------------------

TEST_F(BadFiles, OfExports)
{
  const auto exported = [](const std::string& name, bool replace)
  {
    Export::Request request;
    request.name = name;
    request.replace = replace;
    return refusalOf<Export>("export", request);
  };
  ASSERT_EQ(exported("there", false), "") << "the good one";
  ASSERT_EQ(exported("there", true), "") << "and over it";
  const std::string before = contentOf(root / "exports/there.obj");
  fs::create_directories(root / "exports/folder.obj");
  BadInputs inputs;
  for (const std::string& name : badNames())
  {
    inputs.push_back({ "export " + name.substr(0, 40),
                       [=] { return exported(name, true); },
                       { "name is \"", "must be 1 to 64 letters" } });
  }
  inputs.push_back(
      { "export twice", [=] { return exported("there", false); }, { "there.obj exists already" } });
  for (const bool replace : { false, true })
  {
    inputs.push_back(
        { "export to a folder", [=] { return exported("folder", replace); }, { "folder.obj" } });
  }

  expectRefused(inputs);

  EXPECT_EQ(contentOf(root / "exports/there.obj"), before);
  for (const fs::directory_entry& entry : fs::directory_iterator(root / "exports"))
  {
    EXPECT_NE(entry.path().filename().string().front(), '.') << entry << " was left behind";
  }
}

// -- states ---------------------------------------------------------------------------------------

TEST_F(BadFiles, OfStates)
{
  for (const bool file : { false, true })
  {
    ASSERT_EQ(refusalOf<NamedState>("save_state", state("good", file)), "");
  }
  const fs::path states = root / "states";
  const std::string good = contentOf(states / "good.cloth");
  ASSERT_GT(good.size(), 1000u);
  BadInputs inputs;
  for (const bool file : { false, true })
  {
    for (const std::string& name : badNames())
    {
      for (const char* service : { "save_state", "restore_state" })
      {
        inputs.push_back(
            badState(service, name, file, { "name is \"", "must be 1 to 64 letters" }));
      }
    }
  }
  inputs.push_back(
      badState("restore_state", "unknown", false, { "there is no state \"unknown\"" }));
  for (const std::string& obstacle : putObstacles(states, ".cloth"))
  {
    inputs.push_back(
        badState("restore_state", obstacle, true, { "cannot read", obstacle + ".cloth" }));
  }
  inputs.push_back(badState("save_state", "folder", true, { "cannot write", "folder.cloth" }));

  const auto changed = [&good](std::size_t at)
  {
    std::string bytes = good;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x40);
    return bytes;
  };
  const std::vector<std::pair<std::string, std::string>> contents = {
    { "", "this is no saved state" },
    { "CLOTH", "this is no saved state" },
    { std::string(1000, '\0'), "this is no saved state" },
    { std::string(1000, '\xff'), "this is no saved state" },
    { SQUARE, "this is no saved state" },
    { changed(0), "this is no saved state" },
    { changed(8), "the state has format" },
    { changed(12), "the state's numbers are" },
    { changed(20), "the state is damaged: its checksum does not match" },
    { changed(good.size() / 2), "the state is damaged: its checksum does not match" },
    { changed(good.size() - 1), "the state is damaged: its checksum does not match" },
    { good.substr(0, good.size() - 1), "the state is damaged: its checksum does not match" },
    { good.substr(0, good.size() / 2), "the state is damaged: its checksum does not match" },
    { good.substr(0, 24), "the state is damaged: its checksum does not match" },
    { good + '\0', "the state is damaged: its checksum does not match" },
    { good + good, "the state is damaged: its checksum does not match" },
  };
  for (std::size_t i = 0; i < contents.size(); ++i)
  {
    const std::string name = "bad_" + std::to_string(i);
    put(states / (name + ".cloth"), contents[i].first);
    inputs.push_back(badState("restore_state", name, true, { contents[i].second }));
  }
  put(states / "huge.cloth", "");
  fs::resize_file(states / "huge.cloth", 2000000);
  inputs.push_back(badState("restore_state", "huge", true,
                            { "huge.cloth would take 2 MB, max_state_memory is 1 MB" }));
  put(states / "monstrous.cloth", "");
  fs::resize_file(states / "monstrous.cloth", 1000000000000);
  inputs.push_back(badState("restore_state", "monstrous", true,
                            { "monstrous.cloth would take 1e+06 MB, max_state_memory is 1 MB" }));

  expectRefused(inputs);

  EXPECT_EQ(contentOf(states / "good.cloth"), good);
  for (const bool file : { false, true })
  {
    EXPECT_EQ(refusalOf<NamedState>("restore_state", state("good", file)), "") << "the good one";
  }
}
