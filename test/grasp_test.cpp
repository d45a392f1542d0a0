// Claims of grasps: what they take, whom they refuse, how they carry, how they let go.
#include "cloth_tearing/core/grasp.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace cloth
{
namespace
{

constexpr double PI = 3.14159265358979323846;

Quatd turn(double angle, const Vec3d& axis)
{
  const Vec3d half = std::sin(0.5 * angle) * axis.normalized();
  return { std::cos(0.5 * angle), half.x(), half.y(), half.z() };
}

double angleBetween(const Quatd& a, const Quatd& b)
{
  return 2.0 * std::acos(std::min(1.0, std::abs(a.coeffs().dot(b.coeffs()))));
}

// A sheet of 1 m with particles 0.1 m apart: particle 11 r + c at (c / 10 - 0.5, -r / 10, 0).
class GraspedSheet : public ::testing::Test
{
protected:
  Vec3d at(int particle) const
  {
    return simulation.cloth().state.position[particle].cast<double>();
  }
  GraspTaken take(const Vec3d& point, double radius)
  {
    GraspRequest request;
    request.point = point;
    request.radius = radius;
    request.frame.position = point;
    return simulation.grasp(request);
  }
  static DragTarget target(const Vec3d& position, double speed)
  {
    DragTarget target;
    target.pose.position = position;
    target.linear_speed = speed;
    return target;
  }
  const Grasp& only() const { return simulation.grasps().at(0); }

  ClothModel model = sheet(1.0, 1.0, 11, 11);
  Simulation simulation{ model, { 0 }, vacuum() };
};

TEST_F(GraspedSheet, IsHeldWithinTheRadiusAndNowhereElse)
{
  const GraspTaken taken = take(Vec3d(0.02, -0.5, 0.0), 0.13);

  EXPECT_EQ(taken.held_particles, 7);  // 60, its four neighbours and the two on the right
  EXPECT_NEAR(taken.distance, 0.02, 1e-6);
  int held = 0;
  for (int i = 0; i < 121; ++i)
  {
    const bool inside = (at(i) - Vec3d(0.02, -0.5, 0.0)).norm() <= 0.13;
    EXPECT_EQ(simulation.cloth().attachments[i].kind == Attachment::Kind::GRASP, inside) << i;
    EXPECT_EQ(simulation.cloth().state.inverse_mass[i] == 0, inside || i == 0) << i;
    held += inside;
  }
  EXPECT_EQ(taken.held_particles, held);
}

TEST_F(GraspedSheet, IsHeldAtTheNearestParticleWithoutARadius)
{
  const GraspTaken taken = take(Vec3d(0.02, -0.49, 0.01), 0.0);
  ASSERT_EQ(taken.held_particles, 1);
  EXPECT_EQ(only().held[0].particle.index, 60);
  EXPECT_NEAR(taken.distance, std::sqrt(0.0006), 1e-6);
}

TEST_F(GraspedSheet, RefusesAGraspOutOfReachAndNamesDistanceAndLimit)
{
  const std::uint64_t hash = simulation.stateHash();
  EXPECT_EQ(refusalOf([&] { take(Vec3d(0.0, -0.5, 0.25), 0.0); }),
            "there is no particle within 0.05 m (max_grasp_distance) of the point; the nearest "
            "that is not pinned is 0.25 m away");
  EXPECT_EQ(refusalOf([&] { take(Vec3d(0.0, -0.5, 0.25), 0.2); }),
            "there is no particle within 0.2 m (radius) of the point; the nearest that is not "
            "pinned is 0.25 m away");
  EXPECT_EQ(simulation.stateHash(), hash);
  EXPECT_TRUE(simulation.grasps().empty());
}

TEST_F(GraspedSheet, PassesOverPinnedParticles)
{
  const GraspTaken taken = take(at(0), 0.11);
  EXPECT_EQ(taken.held_particles, 2);
  EXPECT_TRUE(simulation.cloth().attachments[0].pinned());
  EXPECT_NE(refusalOf([&] { take(at(0) + Vec3d(-0.05, 0, 0), 0.06); }).find("no particle within"),
            std::string::npos);
}

TEST_F(GraspedSheet, HasOneOwnerForEachParticle)
{
  const GraspTaken first = take(at(60), 0.11);
  const GraspTaken second = take(at(20), 0.0);
  EXPECT_NE(first.id, second.id);
  EXPECT_EQ(simulation.grasps().size(), 2u);
  const std::uint64_t hash = simulation.stateHash();

  EXPECT_EQ(refusalOf([&] { take(at(62), 0.11); }),
            "particle 61 is held by grasp " + std::to_string(first.id) + ": release that first");
  EXPECT_EQ(simulation.stateHash(), hash) << "nothing has changed";

  simulation.release(first.id);
  EXPECT_EQ(take(at(62), 0.11).held_particles, 5);
}

TEST_F(GraspedSheet, RefusesWhatIsNoPlaceAndNoPose)
{
  const std::uint64_t hash = simulation.stateHash();
  EXPECT_NE(refusalOf([&] { take(Vec3d(std::nan(""), 0, 0), 0.0); }).find("point [m].x is nan"),
            std::string::npos);
  EXPECT_NE(refusalOf([&] { take(Vec3d(0, -0.5, 0), -1.0); }).find("radius [m] is -1"),
            std::string::npos);
  for (const Quatd& rotation :
       { Quatd(std::nan(""), 0, 0, 0), Quatd(0, 0, 0, 0), Quatd(2, 0, 0, 0) })
  {
    GraspRequest request;
    request.point = at(60);
    request.frame.rotation = rotation;
    EXPECT_NE(refusalOf([&] { simulation.grasp(request); }).find("must be a unit quaternion"),
              std::string::npos);
  }
  EXPECT_EQ(simulation.stateHash(), hash);
}

TEST_F(GraspedSheet, NamesAPointThatIsNoPlaceOnce)
{
  GraspRequest request;
  request.point = Vec3d(1e7, 0, 0);
  request.frame.position = request.point;
  EXPECT_EQ(refusalOf([&] { simulation.grasp(request); }),
            "point [m].x is 1e+07, must be at least -1000 and at most 1000");
}

TEST(PinnedSheet, SaysInWordsThatThereIsNothingToTakeHoldOf)
{
  Simulation simulation(sheet(1, 1, 2, 2), { 0, 1, 2, 3 }, SimulationParams());
  EXPECT_EQ(refusalOf([&] { simulation.grasp(GraspRequest()); }),
            "there is no particle to take hold of: all are pinned or were put to rest");
}

TEST_F(GraspedSheet, FollowsADragAtItsSpeedAndArrives)
{
  const Vec3d start = at(60);
  const std::uint64_t id = take(start, 0.11).id;
  const Vec3d goal = start + Vec3d(0, 0, 0.05);
  simulation.drag(id, target(goal, 0.1));

  run(simulation, 100);
  EXPECT_NEAR(only().pose.position.z(), 0.01, 1e-9);
  EXPECT_LT((at(60) - start - Vec3d(0, 0, 0.01)).norm(), 1e-6);
  EXPECT_NEAR(simulation.cloth().state.velocity[60].z(), 0.1, 1e-3);
  run(simulation, 390);
  EXPECT_TRUE(only().target.has_value());
  run(simulation, 20);
  EXPECT_FALSE(only().target.has_value());
  EXPECT_EQ(only().pose.position, goal);
  EXPECT_EQ(simulation.cloth().state.velocity[60], Vec3::Zero().eval()) << "and stands there";
}

TEST_F(GraspedSheet, TurnsAtItsSpeedAndCarriesItsParticlesRound)
{
  const Vec3d center = at(60);
  const std::uint64_t id = take(center, 0.11).id;
  const Vec3d arm = at(61) - center;
  DragTarget drag = target(center, 1.0);
  drag.pose.rotation = turn(0.5 * PI, Vec3d(0, 0, 1));
  drag.angular_speed = 1.0;
  simulation.drag(id, drag);

  run(simulation, 500);
  EXPECT_NEAR(angleBetween(only().pose.rotation, Quatd::Identity()), 0.5, 1e-4);
  EXPECT_LT((at(61) - center - turn(0.5, Vec3d(0, 0, 1)) * arm).norm(), 1e-5);
  run(simulation, 1100);
  EXPECT_FALSE(only().target.has_value());
  EXPECT_LT((at(61) - center - Vec3d(0, 0.1, 0)).norm(), 1e-6);
  EXPECT_NEAR(only().pose.rotation.norm(), 1.0, 1e-12);
}

TEST_F(GraspedSheet, TurnsTheShortWayRoundAlsoByHalfATurn)
{
  const std::uint64_t id = take(at(60), 0.11).id;
  DragTarget drag = target(at(60), 1.0);
  const Quatd there = turn(0.3, Vec3d(0, 1, 0));
  drag.pose.rotation = Quatd(-there.w(), -there.x(), -there.y(), -there.z());  // the same rotation
  drag.angular_speed = 1.0;
  simulation.drag(id, drag);
  run(simulation, 310);
  EXPECT_FALSE(only().target.has_value()) << "0.3 rad, not 2 pi - 0.3";

  drag.pose.rotation = turn(PI, Vec3d(0, 0, 1)) * there;
  simulation.drag(id, drag);
  run(simulation, 3145);
  EXPECT_FALSE(only().target.has_value());
}

TEST_F(GraspedSheet, NeverMovesFasterThanAsked)
{
  const std::uint64_t id = take(at(60), 0.11).id;
  DragTarget drag = target(at(60) + Vec3d(0.2, 0.1, 0.3), 0.7);
  drag.pose.rotation = turn(2.5, Vec3d(1, 2, 3));
  drag.angular_speed = 3.0;
  simulation.drag(id, drag);
  Pose before = only().pose;
  for (int i = 0; i < 900; ++i)
  {
    run(simulation, 1);
    EXPECT_LE((only().pose.position - before.position).norm(), 0.7 * 0.001 * (1 + 1e-9));
    EXPECT_LE(angleBetween(only().pose.rotation, before.rotation), 3.0 * 0.001 + 1e-7);
    before = only().pose;
  }
  EXPECT_FALSE(only().target.has_value());
}

TEST_F(GraspedSheet, FollowsTheSecondOfTwoDrags)
{
  const std::uint64_t id = take(at(60), 0.0).id;
  simulation.drag(id, target(at(60) + Vec3d(1, 0, 0), 0.1));
  run(simulation, 100);
  const Vec3d here = at(60);
  simulation.drag(id, target(here + Vec3d(0, 0, -0.01), 0.1));
  run(simulation, 110);
  EXPECT_LT((at(60) - here - Vec3d(0, 0, -0.01)).norm(), 1e-6);
}

TEST_F(GraspedSheet, LetsGoWithTheSpeedOfTheGripper)
{
  const std::uint64_t id = take(at(60), 0.0).id;
  simulation.drag(id, target(at(60) + Vec3d(0, 0, 1), 0.5));
  run(simulation, 50);

  simulation.release(id);

  EXPECT_TRUE(simulation.grasps().empty());
  EXPECT_FALSE(simulation.cloth().attachments[60].held());
  EXPECT_GT(simulation.cloth().state.inverse_mass[60], 0);
  EXPECT_NEAR(simulation.cloth().state.velocity[60].z(), 0.5, 1e-2);
}

TEST_F(GraspedSheet, LetsGoOfAllAtOnce)
{
  take(at(60), 0.0);
  take(at(100), 0.0);
  EXPECT_EQ(simulation.releaseAll(), 2);
  EXPECT_EQ(simulation.releaseAll(), 0);
  for (int i = 1; i < 121; ++i)
  {
    EXPECT_GT(simulation.cloth().state.inverse_mass[i], 0);
  }
}

TEST_F(GraspedSheet, RefusesToMoveOrReleaseAGraspThatIsNotThere)
{
  EXPECT_EQ(refusalOf([&] { simulation.release(5); }), "there is no grasp 5");
  EXPECT_EQ(refusalOf([&] { simulation.drag(6, DragTarget()); }), "there is no grasp 6");
}

TEST_F(GraspedSheet, RefusesATargetWithAllThatIsWrongWithIt)
{
  const std::uint64_t id = take(at(60), 0.0).id;
  DragTarget drag = target(Vec3d(0, 5000, 0), 0.0);
  drag.pose.rotation = Quatd(1, 1, 0, 0);
  drag.angular_speed = std::nan("");
  const std::string words = refusalOf([&] { simulation.drag(id, drag); });
  for (const char* part :
       { "target position [m].y is 5000, must be at least -1000 and at most 1000",
         "target orientation has length 1.41421, must be a unit quaternion",
         "linear_speed [m/s] is 0, must be greater than 0 and at most 100", "angular_speed" })
  {
    EXPECT_NE(words.find(part), std::string::npos) << words;
  }
  EXPECT_FALSE(only().target.has_value());
}

TEST_F(GraspedSheet, IsNotMovedByTheGraspItself)
{
  const Vec3Array before = simulation.cloth().state.position;
  GraspRequest request;
  request.point = at(60);
  request.radius = 0.3;
  request.frame.position = Vec3d(1, 2, 3);
  request.frame.rotation = turn(1.0, Vec3d(1, 1, 0));
  simulation.grasp(request);

  run(simulation, 10);

  for (int i = 0; i < 121; ++i)
  {
    EXPECT_LT((simulation.cloth().state.position[i] - before[i]).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace cloth
