// One place that judges numbers from outside: finite and within range.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "cloth_tearing/core/limits.h"
#include "cloth_tearing/core/types.h"

namespace cloth
{

/// What a value may be.
struct Range
{
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool above_low = false;  ///< `low` itself is not allowed

  static Range above(double low) { return { low, std::numeric_limits<double>::infinity(), true }; }
  static Range atLeast(double low)
  {
    return { low, std::numeric_limits<double>::infinity(), false };
  }
  static Range between(double low, double high) { return { low, high, false }; }
  static Range aboveUpTo(double low, double high) { return { low, high, true }; }
};

/// Adds a sentence to `found` that names field, value and limit unless `value` is finite and in
/// range.
void check(std::vector<std::string>& found, const std::string& field, double value,
           const Range& range);

/// Adds a sentence to `found` unless every coordinate is finite and at most `limit` in magnitude.
void check(std::vector<std::string>& found, const std::string& field, const Vec3d& value,
           double limit);

/// Adds a sentence to `found` unless `rotation` is a unit quaternion, to a thousandth.
void check(std::vector<std::string>& found, const std::string& field, const Quatd& rotation);

/// `value` as short as it reads back the same to six digits.
std::string text(double value);

}  // namespace cloth
