// Numbers the tears and keeps the last of them.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "cloth_tearing/core/tear_event.h"

namespace cloth
{

class TearLog
{
public:
  /// @param size how many tears are kept
  explicit TearLog(int size) : size_(static_cast<std::size_t>(size)) {}

  /// Gives the event its number and keeps it.
  void add(TearEvent& event);

  /// Tears from sequence number `first` on, at most `most`.
  std::vector<TearEvent> since(std::uint64_t first, std::size_t most) const;

  /// The oldest and newest number that is kept; {1, 0} if there was none.
  std::array<std::uint64_t, 2> range() const;

private:
  std::size_t size_;
  std::deque<TearEvent> events_;
  std::uint64_t next_ = 1;
};

}  // namespace cloth
