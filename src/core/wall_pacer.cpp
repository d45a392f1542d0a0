// Counts the time steps that are due when simulated time goes as real time, or so many times as
// fast.
#include "cloth_tearing/core/wall_pacer.h"

#include <algorithm>

#include "cloth_tearing/core/checks.h"

namespace cloth
{
namespace
{

using Seconds = std::chrono::duration<double>;

}  // namespace

void checkSpeed(std::vector<std::string>& found, double speed)
{
  check(found, "speed", speed, Range::between(0.001, 1000.0));
}

void WallPacer::begin(Clock::time_point now)
{
  seen_ = now;
  ahead_ = 0.0;
}

void WallPacer::setSpeed(double speed, Clock::time_point now)
{
  look(now);
  ahead_ = std::max(ahead_, 0.0);
  speed_ = speed;
}

void WallPacer::look(Clock::time_point now)
{
  ahead_ -= speed_ * Seconds(now - seen_).count();
  ahead_ = std::max(ahead_, -speed_ * Seconds(CATCH_UP).count());
  seen_ = now;
}

WallPacer::Clock::time_point WallPacer::due() const
{
  return seen_ + std::chrono::duration_cast<Clock::duration>(Seconds(ahead_ / speed_));
}

}  // namespace cloth
