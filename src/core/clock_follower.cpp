// Counts the time steps that an outside clock makes due, and the time that is not made up for.
#include "cloth_tearing/core/clock_follower.h"

#include <algorithm>
#include <utility>

#include "cloth_tearing/core/checks.h"

namespace cloth
{
namespace
{

using std::chrono::nanoseconds;

/// The resolution of a reading: a step that is due by less is due.
constexpr double TOLERANCE = 1e-9;  // [s]

double seconds(nanoseconds time)
{
  return std::chrono::duration<double>(time).count();
}

}  // namespace

std::string ClockFollower::look(const Reading& now)
{
  lost_ = 0.0;
  if (!now)
  {
    return "";
  }
  const nanoseconds passed = *now - last_.value_or(*now);
  last_ = now;
  if (passed < nanoseconds(0) || passed > LONGEST_LAG)
  {
    return "the clock jumped by " + text(seconds(passed)) + " s: skipped";
  }
  followed_ += passed;
  const auto lost = std::chrono::duration_cast<nanoseconds>(
      std::chrono::duration<double>(std::max(0.0, lag() - seconds(LONGEST_LAG))));
  followed_ -= lost;
  lost_ = seconds(lost);
  return "";
}

bool ClockFollower::stepDue() const
{
  return lag() + TOLERANCE >= time_step_;
}

/// How far the steps are behind the clock [s].
double ClockFollower::lag() const
{
  return seconds(followed_) - static_cast<double>(steps_) * time_step_;
}

std::string LostTime::tell(Clock::time_point now)
{
  if (total_ == told_ || (last_told_ && now < *last_told_ + TELL_EVERY))
  {
    return "";
  }
  last_told_ = now;
  return "fell behind the clock by " + text(total_ - std::exchange(told_, total_)) +
         " s: not made up for";
}

}  // namespace cloth
