// Thesis 4.1: which balls tear the cloth, and which slide off it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "cloth_tearing/experiments/thesis_world.h"

namespace cloth
{

/// A ball that is thrown at the hanging cloth, straight from its front.
struct BallThrow
{
  const char* name;
  double radius;        ///< [m]
  double speed;         ///< [m/s]
  double height;        ///< of its centre above the lower edge, as a fraction of the hanging height
  bool tears;           ///< what the thesis saw
  double aside = 0.03;  ///< of its centre [m]; the middle itself may be a symmetry line of the mesh
};

/// Figures 4.1 to 4.5.
extern const std::array<BallThrow, 5> THESIS_THROWS;

/// Figure 4.1 itself: three small balls, to be thrown THREE_BALLS_INTERVAL apart.
extern const std::array<BallThrow, 3> THREE_BALLS;
constexpr double THREE_BALLS_INTERVAL = 2.5;  ///< [s]

/// Where a ball's centre starts in front of the cloth [m].
constexpr double BALL_START = 3.5;

struct BallOutcome
{
  std::array<int, TEAR_KINDS> tears{};  ///< by kind; of several balls: those nearest to this one
  bool slid = false;                    ///< the hem rose above the ball's centre while they touched
  double peak_strain = 0.0;             ///< largest of a spring, whatever the ball [-]
  double torn_length = 0.0;             ///< tornLength() in the end [m]
  int pieces = 0;                       ///< in the end

  int total() const { return tears[0] + tears[1] + tears[2]; }

  /// At least three tears, and the ball went through.
  bool toreThrough() const { return total() >= 3 && !slid; }

  /// "torn through", "torn, not through" or "not torn".
  const char* inWords() const;

  /// Whether this is what the thesis saw: torn through, or not a single tear.
  bool agrees(const BallThrow& thrown) const { return thrown.tears ? toreThrough() : total() == 0; }
};

/// Throws balls at a cloth that hangs, one every `interval` [s], and watches until the last is two
/// seconds past.
///
/// @param simulation ends as the balls left it
/// @param watch called after every step; may be empty
/// @return of each ball
/// @throws std::runtime_error if the cloth runs away
std::vector<BallOutcome> throwBalls(Simulation& simulation, const std::vector<BallThrow>& throws,
                                    double interval, const Watch& watch = {});

/// The same with one ball.
BallOutcome throwBall(Simulation& simulation, const BallThrow& thrown, const Watch& watch = {});

/// The largest readings while a ball passes with tearing off [-]: what a threshold must lie below
/// for the ball to tear the cloth, and above for it not to.
struct BallPeaks
{
  double local = 0.0;      ///< a spring's own strain, as in the thesis
  double local_hem = 0.0;  ///< the same over the hem's factor near pins
  double patch = 0.0;      ///< patch strain, over the hem's factor near pins
};

/// @param simulation ends as the ball left it, with tearing off
BallPeaks peaksOf(Simulation& simulation, const BallThrow& thrown);

}  // namespace cloth
