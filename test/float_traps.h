// Ends a test program where arithmetic goes wrong, instead of letting a NaN spread unseen.
#pragma once

#include <cfenv>

namespace cloth
{

/// While it lives, an operation of this thread, or of one that it starts, that has no result,
/// divides by zero or overflows raises SIGFPE. (Comparisons with NaN, too: not for code that is
/// given some.)
class FloatTraps
{
public:
  FloatTraps() : before_(fegetexcept())
  {
    std::feclearexcept(TRAPPED);
    feenableexcept(TRAPPED);
  }
  ~FloatTraps()
  {
    std::feclearexcept(TRAPPED);
    fedisableexcept(TRAPPED & ~before_);
  }
  FloatTraps(const FloatTraps&) = delete;
  FloatTraps& operator=(const FloatTraps&) = delete;

private:
  static constexpr int TRAPPED = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;

  int before_;
};

}  // namespace cloth
