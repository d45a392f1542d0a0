// Draws one cloth in rviz's scene.
#include "cloth_tearing/rviz/cloth_visual.h"

#include <algorithm>

namespace cloth_tearing
{

namespace
{

constexpr float LINE_DEPTH_BIAS = 4.0F;  // torn edges lie before the wireframe

Ogre::Vector3 toOgre(const cloth::Vec3& x)
{
  return { x.x(), x.y(), x.z() };
}

/// Where the colour of a strain lies in the image of all of them.
float placeInRange(float strain, const std::array<float, 2>& range)
{
  const float place = (strain - range[0]) / (range[1] - range[0]);
  return std::min(1.0F, std::max(0.0F, place));
}

std::unique_ptr<rviz::PointCloud> makeSpheres(Ogre::SceneNode* node, const char* name)
{
  auto cloud = std::make_unique<rviz::PointCloud>();
  cloud->setName(name);  // a node wants to tell them apart
  cloud->setRenderMode(rviz::PointCloud::RM_SPHERES);
  node->attachObject(cloud.get());
  return cloud;
}

}  // namespace

ClothVisual::ClothVisual(Ogre::SceneManager* scene, Ogre::SceneNode* parent)
    : scene_(scene)
    , node_(parent->createChildSceneNode())
    , triangles_(std::make_unique<MeshRenderable>(material_.get()))
    , torn_edges_(std::make_unique<rviz::BillboardLine>(scene, node_))
    , weak_points_(makeSpheres(node_, "weak_points"))
    , held_(makeSpheres(node_, "held"))
{
  node_->attachObject(triangles_.get());
  torn_edges_->getMaterial()->setDepthBias(LINE_DEPTH_BIAS, LINE_DEPTH_BIAS);
}

ClothVisual::~ClothVisual()
{
  node_->detachAllObjects();
  torn_edges_.reset();  // its node lies below ours
  scene_->destroySceneNode(node_);
}

void ClothVisual::setStyle(const ClothStyle& style)
{
  style_ = style;
  material_.setStyle(style);
}

void ClothVisual::setPose(const Ogre::Vector3& position, const Ogre::Quaternion& orientation)
{
  node_->setPosition(position);
  node_->setOrientation(orientation);
}

void ClothVisual::hide()
{
  triangles_->hide();
  torn_edges_->clear();
  weak_points_->clear();
  held_->clear();
}

void ClothVisual::draw(const ClothSurface& message, const SurfaceMesh& mesh, bool new_triangles)
{
  drawTriangles(message, mesh, new_triangles);
  drawTornEdges(message, mesh);
  drawWeakPoints(message, mesh);
  drawHeld(message, mesh);
}

void ClothVisual::drawTriangles(const ClothSurface& message, const SurfaceMesh& mesh,
                                bool new_triangles)
{
  if (new_triangles)
  {
    triangles_->setTriangles(mesh.indices(), mesh.vertices().size());
  }
  const bool strain = style_.coloring == ClothStyle::Coloring::STRAIN;
  vertices_.resize(mesh.vertices().size());
  for (std::size_t i = 0; i < vertices_.size(); ++i)
  {
    const MeshVertex& vertex = mesh.vertices()[i];
    const cloth::Vec3& x = mesh.positions()[vertex.particle];
    const cloth::Vec3& normal = mesh.normals()[vertex.particle];
    vertices_[i].position = { x.x(), x.y(), x.z() };
    vertices_[i].normal = { normal.x(), normal.y(), normal.z() };
    if (strain)
    {
      const float place = placeInRange(message.strain[vertex.particle], style_.strain_range);
      vertices_[i].texture = { place, 0.5F };
    }
    else
    {
      vertices_[i].texture = { vertex.u, 1.0F - vertex.v };
    }
  }
  triangles_->setVertices(vertices_);
}

void ClothVisual::drawTornEdges(const ClothSurface& message, const SurfaceMesh& mesh)
{
  torn_edges_->clear();
  if (!style_.torn_edges.shown || message.torn_edges.empty())
  {
    return;
  }
  torn_edges_->setLineWidth(style_.torn_edges.size);
  torn_edges_->setMaxPointsPerLine(2);
  torn_edges_->setNumLines(static_cast<std::uint32_t>(message.torn_edges.size() / 2));
  for (std::size_t i = 0; i < message.torn_edges.size(); ++i)
  {
    if (i > 0 && i % 2 == 0)
    {
      torn_edges_->newLine();
    }
    torn_edges_->addPoint(toOgre(mesh.positions()[message.torn_edges[i]]), style_.torn_edges.color);
  }
}

void ClothVisual::drawWeakPoints(const ClothSurface& message, const SurfaceMesh& mesh)
{
  std::vector<rviz::PointCloud::Point> points;
  if (style_.weak_points.shown)
  {
    for (const std::uint32_t particle : message.weak_points)
    {
      points.push_back({ toOgre(mesh.positions()[particle]), style_.weak_points.color });
    }
  }
  drawPoints(*weak_points_, points, style_.weak_points.size);
}

void ClothVisual::drawHeld(const ClothSurface& message, const SurfaceMesh& mesh)
{
  std::vector<rviz::PointCloud::Point> points;
  if (style_.held.shown)
  {
    for (const HeldParticle& held : message.held)
    {
      const bool pinned = held.grasp == 0;
      points.push_back({ toOgre(mesh.positions()[held.particle]),
                         pinned ? style_.pinned_color : style_.held.color });
    }
  }
  drawPoints(*held_, points, style_.held.size);
}

void ClothVisual::drawPoints(rviz::PointCloud& cloud, std::vector<rviz::PointCloud::Point>& points,
                             float diameter)
{
  cloud.clear();
  if (points.empty())
  {
    return;
  }
  cloud.setDimensions(diameter, diameter, diameter);
  cloud.addPoints(points.data(), static_cast<std::uint32_t>(points.size()));
}

}  // namespace cloth_tearing
