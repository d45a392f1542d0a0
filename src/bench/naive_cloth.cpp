// Heap objects that point to one another, virtual calls, double precision, one after the other.
#include "naive_cloth.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>

#include "engine.h"

namespace cloth_bench
{
namespace naive
{
namespace
{

constexpr double MAX_RATIO = 1.1;  ///< of a structural spring, length over rest length (2.1.1)

/// Fisher and Yates.
template <class Element>
void shuffle(std::vector<Element>& elements, std::mt19937_64& random)
{
  for (std::size_t i = elements.size(); i > 1; --i)
  {
    std::swap(elements[i - 1], elements[random() % i]);
  }
}

/// Makes each edge of the triangles once.
class SpringMaker
{
public:
  SpringMaker(std::vector<std::unique_ptr<Spring>>& springs, const cloth::Material& material)
      : springs_(springs), material_(material)
  {
  }

  Spring* between(Particle* a, Particle* b, double rest_length)
  {
    Spring*& known = known_[std::minmax(a, b)];
    if (known == nullptr)
    {
      springs_.push_back(std::make_unique<Spring>());
      known = springs_.back().get();
      known->first = a;
      known->second = b;
      known->rest_length = rest_length;
      known->stiffness = material_.stiffness;
      known->damping = material_.damping;
    }
    return known;
  }

private:
  std::vector<std::unique_ptr<Spring>>& springs_;
  const cloth::Material& material_;
  std::map<std::pair<Particle*, Particle*>, Spring*> known_;
};

}  // namespace

void Particle::move(double dt)
{
  if (!pinned)
  {
    velocity += force * (dt / mass);
    position += velocity * dt;
  }
}

void Spring::addForce()
{
  const Vec3d d = second->position - first->position;
  const double length = d.norm();
  if (length > 0.0)
  {
    const Vec3d n = d / length;
    const double speed = (second->velocity - first->velocity).dot(n);
    const Vec3d force = (stiffness * (length - rest_length) + damping * speed) * n;
    first->force += force;
    second->force -= force;
  }
}

void Spring::limit(double ratio)
{
  const Vec3d d = second->position - first->position;
  const double length = d.norm();
  const double longest = ratio * rest_length;
  const int free_ends = (first->pinned ? 0 : 1) + (second->pinned ? 0 : 1);
  if (length <= longest || free_ends == 0)
  {
    return;
  }
  const Vec3d shift = d * ((length - longest) / (length * free_ends));
  if (!first->pinned)
  {
    first->position += shift;
  }
  if (!second->pinned)
  {
    second->position -= shift;
  }
}

double Spring::strain() const
{
  return (second->position - first->position).norm() / rest_length - 1.0;
}

void BendShearSpring::limit(double /*ratio*/)
{
}

void Triangle::addWind(const Vec3d& wind, double drag)
{
  const Vec3d a = corners[1]->position - corners[0]->position;
  const Vec3d b = corners[2]->position - corners[0]->position;
  const Vec3d twice_area = a.cross(b);
  const double size = twice_area.norm();
  if (size > 0.0)
  {
    const Vec3d n = twice_area / size;
    const Vec3d velocity =
        (corners[0]->velocity + corners[1]->velocity + corners[2]->velocity) / 3.0;
    const Vec3d force = n * (drag * 0.5 * size * n.dot(wind - velocity) / 3.0);
    for (Particle* corner : corners)
    {
      corner->force += force;
    }
  }
}

Particle* Triangle::opposite(const Spring& side) const
{
  return *std::find_if(std::begin(corners), std::end(corners),
                       [&](const Particle* corner)
                       { return corner != side.first && corner != side.second; });
}

Cloth::Cloth(const Scene& scene) : environment_(scene.environment), ball_(scene.ball)
{
  build(scene);
  addBendShearSprings(scene.material);
  for (std::size_t i = 0; i < particles_.size(); ++i)
  {
    particles_[i]->position = scene.start[i];
  }
}

void Cloth::build(const Scene& scene)
{
  for (const Vec3d& place : scene.model.positions)
  {
    particles_.push_back(std::make_unique<Particle>());
    particles_.back()->position = place;
  }
  for (int i : scene.pinned)
  {
    particles_[i]->pinned = true;
  }
  SpringMaker maker(springs_, scene.material);
  for (const cloth::ModelTriangle& face : scene.model.triangles)
  {
    triangles_.push_back(std::make_unique<Triangle>());
    Triangle& triangle = *triangles_.back();
    for (int k = 0; k < 3; ++k)
    {
      triangle.corners[k] = particles_[face.vertices[k]].get();
    }
    for (int k = 0; k < 3; ++k)
    {
      Particle* const a = triangle.corners[k];
      Particle* const b = triangle.corners[(k + 1) % 3];
      Spring* const side = maker.between(a, b, (b->position - a->position).norm());
      triangle.sides[k] = side;
      (side->left == nullptr ? side->left : side->right) = &triangle;
    }
    const Vec3d a = triangle.corners[1]->position - triangle.corners[0]->position;
    const Vec3d b = triangle.corners[2]->position - triangle.corners[0]->position;
    for (Particle* corner : triangle.corners)
    {
      corner->mass += scene.material.areal_density * 0.5 * a.cross(b).norm() / 3.0;
    }
  }
}

void Cloth::addBendShearSprings(const cloth::Material& material)
{
  for (const auto& spring : springs_)
  {
    if (spring->right == nullptr)
    {
      continue;
    }
    auto across = std::make_unique<BendShearSpring>();
    across->first = spring->left->opposite(*spring);
    across->second = spring->right->opposite(*spring);
    across->rest_length = (across->second->position - across->first->position).norm();
    across->stiffness = material.bend_shear_stiffness;
    across->damping = 0.2 * material.damping;
    if (across->rest_length > 0.0)
    {
      bend_shear_springs_.push_back(std::move(across));
    }
  }
}

void Cloth::step(double dt)
{
  for (const auto& particle : particles_)
  {
    particle->force =
        particle->mass * (environment_.gravity - environment_.air_friction * particle->velocity);
  }
  if (environment_.wind_drag > 0.0)
  {
    for (const auto& triangle : triangles_)
    {
      triangle->addWind(environment_.wind, environment_.wind_drag);
    }
  }
  for (const auto& spring : springs_)
  {
    spring->addForce();
  }
  for (const auto& spring : bend_shear_springs_)
  {
    spring->addForce();
  }
  for (const auto& particle : particles_)
  {
    particle->move(dt);
  }
  for (const auto& spring : springs_)
  {
    spring->limit(MAX_RATIO);
  }
  if (ball_)
  {
    collide(*ball_);
  }
}

void Cloth::collide(const Ball& ball)
{
  for (const auto& particle : particles_)
  {
    const Vec3d d = particle->position - ball.center;
    const double distance = d.norm();
    if (distance < ball.radius && distance > 0.0 && !particle->pinned)
    {
      const Vec3d n = d / distance;
      particle->position = ball.center + ball.radius * n;
      particle->velocity -= std::min(0.0, particle->velocity.dot(n)) * n;
    }
  }
}

void Cloth::scatter()
{
  std::mt19937_64 random(1);
  shuffle(particles_, random);
  shuffle(springs_, random);
  shuffle(bend_shear_springs_, random);
  shuffle(triangles_, random);
}

}  // namespace naive

namespace
{

class NaiveEngine : public Engine
{
public:
  NaiveEngine(const Scene& scene, double time_step) : cloth_(scene), time_step_(time_step) {}

  void scatter() { cloth_.scatter(); }

  void step() override { cloth_.step(time_step_); }

  int particles() const override { return static_cast<int>(cloth_.particles().size()); }

  std::vector<double> strains() const override
  {
    std::vector<double> strains;
    for (const auto& spring : cloth_.springs())
    {
      strains.push_back(spring->strain());
    }
    return strains;
  }

  double fastest() const override
  {
    double fastest = 0.0;
    for (const auto& particle : cloth_.particles())
    {
      const double speed = particle->velocity.norm();
      fastest = speed <= fastest ? fastest : speed;  // a NaN stays
    }
    return fastest;
  }

private:
  naive::Cloth cloth_;
  double time_step_;  ///< [s]
};

}  // namespace

std::unique_ptr<Engine> makeNaiveEngine(EngineKind kind, const Scene& scene, double time_step)
{
  auto engine = std::make_unique<NaiveEngine>(scene, time_step);
  if (kind == EngineKind::NAIVE_SCATTERED)
  {
    engine->scatter();
  }
  return engine;
}

}  // namespace cloth_bench
