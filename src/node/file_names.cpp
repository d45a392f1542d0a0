// Judges names of files.
#include "cloth_tearing/node/file_names.h"

#include <algorithm>

namespace cloth_tearing
{

namespace
{

constexpr std::size_t LONGEST_NAME = 64;
constexpr std::size_t LONGEST_PATH = 1000;

/// The same in every locale.
bool mayBeInName(char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == '.';
}

/// In quotes, without what would end or break the sentence that it stands in.
std::string shown(std::string text, std::size_t most)
{
  text.resize(std::min(text.size(), most));
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, '?');
  return "\"" + text + "\"";
}

}  // namespace

std::vector<std::string> nameProblems(const std::string& name)
{
  if (name.empty() || name.size() > LONGEST_NAME || name.front() == '.' ||
      !std::all_of(name.begin(), name.end(), mayBeInName))
  {
    return { "name is " + shown(name, LONGEST_NAME) +
             ", must be 1 to 64 letters, digits, '_', '-' and '.', not beginning with '.'" };
  }
  return {};
}

std::vector<std::string> pathProblems(const std::string& path)
{
  const std::string quoted = shown(path, LONGEST_PATH);
  if (path.empty() || path.size() > LONGEST_PATH || path.front() == '/' ||
      path.find('\0') != std::string::npos)
  {
    return { quoted + " must be a relative path of 1 to 1000 characters" };
  }
  for (std::size_t start = 0; start <= path.size();)
  {
    const std::size_t end = std::min(path.find('/', start), path.size());
    const std::string part = path.substr(start, end - start);
    if (part.empty() || part == "." || part == "..")
    {
      return { quoted + " has the part \"" + part + "\", must lead down without \".\" and \"..\"" };
    }
    start = end + 1;
  }
  return {};
}

}  // namespace cloth_tearing
