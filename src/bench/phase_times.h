// Times the parts of a step.
#pragma once

#include <array>
#include <chrono>

#include "cloth_tearing/core/step_observer.h"

namespace cloth_bench
{

/// On the steady clock, whose reading costs far less than any part.
class PhaseTimes : public cloth::StepObserver
{
public:
  void enter(cloth::StepPhase phase) override
  {
    const auto now = std::chrono::steady_clock::now();
    if (phase == cloth::StepPhase::CARRY)
    {
      time_.fill(0.0);
    }
    else
    {
      time_[static_cast<int>(phase_)] =
          std::chrono::duration<double, std::micro>(now - since_).count();
    }
    phase_ = phase;
    since_ = now;
  }

  /// Of the last step [us].
  double of(cloth::StepPhase phase) const { return time_[static_cast<int>(phase)]; }

private:
  std::array<double, cloth::STEP_PHASES> time_{};
  cloth::StepPhase phase_ = cloth::StepPhase::CARRY;
  std::chrono::steady_clock::time_point since_;
};

}  // namespace cloth_bench
