// Claims of pins that come and go: all that is named or nothing, and a reset undoes them.
#include "cloth_tearing/core/pin_commands.h"

#include <gtest/gtest.h>

#include <functional>

#include "scenes.h"

namespace cloth
{
namespace
{

// A sheet of 1 m with particles 0.1 m apart: particle 11 r + c at (c / 10 - 0.5, -r / 10, 0).
class PinnedByCommand : public ::testing::Test
{
protected:
  bool pinned(int particle) const { return simulation.cloth().attachments[particle].pinned(); }
  static PinRequest ball(const Vec3d& point, double radius)
  {
    PinRequest request;
    request.point = point;
    request.radius = radius;
    return request;
  }
  static PinRequest ids(const std::vector<int>& particles)
  {
    PinRequest request;
    request.particles = particles;
    return request;
  }
  void expectRefused(const std::function<void()>& request, const std::string& words)
  {
    const std::uint64_t hash = simulation.stateHash();
    try
    {
      request();
      ADD_FAILURE() << "granted: " << words;
    }
    catch (const Refusal& refusal)
    {
      EXPECT_EQ(refusal.what(), words);
    }
    EXPECT_EQ(simulation.stateHash(), hash) << "nothing has changed";
  }

  Simulation simulation{ sheet(1.0, 1.0, 11, 11), { 0 }, untearable() };
};

TEST_F(PinnedByCommand, ParticlesStandStillUntilTheyAreFreed)
{
  EXPECT_EQ(simulation.pin(ball(Vec3d(0.0, -0.5, 0.0), 0.11)), 5);
  EXPECT_EQ(simulation.pin(ids({ 60, 10, 10, 0 })), 1) << "60 and 0 were pinned before";
  run(simulation, 200);
  for (int p : { 0, 10, 49, 59, 60, 61, 71 })
  {
    EXPECT_TRUE(pinned(p)) << p;
    EXPECT_EQ(simulation.cloth().state.velocity[p], Vec3::Zero().eval());
    EXPECT_EQ(simulation.cloth().state.position[p].z(), Real(0)) << p;
  }
  PinRequest both = ball(Vec3d(0.0, -0.5, 0.0), 0.05);
  both.particles = { 10, 12 };
  EXPECT_EQ(simulation.unpin(both), 2) << "12 was free";
  run(simulation, 200);
  EXPECT_LT(simulation.cloth().state.position[10].z(), Real(-0.01));
  EXPECT_TRUE(pinned(59));
}

TEST_F(PinnedByCommand, ParticlesCarryTheirWeightAndTheForceIsThatOfPins)
{
  simulation.unpin(ids({ 0 }));
  std::vector<int> all(121);
  for (int i = 0; i < 121; ++i)
  {
    all[i] = i;
  }
  EXPECT_EQ(simulation.pin(ids(all)), 121);
  run(simulation, 2);
  EXPECT_NEAR(simulation.forceBalance().pin.z(), 0.15 * 9.81, 1e-4);
}

TEST_F(PinnedByCommand, ParticlesAreAsBuiltAfterAReset)
{
  const std::uint64_t hash = simulation.stateHash();
  simulation.pin(ids({ 60 }));
  simulation.unpin(ids({ 0 }));
  EXPECT_NE(simulation.stateHash(), hash);
  simulation.reset();
  EXPECT_EQ(simulation.stateHash(), hash);
  EXPECT_TRUE(pinned(0));
  EXPECT_FALSE(pinned(60));
}

TEST_F(PinnedByCommand, ParticlesOfAGraspAreRefusedByItsName)
{
  GraspRequest request;
  request.point = Vec3d(0.0, -0.5, 0.0);
  const std::uint64_t grasp = simulation.grasp(request).id;
  const std::string words =
      "particle 60 is held by grasp " + std::to_string(grasp) + ": release that first";
  expectRefused([&] { simulation.pin(ball(request.point, 0.11)); }, words);
  expectRefused([&] { simulation.pin(ids({ 5, 60 })); }, words);
  EXPECT_EQ(simulation.unpin(ids({ 0, 60 })), 1) << "a held one is not pinned";
  EXPECT_TRUE(simulation.cloth().attachments[60].held());
}

TEST_F(PinnedByCommand, WhatAGraspHeldStandsStillInTheInstantThatItLetsGo)
{
  GraspRequest request;
  request.point = Vec3d(0.0, -0.5, 0.0);
  request.radius = 0.11;
  request.frame.position = request.point;
  const std::uint64_t moved = simulation.grasp(request).id;
  simulation.steer(moved, { Vec3d(0.0, -0.5, 0.05), Quatd::Identity() }, 0.01);
  run(simulation, 5);
  const Vec3Array before = simulation.cloth().state.position;

  simulation.release(moved, "done", AfterGrasp::PINNED);

  EXPECT_TRUE(simulation.grasps().empty());
  run(simulation, 50);
  for (int p : { 49, 59, 60, 61, 71 })
  {
    EXPECT_TRUE(pinned(p)) << p;
    EXPECT_EQ(simulation.cloth().state.position[p], before[p]) << p;
  }
  EXPECT_FALSE(pinned(48)) << "it was not held";
}

TEST_F(PinnedByCommand, AllThatIsLetGoCanStandStill)
{
  GraspRequest one;
  one.point = Vec3d(0.0, -0.5, 0.0);
  GraspRequest other;
  other.point = Vec3d(0.5, -1.0, 0.0);
  simulation.grasp(one);
  simulation.grasp(other);
  EXPECT_EQ(simulation.releaseAll(AfterGrasp::PINNED), 2);
  EXPECT_TRUE(pinned(60));
  EXPECT_TRUE(pinned(120));
}

// Two grasps hold a sheet that nothing else holds: whichever lets go first leaves the other with a
// loose piece, unless what it held stays pinned.
TEST_F(PinnedByCommand, APatchThatStaysPinnedLeavesNoLoosePieceToOtherGrasps)
{
  const auto told = [this](AfterGrasp after)
  {
    simulation.reset();
    simulation.unpin(ids({ 0 }));
    GraspRequest one;
    one.point = Vec3d(0.0, -0.5, 0.0);
    GraspRequest other;
    other.point = Vec3d(0.5, -1.0, 0.0);
    const std::uint64_t first = simulation.grasp(one).id;
    simulation.grasp(other);
    simulation.release(first, "done", after);
    const auto last = simulation.graspEventsSince(simulation.loggedGraspEvents()[1], 1);
    return last.at(0).kind;
  };
  EXPECT_EQ(told(AfterGrasp::FREE), GraspEventKind::HOLDS_LOOSE_PIECE);
  EXPECT_EQ(told(AfterGrasp::PINNED), GraspEventKind::RELEASED);
}

TEST_F(PinnedByCommand, RequestsThatNameNothingAreRefused)
{
  const auto nothing = "radius [m] is 0 and particles is empty: name a ball or particles";
  expectRefused([&] { simulation.pin(PinRequest()); }, nothing);
  expectRefused([&] { simulation.unpin(PinRequest()); }, nothing);
  expectRefused(
      [&] {
        simulation.pin(ids({ 5, 121 }));
      },
      "there is no particle 121: their ids are 0 to 120");
  expectRefused(
      [&] {
        simulation.unpin(ids({ -1, 0 }));
      },
      "there is no particle -1: their ids are 0 to 120");
  PinRequest far = ball(Vec3d(0.0, -0.5, 1.0), 0.2);
  far.particles = { 5 };
  expectRefused([&] { simulation.pin(far); },
                "there is no particle within 0.2 m (radius) of the point; the nearest is 1 m away");
  expectRefused([&] { simulation.pin(ball(Vec3d(0, 0, 0), -0.1)); },
                "radius [m] is -0.1, must be at least 0 and at most 1000");
  expectRefused([&] { simulation.pin(ids(std::vector<int>(100001, 5))); },
                "there are 100001 particles, must be at most 100000");
}

TEST_F(PinnedByCommand, ParticlesAtRestAreRefused)
{
  SimulationParams params = untearable();
  params.contact.bounds_min = Vec3d(-50.0, -50.0, -0.2);
  Simulation falling(sheet(0.2, 0.2, 3, 3), {}, params);
  run(falling, 500);
  ASSERT_EQ(falling.summary().pieces_at_rest, 1);
  for (const auto& command : { &Simulation::pin, &Simulation::unpin })
  {
    try
    {
      (falling.*command)(ids({ 4 }));
      ADD_FAILURE() << "granted";
    }
    catch (const Refusal& refusal)
    {
      EXPECT_STREQ(refusal.what(), "particle 4 is at rest: its piece of cloth has left the bounds");
    }
  }
}

}  // namespace
}  // namespace cloth
