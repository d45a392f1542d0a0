// Claims of thesis 4.3: how much the cloth of the profile tears, and that no tear is missed.
#include "cloth_tearing/experiments/profile_experiment.h"

#include <gtest/gtest.h>

#include <map>

#include "scenes.h"

namespace cloth
{
namespace
{

/// The profile's tears on the cloth of 4.3, and the cloth it leaves.
struct Profiled
{
  Simulation simulation;
  ProfileOutcome outcome;
  std::vector<TearEvent> tears;

  explicit Profiled(const Simulation& hung) : simulation(hung)
  {
    outcome = profile(simulation, [this](const Simulation&, const StepReport& report)
                      { tears.insert(tears.end(), report.tears.begin(), report.tears.end()); });
  }
};

const Simulation& hung()
{
  static const Simulation HUNG = profileCloth(Setting());
  return HUNG;
}

const Profiled& profiled()
{
  static const Profiled PROFILED(hung());
  return PROFILED;
}

TEST(Profile, BeginsWithTheCountsOfTheThesis)
{
  const Summary& before = profiled().outcome.before;
  EXPECT_EQ(before.particles, 900);
  EXPECT_EQ(before.springs, 2581);
  EXPECT_EQ(before.bend_shear_springs, 2465);
  EXPECT_EQ(before.triangles, 1682);
  EXPECT_EQ(before.pieces, 1);
  EXPECT_TRUE(profiled().outcome.hasThesisCounts());
}

TEST(Profile, HasEverythingSwitchedOnThatTheThesisLists)
{
  const SimulationParams& params = hung().params();
  EXPECT_LT(params.environment.gravity.z(), 0.0);
  EXPECT_GT(params.environment.air_friction, 0.0);
  EXPECT_GT(params.material.damping, 0.0);
  EXPECT_GT(params.environment.wind.norm() * params.environment.wind_drag, 0.0);
  EXPECT_TRUE(params.tearing.enabled);
}

TEST(Profile, TearsAboutAsOftenAsTheThesis)
{
  const ProfileOutcome& outcome = profiled().outcome;
  EXPECT_GE(outcome.tears(), 400);
  EXPECT_LE(outcome.tears(), 650);
  EXPECT_EQ(outcome.tears(), static_cast<int>(profiled().tears.size()));
}

TEST(Profile, TearsAllTheTimeInManyPlaces)
{
  const double start = hung().time();
  std::map<int, int> by_second;
  std::map<std::pair<int, int>, int> by_place;
  for (const TearEvent& tear : profiled().tears)
  {
    ++by_second[static_cast<int>(tear.time - start - 1e-9)];
    ++by_place[{ static_cast<int>(4.0 * tear.uv.x()), static_cast<int>(4.0 * tear.uv.y()) }];
  }
  EXPECT_GE(by_second.size(), 32u);
  EXPECT_EQ(profiled().outcome.torn_time, static_cast<double>(by_second.size()));
  for (const auto& [second, tears] : by_second)
  {
    EXPECT_LE(tears, 65) << "second " << second;
  }
  EXPECT_GE(by_place.size(), 14u) << "of 16 fields of the cloth";
}

TEST(Profile, CountsWhatItsTearsAdd)
{
  const ProfileOutcome& outcome = profiled().outcome;
  std::size_t added = 0;
  for (const TearEvent& tear : profiled().tears)
  {
    added += tear.particles.size();
  }
  EXPECT_EQ(outcome.after.particles, outcome.before.particles + static_cast<int>(added));
  EXPECT_GT(outcome.after.springs, outcome.before.springs);
  EXPECT_GT(outcome.after.triangles, outcome.before.triangles);
  EXPECT_GT(outcome.after.pieces, 1);
  int tears = 0;
  for (std::uint64_t kind : outcome.after.tears)
  {
    tears += static_cast<int>(kind);
  }
  EXPECT_EQ(tears, outcome.tears());
}

TEST(Profile, KeepsMassAreaAndTexture)
{
  const ProfileOutcome& outcome = profiled().outcome;
  EXPECT_NEAR(outcome.after.mass, outcome.before.mass, 1e-11);
  EXPECT_NEAR(outcome.after.rest_area, outcome.before.rest_area, 1e-10);
  EXPECT_NEAR(textureArea(profiled().simulation.cloth().mesh), 1.0, 1e-12);
}

TEST(Profile, LeavesASoundMesh)
{
  EXPECT_TRUE(isSound(profiled().simulation.cloth().mesh));
  EXPECT_TRUE(allFinite(profiled().simulation.cloth().state));
}

TEST(Profile, TimesEveryPhase)
{
  for (double time : profiled().outcome.time)
  {
    EXPECT_GT(time, 0.0);
  }
}

// Where there is something to strike, every spring is looked at in every step.
TEST(Profile, MissesNoTearThatALookAtAllSpringsFinds)
{
  Simulation thorough = hung();
  ThrowRequest far_away;
  far_away.center = Vec3d(0, 45, 0);
  far_away.lifetime = 1000.0;
  thorough.throwSphere(far_away);

  const Profiled expected(thorough);

  ASSERT_EQ(profiled().tears.size(), expected.tears.size());
  for (std::size_t i = 0; i < expected.tears.size(); ++i)
  {
    EXPECT_EQ(profiled().tears[i].step, expected.tears[i].step);
    EXPECT_EQ(profiled().tears[i].spring, expected.tears[i].spring);
    EXPECT_EQ(profiled().tears[i].strain, expected.tears[i].strain);
  }
}

}  // namespace
}  // namespace cloth
