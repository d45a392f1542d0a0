// Draws one cloth in rviz's scene.
#pragma once

#include <OgreQuaternion.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <rviz/ogre_helpers/billboard_line.h>
#include <rviz/ogre_helpers/point_cloud.h>

#include <QImage>
#include <memory>
#include <vector>

#include "cloth_tearing/ClothSurface.h"
#include "cloth_tearing/rviz/cloth_material.h"
#include "cloth_tearing/rviz/cloth_style.h"
#include "cloth_tearing/rviz/mesh_renderable.h"
#include "cloth_tearing/rviz/surface_mesh.h"

namespace cloth_tearing
{

/// The triangles, torn edges, weak points and held particles below a scene node of its own.
class ClothVisual
{
public:
  ClothVisual(Ogre::SceneManager* scene, Ogre::SceneNode* parent);
  ~ClothVisual();
  ClothVisual(const ClothVisual&) = delete;
  ClothVisual& operator=(const ClothVisual&) = delete;

  void setStyle(const ClothStyle& style);
  void setImage(const QImage& image) { material_.setImage(image); }

  /// Where the message's origin lies in the fixed frame.
  void setPose(const Ogre::Vector3& position, const Ogre::Quaternion& orientation);

  /// Draws a message that `mesh` has taken.
  ///
  /// @param new_triangles whether vertices or triangles of `mesh` are others than at the last call
  void draw(const ClothSurface& message, const SurfaceMesh& mesh, bool new_triangles);

  /// Shows nothing until the next draw().
  void hide();

private:
  void drawTriangles(const ClothSurface& message, const SurfaceMesh& mesh, bool new_triangles);
  void drawTornEdges(const ClothSurface& message, const SurfaceMesh& mesh);
  void drawWeakPoints(const ClothSurface& message, const SurfaceMesh& mesh);
  void drawHeld(const ClothSurface& message, const SurfaceMesh& mesh);
  void drawPoints(rviz::PointCloud& cloud, std::vector<rviz::PointCloud::Point>& points,
                  float diameter);

  Ogre::SceneManager* scene_;
  Ogre::SceneNode* node_;
  ClothStyle style_;
  ClothMaterial material_;
  std::vector<BufferVertex> vertices_;
  std::unique_ptr<MeshRenderable> triangles_;
  std::unique_ptr<rviz::BillboardLine> torn_edges_;
  std::unique_ptr<rviz::PointCloud> weak_points_;
  std::unique_ptr<rviz::PointCloud> held_;
};

}  // namespace cloth_tearing
