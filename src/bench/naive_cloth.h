// The reference: cloth as one writes it from the thesis' chapters 2 and 3, without a thought of
// speed.
#pragma once

#include <memory>
#include <vector>

#include "scene.h"

namespace cloth_bench
{
namespace naive
{

using cloth::Vec3d;

class Triangle;

/// A mass point. Knows what it is pulled by only through its sum of forces.
class Particle
{
public:
  Vec3d position = Vec3d::Zero();  ///< [m]
  Vec3d velocity = Vec3d::Zero();  ///< [m/s]
  Vec3d force = Vec3d::Zero();     ///< [N]
  double mass = 0.0;               ///< [kg]
  bool pinned = false;

  /// Symplectic Euler.
  void move(double dt);
};

/// A spring between two particles; the edge of one or two triangles (2.1.1, 3.1).
class Spring
{
public:
  Particle* first = nullptr;
  Particle* second = nullptr;
  Triangle* left = nullptr;
  Triangle* right = nullptr;
  double rest_length = 0.0;  ///< [m]
  double stiffness = 0.0;    ///< [N/m]
  double damping = 0.0;      ///< [N s/m]

  virtual ~Spring() = default;
  virtual void addForce();

  /// Draws the ends together if they are farther apart than `ratio` rest lengths (Provot 1995).
  virtual void limit(double ratio);

  double strain() const;
};

/// Joins the corners opposite an interior spring (3.1.2). It may stretch as far as it likes.
class BendShearSpring : public Spring
{
public:
  void limit(double ratio) override;
};

/// A face.
class Triangle
{
public:
  Particle* corners[3] = {};
  Spring* sides[3] = {};

  /// Wind along the normal, in proportion to area and normal speed.
  void addWind(const Vec3d& wind, double drag);

  Particle* opposite(const Spring& side) const;
};

/// The cloth with all that acts on it. Nothing of it tears.
class Cloth
{
public:
  explicit Cloth(const Scene& scene);

  void step(double dt);

  /// Goes through its objects in random order from now on.
  void scatter();

  const std::vector<std::unique_ptr<Particle>>& particles() const { return particles_; }
  const std::vector<std::unique_ptr<Spring>>& springs() const { return springs_; }

private:
  void build(const Scene& scene);
  void addBendShearSprings(const cloth::Material& material);
  void collide(const Ball& ball);

  std::vector<std::unique_ptr<Particle>> particles_;
  std::vector<std::unique_ptr<Spring>> springs_;
  std::vector<std::unique_ptr<Spring>> bend_shear_springs_;
  std::vector<std::unique_ptr<Triangle>> triangles_;
  cloth::Environment environment_;
  std::optional<Ball> ball_;
};

}  // namespace naive
}  // namespace cloth_bench
