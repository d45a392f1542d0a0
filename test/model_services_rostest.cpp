// Other models take the cloth's place, none from elsewhere; what is exported is the cloth as it is.
#include <cloth_tearing/Drag.h>
#include <cloth_tearing/Export.h>
#include <cloth_tearing/Grasp.h>
#include <cloth_tearing/LoadModel.h>
#include <cloth_tearing/SimulationStatus.h>
#include <cloth_tearing/Step.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>

#include "cloth_tearing/core/obj_reader.h"
#include "cloth_tearing/node/cloth_node.h"
#include "node_client.h"

namespace fs = std::filesystem;
using namespace cloth_tearing;  // NOLINT: the messages are what all of this is about

namespace
{

const std::string SQUARE =
    "v 0 0 0\nv 0.1 0 0\nv 0.1 -0.1 0\nv 0 -0.1 0\nvt 0 1\nvt 1 1\nvt 1 0\nvt 0 0\n"
    "f 4/4 3/3 2/2 1/1\n";

void put(const fs::path& path, const std::string& text)
{
  fs::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

/// A folder with models, one beside it with what nobody may read, and one for exports.
class Folders
{
public:
  Folders()
  {
    char name[] = "/tmp/cloth_models_XXXXXX";
    root = fs::canonical(mkdtemp(name));
    put(root / "models/square.obj", SQUARE);
    put(root / "models/deeper/square.obj", SQUARE);
    put(root / "models/broken.obj", SQUARE + "f 1 2 9\n");
    put(root / "models_not/secret.obj", SQUARE);
    fs::create_symlink(root / "models_not/secret.obj", root / "models/out.obj");
    fs::create_directory_symlink(root / "models_not", root / "models/way_out");
    fs::create_symlink("deeper/square.obj", root / "models/inner.obj");
    fs::create_symlink("nowhere.obj", root / "models/dangling.obj");
    mkfifo((root / "models/pipe.obj").c_str(), 0600);
    fs::create_directory(root / "exports");
  }
  ~Folders() { fs::remove_all(root); }

  fs::path root;
};

NodeParams paramsFor(const Folders& folders)
{
  NodeParams params;
  params.pace = cloth::Pace::STEP;
  params.rectangle.width = 0.4;
  params.rectangle.height = 0.4;
  params.rectangle.columns = 11;
  params.rectangle.rows = 11;
  params.model_folders = { (folders.root / "missing").string(), (folders.root / "models").string(),
                           (folders.root / "exports").string() };
  params.export_folder = (folders.root / "exports").string();
  return params;
}

LoadModel::Response load(const std::string& model, double scale = 0.0, double weld = -1.0)
{
  LoadModel::Request request;
  request.model = model;
  request.scale = scale;
  request.weld_distance = weld;
  return ask<LoadModel>("/cloth/load_model", request);
}

Export::Response exportTo(const std::string& name, bool replace = false)
{
  Export::Request request;
  request.name = name;
  request.replace = replace;
  return ask<Export>("/cloth/export", request);
}

Step::Response step(std::uint32_t steps)
{
  Step::Request request;
  request.steps = steps;
  return ask<Step>("/cloth/step", request);
}

cloth::ObjImport import(const fs::path& file)
{
  return cloth::readObjFile(file.string());
}

/// Pulls the lower corner until the cloth has torn.
void tear()
{
  Grasp::Request grasp;
  grasp.header.frame_id = "world";
  grasp.point.x = 0.2;
  grasp.point.z = 1.1;
  grasp.radius = 0.06;
  const Grasp::Response held = ask<Grasp>("/cloth/grasp", grasp);
  ASSERT_TRUE(held.success) << held.message;
  Drag::Request drag;
  drag.header.frame_id = "world";
  drag.grasp_id = held.grasp_id;
  drag.target.position.x = 0.6;
  drag.target.position.z = 0.6;
  drag.linear_speed = 1.0;
  const Drag::Response sent = ask<Drag>("/cloth/drag", drag);
  ASSERT_TRUE(sent.success) << sent.message;
  ASSERT_GT(step(500).tears, 3u);
}

class ModelServicesTest : public testing::Test
{
protected:
  Folders folders_;
  NodeParams params_ = paramsFor(folders_);
  ClothNode node_{ ros::NodeHandle("/cloth"), params_ };
};

}  // namespace

TEST_F(ModelServicesTest, LoadAModelAsIfTheNodeHadBegunWithIt)
{
  const Step::Response before = step(100);

  const LoadModel::Response loaded = load("square.obj", 4.0);

  ASSERT_TRUE(loaded.success) << loaded.message;
  EXPECT_EQ(loaded.particles, 4u);
  EXPECT_EQ(loaded.triangles, 2u);
  EXPECT_EQ(loaded.pieces, 1u);
  const Step::Response now = step(0);
  EXPECT_EQ(now.epoch, before.epoch + 1);
  EXPECT_EQ(now.step, 0u);
  EXPECT_EQ(now.time, before.time);
  NodeParams begun = params_;
  begun.model_file = (folders_.root / "models/square.obj").string();
  begun.import.scale = 4.0;
  const PlacedModel placed = placedModel(begun);
  cloth::Simulation expected(placed.model, placed.pinned, inClothFrame(begun));
  for (int i = 0; i < 100; ++i)
  {
    expected.step();
  }
  EXPECT_EQ(step(100).state_hash, expected.stateHash());
}

TEST_F(ModelServicesTest, BringBackTheClothOfTheStart)
{
  const std::uint64_t hash = step(50).state_hash;
  ASSERT_TRUE(load("deeper/square.obj").success);
  ASSERT_TRUE(load("inner.obj").success) << "a link that stays inside";

  const LoadModel::Response back = load("");

  ASSERT_TRUE(back.success) << back.message;
  EXPECT_EQ(back.particles, 121u);
  EXPECT_EQ(step(50).state_hash, hash);
  EXPECT_FALSE(load("", 2.0).success);
  EXPECT_NE(load("", 0.0, 0.1).message.find("weld_distance is 0.1"), std::string::npos);
}

TEST_F(ModelServicesTest, RefuseWhatIsNotBelowTheFoldersAndChangeNothing)
{
  const std::vector<std::array<std::string, 2>> refused = {
    { (folders_.root / "models/square.obj").string(), "must be a relative path" },
    { "../models_not/secret.obj", "has the part \"..\"" },
    { "deeper/../../models_not/secret.obj", "has the part \"..\"" },
    { "./square.obj", "has the part \".\"" },
    { "deeper//square.obj", "has the part \"\"" },
    { std::string("square.obj\0", 11), "must be a relative path" },
    { std::string(2000, 'a'), "must be a relative path" },
    { "out.obj", "leads out of" },
    { "way_out/secret.obj", "leads out of" },
    { "deeper", "is no file" },
    { "pipe.obj", "is no file" },
    { "dangling.obj", "there is no model" },
    { "absent.obj", "there is no model" },
    { "broken.obj", "broken.obj, line 10" },
  };
  const Step::Response before = step(20);
  Collector<SimulationStatus> status("/cloth/status");
  for (const auto& entry : refused)
  {
    const LoadModel::Response answer = load(entry[0]);
    EXPECT_FALSE(answer.success) << entry[0];
    EXPECT_NE(answer.message.find(entry[1]), std::string::npos) << answer.message;
  }
  EXPECT_FALSE(load("square.obj", -1.0).success);
  EXPECT_FALSE(load("square.obj", std::nan("")).success);
  EXPECT_FALSE(load("square.obj", 1e9).success) << "too large";

  const Step::Response after = step(0);
  EXPECT_EQ(after.state_hash, before.state_hash);
  EXPECT_EQ(after.epoch, before.epoch);
  status.waitFor("the refusals, counted",
                 [&](const auto& s) { return s.refusals == refused.size() + 3; });
}

TEST_F(ModelServicesTest, RefuseAModelThatThePinsDoNotFit)
{
  NodeParams params = params_;
  params.pins.particles = { 120 };
  ClothNode other(ros::NodeHandle("/pinned"), params);
  LoadModel::Request request;
  request.model = "square.obj";

  const LoadModel::Response answer = ask<LoadModel>("/pinned/load_model", request);

  EXPECT_FALSE(answer.success);
  EXPECT_NE(answer.message.find("pinned particle 120 does not exist"), std::string::npos)
      << answer.message;
}

TEST_F(ModelServicesTest, CutAStepUnderWayShort)
{
  auto stepping = std::async(std::launch::async, [] { return step(100000000); });
  Collector<SimulationStatus> status("/cloth/status");
  status.waitFor("the step under way", [](const auto& s) { return s.step > 0; });

  ASSERT_TRUE(load("square.obj").success);

  const Step::Response cut = stepping.get();
  EXPECT_FALSE(cut.success);
  EXPECT_NE(cut.message.find("another cloth"), std::string::npos) << cut.message;
}

TEST_F(ModelServicesTest, KeepWhatWasTuned)
{
  dynamic_reconfigure::Reconfigure call;
  dynamic_reconfigure::ConfigTools::appendParameter(call.request.config, "x", 3.0);
  ASSERT_TRUE(ros::service::call("/cloth/environment/gravity/set_parameters", call));

  ASSERT_TRUE(load("square.obj").success);

  params_.simulation.environment.gravity.x() = 3.0;
  params_.model_file = (folders_.root / "models/square.obj").string();
  const PlacedModel placed = placedModel(params_);
  cloth::Simulation expected(placed.model, placed.pinned, inClothFrame(params_));
  for (int i = 0; i < 50; ++i)
  {
    expected.step();
  }
  EXPECT_EQ(step(50).state_hash, expected.stateHash());
  ros::param::del("/cloth");
}

TEST_F(ModelServicesTest, ExportTornClothThatIsTheSameWhenItIsLoaded)
{
  tear();

  const Export::Response exported = exportTo("torn");

  ASSERT_TRUE(exported.success) << exported.message;
  EXPECT_EQ(exported.path, (folders_.root / "exports/torn.obj").string());
  Collector<ClothSurface> surfaces("/cloth/surface");
  const ClothSurface surface = surfaces.first();
  const cloth::ObjImport torn = import(exported.path);
  ASSERT_EQ(3 * torn.model.positions.size(), surface.positions.size());
  for (std::size_t i = 0; i < surface.positions.size(); ++i)
  {
    const double origin[] = { surface.origin.x, surface.origin.y, surface.origin.z };
    EXPECT_NEAR(torn.model.positions[i / 3][i % 3], origin[i % 3] + surface.positions[i], 1e-12)
        << "in frame_id";
  }
  EXPECT_EQ(torn.report.untextured_faces, 0);
  EXPECT_GT(torn.report.particles, 121);
  const LoadModel::Response loaded = load("torn.obj");
  ASSERT_TRUE(loaded.success) << loaded.message;
  EXPECT_EQ(loaded.particles, static_cast<std::uint32_t>(torn.report.particles));
  EXPECT_EQ(loaded.triangles, static_cast<std::uint32_t>(torn.report.triangles));
  EXPECT_EQ(loaded.pieces, static_cast<std::uint32_t>(torn.report.pieces));
}

TEST_F(ModelServicesTest, ExportOverAFileOnlyIfAskedTo)
{
  put(folders_.root / "exports/mine.obj", "mine");

  EXPECT_NE(exportTo("mine").message.find("mine.obj exists already"), std::string::npos);
  std::string text;
  std::ifstream(folders_.root / "exports/mine.obj") >> text;
  EXPECT_EQ(text, "mine");
  EXPECT_TRUE(exportTo("mine", true).success);
  EXPECT_EQ(import(folders_.root / "exports/mine.obj").report.particles, 121);
  const fs::directory_iterator files(folders_.root / "exports");
  EXPECT_EQ(std::distance(begin(files), end(files)), 1) << "nothing is left beside it";
}

TEST_F(ModelServicesTest, ExportToNamesOnlyAndOnlyWhereItMay)
{
  for (const char* name :
       { "", ".hidden", "../torn", "a/b", "a b", "\xc3\xa4", "a\nb", "/tmp/torn" })
  {
    const Export::Response answer = exportTo(name);
    EXPECT_FALSE(answer.success) << name;
    EXPECT_NE(answer.message.find("name is \""), std::string::npos) << answer.message;
  }
  EXPECT_FALSE(exportTo(std::string(65, 'a')).success);
  EXPECT_TRUE(exportTo(std::string(64, 'a')).success);
  fs::remove_all(folders_.root / "exports");
  EXPECT_NE(exportTo("torn").message.find("cannot write"), std::string::npos);
}

TEST_F(ModelServicesTest, ExportNothingWithoutAFolder)
{
  NodeParams params = params_;
  params.export_folder = "";
  ClothNode other(ros::NodeHandle("/shut"), params);
  Export::Request request;
  request.name = "torn";

  EXPECT_NE(ask<Export>("/shut/export", request).message.find("export_folder is empty"),
            std::string::npos);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "model_services_rostest");
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
