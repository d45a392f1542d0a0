// Takes typed values out of a tree of parameters, notes what does not fit and what is left over.
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cloth_tearing/core/types.h"

namespace cloth_tearing
{

/// Each read() leaves its value alone if the parameter is absent, of the wrong type or not finite,
/// and notes the latter two. Integers are taken for real numbers, never the other way round.
class ParamReader
{
public:
  /// @param tree a struct, or an invalid value for an empty one
  explicit ParamReader(const XmlRpc::XmlRpcValue& tree);

  void read(const std::string& name, bool& value);
  void read(const std::string& name, int& value);
  void read(const std::string& name, double& value);
  void read(const std::string& name, std::string& value);
  void read(const std::string& name, cloth::Vec3d& value);  ///< a list, or a group of x, y and z
  void read(const std::string& name, std::array<double, 2>& value);
  void read(const std::string& name, cloth::Quatd& value);  ///< x, y, z, w; normalised
  void read(const std::string& name, std::vector<int>& value);
  void read(const std::string& name, std::vector<std::string>& value);

  /// A list of rows of `columns` numbers each.
  void readRows(const std::string& name, std::size_t columns,
                std::vector<std::vector<double>>& rows);

  /// One of several names.
  template <class Choice>
  void readChoice(const std::string& name, const std::map<std::string, Choice>& choices,
                  Choice& value)
  {
    std::vector<std::string> names;
    for (const auto& choice : choices)
    {
      names.push_back(choice.first);
    }
    const std::string chosen = readOneOf(name, names);
    if (!chosen.empty())
    {
      value = choices.at(chosen);
    }
  }

  void note(const std::string& problem) { problems_.push_back(problem); }

  /// Notes every parameter that no read() asked for, with the nearest known name.
  void noteLeftOver();

  const std::vector<std::string>& problems() const { return problems_; }
  const std::set<std::string>& known() const { return known_; }

private:
  bool isFinite(const std::string& name, double number);
  bool take(const std::string& name, XmlRpc::XmlRpcValue& value);
  void flatten(const std::string& prefix, const XmlRpc::XmlRpcValue& tree);
  bool toNumbers(const std::string& name, const XmlRpc::XmlRpcValue& list, std::size_t count,
                 const std::string& expected, std::vector<double>& numbers);
  bool readNumbers(const std::string& name, std::size_t count, const std::string& expected,
                   std::vector<double>& numbers);
  bool readAxes(const std::string& name, cloth::Vec3d& value);
  void noteWrongType(const std::string& name, const XmlRpc::XmlRpcValue& value,
                     const std::string& expected);
  std::string readOneOf(const std::string& name, const std::vector<std::string>& choices);

  std::map<std::string, XmlRpc::XmlRpcValue> left_;
  std::set<std::string> known_;
  std::vector<std::string> problems_;
};

}  // namespace cloth_tearing
