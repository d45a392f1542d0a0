// The sentences in which values are refused.
#include "cloth_tearing/core/checks.h"

#include <cmath>
#include <cstdio>

namespace cloth
{
namespace
{

std::string limits(const Range& range)
{
  const bool bounded_below = std::isfinite(range.low);
  const bool bounded_above = std::isfinite(range.high);
  std::string words = "must be finite";
  if (bounded_below)
  {
    words = std::string("must be ") + (range.above_low ? "greater than " : "at least ") +
            text(range.low);
  }
  if (bounded_above)
  {
    words += " and at most " + text(range.high);
  }
  return words;
}

std::string digits(double value, int most)
{
  if (std::isnan(value))
  {
    return "nan";  // of either sign
  }
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.*g", most, value);
  for (char& c : buffer)
  {
    c = c == ',' ? '.' : c;  // whatever the locale of the process is
  }
  return buffer;
}

/// As short as it does not look like a limit that it is not.
std::string textBeside(double value, const Range& range)
{
  const std::string plain = text(value);
  for (const double limit : { range.low, range.high })
  {
    if (value != limit && plain == text(limit))
    {
      return digits(value, 17);
    }
  }
  return plain;
}

}  // namespace

std::string text(double value)
{
  return digits(value, 6);
}

void check(std::vector<std::string>& found, const std::string& field, double value,
           const Range& range)
{
  const bool low_enough = value <= range.high;
  const bool high_enough = range.above_low ? value > range.low : value >= range.low;
  if (!std::isfinite(value) || !low_enough || !high_enough)
  {
    found.push_back(field + " is " + textBeside(value, range) + ", " + limits(range));
  }
}

void check(std::vector<std::string>& found, const std::string& field, const Vec3d& value,
           double limit)
{
  static const char* const AXES[3] = { ".x", ".y", ".z" };
  for (int i = 0; i < 3; ++i)
  {
    check(found, field + AXES[i], value[i], Range::between(-limit, limit));
  }
}

void check(std::vector<std::string>& found, const std::string& field, const Quatd& rotation)
{
  const double length = rotation.norm();
  if (!(std::abs(length - 1.0) < 1e-3))
  {
    found.push_back(field + " has length " + text(length) + ", must be a unit quaternion");
  }
}

}  // namespace cloth
