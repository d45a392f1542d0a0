// Reads the text of a Wavefront OBJ file into numbers, without judging the shape they describe.
#pragma once

#include <string>
#include <vector>

#include "cloth_tearing/core/import_report.h"
#include "cloth_tearing/core/types.h"

namespace cloth
{

/// One corner of a face.
struct ObjCorner
{
  int vertex = -1;   ///< index into ObjContent::positions
  int texture = -1;  ///< index into ObjContent::uvs, -1 = none
};

/// One `f` line.
struct ObjFace
{
  int line = 0;
  int first_corner = 0;  ///< index into ObjContent::corners
  int corner_count = 0;

  bool textured = false;  ///< every corner has a texture index, else none has
};

/// What stands in the file, indices resolved to count from 0 and checked.
struct ObjContent
{
  std::vector<Vec3d> positions;  ///< units of the file, finite
  std::vector<int> lines;        ///< of each position
  std::vector<Vec2d> uvs;        ///< finite
  std::vector<ObjCorner> corners;
  std::vector<ObjFace> faces;
  std::vector<ImportFinding> ignored;  ///< statements left out, one finding per keyword
};

/// Reads `v`, `vt` and `f` lines; normals, names and groups are passed over, everything else is
/// ignored with a finding. Numbers are read alike in every locale.
///
/// Lines end with LF, CRLF or CR; a backslash at the end joins the next one; `#` starts a comment.
/// A byte order mark is skipped. A face may name vertices that follow it, but negative indices
/// count back from its line.
///
/// @throws ImportError naming every line that cannot be read, or the limit that was passed
ObjContent parseObj(const std::string& text, const std::string& name, const ImportOptions& options);

}  // namespace cloth
