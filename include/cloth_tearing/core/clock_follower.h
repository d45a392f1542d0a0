// Counts the time steps that an outside clock makes due, and the time that is not made up for.
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

  /// What became due with the last look() beyond LONGEST_LAG, and is so no longer [s].
  double lost() const { return lost_; }
  void stepped() { ++steps_; }

  /// Whether there has been a reading.
  bool following() const { return last_.has_value(); }

private:
  double lag() const;

  double time_step_;
  Reading last_;
  std::chrono::nanoseconds followed_{ 0 };  ///< since following began, without jumps and lost time
  std::uint64_t steps_ = 0;                 ///< since following began
  double lost_ = 0.0;                       ///< [s]
};

/// Adds up the time by which steps fell behind a clock, and tells of it now and then.
class LostTime
{
public:
  using Clock = std::chrono::steady_clock;

  static constexpr std::chrono::seconds TELL_EVERY{ 5 };

  /// @param time [s], >= 0
  void add(double time) { total_ += time; }

  /// All of it [s].
  double total() const { return total_; }

  /// @return a sentence on what was lost since the last one, if that was TELL_EVERY ago; empty if
  /// it was not, or nothing was lost
  std::string tell(Clock::time_point now);

private:
  double total_ = 0.0;                          ///< [s]
  double told_ = 0.0;                           ///< of it [s]
  std::optional<Clock::time_point> last_told_;  ///< none yet
};

}  // namespace cloth
