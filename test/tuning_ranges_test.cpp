// What dynamic_reconfigure offers is what the loader takes: the same names, the same ranges.
#include <cloth_tearing/BoundsMaxConfig.h>
#include <cloth_tearing/BoundsMinConfig.h>
#include <cloth_tearing/ContactConfig.h>
#include <cloth_tearing/EnvironmentConfig.h>
#include <cloth_tearing/GravityConfig.h>
#include <cloth_tearing/MaterialConfig.h>
#include <cloth_tearing/SolverConfig.h>
#include <cloth_tearing/TearingConfig.h>
#include <cloth_tearing/WindConfig.h>
#include <gtest/gtest.h>

#include <boost/any.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cloth_tearing/node/params_loader.h"

using XmlRpc::XmlRpcValue;

namespace
{

/// A number that dynamic_reconfigure offers.
struct Offer
{
  std::string group;  ///< empty for none; with a slash for a vector
  std::string name;
  bool whole = false;
  double low = 0.0;
  double high = 0.0;

  std::string fullName() const { return (group.empty() ? "" : group + "/") + name; }

  /// The parameter that it is, or is an axis of.
  std::string parameter() const
  {
    return group.find('/') == std::string::npos ? fullName() : group;
  }
};

double number(const boost::any& value)
{
  return value.type() == typeid(int) ? boost::any_cast<int>(value) : boost::any_cast<double>(value);
}

/// @param[out] names of the parameters, all of them
template <class Config>
void collect(const std::string& group, std::vector<Offer>& numbers, std::vector<std::string>& names)
{
  for (const auto& description : Config::__getParamDescriptions__())
  {
    Offer offer{ group, description->name };
    names.push_back(offer.parameter());
    boost::any low;
    boost::any high;
    description->getValue(Config::__getMin__(), low);
    description->getValue(Config::__getMax__(), high);
    if (description->type == "int" || description->type == "double")
    {
      offer.whole = description->type == "int";
      offer.low = number(low);
      offer.high = number(high);
      numbers.push_back(offer);
    }
  }
}

std::vector<Offer> offers(std::vector<std::string>& names)
{
  using namespace cloth_tearing;  // NOLINT: the generated configurations
  std::vector<Offer> numbers;
  collect<MaterialConfig>("material", numbers, names);
  collect<EnvironmentConfig>("environment", numbers, names);
  collect<GravityConfig>("environment/gravity", numbers, names);
  collect<WindConfig>("environment/wind", numbers, names);
  collect<TearingConfig>("tearing", numbers, names);
  collect<ContactConfig>("contact", numbers, names);
  collect<BoundsMinConfig>("contact/bounds_min", numbers, names);
  collect<BoundsMaxConfig>("contact/bounds_max", numbers, names);
  collect<SolverConfig>("", numbers, names);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return numbers;
}

void put(XmlRpcValue& tree, const std::string& name, double value, bool whole)
{
  const std::size_t slash = name.find('/');
  if (slash != std::string::npos)
  {
    put(tree[name.substr(0, slash)], name.substr(slash + 1), value, whole);
  }
  else if (whole)
  {
    tree[name] = static_cast<int>(value);
  }
  else
  {
    tree[name] = value;
  }
}

/// Whether the loader takes the number, as far as its own range goes.
bool taken(const Offer& offer, double value)
{
  XmlRpcValue tree;
  tree["tearing"]["tear_strain"] = 100.0;  // others must not exceed it
  if (offer.group.find('/') != std::string::npos)
  {
    for (const char* axis : { "x", "y", "z" })
    {
      put(tree, offer.group + "/" + axis, 0.0, false);
    }
  }
  put(tree, offer.fullName(), value, offer.whole);
  const std::vector<std::string> problems = cloth_tearing::loadParams(tree).problems;
  return std::none_of(problems.begin(), problems.end(),
                      [&](const std::string& problem)
                      {
                        return problem.find(offer.parameter() + " ") == 0 &&
                               problem.find("must be less than") == std::string::npos;
                      });
}

}  // namespace

TEST(TuningRanges, AreThoseOfTheLoader)
{
  std::vector<std::string> names;
  for (const Offer& offer : offers(names))
  {
    SCOPED_TRACE(offer.fullName());
    const double infinity = std::numeric_limits<double>::infinity();
    const double least = offer.whole ? 1.0 : 0.0;
    const auto above = [&](double x)
    { return offer.whole ? x + least : std::nextafter(x, infinity); };
    const auto below = [&](double x)
    { return offer.whole ? x - least : std::nextafter(x, -infinity); };
    ASSERT_TRUE(std::isfinite(offer.low) && std::isfinite(offer.high));
    EXPECT_TRUE(taken(offer, above(offer.low))) << "the lower limit itself may be out";
    EXPECT_FALSE(taken(offer, below(offer.low)));
    EXPECT_TRUE(taken(offer, offer.high));
    EXPECT_FALSE(taken(offer, above(offer.high)));
  }
}

TEST(TuningRanges, CoverTheGroupsAndThreeWithout)
{
  std::vector<std::string> offered;
  offers(offered);

  std::vector<std::string> expected;
  for (const std::string& name : cloth_tearing::parameterNames())
  {
    const std::string group = name.substr(0, name.find('/') + 1);
    const bool tuned = group == "material/" || group == "environment/" || group == "tearing/" ||
                       group == "contact/" || name == "speed" || name == "max_strain" ||
                       name == "max_substeps";
    if (tuned)
    {
      expected.push_back(name);
    }
  }
  EXPECT_EQ(offered, expected);
}
