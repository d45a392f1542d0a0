// Counts the time steps that an outside clock makes due.
#include "cloth_tearing/core/clock_follower.h"

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
  const double lost = lag() - seconds(LONGEST_LAG);
  if (lost > 0.0)
  {
    followed_ -= std::chrono::duration_cast<nanoseconds>(std::chrono::duration<double>(lost));
  }
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

}  // namespace cloth
