// Where on a slider a value is, when every step of the slider is the same factor.
#pragma once

#include <algorithm>
#include <cmath>

namespace cloth_tearing
{

class SliderScale
{
public:
  static constexpr int STEPS = 500;

  /// @param low,high values at the ends, 0 < low < high
  SliderScale(double low, double high) : low_(low), high_(high) {}

  /// The position next to `value`, that of an end if it is beyond.
  int position(double value) const
  {
    const double within = std::clamp(value, low_, high_);
    return static_cast<int>(std::lround(STEPS * std::log(within / low_) / std::log(high_ / low_)));
  }

  /// To three digits, as people would write it.
  double value(int position) const
  {
    const double exact = low_ * std::pow(high_ / low_, static_cast<double>(position) / STEPS);
    const double digit = std::pow(10.0, std::floor(std::log10(exact)) - 2.0);
    return std::clamp(std::round(exact / digit) * digit, low_, high_);
  }

private:
  double low_;
  double high_;
};

}  // namespace cloth_tearing
