// The cloth's triangles in buffers of the graphics card.
#pragma once

#include <OgreHardwareIndexBuffer.h>
#include <OgreHardwareVertexBuffer.h>
#include <OgreMaterial.h>
#include <OgreSimpleRenderable.h>

#include <array>
#include <cstdint>
#include <vector>

namespace cloth_tearing
{

/// A vertex as it lies in the buffer.
struct BufferVertex
{
  std::array<float, 3> position;  ///< [m]
  std::array<float, 3> normal;    ///< of length 1
  std::array<float, 2> texture;   ///< [-], downwards in the image
};

/// Triangles that are lit on both sides: each is there twice, its back with the other winding and
/// the other normals, and the material culls those that show their wrong side.
class MeshRenderable : public Ogre::SimpleRenderable
{
public:
  explicit MeshRenderable(const Ogre::MaterialPtr& material);
  ~MeshRenderable() override;

  /// Takes other triangles: three vertices each, counter-clockwise seen from the front. Nothing is
  /// drawn before setVertices().
  void setTriangles(const std::vector<std::uint32_t>& indices, std::size_t vertex_count);

  /// Writes all vertices of these triangles into the buffer that is there.
  void setVertices(const std::vector<BufferVertex>& vertices);

  /// Draws nothing until the next setVertices(), whatever the node above makes visible.
  void hide() { drawn_ = false; }

  void _updateRenderQueue(Ogre::RenderQueue* queue) override;
  const Ogre::MaterialPtr& getMaterial() const override { return material_; }
  Ogre::Real getBoundingRadius() const override { return radius_; }
  Ogre::Real getSquaredViewDepth(const Ogre::Camera* camera) const override;

private:
  void reserve(std::size_t vertices, std::size_t indices);

  Ogre::MaterialPtr material_;
  Ogre::HardwareVertexBufferSharedPtr vertex_buffer_;
  std::size_t vertex_capacity_ = 0;
  std::size_t index_capacity_ = 0;
  Ogre::Real radius_ = 0.0F;
  bool drawn_ = false;
};

}  // namespace cloth_tearing
