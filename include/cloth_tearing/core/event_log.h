// Numbers events and keeps the last of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace cloth
{

/// @tparam Event has a member `sequence`, its number: 1, 2, ... for the life of the log
template <class Event>
class EventLog
{
public:
  /// @param size how many events are kept
  explicit EventLog(int size) : size_(static_cast<std::size_t>(size)) {}

  /// Gives the event its number and keeps it.
  void add(Event& event)
  {
    event.sequence = next_++;
    events_.push_back(event);
    if (events_.size() > size_)
    {
      events_.pop_front();
    }
  }

  /// Events from sequence number `first` on, at most `most`.
  std::vector<Event> since(std::uint64_t first, std::size_t most) const
  {
    const auto from = std::lower_bound(events_.begin(), events_.end(), first,
                                       [](const Event& event, std::uint64_t sequence)
                                       { return event.sequence < sequence; });
    const std::size_t count = std::min(most, static_cast<std::size_t>(events_.end() - from));
    return { from, from + static_cast<std::ptrdiff_t>(count) };
  }

  /// The oldest and newest number that is kept; {1, 0} if there was none.
  std::array<std::uint64_t, 2> range() const
  {
    return events_.empty()
               ? std::array<std::uint64_t, 2>{ 1, 0 }
               : std::array<std::uint64_t, 2>{ events_.front().sequence, events_.back().sequence };
  }

  /// All that are kept, ascending by number.
  const std::deque<Event>& all() const { return events_; }

private:
  std::size_t size_;
  std::deque<Event> events_;
  std::uint64_t next_ = 1;
};

}  // namespace cloth
