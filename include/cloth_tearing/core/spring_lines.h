// Lines of springs side by side in the lanes, each to be solved as a whole.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "cloth_tearing/core/kernels.h"
#include "cloth_tearing/core/line_finder.h"
#include "cloth_tearing/core/spring_lanes.h"
#include "cloth_tearing/core/spring_table.h"
#include "cloth_tearing/core/vec3_array.h"

namespace cloth
{

class NumberReader;

/// Lines side by side: in each lane the spring of rung k joins the particles of nodes k and k + 1.
/// A rung whose lane has no spring parts a line from the next one in that lane.
struct SpringLadder
{
  /// Where neighbours in memory lie side by side, the particle in lane 0 of node 0, and how much
  /// further each node lies. Elsewhere -1 and 0.
  int first = -1;
  int step = 0;

  std::vector<int> particles;  ///< elsewhere, by node and lane; -1: none
  std::vector<char> in_rows;   ///< elsewhere, see kernels::NodeList
  int used = kernels::LANES;   ///< lanes; those after them have no particles

  std::vector<kernels::Lanes> lanes;  ///< by rung
  std::vector<Links> links;           ///< the same

  bool sideBySide() const { return first >= 0; }
  int rungs() const { return static_cast<int>(links.size()); }
  int nodes() const { return rungs() + 1; }
  int particle(int node, int lane) const
  {
    return sideBySide() ? first + node * step + lane : particles[node * kernels::LANES + lane];
  }
  kernels::NodeList nodeList() const { return { particles.data(), in_rows.data(), nodes(), used }; }
};

/// Structural springs in ladders, as many as lie in lines. Depends on the springs and on where the
/// particles were when the lines were found, and on tears, never on the processor or the number of
/// threads. A tear takes springs out; it adds none.
class SpringLines
{
public:
  /// No lines.
  SpringLines() = default;

  /// Finds lines.
  /// @param places of the particles [m]
  SpringLines(const SpringTable& springs, const Vec3Array& places);

  /// Arranges them as toNumbers() told.
  /// @throws Refusal if that is no sound arrangement of these springs
  SpringLines(const SpringTable& springs, int particles, const std::vector<int>& numbers);

  /// All that decides where springs lie.
  std::vector<int> toNumbers() const;

  /// Whether a link lies in a ladder.
  bool has(int link) const
  {
    return link % 2 == 0 && link / 2 < static_cast<int>(places_.size()) &&
           places_[link / 2].ladder >= 0;
  }

  /// Takes over springs that were changed, by SpringId: who does not fit its place any more leaves.
  void follow(const SpringTable& springs, const std::vector<int>& changed);

  /// See SpringBlocks::watch().
  void watch(const SpringTable& springs, Real watched);

  /// Ladders of one phase have no particle in common, nor have lanes of a ladder. Phase k has those
  /// from phases()[k] to phases()[k + 1] - 1.
  const std::vector<SpringLadder>& ladders() const { return ladders_; }
  const std::vector<int>& phases() const { return phases_; }

  /// Nodes of the longest ladder, and of the longest of those that work on copies.
  int longest() const { return longest_; }
  int longestCopied() const { return longest_copied_; }

private:
  /// Where a spring lies.
  struct Place
  {
    int ladder = -1;  ///< -1: in none
    int rung = 0;
    int lane = 0;
  };

  std::vector<SpringLine> laySideBySide(std::vector<SpringLine> lines, int particles,
                                        const SpringTable& springs);
  void layLoose(const std::vector<SpringLine>& lines, const SpringTable& springs);
  void layInLane(int ladder, int lane, const std::vector<const SpringLine*>& lines,
                 const SpringTable& springs);
  static void notePattern(SpringLadder& ladder);
  void endPhase();
  int addLadder(SpringLadder ladder, int rungs);
  void put(int ladder, int rung, int lane, int spring, const SpringTable& springs);
  bool fits(const Place& place, const SpringLaw& law) const;
  void readLadder(NumberReader& reader, const SpringTable& springs, std::vector<int>& touched);
  void refuseSharedParticles(const SpringLadder& ladder, std::vector<int>& touched) const;
  void readSpring(int ladder, int rung, int lane, int link, const SpringTable& springs);
  void write(int spring, const SpringTable& springs);

  std::vector<SpringLadder> ladders_;
  std::vector<int> phases_ = { 0 };
  std::vector<Place> places_;  ///< by SpringId
  int longest_ = 0;
  int longest_copied_ = 0;
  Real watched_ = std::numeric_limits<Real>::infinity();
};

}  // namespace cloth
