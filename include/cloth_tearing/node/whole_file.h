// Writes and reads a file as a whole or not at all.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace cloth_tearing
{

enum class Existing
{
  KEEP,
  REPLACE,
};

/// Writes `bytes` to `path` by way of a temporary file beside it, whose name begins with '.':
/// whoever reads it, and whatever happens meanwhile, finds the old content or the new, never a
/// part.
/// @throws cloth::Refusal with the path and what is wrong: it exists and is to be kept, or cannot
/// be written; what was there is there still
void writeWholeFile(const std::string& path, Existing existing, const std::string& bytes);

/// @param judge is told the size [byte] before anything is read; what it throws is passed on
/// @return all of the file
/// @throws cloth::Refusal with the path and what is wrong: it is no regular file, cannot be read,
/// or has become shorter meanwhile
std::string readWholeFile(const std::string& path, const std::function<void(std::uint64_t)>& judge);

}  // namespace cloth_tearing
