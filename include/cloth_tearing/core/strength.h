// How much stronger or weaker than the rules of tearing say each spring is.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cloth_tearing/core/mesh.h"
#include "cloth_tearing/core/types.h"

namespace cloth
{

/// What varies the strength of the cloth: a factor [-] on every threshold of a spring. All of it
/// together is multiplied and kept within LEAST_STRENGTH and MOST_STRENGTH. The defaults vary
/// nothing.
///
/// A factor belongs to its spring and is not averaged as patch strain is: of the springs of a
/// patch, which read much the same strain, the weakest tears first, and a pinhole smaller than the
/// patch is felt.
///
/// Places are in the model's own coordinates. A spring belongs to a spot or a line that it touches,
/// so that a spot smaller than the mesh weakens the springs that run through it, and a spring that
/// crosses a line belongs to it wherever its ends are.
struct StrengthParams
{
  /// A ball: a pinhole if its factor is below 1, a patch sewn on if above.
  struct Spot
  {
    Vec3d center = Vec3d::Zero();  ///< [m], model frame
    double radius = 0.0;           ///< [m], > 0
    double factor = 1.0;           ///< [-], LEAST_STRENGTH to MOST_STRENGTH
  };

  /// A straight band: a crease or worn fold if its factor is below 1, a seam if above.
  struct Line
  {
    Vec3d from = Vec3d::Zero();  ///< [m], model frame
    Vec3d to = Vec3d::Zero();    ///< [m]
    double width = 0.0;          ///< of the whole band [m], > 0
    double factor = 1.0;         ///< [-], LEAST_STRENGTH to MOST_STRENGTH
  };

  /// A dashed line: weak dashes, of which the first begins at `line.from`, and sound bridges. A
  /// spring belongs to the dash or bridge that its middle is nearest to.
  struct Perforation
  {
    Line line;
    double pitch = 0.0;  ///< a dash and a bridge together [m], > 0
    double duty = 0.5;   ///< the dash's part of that [-], > 0, <= 1
  };

  /// Each spring's factor is drawn from 1 - scatter to 1 + scatter [-], 0 to 0.9.
  double scatter = 0.0;
  std::uint64_t seed = 1;  ///< of the scatter: another number gives another cloth

  std::vector<Spot> spots;
  std::vector<Line> lines;
  std::vector<Perforation> perforations;

  /// A hem along all borders of the untorn cloth, slits among them: springs with an end within
  /// border_width [m], 0 to 100, of a particle of the border; 0 = none.
  double border_factor = 1.0;  ///< [-], LEAST_STRENGTH to MOST_STRENGTH
  double border_width = 0.02;
};

constexpr double LEAST_STRENGTH = 0.05;
constexpr double MOST_STRENGTH = 20.0;

/// Everything wrong with `params` by themselves, whatever the model.
std::vector<std::string> problems(const StrengthParams& params);

/// The same for a model whose axes were turned by `rotation` about its origin.
StrengthParams turned(StrengthParams params, const Quatd& rotation);

/// The factor of each spring of an untorn cloth [-], 1 where nothing varies.
///
/// Scatter is drawn spring by spring in the order of their ids from a triangular distribution: its
/// mean is 1; it is bounded, so that no cloth has a spring without strength and `scatter` says what
/// to expect; and few springs come near its ends, so that the weakest of many depends little on
/// how many there are, which with a flat distribution would be the bound on every mesh.
///
/// @param positions of the particles [m], in the coordinates of `params`
/// @throws Refusal naming each spot, line or perforation that touches no spring
std::vector<double> springStrengths(const Mesh& mesh, const std::vector<Vec3d>& positions,
                                    const StrengthParams& params);

/// Extends `strengths` after an edit of `mesh`. Halves and twins are the cloth that their parent
/// was. A middle spring (3.2.1) runs through a triangle that had no spring there: it gets the mean
/// of the triangle's three sides, so that tears make no cloth weaker or stronger than what lay
/// around it.
void followStrengths(std::vector<double>& strengths, const Mesh& mesh, const Edit& edit);

}  // namespace cloth
