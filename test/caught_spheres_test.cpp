// Claims of spheres that a hand catches, moves, lets go, throws and removes.
#include <gtest/gtest.h>

#include <functional>

#include "scenes.h"

namespace cloth
{
namespace
{

// A sheet of 1 m in the x-y plane whose border stands still, and balls of 10 cm above it.
class CaughtSphere : public ::testing::Test
{
protected:
  static SimulationParams parameters()
  {
    SimulationParams params = untearable();
    params.contact.sphere_timeout = 0.1;
    return params;
  }

  std::uint64_t thrown(const Vec3d& center, const Vec3d& velocity, double mass)
  {
    ThrowRequest request;
    request.center = center;
    request.velocity = velocity;
    request.mass = mass;
    request.lifetime = 0.2;
    return simulation.throwSphere(request);
  }

  void setStreamed(const Vec3d& velocity)
  {
    Sphere sphere;
    sphere.id = 7;
    sphere.center = high;
    sphere.velocity = velocity;
    simulation.setSpheres({ sphere });
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
      EXPECT_EQ(std::string(refusal.what()).substr(0, words.size()), words);
    }
    EXPECT_EQ(simulation.stateHash(), hash) << "nothing has changed";
  }

  const Sphere& only() const { return simulation.spheres().at(0); }

  ClothModel model = sheet(1.0, 1.0, 11, 11);
  Simulation simulation{ model, wholeBorder(model), parameters() };
  Vec3d high = Vec3d(0.1, -0.4, 1.0);
};

TEST_F(CaughtSphere, StandsStillAndDoesNotAgeUntilItIsLetGo)
{
  const std::uint64_t id = thrown(high, Vec3d(1.0, 0.0, 0.0), 0.5);
  run(simulation, 100);
  const Vec3d place = only().center;
  const Vec3d velocity = only().velocity;

  simulation.holdSphere(SphereSource::THROWN, id, place);
  run(simulation, 1000);
  EXPECT_EQ(only().center, place) << "five lifetimes later";

  simulation.letGoOfSphere(SphereSource::THROWN, id);
  EXPECT_EQ(only().velocity, velocity);
  run(simulation, 90);
  EXPECT_GT(only().center.x(), place.x() + 0.08) << "it flies on";
  EXPECT_LT(only().center.z(), place.z()) << "and falls";
  run(simulation, 20);
  EXPECT_TRUE(simulation.spheres().empty()) << "its lifetime goes on";
}

TEST_F(CaughtSphere, GoesWhereItIsSentAndPushesTheClothOnItsWay)
{
  for (const double mass : { 0.0, 0.001 })
  {
    simulation.reset();
    const Vec3d start(0.0, -0.5, 0.15);
    const std::uint64_t id = thrown(start, Vec3d::Zero(), mass);
    simulation.holdSphere(SphereSource::THROWN, id, start);
    run(simulation, 100);
    const Vec3d end(0.0, -0.5, -0.05);
    simulation.holdSphere(SphereSource::THROWN, id, end);
    run(simulation, 50);
    EXPECT_GT(only().center.z(), end.z() + 0.05) << "swept, not placed";
    run(simulation, 51);
    EXPECT_NEAR((only().center - end).norm(), 0.0, 1e-9)
        << "the cloth cannot push it, mass " << mass;
    EXPECT_LT(simulation.cloth().state.position[60].z(), Real(-0.12)) << "the middle of the sheet";
  }
}

TEST_F(CaughtSphere, OfAStreamMovesOnLikeANewOneWhenItIsLetGo)
{
  setStreamed(Vec3d(0.0, 1.0, 0.0));
  run(simulation, 50);
  simulation.holdSphere(SphereSource::STREAMED, 7, high);
  run(simulation, 200);
  EXPECT_NEAR((only().center - high).norm(), 0.0, 1e-9);
  simulation.letGoOfSphere(SphereSource::STREAMED, 7);
  run(simulation, 500);
  EXPECT_NEAR(only().center.y() - high.y(), 0.1, 2e-3) << "for sphere_timeout";
}

TEST_F(CaughtSphere, BelongsToTheStreamAgainByTheNextSet)
{
  setStreamed(Vec3d::Zero());
  simulation.holdSphere(SphereSource::STREAMED, 7, high);
  run(simulation, 10);
  setStreamed(Vec3d(0.0, 0.0, 1.0));
  EXPECT_FALSE(only().caught);
  run(simulation, 50);
  EXPECT_NEAR(only().center.z(), high.z() + 0.05, 1e-3);
}

TEST_F(CaughtSphere, IsCaughtInARestoredStateToo)
{
  const std::uint64_t id = thrown(high, Vec3d::Zero(), 1.0);
  simulation.holdSphere(SphereSource::THROWN, id, high);
  Simulation flying = simulation;
  flying.letGoOfSphere(SphereSource::THROWN, id);
  EXPECT_NE(simulation.stateHash(), flying.stateHash());
  Simulation restored = simulation.restored(simulation.save());
  EXPECT_TRUE(restored.spheres().at(0).caught);
  run(simulation, 20);
  run(restored, 20);
  EXPECT_EQ(restored.stateHash(), simulation.stateHash());
}

TEST_F(CaughtSphere, IsThrownAtTheCentreOfTheClothUnderANumberOfItsOwn)
{
  setStreamed(Vec3d::Zero());
  const std::uint64_t id = simulation.throwAtCloth(SphereSource::STREAMED, 7, 2.0);
  ASSERT_EQ(simulation.spheres().size(), 1u);
  EXPECT_EQ(only().source, SphereSource::THROWN);
  EXPECT_EQ(only().id, id);
  EXPECT_EQ(only().center, high);
  EXPECT_NEAR(only().velocity.norm(), 2.0, 1e-12);
  const Vec3d way = (Vec3d(0.0, -0.5, 0.0) - high).normalized();
  EXPECT_NEAR(only().velocity.normalized().dot(way), 1.0, 1e-6);

  EXPECT_EQ(simulation.throwAtCloth(SphereSource::THROWN, id, 3.0), id + 1);
  ASSERT_EQ(simulation.spheres().size(), 1u);
  EXPECT_NEAR(only().velocity.norm(), 3.0, 1e-12);
}

TEST_F(CaughtSphere, CanBeRemoved)
{
  const std::uint64_t id = thrown(high, Vec3d::Zero(), 0.0);
  setStreamed(Vec3d::Zero());
  simulation.removeSphere(SphereSource::THROWN, id);
  ASSERT_EQ(simulation.spheres().size(), 1u);
  EXPECT_EQ(only().id, 7u);
  simulation.removeSphere(SphereSource::STREAMED, 7);
  EXPECT_TRUE(simulation.spheres().empty());
}

TEST_F(CaughtSphere, IsRefusedUnlessItIsThereAndFreeAndThePlaceIsOne)
{
  const SphereSource streamed = SphereSource::STREAMED;
  const SphereSource by_hand = SphereSource::THROWN;
  Sphere finger;
  finger.id = 3;
  finger.center = high;
  finger.frame = "finger";
  simulation.setSpheres({ finger });
  const std::uint64_t id = thrown(high, Vec3d::Zero(), 0.0);
  expectRefused([&] { simulation.holdSphere(streamed, 4, high); }, "there is no sphere 4");
  expectRefused([&] { simulation.holdSphere(by_hand, 99, high); }, "there is no thrown sphere 99");
  expectRefused([&] { simulation.letGoOfSphere(streamed, 4); }, "there is no sphere 4");
  expectRefused([&] { simulation.removeSphere(streamed, 4); }, "there is no sphere 4");
  expectRefused([&] { simulation.throwAtCloth(streamed, 4, 1.0); }, "there is no sphere 4");
  expectRefused([&] { simulation.holdSphere(streamed, 3, high); },
                "sphere 3 follows the frame \"finger\": nothing else can move it");
  expectRefused([&] { simulation.holdSphere(by_hand, id, Vec3d(0.0, NAN, 0.0)); },
                "thrown sphere " + std::to_string(id) + ": center [m].y is nan");
  expectRefused([&] { simulation.throwAtCloth(by_hand, id, 0.0); }, "speed [m/s] is 0");
}

}  // namespace
}  // namespace cloth
