// Bullet's soft body as a peer: the same particles and springs, its own way to hold them together.
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <map>
#include <utility>

#include "engine.h"

namespace cloth_bench
{
namespace
{

constexpr btScalar BEND_SHEAR = 0.2F;  ///< stiffness of bend-shear links, structural ones have 1
constexpr btScalar MARGIN = 0.005F;    ///< round the cloth [m]
constexpr btScalar AIR_DENSITY = 1.2F;
constexpr btScalar DRAG = 0.8F;  ///< about the pressure that the other engines' wind_drag gives

btVector3 toBullet(const cloth::Vec3d& v)
{
  return { static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()),
           static_cast<btScalar>(v.z()) };
}

/// Edges in the order in which the triangles name them, with the corners opposite.
struct Edge
{
  std::pair<int, int> ends;
  std::vector<int> opposite;
};

std::vector<Edge> edgesOf(const cloth::ClothModel& model)
{
  std::vector<Edge> edges;
  std::map<std::pair<int, int>, std::size_t> known;
  for (const cloth::ModelTriangle& face : model.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const std::pair<int, int> ends = std::minmax(face.vertices[k], face.vertices[(k + 1) % 3]);
      const auto [at, is_new] = known.emplace(ends, edges.size());
      if (is_new)
      {
        edges.push_back({ ends, {} });
      }
      edges[at->second].opposite.push_back(face.vertices[(k + 2) % 3]);
    }
  }
  return edges;
}

class BulletEngine : public Engine
{
public:
  BulletEngine(const Scene& scene, double time_step)
      : time_step_(time_step)
      , dispatcher_(&configuration_)
      , world_(&dispatcher_, &broadphase_, &solver_, &configuration_)
  {
    world_.setGravity(toBullet(scene.environment.gravity));
    btSoftBodyWorldInfo& info = world_.getWorldInfo();
    info.m_gravity = toBullet(scene.environment.gravity);
    info.air_density = AIR_DENSITY;
    info.m_sparsesdf.Initialize();
    addCloth(scene, info);
    if (scene.ball)
    {
      addBall(*scene.ball);
    }
  }

  ~BulletEngine() override
  {
    world_.removeSoftBody(cloth_.get());
    if (ball_)
    {
      world_.removeRigidBody(ball_.get());
    }
  }

  BulletEngine(const BulletEngine&) = delete;
  BulletEngine& operator=(const BulletEngine&) = delete;

  void step() override { world_.stepSimulation(static_cast<btScalar>(time_step_), 0); }

  int particles() const override { return cloth_->m_nodes.size(); }

  std::vector<double> strains() const override
  {
    std::vector<double> strains;
    for (int i = 0; i < structural_; ++i)
    {
      const btSoftBody::Link& link = cloth_->m_links[i];
      strains.push_back((link.m_n[1]->m_x - link.m_n[0]->m_x).length() / rest_[i] - 1.0);
    }
    return strains;
  }

  double fastest() const override
  {
    double fastest = 0.0;
    for (int i = 0; i < particles(); ++i)
    {
      const double speed = cloth_->m_nodes[i].m_v.length();
      fastest = speed <= fastest ? fastest : speed;  // a NaN stays
    }
    return fastest;
  }

private:
  void addCloth(const Scene& scene, btSoftBodyWorldInfo& info)
  {
    std::vector<btVector3> places;
    for (const cloth::Vec3d& place : scene.model.positions)
    {
      places.push_back(toBullet(place));
    }
    cloth_ = std::make_unique<btSoftBody>(&info, static_cast<int>(places.size()), places.data(),
                                          nullptr);
    for (const cloth::ModelTriangle& face : scene.model.triangles)
    {
      cloth_->appendFace(face.vertices[0], face.vertices[1], face.vertices[2]);
    }
    addLinks(edgesOf(scene.model));
    setMasses(scene);
    configure(scene);
    cloth_->getCollisionShape()->setMargin(MARGIN);
    for (int i = 0; i < particles(); ++i)
    {
      cloth_->m_nodes[i].m_x = cloth_->m_nodes[i].m_q = toBullet(scene.start[i]);
    }
    world_.addSoftBody(cloth_.get());
  }

  void addLinks(const std::vector<Edge>& edges)
  {
    for (const Edge& edge : edges)
    {
      cloth_->appendLink(edge.ends.first, edge.ends.second);
    }
    structural_ = cloth_->m_links.size();
    for (int i = 0; i < structural_; ++i)
    {
      rest_.push_back(cloth_->m_links[i].m_rl);
    }
    btSoftBody::Material* const soft = cloth_->appendMaterial();
    soft->m_kLST = BEND_SHEAR;
    for (const Edge& edge : edges)
    {
      if (edge.opposite.size() == 2)
      {
        cloth_->appendLink(edge.opposite[0], edge.opposite[1], soft);
      }
    }
  }

  void setMasses(const Scene& scene)
  {
    std::vector<double> mass(particles(), 0.0);
    for (const cloth::ModelTriangle& face : scene.model.triangles)
    {
      const cloth::Vec3d& x = scene.model.positions[face.vertices[0]];
      const cloth::Vec3d a = scene.model.positions[face.vertices[1]] - x;
      const cloth::Vec3d b = scene.model.positions[face.vertices[2]] - x;
      for (int vertex : face.vertices)
      {
        mass[vertex] += scene.material.areal_density * 0.5 * a.cross(b).norm() / 3.0;
      }
    }
    for (int i = 0; i < particles(); ++i)
    {
      cloth_->setMass(i, static_cast<btScalar>(mass[i]));
    }
    for (int i : scene.pinned)
    {
      cloth_->setMass(i, 0.0F);
    }
  }

  void configure(const Scene& scene)
  {
    btSoftBody::Config& config = cloth_->m_cfg;
    config.piterations = 1;  // many short steps of one sweep, as the others
    config.kDP = static_cast<btScalar>(scene.environment.air_friction * time_step_);
    if (scene.environment.wind_drag > 0.0)
    {
      config.aeromodel = btSoftBody::eAeroModel::F_TwoSided;
      config.kDG = DRAG;
      cloth_->setWindVelocity(toBullet(scene.environment.wind));
    }
    cloth_->setActivationState(DISABLE_DEACTIVATION);
  }

  void addBall(const Ball& ball)
  {
    ball_shape_ = std::make_unique<btSphereShape>(static_cast<btScalar>(ball.radius));
    btTransform place(btQuaternion::getIdentity(), toBullet(ball.center));
    ball_motion_ = std::make_unique<btDefaultMotionState>(place);
    ball_ = std::make_unique<btRigidBody>(0.0F, ball_motion_.get(), ball_shape_.get());
    world_.addRigidBody(ball_.get());
  }

  double time_step_;  ///< [s]
  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btSoftRigidDynamicsWorld world_;
  std::unique_ptr<btCollisionShape> ball_shape_;
  std::unique_ptr<btMotionState> ball_motion_;
  std::unique_ptr<btRigidBody> ball_;
  std::unique_ptr<btSoftBody> cloth_;
  std::vector<double> rest_;  ///< of structural links [m]
  int structural_ = 0;        ///< links; bend-shear ones follow
};

}  // namespace

std::unique_ptr<Engine> makeBulletEngine(const Scene& scene, double time_step)
{
  return std::make_unique<BulletEngine>(scene, time_step);
}

}  // namespace cloth_bench
