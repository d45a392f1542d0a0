// Bad parameters, at the node's start and while it runs.
#include <cloth_tearing/Release.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "bad_inputs.h"
#include "cloth_tearing/node/params_loader.h"

using cloth::Range;
using XmlRpc::XmlRpcValue;

namespace
{

enum class Kind
{
  REAL,
  WHOLE,
  VECTOR,  ///< three numbers, each in the range
};

struct Parameter
{
  std::string name;
  Kind kind;
  Range range;
};

/// All numbers of config/cloth.yaml, with the ranges that it tells.
std::vector<Parameter> parameters()
{
  using cloth::MAX_COORDINATE;
  const auto real = [](const std::string& name, double low, double high) {
    return Parameter{ name, Kind::REAL, Range::between(low, high) };
  };
  const auto above = [](const std::string& name, double high) {
    return Parameter{ name, Kind::REAL, Range::aboveUpTo(0.0, high) };
  };
  const auto whole = [](const std::string& name, double low, double high) {
    return Parameter{ name, Kind::WHOLE, Range::between(low, high) };
  };
  const auto vector = [](const std::string& name, double limit) {
    return Parameter{ name, Kind::VECTOR, Range::between(-limit, limit) };
  };
  const double most = std::numeric_limits<int>::max();
  return {
    vector("cloth_pose/position", 1e7),
    real("speed", 0.001, 1000),
    real("clock_rate", 0.1, 100000),
    real("time_step", 0.00001, 0.02),
    real("tf_patience", 0, 10),
    real("command_patience", 0.01, 60),
    whole("max_states", 1, 10000),
    real("max_state_memory", 1, 100000),
    real("recording_limit", 1, 1000000),
    { "import/scale", Kind::REAL, Range::above(0) },
    { "import/weld_distance", Kind::REAL, Range::atLeast(0) },
    real("rectangle/width", 0.001, 1000),
    real("rectangle/height", 0.001, 1000),
    whole("rectangle/columns", 2, 500000),
    whole("rectangle/rows", 2, 500000),
    real("rectangle/grading", 0.2, 5),
    real("rectangle/jitter", 0, 0.5),
    whole("rectangle/seed", 0, most),
    real("material/areal_density", 0.001, 1000),
    real("material/stiffness", 0.001, 1e7),
    real("material/bend_shear_stiffness", 0, 1e7),
    real("material/damping", 0, 10000),
    vector("environment/gravity", 1000),
    real("environment/air_friction", 0, 50),
    vector("environment/wind", 100),
    real("environment/wind_drag", 0, 100),
    above("tearing/tear_strain", 100),
    above("tearing/weak_tear_strain", 0.3),
    real("tearing/one_point_tear_strain", 0, 0.3),
    real("tearing/tear_radius", 0, 10),
    real("tearing/crack_length", 0, 10),
    real("tearing/hem_factor", 1, 1000),
    real("tearing/hem_width", 0, 100),
    whole("tearing/max_tears_per_step", 1, 100000),
    above("tearing/min_length", 0.5),
    above("tearing/min_altitude", 0.5),
    real("strength/scatter", 0, 0.9),
    whole("strength/seed", 0, most),
    real("strength/border_factor", 0.05, 20),
    real("strength/border_width", 0, 100),
    real("contact/friction", 0, 10),
    above("contact/thickness", 1),
    above("contact/push_speed", 100),
    real("contact/floor_height", -MAX_COORDINATE, MAX_COORDINATE),
    real("contact/floor_friction", 0, 10),
    vector("contact/bounds_min", MAX_COORDINATE),
    vector("contact/bounds_max", MAX_COORDINATE),
    above("contact/max_sphere_speed", 1000),
    real("contact/sphere_timeout", 0, 1e6),
    whole("limits/particles", 1, 1000000),
    whole("limits/triangles", 1, 2000000),
    whole("limits/spheres", 1, 1000),
    whole("limits/grasps", 1, 1000),
    real("limits/model_file", 0.001, 1000),
    whole("limits/commands", 1, 10000),
    above("max_grasp_distance", MAX_COORDINATE),
    real("grasp_force_filter", 0, 10),
    above("max_gripper_speed", 100),
    above("max_gripper_turn", 100),
    real("frame_timeout", 0.01, 60),
    above("max_speed", 10000),
    above("runaway_strain", 10000),
    whole("tear_log_size", 1, 10000000),
    real("max_strain", 0.001, 10),
    whole("max_substeps", 1, 64),
    whole("threads", 0, 256),
    real("grasp_state_rate", 0.1, 1000),
    real("marker_rate", 0.1, 1000),
    real("surface_rate", 0.1, 1000),
    real("status_rate", 0.1, 1000),
    real("master_period", 0.1, 3600),
    whole("markers/checks", 1, 200),
    { "markers/plain_color", Kind::VECTOR, Range::between(0, 1) },
    above("markers/edge_width", 1),
    above("markers/point_size", 1),
    real("handles/rate", 0.1, 1000),
    real("handles/radius", 0.0001, 1000),
    above("handles/throw_speed", 1000),
    real("handles/ball_radius", 0.0001, 100),
  };
}

/// Numbers among the parameters whose ranges are not those of single numbers: see Shapes.
const std::set<std::string> APART = { "cloth_pose/rotation", "markers/strain_range" };

std::string joined(const std::vector<std::string>& lines)
{
  std::string all;
  for (const std::string& line : lines)
  {
    all += line + "\n";
  }
  return all;
}

XmlRpcValue list(const std::vector<double>& numbers)
{
  XmlRpcValue list;
  list.setSize(static_cast<int>(numbers.size()));
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    list[static_cast<int>(i)] = numbers[i];
  }
  return list;
}

/// What is wrong with a tree of this one parameter.
std::string problemsWith(const std::string& name, const XmlRpcValue& value)
{
  XmlRpcValue tree;
  const std::size_t slash = name.find('/');
  if (slash == std::string::npos)
  {
    tree[name] = value;
  }
  else
  {
    tree[name.substr(0, slash)][name.substr(slash + 1)] = value;
  }
  return joined(cloth_tearing::loadParams(tree).problems);
}

BadInput bad(const std::string& name, const XmlRpcValue& value, std::vector<std::string> words)
{
  words.push_back(name);
  return { name, [name, value] { return problemsWith(name, value); }, words };
}

/// Every number that it must not be.
BadInputs badValues(const Parameter& parameter)
{
  BadInputs inputs;
  if (parameter.kind == Kind::WHOLE)
  {
    for (const BadNumber& number : badWholeNumbers(parameter.range))
    {
      inputs.push_back(bad(parameter.name, static_cast<int>(number.value), number.words));
    }
    for (const double value : { 1.5, 1e308, std::numeric_limits<double>::quiet_NaN() })
    {
      inputs.push_back(bad(parameter.name, value, { "must be a whole number" }));
    }
    return inputs;
  }
  for (const BadNumber& number : badNumbers(parameter.range))
  {
    if (parameter.kind == Kind::REAL)
    {
      inputs.push_back(bad(parameter.name, number.value, number.words));
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      std::vector<double> vector(3, 0.5);
      vector[i] = number.value;
      inputs.push_back(bad(parameter.name, list(vector), number.words));
    }
  }
  return inputs;
}

/// Names of all numbers in a tree of parameters.
void listNumbers(const std::string& prefix, const XmlRpcValue& tree, std::set<std::string>& names)
{
  const auto number = [](const XmlRpcValue& value)
  { return value.getType() == XmlRpcValue::TypeInt || value.getType() == XmlRpcValue::TypeDouble; };
  for (const auto& entry : tree)
  {
    if (entry.second.getType() == XmlRpcValue::TypeStruct)
    {
      listNumbers(prefix + entry.first + "/", entry.second, names);
    }
    else if (number(entry.second) || (entry.second.getType() == XmlRpcValue::TypeArray &&
                                      entry.second.size() > 0 && number(entry.second[0])))
    {
      names.insert(prefix + entry.first);
    }
  }
}

}  // namespace

// -- at the start ---------------------------------------------------------------------------------

TEST(BadParameters, HaveATableOfEveryNumberInClothYaml)
{
  XmlRpcValue tree;
  ASSERT_TRUE(ros::param::get("/cloth_yaml", tree));
  std::set<std::string> expected;
  listNumbers("", tree, expected);
  std::set<std::string> here = APART;
  for (const Parameter& parameter : parameters())
  {
    here.insert(parameter.name);
  }
  EXPECT_EQ(here, expected);
}

TEST(BadParameters, AreRefusedBeyondTheirRanges)
{
  for (const Parameter& parameter : parameters())
  {
    expectRefusedInWords(badValues(parameter));
  }
}

TEST(BadParameters, AreRefusedOfOtherTypes)
{
  BadInputs inputs;
  for (const Parameter& parameter : parameters())
  {
    inputs.push_back(bad(parameter.name, "1e3", { "is the text \"1e3\", must be" }));
    inputs.push_back(bad(parameter.name, true, { "must be" }));
    inputs.push_back(bad(parameter.name, list({ 1.0, 2.0 }), { "must be" }));
  }
  expectRefusedInWords(inputs);
}

TEST(BadParameters, AreRefusedInOtherShapes)
{
  BadInputs inputs;
  for (const std::array<double, 4>& q : badRotations())
  {
    inputs.push_back(bad("cloth_pose/rotation", list({ q[0], q[1], q[2], q[3] }), { "must be" }));
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const auto& range : { std::vector<double>{ 0.2, 0.2 },
                             { 0.2, 0.1 },
                             { nan, 1.0 },
                             { 0.0, infinite },
                             { -infinite, 0.0 } })
  {
    inputs.push_back(bad("markers/strain_range", list(range), { "is" }));
  }
  for (const char* name : { "frame_id", "pace", "solver", "rest_shape", "lost_frame",
                            "markers/coloring", "rectangle/pattern", "material/stiffness_law" })
  {
    inputs.push_back(bad(name, 3, { "must be" }));
    inputs.push_back(bad(name, "", { "must" }));
  }
  for (const char* name : { "paused", "publish_clock", "lines", "tearing/enabled", "contact/floor",
                            "handles/enabled" })
  {
    inputs.push_back(bad(name, 1, { "must be true or false" }));
    inputs.push_back(bad(name, "yes", { "must be true or false" }));
  }
  for (const char* name : { "model_file", "export_folder", "state_folder", "recording_folder" })
  {
    inputs.push_back(bad(name, "../elsewhere", { "must be an absolute path" }));
  }
  const std::map<std::string, std::size_t> rows = { { "rectangle/slits", 4 },
                                                    { "pins/regions", 4 },
                                                    { "strength/spots", 5 },
                                                    { "strength/lines", 8 },
                                                    { "strength/perforations", 10 } };
  for (const auto& row : rows)
  {
    for (const double value : { nan, infinite, -infinite, 1e308, -1e308 })
    {
      XmlRpcValue table;
      table[0] = list(std::vector<double>(row.second, value));
      const std::string group = row.first.substr(0, row.first.find('/'));
      inputs.push_back({ row.first,
                         [=] { return problemsWith(row.first, table); },
                         { group, "is " + cloth::text(value) + ", must be" } });
    }
    XmlRpcValue table;
    table[0] = list(std::vector<double>(row.second - 1, 0.1));
    inputs.push_back(bad(row.first, table, { "[0]", "must be a list of" }));
  }
  inputs.push_back(bad("tearing/tear_strian", 0.1, { "did you mean tearing/tear_strain?" }));
  inputs.push_back(bad("frame_id", std::string(256, 'f'), { "a name of 256 characters" }));
  inputs.push_back(bad("frame_id", "/world", { "must not begin with a slash" }));

  expectRefusedInWords(inputs);
}

TEST(BadParameters, AreNextToGoodOnes)
{
  for (const Parameter& parameter : parameters())
  {
    if (parameter.kind == Kind::VECTOR)
    {
      EXPECT_EQ(problemsWith(parameter.name, list({ 0.5, 0.5, 0.5 })), "") << parameter.name;
      continue;
    }
    for (const double end : { parameter.range.low, parameter.range.high })
    {
      if (!std::isfinite(end) || (end == parameter.range.low && parameter.range.above_low))
      {
        continue;
      }
      const XmlRpcValue value =
          parameter.kind == Kind::WHOLE ? XmlRpcValue(static_cast<int>(end)) : XmlRpcValue(end);
      const std::string problems = problemsWith(parameter.name, value);
      EXPECT_EQ(problems.find(parameter.name + " is "), std::string::npos) << problems;
      EXPECT_EQ(problems.find(parameter.name + " ["), std::string::npos) << problems;
    }
  }
}

// -- while it runs --------------------------------------------------------------------------------

namespace
{

/// The servers of ~GROUP/set_parameters, and what they showed in the beginning.
class Tuned
{
public:
  /// Sends one value. @return why it was refused; empty if it was not
  template <class Value>
  std::string set(const std::string& group, const std::string& name, const Value& value)
  {
    const std::string service = group.empty() ? "set_parameters" : group + "/set_parameters";
    dynamic_reconfigure::Reconfigure before;
    EXPECT_TRUE(ros::service::call("/cloth/" + service, before));
    dynamic_reconfigure::Reconfigure call;
    dynamic_reconfigure::ConfigTools::appendParameter(call.request.config, name, value);
    const std::string told =
        watch_.after([&] { EXPECT_TRUE(ros::service::call("/cloth/" + service, call)); });
    EXPECT_EQ(testing::PrintToString(call.response.config),
              testing::PrintToString(before.response.config))
        << service << " " << name;
    EXPECT_TRUE(told.empty() || told.rfind(service + ": ", 0) == 0) << told;
    return told;
  }

private:
  RefusalWatch watch_;
};

}  // namespace

TEST(BadTuning, IsRefusedBeyondTheRanges)
{
  resetCloth();
  Tuned tuned;
  const std::set<std::string> groups = { "material", "environment", "tearing", "contact" };
  const std::set<std::string> others = { "speed", "max_strain", "max_substeps" };
  std::size_t fields = 0;
  for (const Parameter& parameter : parameters())
  {
    const std::size_t slash = parameter.name.find('/');
    const bool alone = slash == std::string::npos;
    const std::string group = alone ? "" : parameter.name.substr(0, slash);
    const std::string name = alone ? parameter.name : parameter.name.substr(slash + 1);
    if ((alone ? others : groups).count(alone ? name : group) == 0)
    {
      continue;
    }
    BadInputs inputs;
    if (parameter.kind == Kind::WHOLE)
    {
      for (const BadNumber& number : badWholeNumbers(parameter.range))
      {
        const int value = static_cast<int>(number.value);
        inputs.push_back(
            { parameter.name, [&, value] { return tuned.set(group, name, value); }, number.words });
        inputs.back().words.push_back(name);
      }
    }
    else
    {
      for (const BadNumber& number : badNumbers(parameter.range))
      {
        const bool vector = parameter.kind == Kind::VECTOR;
        const double value = number.value;
        for (const std::string& axis :
             vector ? std::vector<std::string>{ "x", "y", "z" } : std::vector<std::string>{ "" })
        {
          const std::string server = vector ? parameter.name : group;
          const std::string entry = vector ? axis : name;
          inputs.push_back({ parameter.name + " " + axis,
                             [&, value, server, entry] { return tuned.set(server, entry, value); },
                             number.words });
          inputs.back().words.push_back(vector ? name + " [" : name);
        }
      }
    }
    fields += inputs.empty() ? 0 : 1;
    expectRefused(inputs);
  }
  EXPECT_EQ(fields, 30u);
}

TEST(BadTuning, IsRefusedOfUnknownNames)
{
  resetCloth();
  Tuned tuned;
  expectRefused({ { "stiffness_law",
                    [&] { return tuned.set("material", "stiffness_law", std::string("soft")); },
                    { "stiffness_law is \"soft\", must be one of per_spring, per_width" } },
                  { "an unknown name",
                    [&] { return tuned.set("material", "stifness", 120.0); },
                    { "there is no parameter \"stifness\" of this type" } },
                  { "another type",
                    [&] { return tuned.set("material", "stiffness", true); },
                    { "there is no parameter \"stiffness\" of this type" } } });
}
