// What the rules of tearing may be.
#include "cloth_tearing/core/tear_rules.h"

#include "cloth_tearing/core/checks.h"

namespace cloth
{
namespace
{

constexpr double MOST_STRAIN = 100.0;  // [-]

}  // namespace

std::vector<std::string> problems(const TearRules& rules)
{
  std::vector<std::string> found;
  check(found, "tear_strain [-]", rules.tear_strain, Range::aboveUpTo(0.0, MOST_STRAIN));
  const double sound = found.empty() ? rules.tear_strain : MOST_STRAIN;
  check(found, "weak_tear_strain [-]", rules.weak_tear_strain, Range::aboveUpTo(0.0, sound));
  check(found, "one_point_tear_strain [-]", rules.one_point_tear_strain,
        Range::between(0.0, sound));
  check(found, "tear_radius [m]", rules.tear_radius, Range::between(0.0, 10.0));
  check(found, "crack_length [m]", rules.crack_length, Range::between(0.0, 10.0));
  check(found, "hem_factor [-]", rules.hem_factor, Range::between(1.0, 1000.0));
  check(found, "hem_width [m]", rules.hem_width, Range::between(0.0, 100.0));
  check(found, "max_tears_per_step", rules.max_tears_per_step,
        Range::between(1, MAX_TEARS_PER_STEP));
  check(found, "min_length [-]", rules.min_length, Range::aboveUpTo(0.0, 0.5));
  check(found, "min_altitude [-]", rules.min_altitude, Range::aboveUpTo(0.0, 0.5));
  return found;
}

}  // namespace cloth
