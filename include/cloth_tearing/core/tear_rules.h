// When and how finely the cloth tears.
#pragma once

#include <string>
#include <vector>

namespace cloth
{

/// Thresholds and guards of tearing (3.2). tear_radius 0, crack_length 0 and hem_factor 1 are the
/// thesis to the letter.
struct TearRules
{
  bool enabled = true;
  double tear_strain = 0.30;       ///< sound cloth tears above this [-], > 0 (3.2.1)
  double weak_tear_strain = 0.22;  ///< at a weak point [-], > 0, <= tear_strain (3.2.2)

  /// At a one-point connection [-], >= 0, <= tear_strain; 0 = as weak_tear_strain (3.2.3).
  double one_point_tear_strain = 0.0;

  /// An intact spring tears on the mean stretch of the cloth within this distance [m], >= 0; 0 =
  /// on its own strain alone.
  double tear_radius = 0.05;

  /// Crack band: at a weak point the threshold grows by sqrt(crack_length / rest length) for
  /// springs shorter than this [m], >= 0, so that a tear costs the same energy on any mesh.
  double crack_length = 0.03;

  /// Thresholds are multiplied by this within hem_width of a pin [-], >= 1; 1 = no hem.
  double hem_factor = 2.0;
  double hem_width = 0.10;  ///< [m], >= 0

  int max_tears_per_step = 50;  ///< the rest wait for the next step, >= 1

  /// No tear makes a spring shorter, or a triangle lower, than these fractions of the local
  /// spacing of the untorn mesh [-], 0 < fraction <= 0.5.
  double min_length = 0.4;
  double min_altitude = 0.2;

  /// The threshold that one_point_tear_strain stands for [-].
  double onePointThreshold() const
  {
    return one_point_tear_strain > 0.0 ? one_point_tear_strain : weak_tear_strain;
  }
};

std::vector<std::string> problems(const TearRules& rules);

}  // namespace cloth
