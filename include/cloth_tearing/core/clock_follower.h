// Counts the time steps that an outside clock makes due.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace cloth
{

/// Follows a clock that may be missing, stand still, tick coarsely or jump. Never runs ahead of it.
class ClockFollower
{
public:
  /// What a clock shows; nothing while there is none. Whole nanoseconds, as seconds since 1970 are
  /// too coarse in a double.
  using Reading = std::optional<std::chrono::nanoseconds>;

  /// A clock that goes on by more at a time has jumped; of what is due, more is not made up for: a
  /// machine that is too slow runs late, not wild.
  static constexpr std::chrono::seconds LONGEST_LAG{ 1 };

  /// @param time_step [s]
  explicit ClockFollower(double time_step) : time_step_(time_step) {}

  /// Takes what the clock shows now; the first reading is where following begins.
  /// @return a sentence on a jump, which is skipped; else empty
  std::string look(const Reading& now);

  /// Whether the clock has gone on by a whole time step more than stepped() was told.
  bool stepDue() const;
  void stepped() { ++steps_; }

  /// Whether there has been a reading.
  bool following() const { return last_.has_value(); }

private:
  double lag() const;

  double time_step_;
  Reading last_;
  std::chrono::nanoseconds followed_{ 0 };  ///< since following began, without jumps and lost time
  std::uint64_t steps_ = 0;                 ///< since following began
};

}  // namespace cloth
