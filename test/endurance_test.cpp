// Claims of endurance: cloth taken apart, held everywhere, lying for long, slivers pulled.
#include <gtest/gtest.h>

#include <cstdlib>
#include <numeric>
#include <random>

#include "cloth_tearing/core/forces.h"
#include "scenes.h"

namespace cloth
{
namespace
{

/// Long runs are shortened unless asked for.
bool thorough()
{
  return std::getenv("CLOTH_TEARING_THOROUGH") != nullptr;
}

bool everyTriangleIsAlone(const Mesh& mesh)
{
  return mesh.particleCount() == 3 * mesh.triangleCount();
}

/// Detaches triangles at random particles until none hangs on another.
/// @return how many edits it took
int takeApart(Mesh& mesh, const std::function<void(const Edit&)>& follow, std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  int edits = 0;
  while (!everyTriangleIsAlone(mesh))
  {
    const SpringId s{ static_cast<int>(random() % static_cast<unsigned>(mesh.springCount())) };
    const ParticleId p = mesh.spring(s).particles[random() % 2];
    if (mesh.fanCount(p) > 1)
    {
      follow(mesh.detachFan(p, mesh.spring(s).triangles[0]));
      ++edits;
    }
    else if (!mesh.spring(s).border())
    {
      const Fan fan = mesh.fanAt(p, mesh.spring(s).triangles[0]);
      if (fan.closed)
      {
        const SpringId other = fan.springs[(fan.indexOf(s) + 1) % fan.springs.size()];
        follow(mesh.openAlong(p, s, other));
      }
      else
      {
        follow(mesh.detachAlong(p, s));
      }
      ++edits;
    }
  }
  return edits;
}

using Endurance = WithBothSolvers;
INSTANTIATE_TEST_SUITE_P(Motion, Endurance, bothSolvers(), solverName);

TEST_P(Endurance, OfClothWhoseTrianglesAreDetachedOneByOneWhileItMoves)
{
  // A world without a Simulation, which would not know of the edits.
  SimulationParams params = untearable(GetParam());
  params.solver.max_substeps = 64;
  params.contact.floor = true;
  params.contact.floor_height = -1.2;
  const double dt = params.solver.time_step;
  Cloth cloth = makeCloth(upright(sheet(1.0, 1.0, 8, 8, RectanglePattern::IRREGULAR)), {},
                          params.material, RestShapeSource::IMPORTED, 0.0);
  const auto solver = makeSolver(params.solver);
  const Mesh untorn = cloth.mesh;
  OuterForces outer;
  SphereContact contact;
  std::vector<Sphere> none;
  Vec3Array acceleration;
  const auto step = [&]
  {
    cloth.state.previous = cloth.state.position;
    outer.accelerate(cloth, untorn, params.environment, acceleration);
    solver->advance(cloth.state, cloth.springs, acceleration, dt);
    solver->limitStrain(cloth.state, cloth.springs);
    contact.resolve(cloth, none, params.contact, dt);
  };
  const auto mass = [&]
  { return std::accumulate(cloth.rest.mass.begin(), cloth.rest.mass.end(), 0.0); };
  const double whole = mass();

  const int edits = takeApart(
      cloth.mesh,
      [&](const Edit& edit)
      {
        cloth.follow(edit);
        EXPECT_EQ(solver->checkStability(cloth.state, cloth.springs, dt, 0.0).floored, 0);
        step();
        step();
      },
      7);

  EXPECT_GT(edits, 100);
  for (int i = 0; i < 6000; ++i)
  {
    step();
  }
  EXPECT_TRUE(isSound(cloth.mesh));
  EXPECT_TRUE(allFinite(cloth.state));
  EXPECT_EQ(countPieces(cloth.mesh), cloth.mesh.triangleCount());
  EXPECT_NEAR(mass(), whole, 1e-9);
  EXPECT_LT(fastest(cloth.state), 0.01) << "it lies still";
}

TEST_P(Endurance, OfClothThatIsDrivenApartUntilNothingIsLeftToTear)
{
  const FloatTraps traps;
  // Every particle flies away from the middle at 3 / s, whatever holds it: soft springs cannot.
  SimulationParams params = vacuum(GetParam());
  params.solver.max_substeps = 64;
  params.solver.max_strain = 10.0;
  params.material.stiffness = 0.5;
  params.material.bend_shear_stiffness = 0.1;
  params.tearing = tearable().tearing;
  params.contact.bounds_min = Vec3d::Constant(-1000.0);
  params.contact.bounds_max = Vec3d::Constant(1000.0);
  const ClothModel model =
      moved(sheet(1.0, 1.0, 8, 8, RectanglePattern::IRREGULAR), Vec3d(0, 0.5, 0));
  Simulation simulation(model, {}, params);
  Cloth& cloth = const_cast<Cloth&>(simulation.cloth());
  const double texture = textureArea(cloth.mesh);
  std::size_t tears = 0;
  int last = 0;
  for (int i = 0; i < 1500; ++i)
  {
    for (int p = 0; p < cloth.state.size(); ++p)
    {
      cloth.state.velocity[p] = Real(3) * cloth.state.position[p];
    }
    const StepReport report = simulation.step();
    ASSERT_TRUE(report.fault.empty()) << "step " << i << ": " << report.fault;
    tears += report.tears.size();
    last = report.tears.empty() ? last : i;
  }

  EXPECT_GT(tears, 400u);
  EXPECT_LT(last, 1400) << "it comes to an end";
  const auto held = [](const SpringLaw& law) { return law.active(); };
  EXPECT_TRUE(everyTriangleIsAlone(cloth.mesh) ||
              std::none_of(cloth.springs.structural.begin(), cloth.springs.structural.end(), held));
  EXPECT_TRUE(isSound(cloth.mesh));
  EXPECT_TRUE(allFinite(cloth.state));
  EXPECT_NEAR(textureArea(cloth.mesh), texture, 1e-12 * texture);
  EXPECT_EQ(simulation.summary().pieces, countPieces(cloth.mesh));
}

TEST_P(Endurance, OfClothPinnedAtEveryParticle)
{
  const ClothModel model = sheet(1.0, 1.0, 8, 8);
  std::vector<int> all(model.positions.size());
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    all[i] = static_cast<int>(i);
  }
  Simulation simulation(model, all, tearable(GetParam()));
  ThrowRequest thrown;
  thrown.center = Vec3d(0, -0.5, -0.5);
  thrown.velocity = Vec3d(0, 0, 5);
  simulation.throwSphere(thrown);
  thrown.mass = 0.1;
  thrown.center.x() = 0.3;
  simulation.throwSphere(thrown);
  const Vec3Array before = simulation.cloth().state.position;

  EXPECT_TRUE(run(simulation, 500).empty());

  EXPECT_EQ(simulation.cloth().state.position, before);
  EXPECT_LT(simulation.spheres()[1].center.z(), 0.0) << "the ball with a mass bounced off or stuck";
}

TEST_P(Endurance, OfClothGraspedAtEveryParticleAndPulledApart)
{
  SimulationParams params = tearable(GetParam());
  params.solver.max_substeps = 64;
  const ClothModel model = sheet(1.0, 1.0, 8, 8);
  Simulation simulation(model, {}, params);
  const double mass = simulation.summary().mass;
  for (int i = 0; i < 64; ++i)
  {
    GraspRequest request;
    request.point = model.positions[i];
    request.frame.position = request.point;
    const std::uint64_t id = simulation.grasp(request).id;
    DragTarget target;
    target.pose.position = 3.0 * request.point;
    target.linear_speed = 1.0;
    simulation.drag(id, target);
  }

  const std::size_t tears = run(simulation, 3000).size();

  EXPECT_GT(tears, 50u);
  EXPECT_TRUE(isSound(simulation.cloth().mesh));
  EXPECT_TRUE(allFinite(simulation.cloth().state));
  EXPECT_EQ(simulation.grasps().size(), 64u);
  for (const Grasp& grasp : simulation.grasps())
  {
    ASSERT_EQ(grasp.held.size(), 1u) << "who held one particle holds one";
    EXPECT_EQ(simulation.cloth().attachments[grasp.held[0].particle.index].grasp, grasp.id);
  }
  EXPECT_NEAR(simulation.summary().mass, mass, 1e-9);
}

TEST_P(Endurance, OfAHundredPiecesThatLieOnTheFloorForMinutes)
{
  // 100 squares of two triangles, out of a sheet detached along the lines between its cells.
  SimulationParams params = untearable(GetParam());
  params.solver.max_substeps = 64;
  params.solver.time_step = thorough() ? 0.001 : 0.002;
  params.contact.floor = true;
  params.contact.floor_height = -0.3;
  const ClothModel whole = sheet(1.0, 1.0, 11, 11);
  ClothModel model;
  for (std::size_t i = 0; i < whole.triangles.size(); i += 2)
  {
    std::vector<int> taken;  // vertex of the whole sheet, in the order of its copies
    for (std::size_t j : { i, i + 1 })
    {
      ModelTriangle t = whole.triangles[j];
      for (int& v : t.vertices)
      {
        const auto known = std::find(taken.begin(), taken.end(), v);
        const int place = static_cast<int>(known - taken.begin());
        if (known == taken.end())
        {
          taken.push_back(v);
          const double tilt = 0.02 * static_cast<double>((v * 7) % 5);
          model.positions.push_back(whole.positions[v] + Vec3d(0, 0, tilt));
        }
        v = static_cast<int>(model.positions.size() - taken.size()) + place;
      }
      model.triangles.push_back(t);
    }
  }
  Simulation simulation(model, {}, params);
  ASSERT_EQ(simulation.summary().pieces, 100);

  const double minutes = 10.0;
  run(simulation, stepsFor(simulation, minutes * 60.0 - 10.0));
  const std::uint64_t hash = simulation.stateHash();
  run(simulation, stepsFor(simulation, 10.0));

  EXPECT_TRUE(allFinite(simulation.cloth().state));
  EXPECT_EQ(fastest(simulation.cloth().state), 0.0);
  EXPECT_EQ(simulation.stateHash(), hash);
}

TEST_P(Endurance, OfSliversPulledFarBeyondTheirLength)
{
  const FloatTraps traps;
  // 40 long thin triangles side by side: altitudes a hundredth of their length.
  ClothModel model;
  const int n = 20;
  for (int i = 0; i <= n; ++i)
  {
    model.positions.push_back(Vec3d(0.01 * i, 0, 0));
    model.positions.push_back(Vec3d(0.01 * i + 0.005, -1, 0));
  }
  const auto uv = [&](int v)
  { return Vec2d(model.positions[v].x() / 0.205, 1.0 + model.positions[v].y()); };
  const auto add = [&](int a, int b, int c) {
    model.triangles.push_back({ { a, b, c }, { uv(a), uv(b), uv(c) } });
  };
  for (int i = 0; i < n; ++i)
  {
    add(2 * i, 2 * i + 1, 2 * i + 2);
    add(2 * i + 1, 2 * i + 3, 2 * i + 2);
  }
  SimulationParams params = tearable(GetParam());
  params.solver.max_substeps = 64;
  Simulation simulation(model, {}, params);
  for (double y : { 0.0, -1.0 })
  {
    GraspRequest request;
    request.point = Vec3d(0.1, y, 0);
    request.radius = 0.12;
    request.frame.position = request.point;
    const std::uint64_t id = simulation.grasp(request).id;
    DragTarget target;
    target.pose.position = request.point + Vec3d(0, y == 0.0 ? 2.0 : -2.0, 0);
    target.linear_speed = 1.0;
    simulation.drag(id, target);
  }

  const std::size_t tears = run(simulation, 3000).size();

  EXPECT_GT(tears, 10u);
  EXPECT_TRUE(isSound(simulation.cloth().mesh));
  EXPECT_TRUE(allFinite(simulation.cloth().state));
  EXPECT_GT(simulation.summary().pieces, 1) << "it has parted";
}

TEST_P(Endurance, OfClothTornAgainAndAgainWithoutGainingSpeed)
{
  SimulationParams params = tearable(GetParam());
  params.solver.max_substeps = 64;
  params.contact.floor = true;
  params.contact.floor_height = -1.2;
  const ClothModel flat = sheet(1.0, 1.0, 20, 20, RectanglePattern::IRREGULAR);
  Simulation simulation(upright(flat), edgeOf(flat, "top"), params);
  double most = 0.0;
  std::size_t tears = 0;
  for (int shot = 0; shot < 6; ++shot)
  {
    ThrowRequest thrown;
    thrown.center = Vec3d(-0.3 + 0.12 * shot, -0.3, -0.3 - 0.1 * (shot % 3));
    thrown.velocity = Vec3d(0, 6, 0);
    thrown.radius = 0.08;
    thrown.lifetime = 0.3;
    simulation.throwSphere(thrown);
    for (int i = 0; i < 500; ++i)
    {
      tears += run(simulation, 1).size();
      most = std::max(most, fastest(simulation.cloth().state));
    }
  }
  EXPECT_GT(tears, 25u);
  EXPECT_LT(most, 30.0) << "five times the balls' speed";
  run(simulation, 3000);
  EXPECT_LT(meanSpeed(simulation.cloth().state), 0.2);
  EXPECT_TRUE(isSound(simulation.cloth().mesh));
  RecordProperty("fastest", std::to_string(most));
  RecordProperty("tears", std::to_string(tears));
}

}  // namespace
}  // namespace cloth
