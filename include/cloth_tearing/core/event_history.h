// Which events made the present state what it is.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace cloth
{

/// Sequence numbers of events, in ranges: a reset forgets them, a restored state brings its own.
struct EventHistory
{
  std::vector<std::array<std::uint64_t, 2>> ranges;  ///< first and last, ascending

  /// `sequence` is newer than all before.
  void add(std::uint64_t sequence)
  {
    if (!ranges.empty() && ranges.back()[1] + 1 == sequence)
    {
      ranges.back()[1] = sequence;
    }
    else
    {
      ranges.push_back({ sequence, sequence });
    }
  }

  bool holds(std::uint64_t sequence) const
  {
    return std::any_of(ranges.begin(), ranges.end(),
                       [sequence](const std::array<std::uint64_t, 2>& range)
                       { return range[0] <= sequence && sequence <= range[1]; });
  }

  /// The newest of them; 0 if there is none.
  std::uint64_t newest() const { return ranges.empty() ? 0 : ranges.back()[1]; }

  friend bool operator==(const EventHistory& a, const EventHistory& b)
  {
    return a.ranges == b.ranges;
  }
};

}  // namespace cloth
