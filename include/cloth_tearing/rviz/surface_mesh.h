// Turns a surface message into what a graphics card draws, and refuses one that makes no sense.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cloth_tearing/ClothSurface.h"
#include "cloth_tearing/core/types.h"

namespace cloth_tearing
{

/// Everything wrong with a message, one sentence for each field that names its value and limit:
/// no frame, arrays whose lengths do not fit, indices without a particle, numbers that are not
/// finite or too large to be drawn. Empty if it can be drawn.
std::vector<std::string> surfaceProblems(const ClothSurface& message);

/// A vertex: a particle at one of its places in the texture.
struct MeshVertex
{
  std::uint32_t particle;
  float u;  ///< [-]
  float v;  ///< [-], upwards in the image
};

/// The triangles of the last message taken, with vertices that own a place in the texture: a
/// particle has one for each place that corners of triangles have there.
class SurfaceMesh
{
public:
  /// Takes over a message; vertices and triangles are made anew only if they differ.
  ///
  /// @return whether they do
  /// @throws cloth::Refusal with what surfaceProblems() says; nothing has changed then
  bool take(const ClothSurface& message);

  const std::vector<MeshVertex>& vertices() const { return vertices_; }

  /// Three vertices of each triangle, counter-clockwise seen from the front.
  const std::vector<std::uint32_t>& indices() const { return indices_; }

  /// Three particles of each triangle, likewise.
  const std::vector<std::uint32_t>& triangles() const { return triangles_; }

  /// Of each particle, in metres from the message's origin.
  const std::vector<cloth::Vec3>& positions() const { return positions_; }

  /// Of each particle: the mean of the triangles around by their area, of length 1.
  const std::vector<cloth::Vec3>& normals() const { return normals_; }

private:
  bool sameTopology(const ClothSurface& message) const;
  void makeVertices(const ClothSurface& message);
  void makeNormals();

  std::vector<std::uint32_t> triangles_;  ///< as in the message, for comparison
  std::vector<float> uv_;                 ///< likewise
  std::vector<MeshVertex> vertices_;
  std::vector<std::uint32_t> indices_;
  std::vector<cloth::Vec3> positions_;
  std::vector<cloth::Vec3> normals_;
};

}  // namespace cloth_tearing
