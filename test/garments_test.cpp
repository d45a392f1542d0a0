// Claims on garments that nobody here drew: they load, hang, are grasped, dragged and tear.
#include <gtest/gtest.h>

#include <fstream>

#include "cloth_tearing/core/obj_reader.h"
#include "scenes.h"

namespace cloth
{
namespace
{

std::string pathOf(const std::string& name)
{
  return std::string(CLOTH_TEARING_SOURCE_DIR) + "/../shared/meshes/dedo/" + name + ".obj";
}

bool isThere(const std::string& path)
{
  return std::ifstream(path).good();
}

int longestAxis(const ObjImport& import)
{
  int axis = 0;
  (import.report.highest - import.report.lowest).maxCoeff(&axis);
  return axis;
}

/// The garment as a metre of cloth, its longest side upright, its top at z = 0.
ClothModel garment(const std::string& path)
{
  const ObjImport as_drawn = readObjFile(path);
  const int up = longestAxis(as_drawn);
  ImportOptions options;  // the files are in units of their own
  options.scale = 1.0 / (as_drawn.report.highest - as_drawn.report.lowest)[up];
  ObjImport import = readObjFile(path, options);
  for (Vec3d& x : import.model.positions)
  {
    x -= import.report.highest;
    x = Vec3d(x[(up + 1) % 3], x[(up + 2) % 3], x[up]);
  }
  return import.model;
}

struct Case
{
  const char* name;
  SolverKind solver;
};

class Garment : public ::testing::TestWithParam<Case>
{
};

INSTANTIATE_TEST_SUITE_P(Of, Garment,
                         ::testing::Values(Case{ "tshirt_0", SolverKind::XPBD },
                                           Case{ "tshirt_0", SolverKind::FORCE_SPRINGS },
                                           Case{ "mask_0", SolverKind::XPBD },
                                           Case{ "mask_0", SolverKind::FORCE_SPRINGS },
                                           Case{ "button_cloth", SolverKind::XPBD },
                                           Case{ "button_cloth", SolverKind::FORCE_SPRINGS },
                                           Case{ "vest_00", SolverKind::XPBD },
                                           Case{ "vest_00", SolverKind::FORCE_SPRINGS },
                                           Case{ "generated_cloth", SolverKind::XPBD },
                                           Case{ "generated_cloth", SolverKind::FORCE_SPRINGS }),
                         [](const auto& info) {
                           return std::string(info.param.name) + "_" + nameOf(info.param.solver);
                         });

TEST_P(Garment, LoadsHangsIsGraspedDraggedAndTears)
{
  const std::string path = pathOf(GetParam().name);
  if (!isThere(path))
  {
    GTEST_SKIP() << path << " is not on this machine";
  }
  const ClothModel model = garment(path);
  std::vector<int> pinned;
  for (std::size_t i = 0; i < model.positions.size(); ++i)
  {
    if (model.positions[i].z() > -0.03)
    {
      pinned.push_back(static_cast<int>(i));
    }
  }
  SimulationParams params = tearable(GetParam().solver);
  params.solver.max_substeps = 64;
  params.tearing.hem_width = 0.05;
  Simulation simulation(model, pinned, params);
  const Mesh& mesh = simulation.cloth().mesh;
  const ParticleState& state = simulation.cloth().state;
  const Summary whole = simulation.summary();
  const double texture = textureArea(mesh);
  EXPECT_TRUE(isSound(mesh));

  run(simulation, 1000);

  const Vec3 lowest = *std::min_element(state.position.begin(), state.position.end(),
                                        [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
  GraspRequest request;
  request.point = lowest.cast<double>();
  request.radius = 0.08;
  request.frame.position = request.point;
  const GraspTaken taken = simulation.grasp(request);
  EXPECT_GT(taken.held_particles, 0);
  DragTarget target;
  target.pose.position = request.point - Vec3d(0.3, 0.2, 1.0);
  target.linear_speed = 1.0;
  simulation.drag(taken.id, target);

  const std::size_t tears = run(simulation, 1500).size();

  EXPECT_GT(tears, 0u);
  EXPECT_FALSE(simulation.grasps().at(0).target.has_value()) << "it has arrived";
  EXPECT_TRUE(isSound(mesh));
  EXPECT_TRUE(allFinite(state));
  EXPECT_NEAR(textureArea(mesh), texture, 1e-12 * texture);
  EXPECT_NEAR(simulation.summary().mass, whole.mass, 1e-12 * whole.mass);
  EXPECT_NEAR(simulation.summary().rest_area, whole.rest_area, 1e-12 * whole.rest_area);
  EXPECT_EQ(simulation.summary().pieces, countPieces(mesh));
  EXPECT_LT(fastest(state), 50.0);
}

TEST(Apron, IsRefusedNamingItsNonManifoldEdges)
{
  const std::string path = pathOf("apron_0");
  if (!isThere(path))
  {
    GTEST_SKIP() << path << " is not on this machine";
  }
  try
  {
    readObjFile(path);
    FAIL() << "must be refused";
  }
  catch (const ImportError& error)
  {
    const std::string what = error.what();
    EXPECT_NE(what.find("apron_0.obj"), std::string::npos) << what;
    EXPECT_NE(what.find("line "), std::string::npos) << what;
    EXPECT_NE(what.find("edge"), std::string::npos) << what;
    EXPECT_NE(what.find("vertices "), std::string::npos) << what;
  }
}

}  // namespace
}  // namespace cloth
