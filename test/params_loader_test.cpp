// Parameters are carried over the defaults, and everything wrong with them is named at once.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "cloth_tearing/node/limit_words.h"
#include "cloth_tearing/node/params_loader.h"

using cloth_tearing::loadParams;
using XmlRpc::XmlRpcValue;

namespace
{

XmlRpcValue list(const std::vector<XmlRpcValue>& entries)
{
  XmlRpcValue result;
  result.setSize(static_cast<int>(entries.size()));
  for (std::size_t i = 0; i < entries.size(); ++i)
  {
    result[static_cast<int>(i)] = entries[i];
  }
  return result;
}

std::string joined(const std::vector<std::string>& lines)
{
  std::string all;
  for (const std::string& line : lines)
  {
    all += line + "\n";
  }
  return all;
}

/// The problems with a tree of one wrong entry.
std::string problemsWith(const std::string& group, const std::string& entry,
                         const XmlRpcValue& value)
{
  XmlRpcValue tree;
  if (group.empty())
  {
    tree[entry] = value;
  }
  else
  {
    tree[group][entry] = value;
  }
  return joined(loadParams(tree).problems);
}

}  // namespace

TEST(ParamsLoader, FindsNothingWrongWithNoParametersAtAll)
{
  EXPECT_EQ(joined(loadParams(XmlRpcValue()).problems), "");
}

TEST(ParamsLoader, CarriesValuesOfEveryTypeOverTheDefaults)
{
  XmlRpcValue tree;
  tree["frame_id"] = "map";
  tree["pace"] = "step";
  tree["speed"] = 0.25;
  tree["paused"] = true;
  tree["cloth_pose"]["position"] = list({ 1, 2.5, -3 });
  tree["cloth_pose"]["rotation"] = list({ 0, 0, 1, 0 });
  tree["rectangle"]["columns"] = 12;
  tree["rectangle"]["pattern"] = "irregular";
  tree["rectangle"]["seed"] = 7;
  tree["rectangle"]["slits"] = list({ list({ 0.1, -0.2, 0.3, -0.4 }) });
  tree["pins"]["edges"] = list({ "left", "right" });
  tree["pins"]["particles"] = list({ 4, 5 });
  tree["pins"]["regions"] = list({ list({ 0, 0, 0, 1 }) });
  tree["solver"] = "force_springs";
  tree["threads"] = 3;
  tree["material"]["stiffness"] = 55.5;
  tree["material"]["stiffness_law"] = "per_spring";
  tree["tearing"]["enabled"] = false;
  tree["markers"]["coloring"] = "strain";

  const cloth_tearing::LoadedParams loaded = loadParams(tree);

  ASSERT_EQ(joined(loaded.problems), "");
  const cloth_tearing::NodeParams& params = loaded.params;
  EXPECT_EQ(params.frame_id, "map");
  EXPECT_EQ(params.pace, cloth::Pace::STEP);
  EXPECT_EQ(params.speed, 0.25);
  EXPECT_TRUE(params.paused);
  EXPECT_EQ(params.cloth_pose.position, cloth::Vec3d(1.0, 2.5, -3.0));
  EXPECT_EQ(params.cloth_pose.rotation.z(), 1.0);
  EXPECT_EQ(params.rectangle.columns, 12);
  EXPECT_EQ(params.rectangle.pattern, cloth::RectanglePattern::IRREGULAR);
  EXPECT_EQ(params.rectangle.seed, 7u);
  ASSERT_EQ(params.rectangle.slits.size(), 1u);
  EXPECT_EQ(params.rectangle.slits[0].end, cloth::Vec2d(0.3, -0.4));
  EXPECT_EQ(params.pins.edges, (std::vector<std::string>{ "left", "right" }));
  EXPECT_EQ(params.pins.particles, (std::vector<int>{ 4, 5 }));
  ASSERT_EQ(params.pins.regions.size(), 1u);
  EXPECT_EQ(params.pins.regions[0].radius, 1.0);
  EXPECT_EQ(params.simulation.solver.kind, cloth::SolverKind::FORCE_SPRINGS);
  EXPECT_EQ(params.simulation.threads, 3);
  EXPECT_EQ(params.simulation.material.stiffness, 55.5);
  EXPECT_EQ(params.simulation.material.stiffness_law, cloth::StiffnessLaw::PER_SPRING);
  EXPECT_FALSE(params.simulation.tearing.enabled);
  EXPECT_EQ(params.markers.coloring, cloth_tearing::Coloring::STRAIN);
}

TEST(ParamsLoader, TakesAVectorAsAListOrAsAGroupOfItsAxes)
{
  XmlRpcValue tree;
  tree["environment"]["wind"] = list({ 1, 2.5, -3 });
  tree["environment"]["gravity"]["x"] = 1;
  tree["environment"]["gravity"]["y"] = 2.5;
  tree["environment"]["gravity"]["z"] = -3.0;

  const cloth_tearing::LoadedParams loaded = loadParams(tree);

  EXPECT_EQ(joined(loaded.problems), "");
  EXPECT_EQ(loaded.params.simulation.environment.wind, cloth::Vec3d(1.0, 2.5, -3.0));
  EXPECT_EQ(loaded.params.simulation.environment.gravity, cloth::Vec3d(1.0, 2.5, -3.0));
}

TEST(ParamsLoader, RefusesAVectorOfWhichAnAxisIsMissingOrWrongOrTooMany)
{
  XmlRpcValue tree;
  tree["environment"]["gravity"]["x"] = 1.0;
  tree["environment"]["wind"]["x"] = 1.0;
  tree["environment"]["wind"]["y"] = "strong";
  tree["environment"]["wind"]["z"] = std::numeric_limits<double>::infinity();
  tree["environment"]["wind"]["w"] = 1.0;

  const std::string problems = joined(loadParams(tree).problems);

  EXPECT_NE(problems.find("there is no environment/gravity/y, environment/gravity/z"),
            std::string::npos)
      << problems;
  EXPECT_NE(problems.find("environment/wind/y is the text \"strong\", must be a number"),
            std::string::npos)
      << problems;
  EXPECT_NE(problems.find("environment/wind/z is inf"), std::string::npos) << problems;
  EXPECT_NE(problems.find("there is no parameter environment/wind/w"), std::string::npos)
      << problems;
}

TEST(ParamsLoader, CarriesTheStrengthMapNumberByNumber)
{
  XmlRpcValue tree;
  tree["strength"]["scatter"] = 0.2;
  tree["strength"]["seed"] = 9;
  tree["strength"]["spots"] = list({ list({ 0.1, -0.2, 0.3, 0.04, 0.5 }) });
  tree["strength"]["lines"] = list({ list({ 1, 2, 3, 4, 5, 6, 0.7, 8 }) });
  tree["strength"]["perforations"] = list({ list({ 1, 2, 3, 4, 5, 6, 0.7, 0.8, 0.09, 0.6 }) });
  tree["strength"]["border_factor"] = 3.0;
  tree["strength"]["border_width"] = 0.05;

  const cloth_tearing::LoadedParams loaded = loadParams(tree);

  ASSERT_EQ(joined(loaded.problems), "");
  const cloth::StrengthParams& strength = loaded.params.simulation.strength;
  EXPECT_EQ(strength.scatter, 0.2);
  EXPECT_EQ(strength.seed, 9u);
  ASSERT_EQ(strength.spots.size(), 1u);
  EXPECT_EQ(strength.spots[0].center, cloth::Vec3d(0.1, -0.2, 0.3));
  EXPECT_EQ(strength.spots[0].radius, 0.04);
  EXPECT_EQ(strength.spots[0].factor, 0.5);
  ASSERT_EQ(strength.lines.size(), 1u);
  EXPECT_EQ(strength.lines[0].from, cloth::Vec3d(1.0, 2.0, 3.0));
  EXPECT_EQ(strength.lines[0].to, cloth::Vec3d(4.0, 5.0, 6.0));
  EXPECT_EQ(strength.lines[0].width, 0.7);
  EXPECT_EQ(strength.lines[0].factor, 8.0);
  ASSERT_EQ(strength.perforations.size(), 1u);
  EXPECT_EQ(strength.perforations[0].line.to, cloth::Vec3d(4.0, 5.0, 6.0));
  EXPECT_EQ(strength.perforations[0].line.factor, 0.8);
  EXPECT_EQ(strength.perforations[0].pitch, 0.09);
  EXPECT_EQ(strength.perforations[0].duty, 0.6);
  EXPECT_EQ(strength.border_factor, 3.0);
  EXPECT_EQ(strength.border_width, 0.05);
}

TEST(ParamsLoader, KnowsEveryColoring)
{
  using cloth_tearing::Coloring;
  const std::map<std::string, Coloring> colorings = { { "texture", Coloring::TEXTURE },
                                                      { "strain", Coloring::STRAIN },
                                                      { "plain", Coloring::PLAIN },
                                                      { "wireframe", Coloring::WIREFRAME } };
  for (const auto& entry : colorings)
  {
    XmlRpcValue tree;
    tree["markers"]["coloring"] = entry.first;

    const cloth_tearing::LoadedParams loaded = loadParams(tree);

    EXPECT_EQ(joined(loaded.problems), "");
    EXPECT_EQ(loaded.params.markers.coloring, entry.second) << entry.first;
  }
}

TEST(ParamsLoader, TakesWholeNumbersForRealOnes)
{
  XmlRpcValue tree;
  tree["marker_rate"] = 20;
  tree["material"]["stiffness"] = 55;

  const cloth_tearing::LoadedParams loaded = loadParams(tree);

  ASSERT_EQ(joined(loaded.problems), "");
  EXPECT_EQ(loaded.params.marker_rate, 20.0);
  EXPECT_EQ(loaded.params.simulation.material.stiffness, 55.0);
}

TEST(ParamsLoader, NamesEveryProblemAtOnce)
{
  XmlRpcValue tree;
  tree["time_step"] = "fast";
  tree["material"]["stiffness"] = -1.0;
  tree["environment"]["wind"] = list({ 0, 0 });
  tree["tearing"]["tear_strian"] = 0.3;
  tree["marker_rate"] = std::numeric_limits<double>::quiet_NaN();
  tree["rectangle"]["rows"] = 1;

  const std::string found = joined(loadParams(tree).problems);

  for (const char* name : { "time_step", "material/stiffness", "environment/wind",
                            "tearing/tear_strian", "marker_rate", "rectangle/rows" })
  {
    EXPECT_NE(found.find(name), std::string::npos) << name << " is not among:\n" << found;
  }
  EXPECT_EQ(loadParams(tree).problems.size(), 6u) << found;
}

TEST(ParamsLoader, RefusesToFollowTheClockThatItPublishes)
{
  XmlRpcValue tree;
  tree["pace"] = "clock";
  EXPECT_EQ(joined(loadParams(tree).problems), "");
  EXPECT_EQ(loadParams(tree).params.pace, cloth::Pace::CLOCK);
  tree["publish_clock"] = true;
  EXPECT_NE(joined(loadParams(tree).problems).find("publish_clock is true with pace clock"),
            std::string::npos);
}

TEST(ParamsLoader, RefusesLinesOfForceSprings)
{
  XmlRpcValue tree;
  tree["lines"] = true;
  EXPECT_EQ(joined(loadParams(tree).problems), "");
  EXPECT_TRUE(loadParams(tree).params.simulation.solver.lines);
  tree["solver"] = "force_springs";
  EXPECT_NE(joined(loadParams(tree).problems).find("lines is true, must be false"),
            std::string::npos);
}

TEST(ParamsLoader, SaysWhatIsWrongWithAValue)
{
  const double infinity = std::numeric_limits<double>::infinity();
  struct Case
  {
    const char* group;
    const char* entry;
    XmlRpcValue value;
    const char* expected;
  };
  const std::vector<Case> cases = {
    { "", "frame_id", 3, "must be text" },
    { "", "frame_id", "", "frame_id is empty" },
    { "", "frame_id", "/world", "must not begin with a slash" },
    { "", "paused", 1, "must be true or false" },
    { "", "pace", "", "must be one of clock, free, step, wall" },
    { "", "speed", 0, "speed is 0" },
    { "", "clock_rate", 0, "clock_rate [Hz] is 0" },
    { "", "state_folder", "states", "must be an absolute path" },
    { "", "recording_folder", "runs", "must be an absolute path" },
    { "", "recording_limit", 0.5, "recording_limit [MB] is 0.5" },
    { "", "max_states", 0, "max_states is 0" },
    { "", "max_state_memory", 0.5, "max_state_memory [MB] is 0.5" },
    { "", "solver", 1, "must be one of force_springs, xpbd" },
    { "", "lines", 1, "must be true or false" },
    { "", "time_step", "1e-3", "write 1.0e-3" },
    { "", "time_step", 0.5, "time_step [s] is 0.5" },
    { "", "time_step", infinity, "must be finite" },
    { "", "tear_log_size", 10.5, "must be a whole number" },
    { "", "tear_log_size", 0, "tear_log_size is 0" },
    { "", "threads", -1, "threads is -1, must be at least 0 and at most 256" },
    { "", "threads", 257, "threads is 257, must be at least 0 and at most 256" },
    { "", "threads", 1.5, "threads is the number 1.5, must be a whole number" },
    { "", "marker_rate", 0.0, "marker_rate [Hz] is 0" },
    { "", "max_grasp_distance", -1.0, "max_grasp_distance [m] is -1" },
    { "", "grasp_force_filter", -1.0, "grasp_force_filter [s] is -1" },
    { "", "max_gripper_speed", 0.0, "max_gripper_speed [m/s] is 0" },
    { "", "max_gripper_turn", 0.0, "max_gripper_turn [rad/s] is 0" },
    { "", "model_file", "cloth.obj", "must be an absolute path or package://" },
    { "", "material", 5, "must be a group with entries like material/" },
    { "cloth_pose", "position", list({ 0, 0 }), "a list of 2, must be a list of three numbers" },
    { "cloth_pose", "position", list({ 0, 0, "up" }), "cloth_pose/position[2] is the text" },
    { "cloth_pose", "position", list({ 0, 0, infinity }), "position[2] is inf, must be finite" },
    { "cloth_pose", "rotation", list({ 0, 0, 0, 0 }), "must be a unit quaternion" },
    { "cloth_pose", "position", list({ 0, -2e7, 0 }),
      "cloth_pose/position [m].y is -2e+07, must be at least -1e+07 and at most 1e+07" },
    { "import", "scale", -1.0, "import/scale is -1" },
    { "import", "weld_distance", -1.0, "import/weld_distance is -1" },
    { "rectangle", "columns", 1, "rectangle/columns is 1" },
    { "rectangle", "seed", -1, "rectangle/seed is -1" },
    { "rectangle", "pattern", "knitted", "alternating, irregular, one_diagonal" },
    { "rectangle", "slits", list({ list({ 1, 2, 3 }) }), "rectangle/slits[0] is a list of 3" },
    { "rectangle", "slits", 1, "must be a list, each entry a list of 4 numbers" },
    { "pins", "edges", "top", "must be a list of names" },
    { "pins", "particles", list({ 1.5 }), "must be a list of whole numbers" },
    { "pins", "particles", list({ -1 }), "pins: pinned particle -1 must be at least 0" },
    { "pins", "edges", list({ "middle" }), "pins: pin edge \"middle\" is not one of top, bottom" },
    { "pins", "regions", list({ list({ 0, 0, 0, 0 }) }), "pins: pin region radius [m] is 0" },
    { "tearing", "weak_tear_strain", 99.0, "tearing/weak_tear_strain" },
    { "strength", "scatter", 1.0, "strength/scatter [-] is 1, must be at least 0 and at most 0.9" },
    { "strength", "seed", -1, "strength/seed is -1" },
    { "strength", "spots", list({ list({ 0, 0, 0, 0.1 }) }), "strength/spots[0] is a list of 4" },
    { "strength", "lines", list({ list({ 0, 0, 0, 1, 0, 0, 0.1, 99 }) }),
      "strength/lines[0] factor [-] is 99" },
    { "strength", "perforations", list({ list({ 0, 0, 0, 1, 0, 0, 0.1, 0.5, 0.1, 2 }) }),
      "strength/perforations[0] duty [-] is 2" },
    { "strength", "border_factor", 0.0, "strength/border_factor [-] is 0" },
    { "contact", "friction", -0.1, "contact/friction" },
    { "contact", "bounds_min", list({ 0, 60, 0 }),
      "contact/bounds_min [m].y is 60, must be less than bounds_max.y = 50" },
    { "markers", "checks", 0, "markers/checks is 0" },
    { "handles", "rate", 0.0, "handles/rate [Hz] is 0" },
    { "handles", "radius", 0.0, "handles/radius [m] is 0" },
    { "handles", "throw_speed", 0.0, "handles/throw_speed [m/s] is 0" },
    { "handles", "ball_radius", 200.0, "handles/ball_radius [m] is 200" },
    { "markers", "strain_range", list({ 1, 0 }), "must ascend" },
    { "markers", "plain_color", list({ 0, 2, 0 }), "markers/plain_color[1] is 2" },
  };
  for (const Case& c : cases)
  {
    const std::string found = problemsWith(c.group, c.entry, c.value);
    EXPECT_NE(found.find(c.expected), std::string::npos)
        << c.group << "/" << c.entry << ": no '" << c.expected << "' in: " << found;
  }
}

TEST(ParamsLoader, ChecksTheRectangleThoughAModelIsNamed)
{
  XmlRpcValue tree;
  tree["model_file"] = "/models/towel.obj";
  tree["rectangle"]["columns"] = 1;

  EXPECT_NE(joined(loadParams(tree).problems).find("rectangle/columns is 1"), std::string::npos);
}

TEST(ParamsLoader, SuggestsTheNameThatWasMeant)
{
  EXPECT_NE(problemsWith("material", "stifness", 1.0).find("did you mean material/stiffness?"),
            std::string::npos);
  EXPECT_NE(problemsWith("", "stiffness", 1.0).find("did you mean material/stiffness?"),
            std::string::npos);
  EXPECT_NE(problemsWith("", "makrer_rate", 1.0).find("did you mean marker_rate?"),
            std::string::npos);
}

TEST(ParamsLoader, SuggestsNothingForANameLikeNoOther)
{
  const std::string found = problemsWith("", "bananas", 1.0);

  EXPECT_NE(found.find("there is no parameter bananas"), std::string::npos) << found;
  EXPECT_EQ(found.find("did you mean"), std::string::npos) << found;
}

TEST(PlacedModel, HangsUprightByDefault)
{
  const cloth_tearing::PlacedModel placed = cloth_tearing::placedModel({});

  ASSERT_EQ(placed.model.positions.size(), 900u);
  for (const int p : placed.pinned)  // the upper edge, level at the origin's height
  {
    EXPECT_NEAR(placed.model.positions[p].z(), 0.0, 1e-9);
  }
  for (const cloth::Vec3d& x : placed.model.positions)
  {
    EXPECT_NEAR(x.y(), 0.0, 1e-9);
    EXPECT_LE(x.z(), 1e-9);
    EXPECT_GE(x.z(), -1.0 - 1e-9);
  }
  EXPECT_EQ(placed.pinned.size(), 30u);
}

TEST(PlacedModel, SaysWhyThereIsNoModel)
{
  cloth_tearing::NodeParams params;
  params.model_file = "package://no_such_package_anywhere/cloth.obj";
  try
  {
    cloth_tearing::placedModel(params);
    FAIL() << "a package that does not exist was found";
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_NE(std::string(error.what()).find("no package no_such_package_anywhere"),
              std::string::npos)
        << error.what();
  }
  params.model_file = "/nowhere/cloth.obj";
  EXPECT_THROW(cloth_tearing::placedModel(params), std::runtime_error);
}

TEST(InClothFrame, MovesTheFloorToTheClothAndLeavesTheRest)
{
  cloth_tearing::NodeParams params;
  params.simulation.contact.floor = true;
  params.simulation.contact.floor_height = 0.25;

  const cloth::SimulationParams simulation = cloth_tearing::inClothFrame(params);

  EXPECT_DOUBLE_EQ(simulation.contact.floor_height, 0.25 - params.cloth_pose.position.z());
  EXPECT_EQ(simulation.contact.bounds_min, params.simulation.contact.bounds_min);
}

TEST(InClothFrame, TurnsTheStrengthMapWithTheModel)
{
  cloth_tearing::NodeParams params;
  params.simulation.strength.spots = { { cloth::Vec3d(0.2, -0.3, 0.0), 0.01, 0.5 } };
  params.simulation.strength.lines = { { cloth::Vec3d(-0.5, -0.5, 0.0),
                                         cloth::Vec3d(0.5, -0.5, 0.0), 0.01, 0.5 } };
  params.simulation.strength.perforations = { { params.simulation.strength.lines[0], 0.1, 0.5 } };
  const cloth_tearing::PlacedModel placed = cloth_tearing::placedModel(params);

  const cloth::SimulationParams simulation = cloth_tearing::inClothFrame(params);

  // The default pose hangs the model's x-y plane up in x-z.
  EXPECT_TRUE(simulation.strength.spots[0].center.isApprox(cloth::Vec3d(0.2, 0.0, -0.3), 1e-6));
  const cloth::Mesh mesh(static_cast<int>(placed.model.positions.size()), placed.model.triangles);
  EXPECT_EQ(cloth::springStrengths(mesh, placed.model.positions, simulation.strength),
            cloth::springStrengths(mesh, cloth::rectangle(params.rectangle).positions,
                                   params.simulation.strength));
}

TEST(LimitWords, TellEachLimitAndHowFarItMayBeRaised)
{
  cloth_tearing::NodeParams params;
  params.max_model_file = 2.5;
  params.simulation.limits.spheres = 7;
  params.recording.limit = 30.0;

  const std::string words = cloth_tearing::limitsInWords(params);

  for (const std::string& name : cloth_tearing::parameterNames())
  {
    if (name.rfind("limits/", 0) == 0)
    {
      EXPECT_NE(words.find("\n  " + name), std::string::npos) << name << " is not among:\n"
                                                              << words;
    }
  }
  EXPECT_NE(words.find("\n  limits/spheres: 7 of 1000\n"), std::string::npos) << words;
  EXPECT_NE(words.find("\n  limits/model_file [MB]: 2.5 of 1000\n"), std::string::npos) << words;
  EXPECT_NE(words.find("\n  recording_limit [MB]: 30 of 1000000\n"), std::string::npos) << words;
}
