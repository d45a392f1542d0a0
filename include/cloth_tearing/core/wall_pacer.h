// Counts the time steps that are due when simulated time goes as real time, or so many times as
// fast.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace cloth
{

/// Adds a sentence to `found` unless `speed`, simulated over real time [-], is 0.001 to 1000.
void checkSpeed(std::vector<std::string>& found, double speed);

/// Keeps the pace: is told what time it is and what was stepped, and never runs ahead by more than
/// the step that is under way.
class WallPacer
{
public:
  using Clock = std::chrono::steady_clock;

  /// Time lost beyond this is not made up for: a machine that is too slow runs late, not wild.
  static constexpr std::chrono::milliseconds CATCH_UP{ 100 };

  /// @param speed simulated over real time [-], see checkSpeed
  WallPacer(double speed, Clock::time_point now) : speed_(speed), seen_(now) {}

  /// Begins anew: a step is due, and nothing has to be made up for.
  void begin(Clock::time_point now);

  /// What passed until `now` goes by the old speed, and what of it is left to be done is not done:
  /// the simulation goes on from where it is.
  void setSpeed(double speed, Clock::time_point now);

  void look(Clock::time_point now);
  bool stepDue() const { return ahead_ <= 0.0; }

  /// @param time_step [s]
  void stepped(double time_step) { ahead_ += time_step; }

  /// When the next step is due; in the past if it is already.
  Clock::time_point due() const;

private:
  double speed_;
  Clock::time_point seen_;
  double ahead_ = 0.0;  ///< simulated time over what it should be [s]
};

}  // namespace cloth
