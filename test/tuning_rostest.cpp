// Parameters change while the node runs, and what cannot be is not.
#include <cloth_tearing/NamedState.h>
#include <cloth_tearing/SimulationStatus.h>
#include <cloth_tearing/Step.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <std_srvs/Trigger.h>

#include <future>
#include <limits>

#include "cloth_tearing/node/params_loader.h"
#include "node_client.h"

using cloth_tearing::SimulationStatus;
using cloth_tearing::Step;
using dynamic_reconfigure::Config;
using dynamic_reconfigure::ConfigTools;
using dynamic_reconfigure::Reconfigure;

namespace
{

constexpr int STEPS = 150;

/// The groups with a server of their own; the last one has no name.
const std::vector<std::string> GROUPS = {
  "/material", "/environment", "/environment/gravity", "/environment/wind",
  "/tearing",  "/contact",     "/contact/bounds_min",  "/contact/bounds_max",
  ""
};

std::uint64_t hashAfter(std::uint32_t steps, const std::string& node = "/tuned")
{
  Step::Request request;
  request.steps = steps;
  const Step::Response answer = ask<Step>(node + "/step", request);
  EXPECT_TRUE(answer.success) << answer.message;
  return answer.state_hash;
}

/// The parameters that the node was started with, or has left on the parameter server.
cloth_tearing::NodeParams paramsAt(const std::string& name)
{
  XmlRpc::XmlRpcValue tree;
  EXPECT_TRUE(ros::param::get(name, tree));
  const cloth_tearing::LoadedParams loaded = cloth_tearing::loadParams(tree);
  for (const std::string& problem : loaded.problems)
  {
    ADD_FAILURE() << name << ": " << problem;
  }
  return loaded.params;
}

/// The cloth that a node of these parameters has.
cloth::Simulation simulationOf(const cloth_tearing::NodeParams& params)
{
  const cloth_tearing::PlacedModel placed = cloth_tearing::placedModel(params);
  return { placed.model, placed.pinned, cloth_tearing::inClothFrame(params) };
}

std::uint64_t hashAfter(int steps, cloth::Simulation& simulation)
{
  for (int i = 0; i < steps; ++i)
  {
    simulation.step();
  }
  return simulation.stateHash();
}

Config values(const std::vector<std::pair<std::string, double>>& numbers)
{
  Config config;
  for (const auto& entry : numbers)
  {
    ConfigTools::appendParameter(config, entry.first, entry.second);
  }
  return config;
}

Config set(const std::string& group, const Config& wanted, const std::string& node = "/tuned")
{
  Reconfigure call;
  call.request.config = wanted;
  EXPECT_TRUE(
      ros::service::waitForService(node + group + "/set_parameters", ros::Duration(PATIENCE)));
  EXPECT_TRUE(ros::service::call(node + group + "/set_parameters", call));
  return call.response.config;
}

double number(const Config& config, const std::string& name)
{
  double value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(ConfigTools::getParameter(config, name, value)) << name;
  return value;
}

void reset()
{
  EXPECT_TRUE(ask<std_srvs::Trigger>("/tuned/reset").success);
}

std::uint64_t refusals()
{
  Collector<SimulationStatus> status("/tuned/status");
  return status.first().refusals;
}

std::string text(const Config& config)
{
  std::ostringstream shown;
  shown << config;
  return shown.str();
}

}  // namespace

TEST(Tuning, ShowsTheDefaultsOfTheCoreAsItsOwn)
{
  for (const std::string& group : GROUPS)
  {
    Collector<dynamic_reconfigure::ConfigDescription> description("/default" + group +
                                                                  "/parameter_descriptions");
    Collector<Config> update("/default" + group + "/parameter_updates");
    EXPECT_EQ(text(update.first()), text(description.first().dflt)) << group;
  }
}

// Before anything else is tuned: tests run in this order.
TEST(Tuning, ChangesNothingByBeingThere)
{
  cloth::Simulation expected = simulationOf(paramsAt("/expected"));

  EXPECT_EQ(hashAfter(STEPS), hashAfter(STEPS, expected));

  Collector<Config> gravity("/tuned/environment/gravity/parameter_updates");
  EXPECT_EQ(number(gravity.first(), "y"), 0.5);
  EXPECT_EQ(number(gravity.first(), "z"), -9.0);
  Collector<Config> material("/tuned/material/parameter_updates");
  EXPECT_EQ(number(material.first(), "stiffness"), 90.0);
  Collector<Config> contact("/tuned/contact/parameter_updates");
  EXPECT_EQ(number(contact.first(), "floor_height"), 0.2) << "as it was given, in frame_id";
}

TEST(Tuning, LeavesParametersWithWhichANodeWouldBeTheSameCloth)
{
  const cloth_tearing::NodeParams given = paramsAt("/expected");
  const cloth_tearing::NodeParams left = paramsAt("/tuned");

  EXPECT_EQ(left.simulation.environment.gravity, given.simulation.environment.gravity);
  EXPECT_EQ(left.simulation.contact.bounds_min, given.simulation.contact.bounds_min);
  cloth::Simulation one = simulationOf(given);
  cloth::Simulation other = simulationOf(left);
  EXPECT_EQ(hashAfter(STEPS, other), hashAfter(STEPS, one));
}

TEST(Tuning, IsWhatANodeWithTheseParametersWouldDo)
{
  reset();
  set("/material", values({ { "stiffness", 75.5 }, { "areal_density", 0.2 } }));
  set("/environment", values({ { "air_friction", 0.7 } }));
  set("/environment/gravity", values({ { "x", 0.25 }, { "z", -1.0 / 3.0 } }));
  set("/environment/wind", values({ { "y", 2.0 } }));
  set("/tearing", values({ { "hem_width", 0.15 }, { "tear_strain", 0.3 } }));
  Config contact = values({ { "floor_height", 1.3 }, { "friction", 0.4 } });
  EXPECT_EQ(number(set("/contact", contact), "floor_height"), 1.3);
  set("/contact/bounds_max", values({ { "z", 30.0 } }));
  Config solver = values({ { "max_strain", 0.2 } });
  ConfigTools::appendParameter(solver, std::string("max_substeps"), 12);
  set("", solver);
  cloth_tearing::NodeParams params = paramsAt("/expected");
  cloth::SimulationParams& wanted = params.simulation;
  wanted.material.stiffness = 75.5;
  wanted.material.areal_density = 0.2;
  wanted.environment.air_friction = 0.7;
  wanted.environment.gravity = cloth::Vec3d(0.25, 0.5, -1.0 / 3.0);
  wanted.environment.wind.y() = 2.0;
  wanted.tearing.hem_width = 0.15;
  wanted.tearing.tear_strain = 0.3;
  wanted.contact.floor_height = 1.3;
  wanted.contact.friction = 0.4;
  wanted.contact.bounds_max.z() = 30.0;
  wanted.solver.max_strain = 0.2;
  wanted.solver.max_substeps = 12;

  const std::uint64_t tuned = hashAfter(STEPS);

  cloth::Simulation expected = simulationOf(params);
  EXPECT_EQ(tuned, hashAfter(STEPS, expected));
  const cloth_tearing::NodeParams left = paramsAt("/tuned");
  EXPECT_EQ(left.simulation.environment.gravity, wanted.environment.gravity)
      << "a list of three has become a group of three";
  EXPECT_EQ(left.simulation.solver.max_substeps, 12);
  cloth::Simulation restarted = simulationOf(left);
  EXPECT_EQ(tuned, hashAfter(STEPS, restarted));
  reset();
  EXPECT_EQ(tuned, hashAfter(STEPS)) << "a reset keeps the values";
}

TEST(Tuning, IsAnsweredWithTheValuesInForceWhereItIsRefused)
{
  const std::uint64_t before = refusals();
  const std::uint64_t hash = hashAfter(0);
  Config wanted = values({ { "tear_strain", 0.05 }, { "hem_factor", 3.0 } });

  const Config answer = set("/tearing", wanted);

  EXPECT_EQ(number(answer, "tear_strain"), 0.3);
  EXPECT_EQ(number(answer, "hem_factor"), 2.0) << "all or nothing";
  EXPECT_EQ(hashAfter(0), hash);
  EXPECT_EQ(paramsAt("/tuned").simulation.tearing.hem_factor, 2.0);
  Collector<SimulationStatus> status("/tuned/status");
  const SimulationStatus counted =
      status.waitFor("the refusal", [&](const auto& s) { return s.refusals == before + 1; });
  EXPECT_NE(counted.last_refusal.find("tearing/set_parameters: weak_tear_strain"),
            std::string::npos)
      << counted.last_refusal;
  EXPECT_EQ(number(set("/tearing", values({ { "hem_factor", 3.0 } })), "hem_factor"), 3.0);
}

TEST(Tuning, RefusesWhatIsNoNumberOrNoName)
{
  const std::uint64_t before = refusals();
  EXPECT_EQ(number(set("/material", values({ { "damping", std::nan("") } })), "damping"), 0.02);
  Config wanted;
  ConfigTools::appendParameter(wanted, std::string("stiffness_law"), std::string("by_mood"));
  std::string law;
  EXPECT_TRUE(ConfigTools::getParameter(set("/material", wanted), "stiffness_law", law));
  EXPECT_EQ(law, "per_width");
  EXPECT_EQ(refusals(), before + 2);
}

TEST(Tuning, RefusesValuesBeyondALimit)
{
  EXPECT_EQ(number(set("/environment/wind", values({ { "x", 100.0 } })), "x"), 100.0);
  EXPECT_EQ(number(set("/environment/wind", values({ { "x", 0.0 } })), "x"), 0.0);
  EXPECT_EQ(number(set("/environment/wind", values({ { "x", 1e9 } })), "x"), 0.0);
}

TEST(Tuning, ToTheSameValuesIsNoChange)
{
  const std::uint64_t before = refusals();
  cloth::Simulation expected = simulationOf(paramsAt("/tuned"));
  reset();
  EXPECT_EQ(hashAfter(STEPS), hashAfter(STEPS, expected));

  set("/material", values({ { "stiffness", 75.5 } }));

  EXPECT_EQ(hashAfter(STEPS), hashAfter(STEPS, expected));
  EXPECT_EQ(refusals(), before);
}

TEST(Tuning, ShowsTheValuesThatARestoredStateBrings)
{
  set("/material", values({ { "stiffness", 70.0 } }));
  cloth_tearing::NamedState::Request request;
  request.name = "soft";
  ASSERT_TRUE(ask<cloth_tearing::NamedState>("/tuned/save_state", request).success);
  set("/material", values({ { "stiffness", 120.0 } }));

  ASSERT_TRUE(ask<cloth_tearing::NamedState>("/tuned/restore_state", request).success);

  EXPECT_EQ(paramsAt("/tuned").simulation.material.stiffness, 70.0);
  EXPECT_EQ(number(set("/material", values({ { "damping", 0.03 } })), "stiffness"), 70.0);
  EXPECT_EQ(paramsAt("/tuned").simulation.contact.floor_height, 1.3) << "as it was given";
}

TEST(Tuning, ChangesTheSpeedThatIsWanted)
{
  EXPECT_EQ(number(set("", values({ { "speed", 1e6 } }), "/live"), "speed"), 1.0);
  EXPECT_EQ(number(set("", values({ { "speed", 0.25 } }), "/live"), "speed"), 0.25);
  EXPECT_EQ(paramsAt("/live").speed, 0.25);
  Collector<SimulationStatus> status("/live/status");
  const SimulationStatus slow =
      status.waitFor("the speed reached", [](const auto& s)
                     { return s.real_time_factor > 0.0 && s.real_time_factor < 0.3; });
  EXPECT_EQ(slow.speed, 0.25);
  EXPECT_EQ(number(set("", values({ { "speed", std::nan("") } }), "/live"), "speed"), 0.25);
  status.waitFor("the refusal",
                 [](const auto& s) { return s.last_refusal.find("set_parameters: speed") == 0; });
  EXPECT_EQ(number(set("", values({ { "speed", 1.0 } }), "/live"), "speed"), 1.0);
}

TEST(Tuning, IsSafeWhileItRuns)
{
  const std::uint64_t before = Collector<SimulationStatus>("/live/status").first().refusals;
  const auto tuneAll = [](const std::string& group, const std::string& name, double from)
  {
    for (int i = 0; i < 40; ++i)
    {
      EXPECT_EQ(number(set(group, values({ { name, from + i } }), "/live"), name), from + i);
    }
  };
  auto material = std::async(std::launch::async, tuneAll, "/material", "stiffness", 60.0);
  auto gravity = std::async(std::launch::async, tuneAll, "/environment/gravity", "z", -20.0);
  tuneAll("/tearing", "hem_factor", 2.0);
  material.get();
  gravity.get();

  Collector<SimulationStatus> status("/live/status");
  const SimulationStatus after = status.first();
  EXPECT_FALSE(after.paused) << after.fault;
  EXPECT_EQ(after.refusals, before) << after.last_refusal;
  const cloth::SimulationParams left = paramsAt("/live").simulation;
  EXPECT_EQ(left.material.stiffness, 99.0);
  EXPECT_EQ(left.environment.gravity.z(), 19.0);
  EXPECT_EQ(left.tearing.hem_factor, 41.0);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "tuning_rostest");
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
