// The cloth's triangles in buffers of the graphics card.
#include "cloth_tearing/rviz/mesh_renderable.h"

#include <OgreAxisAlignedBox.h>
#include <OgreCamera.h>
#include <OgreHardwareBufferManager.h>
#include <OgreNode.h>
#include <OgreVertexIndexData.h>

#include <algorithm>

namespace cloth_tearing
{

namespace
{

/// Leaves room to grow, so that not every tear asks for other buffers.
std::size_t withReserve(std::size_t count)
{
  return count + count / 4 + 256;
}

}  // namespace

MeshRenderable::MeshRenderable(const Ogre::MaterialPtr& material) : material_(material)
{
  mRenderOp.operationType = Ogre::RenderOperation::OT_TRIANGLE_LIST;
  mRenderOp.useIndexes = true;
  mRenderOp.vertexData = new Ogre::VertexData;
  mRenderOp.indexData = new Ogre::IndexData;
  mRenderOp.vertexData->vertexStart = 0;
  mRenderOp.indexData->indexStart = 0;

  Ogre::VertexDeclaration* layout = mRenderOp.vertexData->vertexDeclaration;
  layout->addElement(0, offsetof(BufferVertex, position), Ogre::VET_FLOAT3, Ogre::VES_POSITION);
  layout->addElement(0, offsetof(BufferVertex, normal), Ogre::VET_FLOAT3, Ogre::VES_NORMAL);
  layout->addElement(0, offsetof(BufferVertex, texture), Ogre::VET_FLOAT2,
                     Ogre::VES_TEXTURE_COORDINATES, 0);
  reserve(1, 3);
}

MeshRenderable::~MeshRenderable()
{
  delete mRenderOp.vertexData;
  delete mRenderOp.indexData;
}

void MeshRenderable::reserve(std::size_t vertices, std::size_t indices)
{
  Ogre::HardwareBufferManager& buffers = Ogre::HardwareBufferManager::getSingleton();
  if (vertices > vertex_capacity_)
  {
    vertex_capacity_ = withReserve(vertices);
    vertex_buffer_ =
        buffers.createVertexBuffer(sizeof(BufferVertex), vertex_capacity_,
                                   Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY_DISCARDABLE);
    mRenderOp.vertexData->vertexBufferBinding->setBinding(0, vertex_buffer_);
  }
  if (indices > index_capacity_)
  {
    index_capacity_ = withReserve(indices);
    mRenderOp.indexData->indexBuffer =
        buffers.createIndexBuffer(Ogre::HardwareIndexBuffer::IT_32BIT, index_capacity_,
                                  Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY_DISCARDABLE);
  }
}

void MeshRenderable::setTriangles(const std::vector<std::uint32_t>& indices,
                                  std::size_t vertex_count)
{
  reserve(2 * vertex_count, 2 * indices.size());
  mRenderOp.vertexData->vertexCount = 2 * vertex_count;
  mRenderOp.indexData->indexCount = 2 * indices.size();
  hide();
  if (indices.empty())
  {
    return;
  }
  auto* target = static_cast<std::uint32_t*>(
      mRenderOp.indexData->indexBuffer->lock(Ogre::HardwareBuffer::HBL_DISCARD));
  std::uint32_t* back = std::copy(indices.begin(), indices.end(), target);
  const auto shift = static_cast<std::uint32_t>(vertex_count);
  for (std::size_t t = 0; t + 3 <= indices.size(); t += 3)
  {
    *back++ = indices[t] + shift;
    *back++ = indices[t + 2] + shift;
    *back++ = indices[t + 1] + shift;
  }
  mRenderOp.indexData->indexBuffer->unlock();
}

void MeshRenderable::setVertices(const std::vector<BufferVertex>& vertices)
{
  if (vertices.empty())
  {
    hide();
    return;
  }
  auto* target =
      static_cast<BufferVertex*>(vertex_buffer_->lock(Ogre::HardwareBuffer::HBL_DISCARD));
  BufferVertex* back = std::copy(vertices.begin(), vertices.end(), target);
  Ogre::AxisAlignedBox box;
  for (BufferVertex vertex : vertices)
  {
    box.merge(Ogre::Vector3(vertex.position.data()));
    for (float& coordinate : vertex.normal)
    {
      coordinate = -coordinate;
    }
    *back++ = vertex;
  }
  vertex_buffer_->unlock();

  setBoundingBox(box);
  radius_ = std::max(box.getMinimum().length(), box.getMaximum().length());
  if (getParentNode() != nullptr)
  {
    getParentNode()->needUpdate();
  }
  drawn_ = true;
}

void MeshRenderable::_updateRenderQueue(Ogre::RenderQueue* queue)
{
  if (drawn_)
  {
    SimpleRenderable::_updateRenderQueue(queue);
  }
}

Ogre::Real MeshRenderable::getSquaredViewDepth(const Ogre::Camera* camera) const
{
  const Ogre::Vector3 middle = getParentNode()->_getFullTransform() * mBox.getCenter();
  return (camera->getDerivedPosition() - middle).squaredLength();
}

}  // namespace cloth_tearing
