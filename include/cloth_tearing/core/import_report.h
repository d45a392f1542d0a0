// What an import is asked for, what it reports, and how it refuses.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/cloth_model.h"
#include "cloth_tearing/core/types.h"

namespace cloth
{

/// How a model file is read. The limits keep a wrong file from filling the memory.
struct ImportOptions
{
  double scale = 1.0;          ///< [m] per unit of the file, > 0
  double weld_distance = 0.0;  ///< vertices no further apart are joined [m]; 0 = by index alone

  std::size_t max_bytes = 100000000;       ///< length of the file [bytes]
  int max_vertices = MAX_PARTICLES;        ///< `v` lines, and `vt` lines
  int max_triangles = MAX_TRIANGLES;       ///< after polygons are cut
  int max_polygon_corners = 1000;          ///< of one face
  double max_coordinate = MAX_COORDINATE;  ///< largest coordinate after scaling [m]
  double max_texture_coordinate = 1e6;     ///< largest u or v [-]; floats stay finer than a texel
};

/// Everything wrong with `options`, one sentence each, naming field, value and limit.
std::vector<std::string> problems(const ImportOptions& options);

/// Something the import mended, dropped, made up or left out.
struct ImportFinding
{
  int line = 0;      ///< of the file, from 1
  std::string text;  ///< what was found there and what was done
};

/// What was found in a file and what was made of it.
struct ImportReport
{
  int vertices = 0;          ///< `v` lines in the file
  int texture_vertices = 0;  ///< `vt` lines in the file
  int faces = 0;             ///< `f` lines in the file

  int particles = 0;       ///< vertices of the model
  int springs = 0;         ///< edges of the model
  int border_springs = 0;  ///< edges with one triangle
  int triangles = 0;       ///< of the model
  int pieces = 0;          ///< parts that share no vertex
  int borders = 0;         ///< closed loops of border edges
  int seam_edges = 0;      ///< inner edges across which the texture jumps

  int welded_vertices = 0;   ///< joined to another one because of `weld_distance`
  int collapsed_edges = 0;   ///< of zero length
  int dropped_faces = 0;     ///< of zero area, or flattened by a collapsed or welded edge
  int turned_faces = 0;      ///< wound against their neighbours, now alike
  int unused_vertices = 0;   ///< in no face, left out
  int untextured_faces = 0;  ///< without usable `vt`, texture coordinates made up
  int flat_texture = 0;      ///< triangles of the model whose texture coordinates span no area

  Vec3d lowest = Vec3d::Zero();   ///< corner of the box around the model [m]
  Vec3d highest = Vec3d::Zero();  ///< the opposite corner [m]
  double shortest_edge = 0;       ///< [m], > 0
  double longest_edge = 0;        ///< [m]
  double least_altitude = 0;      ///< of any triangle [m], > 0
  double area = 0;                ///< [m^2]

  /// In the order of their lines; of one kind at most MAX_FINDINGS_KEPT, the counts above are full.
  std::vector<ImportFinding> findings;
};

constexpr int MAX_FINDINGS_KEPT = 1000;

/// A model that cannot become cloth. what() names the file and, for up to ten problems, line and
/// reason, and how many there are.
class ImportError : public std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// Collects what is wrong with a file until it is time to refuse it.
class ImportProblems
{
public:
  explicit ImportProblems(std::string file) : file_(std::move(file)) {}

  void add(int line, const std::string& reason);
  bool empty() const { return count_ == 0; }

  /// @throws ImportError with the problems so far, if there are any
  void refuseIfAny() const;

  /// For what makes reading on pointless: a limit, an empty file. Line 0 = the file as a whole.
  /// @throws ImportError with this problem after those so far
  [[noreturn]] void refuse(int line, const std::string& reason);

private:
  [[noreturn]] void refuseNow() const;

  std::string file_;
  std::vector<ImportFinding> first_;  ///< the first ten
  std::size_t count_ = 0;
};

}  // namespace cloth
