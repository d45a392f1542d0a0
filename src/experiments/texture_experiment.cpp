// Tears, puts back, and compares texture point by point.
#include "cloth_tearing/experiments/texture_experiment.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "cloth_tearing/experiments/pull.h"

namespace cloth
{
namespace
{

constexpr int POINTS = 10000;
constexpr double LARGEST_DEVIATION = 1e-6;     ///< [-]
constexpr double LARGEST_AREA_CHANGE = 1e-12;  ///< [-]

/// A point counts as covered this far off a triangle, in parts of the triangle: rounding [-].
constexpr double EDGE = 1e-9;

constexpr int PULLS = 8;
constexpr double PULL_TIME = 0.35;    ///< [s]
constexpr double PULL_SPEED = 4.0;    ///< [m/s]
constexpr double PULL_RADIUS = 0.25;  ///< [m]
constexpr double WAY_HOME = 1.5;      ///< the cloth is put back in so long [s]
constexpr double STAY = 1.0;          ///< and shown so long [s]

/// A place on the cloth and what it shows there.
struct Point
{
  Vec3d place;
  Vec2d uv;
};

double cross(const Vec2d& a, const Vec2d& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

double areaOf(const TexturedTriangle& t)
{
  return 0.5 * (t.corners[1] - t.corners[0]).cross(t.corners[2] - t.corners[0]).norm();
}

double textureAreaOf(const TexturedTriangle& t)
{
  return 0.5 * cross(t.uv[1] - t.uv[0], t.uv[2] - t.uv[0]);
}

double textureArea(const std::vector<TexturedTriangle>& triangles)
{
  double sum = 0.0;
  for (const TexturedTriangle& t : triangles)
  {
    sum += textureAreaOf(t);
  }
  return sum;
}

template <class Value>
Value blend(const std::array<Value, 3>& corners, const std::array<double, 3>& weights)
{
  return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

/// Points spread evenly over the area of a cloth.
class Sampler
{
public:
  Sampler(const std::vector<TexturedTriangle>& triangles, std::uint64_t seed)
      : triangles_(triangles), random_(seed)
  {
    for (const TexturedTriangle& t : triangles)
    {
      area_up_to_.push_back((area_up_to_.empty() ? 0.0 : area_up_to_.back()) + areaOf(t));
    }
  }

  Point next()
  {
    const auto found =
        std::upper_bound(area_up_to_.begin(), area_up_to_.end(), fraction() * area_up_to_.back());
    const auto index = std::min<std::size_t>(found - area_up_to_.begin(), area_up_to_.size() - 1);
    double a = fraction();
    double b = fraction();
    if (a + b > 1.0)
    {
      a = 1.0 - a;
      b = 1.0 - b;
    }
    const std::array<double, 3> weights = { 1.0 - a - b, a, b };
    return { blend(triangles_[index].corners, weights), blend(triangles_[index].uv, weights) };
  }

private:
  /// From 0 to below 1.
  double fraction() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  const std::vector<TexturedTriangle>& triangles_;
  std::mt19937_64 random_;
  std::vector<double> area_up_to_;
};

/// Answers which triangles cover a place.
class Cover
{
public:
  explicit Cover(const std::vector<TexturedTriangle>& triangles) : triangles_(triangles)
  {
    for (const TexturedTriangle& t : triangles)
    {
      const double margin = EDGE * std::sqrt(areaOf(t));
      low_.push_back(t.corners[0].cwiseMin(t.corners[1]).cwiseMin(t.corners[2]).array() - margin);
      high_.push_back(t.corners[0].cwiseMax(t.corners[1]).cwiseMax(t.corners[2]).array() + margin);
    }
  }

  /// What is to be seen at `place`, of every triangle there.
  std::vector<Vec2d> at(const Vec3d& place) const
  {
    std::vector<Vec2d> seen;
    for (std::size_t i = 0; i < triangles_.size(); ++i)
    {
      const bool near =
          (place.array() >= low_[i].array()).all() && (place.array() <= high_[i].array()).all();
      std::array<double, 3> weights;
      if (near && covers(triangles_[i], place, weights))
      {
        seen.push_back(blend(triangles_[i].uv, weights));
      }
    }
    return seen;
  }

private:
  static bool covers(const TexturedTriangle& t, const Vec3d& place, std::array<double, 3>& weights)
  {
    const Vec3d normal = (t.corners[1] - t.corners[0]).cross(t.corners[2] - t.corners[0]);
    const double squared = normal.squaredNorm();  // of twice the area
    for (int k = 0; k < 3; ++k)
    {
      const Vec3d& from = t.corners[(k + 1) % 3];
      const Vec3d& to = t.corners[(k + 2) % 3];
      weights[k] = normal.dot((to - from).cross(place - from)) / squared;
    }
    const double off = std::abs(normal.dot(place - t.corners[0]));  // times twice the area
    return *std::min_element(weights.begin(), weights.end()) >= -EDGE &&
           off <= EDGE * std::pow(squared, 0.75);
  }

  const std::vector<TexturedTriangle>& triangles_;
  std::vector<Vec3d> low_;
  std::vector<Vec3d> high_;
};

std::vector<TexturedTriangle> texturedTriangles(const Mesh& mesh, const std::vector<Vec3d>& places)
{
  std::vector<TexturedTriangle> triangles;
  for (int i = 0; i < mesh.triangleCount(); ++i)
  {
    const Triangle& t = mesh.triangle({ i });
    const auto& p = t.particles;
    triangles.push_back({ { places[p[0].index], places[p[1].index], places[p[2].index] }, t.uv });
  }
  return triangles;
}

std::vector<Vec3d> places(const Cloth& cloth)
{
  std::vector<Vec3d> places;
  for (const Vec3& x : cloth.state.position)
  {
    places.push_back(x.cast<double>());
  }
  return places;
}

/// From the lower part up, all over the width, to the front and to either side in turn.
Pull pullAt(int number)
{
  const double across = 0.2 + 0.6180339887498949 * number;
  Pull pull;
  pull.place = Vec2d(across - std::floor(across), 0.1 + 0.7 * number / PULLS);
  pull.way = PULL_SPEED * PULL_TIME * Vec3d(number % 2 == 0 ? -1.0 : 1.0, -1.0, -1.0).normalized();
  pull.speed = PULL_SPEED;
  pull.radius = PULL_RADIUS;
  return pull;
}

}  // namespace

std::vector<TexturedTriangle> texturedTriangles(const Cloth& cloth)
{
  return texturedTriangles(cloth.mesh, places(cloth));
}

std::vector<Vec3d> homes(const Cloth& torn, const Cloth& untorn)
{
  std::vector<Vec3d> home = places(untorn);
  for (std::size_t i = home.size(); i < torn.damage.parents.size(); ++i)
  {
    const auto& [a, b] = torn.damage.parents[i];  // older than i: at home already
    home.push_back(0.5 * (home[a] + home[b]));
  }
  return home;
}

std::vector<TexturedTriangle> putBack(const Cloth& torn, const Cloth& untorn)
{
  return texturedTriangles(torn.mesh, homes(torn, untorn));
}

double TextureFit::areaChange() const
{
  return std::abs(area_after - area_before) / std::abs(area_before);
}

bool TextureFit::fits() const
{
  return uncovered == 0 && covered_twice == 0 && deviation <= LARGEST_DEVIATION &&
         areaChange() <= LARGEST_AREA_CHANGE;
}

TextureFit compareTexture(const std::vector<TexturedTriangle>& untorn,
                          const std::vector<TexturedTriangle>& torn, std::uint64_t seed)
{
  TextureFit fit;
  fit.area_before = textureArea(untorn);
  fit.area_after = textureArea(torn);
  Sampler sampler(untorn, seed);
  const Cover cover(torn);
  for (fit.points = 0; fit.points < POINTS; ++fit.points)
  {
    const Point point = sampler.next();
    const std::vector<Vec2d> seen = cover.at(point.place);
    fit.uncovered += seen.empty() ? 1 : 0;
    fit.covered_twice += seen.size() > 1 ? 1 : 0;
    for (const Vec2d& uv : seen)
    {
      fit.deviation = std::max(fit.deviation, (uv - point.uv).norm());
    }
  }
  return fit;
}

std::vector<TexturedTriangle> withSwappedCorners(std::vector<TexturedTriangle> triangles)
{
  const auto largest = std::max_element(triangles.begin(), triangles.end(),
                                        [](const TexturedTriangle& a, const TexturedTriangle& b)
                                        { return areaOf(a) < areaOf(b); });
  std::swap(largest->uv[0], largest->uv[1]);
  return triangles;
}

void tearBadly(Simulation& simulation, const Watch& watch)
{
  const auto steps = std::lround(PULL_TIME / simulation.params().solver.time_step);
  for (int number = 0; number < PULLS; ++number)
  {
    const std::uint64_t grasp = beginPull(simulation, pullAt(number));
    for (long i = 0; i < steps; ++i)
    {
      const StepReport report = stepOrThrow(simulation);
      if (watch)
      {
        watch(simulation, report);
      }
    }
    simulation.release(grasp);
  }
}

void putBackSlowly(Simulation& simulation, const Cloth& untorn, const Watch& watch)
{
  const std::vector<Vec3d> home = homes(simulation.cloth(), untorn);
  const std::vector<Vec3d> from = places(simulation.cloth());
  const double dt = simulation.params().solver.time_step;
  const auto steps = std::lround((WAY_HOME + STAY) / dt);
  for (long step = 1; step <= steps; ++step)
  {
    const double done = std::min(1.0, step * dt / WAY_HOME);
    std::vector<Vec3> now;
    for (std::size_t i = 0; i < home.size(); ++i)
    {
      now.push_back((from[i] + done * (home[i] - from[i])).cast<Real>());
    }
    simulation.place(now);
    watch(simulation, StepReport());
  }
}

}  // namespace cloth
