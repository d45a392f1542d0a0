// Names that requests give to files.
#pragma once

#include <string>
#include <vector>

namespace cloth_tearing
{

/// Everything wrong with a name for something to be kept: letters, digits, '_', '-' and '.', at
/// most 64, not beginning with '.', which names a file in one folder on any system. Empty if it can
/// be used.
std::vector<std::string> nameProblems(const std::string& name);

/// Everything wrong with a path that has to lead down from a folder: relative, without "." and
/// "..".
std::vector<std::string> pathProblems(const std::string& path);

}  // namespace cloth_tearing
