// Thesis 4.1: which balls tear the cloth, and which slide off it.
#pragma once

#include <array>
#include <string>

#include "cloth_tearing/experiments/thesis_world.h"

namespace cloth
{

/// A ball that is thrown at the hanging cloth, straight from its front.
struct BallThrow
{
  const char* name;
  double radius;  ///< [m]
  double speed;   ///< [m/s]
  double height;  ///< of its centre above the lower edge, as a fraction of the hanging height
  bool tears;     ///< what the thesis saw
};

/// Figures 4.1 to 4.5.
extern const std::array<BallThrow, 5> THESIS_THROWS;

struct BallOutcome
{
  std::array<int, TEAR_KINDS> tears{};  ///< by kind
  bool slid = false;                    ///< the hem rose above the ball's centre while they touched
  double peak_strain = 0.0;             ///< largest of a spring [-]
  double peak_utilisation = 0.0;  ///< largest reading over its threshold, sampled every 10 ms; only
                                  ///< with tearing off
  double torn_length = 0.0;       ///< rest length of the edges that tears opened, both sides [m]
  int pieces = 0;

  int total() const { return tears[0] + tears[1] + tears[2]; }

  /// At least three tears, and the ball went through.
  bool toreThrough() const { return total() >= 3 && !slid; }

  /// Whether this is what the thesis saw: torn through, or not a single tear.
  bool agrees(const BallThrow& thrown) const { return thrown.tears ? toreThrough() : total() == 0; }
};

/// Throws a ball at a cloth that hangs, and watches until it is two seconds past.
///
/// @param simulation ends as the ball left it
/// @param watch called after every step, for pictures and tables; may be empty
BallOutcome throwBall(Simulation& simulation, const BallThrow& thrown, const Watch& watch = {});

}  // namespace cloth
