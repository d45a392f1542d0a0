// A request that cannot be granted: an answer with its reason, and nothing has changed.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace cloth
{

/// Names field, value and limit; whoever throws it has changed nothing.
class Refusal : public std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// @throws Refusal with `problems`, one a line, if there are any: of more than 20 the first, and
/// how many more there are
void refuseIf(const std::vector<std::string>& problems);

}  // namespace cloth
