// Claims of limits: what is beyond one is refused with its name, the value and the limit, and
// changes nothing.
#include "cloth_tearing/core/limits.h"

#include <gtest/gtest.h>

#include "cloth_tearing/core/simulation_loop.h"
#include "scenes.h"

namespace cloth
{
namespace
{

const std::string GRANTED = "it was granted";

/// 4 x 4 particles, 18 triangles.
Simulation small(const Limits& limits)
{
  SimulationParams params = untearable();
  params.limits = limits;
  const ClothModel flat = sheet(0.3, 0.3, 4, 4);
  return { upright(flat), edgeOf(flat, "top"), params };
}

GraspRequest graspOf(const Simulation& simulation, int particle)
{
  GraspRequest request;
  request.point = simulation.cloth().state.position[particle].cast<double>();
  request.frame.position = request.point;
  return request;
}

Sphere sphereOf(std::uint64_t id)
{
  Sphere sphere;
  sphere.id = id;
  sphere.radius = 0.01;
  sphere.center = Vec3d(0.0, double(id), 0.0);
  return sphere;
}

TEST(Limits, AreRefusedBeyondTheirCeilings)
{
  EXPECT_TRUE(problems(Limits()).empty());
  const Limits beyond{ MAX_PARTICLES + 1, MAX_TRIANGLES + 1, MAX_SPHERES + 1, 0 };
  EXPECT_EQ(problems(beyond),
            (std::vector<std::string>{
                "limits/particles is 1000001, must be at least 1 and at most 1e+06",
                "limits/triangles is 2000001, must be at least 1 and at most 2e+06",
                "limits/spheres is 1001, must be at least 1 and at most 1000",
                "limits/grasps is 0, must be at least 1 and at most 1000" }));
}

TEST(Limits, RefuseALargerModel)
{
  Limits limits;
  limits.particles = 16;
  limits.triangles = 18;
  EXPECT_EQ(refusalOf([&] { small(limits); }), GRANTED);
  limits.particles = 15;
  limits.triangles = 17;
  EXPECT_EQ(refusalOf([&] { small(limits); }),
            "there would be 16 particles of the model, must be at most limits/particles = 15\n"
            "there would be 18 triangles of the model, must be at most limits/triangles = 17");
}

TEST(Limits, RefuseOneGraspTooMany)
{
  Limits limits;
  limits.grasps = 2;
  Simulation simulation = small(limits);
  const std::uint64_t first = simulation.grasp(graspOf(simulation, 8)).id;
  simulation.grasp(graspOf(simulation, 9));
  const std::uint64_t before = simulation.stateHash();

  EXPECT_EQ(refusalOf([&] { simulation.grasp(graspOf(simulation, 10)); }),
            "there would be 3 grasps, must be at most limits/grasps = 2");

  EXPECT_EQ(simulation.stateHash(), before);
  simulation.release(first, "");
  EXPECT_EQ(refusalOf([&] { simulation.grasp(graspOf(simulation, 10)); }), GRANTED);
}

TEST(Limits, CountStreamedAndThrownSpheresTogether)
{
  Limits limits;
  limits.spheres = 2;
  Simulation simulation = small(limits);
  simulation.throwSphere(ThrowRequest());
  simulation.setSpheres({ sphereOf(1) });
  const std::uint64_t before = simulation.stateHash();
  const std::string reason = "there would be 3 spheres, must be at most limits/spheres = 2";

  EXPECT_EQ(refusalOf([&] { simulation.throwSphere(ThrowRequest()); }), reason);
  EXPECT_EQ(refusalOf([&] { simulation.setSpheres({ sphereOf(1), sphereOf(2) }); }), reason);

  EXPECT_EQ(simulation.stateHash(), before);
  simulation.setSpheres({});
  EXPECT_EQ(refusalOf([&] { simulation.throwSphere(ThrowRequest()); }), GRANTED);
}

TEST(Limits, RefuseAStateThatHasMore)
{
  Simulation full = small(Limits());
  full.grasp(graspOf(full, 8));
  full.grasp(graspOf(full, 9));
  full.setSpheres({ sphereOf(1), sphereOf(2) });
  const std::string state = full.save();
  const Simulation lean = small({ 16, 18, 1, 1 });
  const std::uint64_t before = lean.stateHash();

  EXPECT_EQ(refusalOf([&] { lean.restored(state); }),
            "there would be 2 grasps, must be at most limits/grasps = 1\n"
            "there would be 2 spheres, must be at most limits/spheres = 1");

  EXPECT_EQ(lean.stateHash(), before);
  EXPECT_EQ(small({ 16, 18, 2, 2 }).restored(state).grasps().size(), 2u);
}

TEST(Limits, AnswerBusyToOneCommandTooMany)
{
  CommandQueue<int> queue(2);
  const auto reason = [&queue]
  {
    try
    {
      queue.call([](int&) {}, std::chrono::seconds(0));
    }
    catch (const Busy& busy)
    {
      return std::string(busy.what());
    }
    return std::string("it was taken");
  };
  const std::string not_yet = "busy: the simulation did not take the command in time";
  EXPECT_EQ(reason(), not_yet);
  EXPECT_EQ(reason(), not_yet);
  EXPECT_EQ(reason(),
            "busy: there would be 3 commands that wait, must be at most limits/commands = 2");

  int target = 0;
  queue.runAll(target);
  EXPECT_EQ(reason(), not_yet) << "there is room again";
}

}  // namespace
}  // namespace cloth
