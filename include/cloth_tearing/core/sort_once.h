// Sorts ids of which some may be there more than once.
#pragma once

#include <algorithm>
#include <vector>

namespace cloth
{

/// Sorts `ids` and leaves each once.
template <class Id>
void sortOnce(std::vector<Id>& ids)
{
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace cloth
