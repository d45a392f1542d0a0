// Takes typed values out of a tree of parameters, notes what does not fit and what is left over.
#include "cloth_tearing/node/param_reader.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "cloth_tearing/core/checks.h"

namespace cloth_tearing
{

using XmlRpc::XmlRpcValue;

namespace
{

std::string described(const XmlRpcValue& value)
{
  std::ostringstream shown;
  shown << value;
  switch (value.getType())
  {
    case XmlRpcValue::TypeBoolean:
      return static_cast<const bool&>(value) ? "the switch true" : "the switch false";
    case XmlRpcValue::TypeInt:
      return "the whole number " + shown.str();
    case XmlRpcValue::TypeDouble:
      return "the number " + cloth::text(static_cast<const double&>(value));
    case XmlRpcValue::TypeString:
      return "the text \"" + shown.str() + "\"";
    case XmlRpcValue::TypeArray:
      return "a list of " + std::to_string(value.size());
    case XmlRpcValue::TypeStruct:
      return "a group";
    default:
      return "of a type that is not used here";
  }
}

bool isNumber(const XmlRpcValue& value)
{
  return value.getType() == XmlRpcValue::TypeInt || value.getType() == XmlRpcValue::TypeDouble;
}

double toNumber(const XmlRpcValue& value)
{
  return value.getType() == XmlRpcValue::TypeInt ? static_cast<const int&>(value)
                                                 : static_cast<const double&>(value);
}

/// The least number of letters to put in, take out or exchange that makes `a` of `b`.
std::size_t distance(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{ 0 });
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      const std::size_t exchanged = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({ row[j] + 1, row[j - 1] + 1, exchanged });
    }
  }
  return row.back();
}

std::string lastPart(const std::string& name)
{
  return name.substr(name.find_last_of('/') + 1);  // npos + 1 is 0: the whole name
}

/// The known name that was probably meant by `name`; empty if none is near.
std::string nearest(const std::string& name, const std::set<std::string>& known)
{
  for (const std::string& candidate : known)
  {
    if (lastPart(candidate) == lastPart(name))  // right, but in another group
    {
      return candidate;
    }
  }
  std::string best;
  std::size_t least = 1 + name.size() / 3;
  for (const std::string& candidate : known)
  {
    const std::size_t d =
        std::min(distance(name, candidate), 1 + distance(lastPart(name), lastPart(candidate)));
    if (d < least)
    {
      least = d;
      best = candidate;
    }
  }
  return best;
}

}  // namespace

ParamReader::ParamReader(const XmlRpcValue& tree)
{
  if (tree.getType() == XmlRpcValue::TypeStruct)
  {
    flatten("", tree);
  }
}

void ParamReader::flatten(const std::string& prefix, const XmlRpcValue& tree)
{
  for (const auto& entry : tree)
  {
    if (entry.second.getType() == XmlRpcValue::TypeStruct)
    {
      flatten(prefix + entry.first + "/", entry.second);
    }
    else
    {
      left_[prefix + entry.first] = entry.second;
    }
  }
}

bool ParamReader::take(const std::string& name, XmlRpcValue& value)
{
  known_.insert(name);
  const auto found = left_.find(name);
  if (found == left_.end())
  {
    return false;
  }
  value = found->second;
  left_.erase(found);
  return true;
}

void ParamReader::noteWrongType(const std::string& name, const XmlRpcValue& value,
                                const std::string& expected)
{
  std::string problem = name + " is " + described(value) + ", must be " + expected;
  if (value.getType() == XmlRpcValue::TypeString && expected.find("number") != std::string::npos)
  {
    problem += " (YAML reads 1e-3 as text: write 1.0e-3)";
  }
  note(problem);
}

std::string ParamReader::readOneOf(const std::string& name, const std::vector<std::string>& choices)
{
  XmlRpcValue given;
  if (!take(name, given))
  {
    return "";
  }
  std::string list;
  for (const std::string& choice : choices)
  {
    list += (list.empty() ? "one of " : ", ") + choice;
  }
  if (given.getType() != XmlRpcValue::TypeString ||
      std::count(choices.begin(), choices.end(), static_cast<const std::string&>(given)) == 0)
  {
    noteWrongType(name, given, list);
    return "";
  }
  return static_cast<const std::string&>(given);
}

void ParamReader::read(const std::string& name, bool& value)
{
  XmlRpcValue given;
  if (!take(name, given))
  {
    return;
  }
  if (given.getType() != XmlRpcValue::TypeBoolean)
  {
    noteWrongType(name, given, "true or false");
    return;
  }
  value = static_cast<const bool&>(given);
}

void ParamReader::read(const std::string& name, int& value)
{
  XmlRpcValue given;
  if (!take(name, given))
  {
    return;
  }
  if (given.getType() != XmlRpcValue::TypeInt)
  {
    noteWrongType(name, given, "a whole number");
    return;
  }
  value = static_cast<const int&>(given);
}

/// Notes a number that is not.
bool ParamReader::isFinite(const std::string& name, double number)
{
  const std::size_t before = problems_.size();
  cloth::check(problems_, name, number, cloth::Range());
  return problems_.size() == before;
}

void ParamReader::read(const std::string& name, double& value)
{
  XmlRpcValue given;
  if (!take(name, given))
  {
    return;
  }
  if (!isNumber(given))
  {
    noteWrongType(name, given, "a number");
    return;
  }
  if (isFinite(name, toNumber(given)))
  {
    value = toNumber(given);
  }
}

void ParamReader::read(const std::string& name, std::string& value)
{
  XmlRpcValue given;
  if (!take(name, given))
  {
    return;
  }
  if (given.getType() != XmlRpcValue::TypeString)
  {
    noteWrongType(name, given, "text (in quotes if it looks like something else)");
    return;
  }
  value = static_cast<const std::string&>(given);
}

bool ParamReader::toNumbers(const std::string& name, const XmlRpcValue& list, std::size_t count,
                            const std::string& expected, std::vector<double>& numbers)
{
  if (list.getType() != XmlRpcValue::TypeArray || static_cast<std::size_t>(list.size()) != count)
  {
    noteWrongType(name, list, expected);
    return false;
  }
  for (int i = 0; i < list.size(); ++i)
  {
    const std::string element = name + "[" + std::to_string(i) + "]";
    if (!isNumber(list[i]))
    {
      noteWrongType(element, list[i], "a number");
      return false;
    }
    if (!isFinite(element, toNumber(list[i])))
    {
      return false;
    }
    numbers.push_back(toNumber(list[i]));
  }
  return true;
}

bool ParamReader::readNumbers(const std::string& name, std::size_t count,
                              const std::string& expected, std::vector<double>& numbers)
{
  XmlRpcValue given;
  return take(name, given) && toNumbers(name, given, count, expected, numbers);
}

void ParamReader::read(const std::string& name, cloth::Vec3d& value)
{
  std::vector<double> numbers;
  if (readNumbers(name, 3, "a list of three numbers", numbers))
  {
    value = cloth::Vec3d(numbers[0], numbers[1], numbers[2]);
  }
  cloth::Vec3d axes;
  if (readAxes(name, axes))
  {
    value = axes;
  }
}

/// What ~set_parameters leaves behind, which knows no lists. @return whether it was there, in full
bool ParamReader::readAxes(const std::string& name, cloth::Vec3d& value)
{
  const std::size_t before = problems_.size();
  std::string missing;
  int found = 0;
  for (int i = 0; i < 3; ++i)
  {
    const std::string axis = name + "/" + "xyz"[i];
    if (left_.count(axis) == 0)
    {
      missing += (missing.empty() ? "" : ", ") + axis;
      continue;
    }
    ++found;
    read(axis, value[i]);
    known_.erase(axis);  // the vector is the parameter
  }
  if (found > 0 && found < 3)
  {
    note("there is no " + missing + ": " + name +
         " must be a list of three numbers or a group of x, y and z");
  }
  return found == 3 && problems_.size() == before;
}

void ParamReader::read(const std::string& name, std::array<double, 2>& value)
{
  std::vector<double> numbers;
  if (readNumbers(name, 2, "a list of two numbers", numbers))
  {
    value = { numbers[0], numbers[1] };
  }
}

void ParamReader::read(const std::string& name, cloth::Quatd& value)
{
  std::vector<double> numbers;
  if (!readNumbers(name, 4, "a list of four numbers: x, y, z, w", numbers))
  {
    return;
  }
  cloth::Quatd rotation(numbers[3], numbers[0], numbers[1], numbers[2]);
  const std::size_t before = problems_.size();
  cloth::check(problems_, name, rotation);
  if (problems_.size() == before)
  {
    rotation.normalize();
    value = rotation;
  }
}

void ParamReader::read(const std::string& name, std::vector<int>& value)
{
  XmlRpcValue given;
  if (!take(name, given))
  {
    return;
  }
  std::vector<int> numbers;
  for (int i = 0; given.getType() == XmlRpcValue::TypeArray && i < given.size(); ++i)
  {
    if (given[i].getType() == XmlRpcValue::TypeInt)
    {
      numbers.push_back(static_cast<const int&>(given[i]));
    }
  }
  if (given.getType() != XmlRpcValue::TypeArray ||
      numbers.size() != static_cast<std::size_t>(given.size()))
  {
    noteWrongType(name, given, "a list of whole numbers");
    return;
  }
  value = numbers;
}

void ParamReader::read(const std::string& name, std::vector<std::string>& value)
{
  XmlRpcValue given;
  if (!take(name, given))
  {
    return;
  }
  std::vector<std::string> texts;
  for (int i = 0; given.getType() == XmlRpcValue::TypeArray && i < given.size(); ++i)
  {
    if (given[i].getType() == XmlRpcValue::TypeString)
    {
      texts.push_back(static_cast<const std::string&>(given[i]));
    }
  }
  if (given.getType() != XmlRpcValue::TypeArray ||
      texts.size() != static_cast<std::size_t>(given.size()))
  {
    noteWrongType(name, given, "a list of names");
    return;
  }
  value = texts;
}

void ParamReader::readRows(const std::string& name, std::size_t columns,
                           std::vector<std::vector<double>>& rows)
{
  const std::string expected = "a list of " + std::to_string(columns) + " numbers";
  XmlRpcValue given;
  if (!take(name, given))
  {
    return;
  }
  if (given.getType() != XmlRpcValue::TypeArray)
  {
    noteWrongType(name, given, "a list, each entry " + expected);
    return;
  }
  for (int i = 0; i < given.size(); ++i)
  {
    std::vector<double> row;
    if (toNumbers(name + "[" + std::to_string(i) + "]", given[i], columns, expected, row))
    {
      rows.push_back(row);
    }
  }
}

void ParamReader::noteLeftOver()
{
  for (const auto& entry : left_)
  {
    const std::string& name = entry.first;
    const auto group = known_.lower_bound(name + "/");
    if (group != known_.end() && group->compare(0, name.size() + 1, name + "/") == 0)
    {
      note(name + " is " + described(entry.second) + ", must be a group with entries like " +
           *group);
      continue;
    }
    const std::string meant = nearest(name, known_);
    note("there is no parameter " + name + (meant.empty() ? "" : ": did you mean " + meant + "?"));
  }
}

}  // namespace cloth_tearing
