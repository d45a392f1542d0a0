// Numbers the tears and keeps the last of them.
#include "cloth_tearing/core/tear_log.h"

#include <algorithm>

namespace cloth
{

void TearLog::add(TearEvent& event)
{
  event.sequence = next_++;
  events_.push_back(event);
  if (events_.size() > size_)
  {
    events_.pop_front();
  }
}

std::vector<TearEvent> TearLog::since(std::uint64_t first, std::size_t most) const
{
  auto from = std::lower_bound(events_.begin(), events_.end(), first,
                               [](const TearEvent& event, std::uint64_t sequence)
                               { return event.sequence < sequence; });
  const std::size_t count = std::min(most, static_cast<std::size_t>(events_.end() - from));
  return { from, from + static_cast<std::ptrdiff_t>(count) };
}

std::array<std::uint64_t, 2> TearLog::range() const
{
  return events_.empty()
             ? std::array<std::uint64_t, 2>{ 1, 0 }
             : std::array<std::uint64_t, 2>{ events_.front().sequence, events_.back().sequence };
}

}  // namespace cloth
