// Makes a sheet of cloth from a Wavefront OBJ file, mends what can be mended and refuses the rest.
#pragma once

#include <istream>
#include <string>

#include "cloth_tearing/core/cloth_model.h"
#include "cloth_tearing/core/import_report.h"

namespace cloth
{

/// A model that a Mesh can be built from, and what had to be done to it.
struct ObjImport
{
  ClothModel model;  ///< [m], axes as in the file
  ImportReport report;
};

/// Reads a model. Units other than metres are the caller's to know (`options.scale`).
///
/// - Vertices are joined by their `v` index, never by position, unless `options.weld_distance`
///   asks for it: a texture seam shares `v` and differs in `vt`, coincident vertices with different
///   indices are a slit.
/// - "Zero" is 1e-6 of the diagonal of the box around all faces: about what single precision can
///   tell apart. Edges no longer than that are collapsed, faces no higher are dropped, both
///   reported; no edge length or area of the result is zero.
/// - Polygons are cut in their best-fit plane.
/// - Faces wound against their neighbours are turned over and reported.
/// - Faces without `vt`, and all faces if no `vt` of them span an area, get texture coordinates by
/// looking along the axis in which the model is
///   thinnest (z rather than x rather than y, if equal), the remaining axes (x, y), (z, y) or (x,
///   z) becoming u and v, scaled alike so that the longer one runs from 0 to 1.
/// - Vertices in no face are left out; the others keep their order.
///
/// @param name of the file, for messages
/// @throws ImportError naming file, line and reason of up to ten problems and their number:
///   anything unreadable, beyond the limits of `options`, a face that repeats a vertex or another
///   face, a polygon that crosses itself, an edge with more than two triangles, a surface with only
///   one side
/// @throws std::invalid_argument if `options` have problems
ObjImport readObj(std::istream& stream, const std::string& name,
                  const ImportOptions& options = ImportOptions());

/// Reads a model from a file.
///
/// @throws ImportError also if it cannot be opened
ObjImport readObjFile(const std::string& path, const ImportOptions& options = ImportOptions());

}  // namespace cloth
