// Small cloths drawn by hand, and what the tests of topology ask of any mesh.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/mesh.h"
#include "cloth_tearing/core/mesh_builder.h"
#include "cloth_tearing/core/tearing.h"

namespace cloth
{

using Faces = std::vector<std::array<int, 3>>;

/// A flat sheet in the x-y plane whose texture position is its place.
inline ClothModel flatModel(const std::vector<Vec2d>& places, const Faces& faces)
{
  ClothModel model;
  for (const Vec2d& place : places)
  {
    model.positions.emplace_back(place.x(), place.y(), 0.0);
  }
  for (const auto& face : faces)
  {
    model.triangles.push_back({ face, { places[face[0]], places[face[1]], places[face[2]] } });
  }
  return model;
}

inline Mesh meshOf(const ClothModel& model)
{
  return Mesh(static_cast<int>(model.positions.size()), model.triangles);
}

/// A point at `degrees` from the x axis, counter-clockwise.
inline Vec2d polar(double radius, double degrees)
{
  const double angle = degrees * M_PI / 180.0;
  return { radius * std::cos(angle), radius * std::sin(angle) };
}

/// One triangle.
///
///        2
///       / \.
///      0---1
inline ClothModel singleTriangle()
{
  return flatModel({ { 0, 0 }, { 2, 0 }, { 0.8, 1.5 } }, { { 0, 1, 2 } });
}

/// Two triangles on both sides of the spring between 0 and 1, as in figure 3.8.
///
///        2
///       / \.
///      0---1
///       \ /
///        3
inline ClothModel kite()
{
  return flatModel({ { -1, 0 }, { 1, 0 }, { 0, 1 }, { 0, -1 } }, { { 0, 1, 2 }, { 1, 0, 3 } });
}

/// A closed fan: `spokes` triangles around hub 0, rim 1 to `spokes` counter-clockwise from +x.
inline ClothModel wheel(int spokes)
{
  std::vector<Vec2d> places = { { 0, 0 } };
  Faces faces;
  for (int i = 0; i < spokes; ++i)
  {
    places.push_back(polar(1.0, 360.0 * i / spokes));
    faces.push_back({ 0, 1 + i, 1 + (i + 1) % spokes });
  }
  return flatModel(places, faces);
}

/// An open fan: triangles around hub 0 with springs to rim 1, 2, ... at these angles [degrees].
inline ClothModel openFan(const std::vector<double>& degrees)
{
  std::vector<Vec2d> places = { { 0, 0 } };
  Faces faces;
  for (std::size_t i = 0; i < degrees.size(); ++i)
  {
    places.push_back(polar(1.0, degrees[i]));
    if (i > 0)
    {
      faces.push_back({ 0, static_cast<int>(i), static_cast<int>(i) + 1 });
    }
  }
  return flatModel(places, faces);
}

/// A one-point connection: `fans` fans of `each` triangles that touch in particle 0 alone.
///
///      3       2       two fans of one triangle each
///      | \   / |
///      |   0   |
///      | /   \ |
///      4       1
inline ClothModel bowTie(int fans, int each)
{
  std::vector<Vec2d> places = { { 0, 0 } };
  Faces faces;
  for (int fan = 0; fan < fans; ++fan)
  {
    for (int i = 0; i <= each; ++i)
    {
      const double share = (fan + 0.7 * i / each) / fans;
      places.push_back(polar(1.0, 360.0 * share));
      const int last = static_cast<int>(places.size()) - 1;
      if (i > 0)
      {
        faces.push_back({ 0, last - 1, last });
      }
    }
  }
  return flatModel(places, faces);
}

/// A closed fan of six and an open one of two that touch in particle 0.
inline ClothModel wheelOnAPoint()
{
  ClothModel model = wheel(6);
  const std::vector<Vec2d> places = { { 1.0, 3.0 }, { 0.0, 3.2 }, { -1.0, 3.0 } };
  for (const Vec2d& place : places)
  {
    model.positions.emplace_back(place.x(), place.y(), 0.5);
  }
  model.triangles.push_back({ { 0, 7, 8 }, { Vec2d(0, 0), places[0], places[1] } });
  model.triangles.push_back({ { 0, 8, 9 }, { Vec2d(0, 0), places[1], places[2] } });
  return model;
}

/// Both models, the second moved by `shift` along x; its particles are numbered after the first's.
inline ClothModel beside(ClothModel first, const ClothModel& second, double shift)
{
  const int offset = static_cast<int>(first.positions.size());
  for (const Vec3d& place : second.positions)
  {
    first.positions.push_back(place + Vec3d(shift, 0, 0));
  }
  for (ModelTriangle t : second.triangles)
  {
    for (int& vertex : t.vertices)
    {
      vertex += offset;
    }
    first.triangles.push_back(t);
  }
  return first;
}

/// A square sheet of `side` [m], hanging from y = 0.
inline ClothModel sheet(int columns, int rows, RectanglePattern pattern, double side = 1.0,
                        std::uint64_t seed = 1)
{
  RectangleParams params;
  params.width = side;
  params.height = side;
  params.columns = columns;
  params.rows = rows;
  params.pattern = pattern;
  params.seed = seed;
  return rectangle(params);
}

struct NamedModel
{
  std::string name;
  ClothModel model;
};

/// Every configuration that an edit can meet.
inline std::vector<NamedModel> everyConfiguration()
{
  return { { "single triangle", singleTriangle() },
           { "kite", kite() },
           { "closed fan of three", wheel(3) },
           { "closed fan of six", wheel(6) },
           { "open fan of five", openFan({ 0, 40, 90, 120, 170, 230 }) },
           { "bow-tie of two triangles", bowTie(2, 1) },
           { "bow-tie of three fans", bowTie(3, 2) },
           { "bow-tie of four fans", bowTie(4, 3) },
           { "closed fan on a point", wheelOnAPoint() },
           { "one-diagonal grid", sheet(4, 4, RectanglePattern::ONE_DIAGONAL) },
           { "alternating grid", sheet(4, 5, RectanglePattern::ALTERNATING) },
           { "irregular mesh", sheet(6, 6, RectanglePattern::IRREGULAR) } };
}

/// Passes if `mesh` has no defect; prints them all otherwise.
inline testing::AssertionResult isSound(const Mesh& mesh)
{
  testing::AssertionResult result = testing::AssertionSuccess();
  const std::vector<std::string> found = defects(mesh);
  if (!found.empty())
  {
    result = testing::AssertionFailure();
    for (const std::string& defect : found)
    {
      result << defect << "\n";
    }
  }
  return result;
}

/// The spring between two particles; none if there is none.
inline SpringId springBetween(const Mesh& mesh, ParticleId a, ParticleId b)
{
  for (int i = 0; i < mesh.springCount(); ++i)
  {
    if (mesh.spring({ i }).joins(a) && mesh.spring({ i }).joins(b))
    {
      return { i };
    }
  }
  return {};
}

inline SpringId springBetween(const Mesh& mesh, int a, int b)
{
  return springBetween(mesh, ParticleId{ a }, ParticleId{ b });
}

/// How many of each element there are.
struct Counts
{
  int particles = 0;
  int springs = 0;
  int triangles = 0;

  friend bool operator==(const Counts& a, const Counts& b)
  {
    return a.particles == b.particles && a.springs == b.springs && a.triangles == b.triangles;
  }
  friend Counts operator-(const Counts& a, const Counts& b)
  {
    return { a.particles - b.particles, a.springs - b.springs, a.triangles - b.triangles };
  }
  friend std::ostream& operator<<(std::ostream& out, const Counts& c)
  {
    return out << c.particles << " particles, " << c.springs << " springs, " << c.triangles
               << " triangles";
  }
};

inline Counts countsOf(const Mesh& mesh)
{
  return { mesh.particleCount(), mesh.springCount(), mesh.triangleCount() };
}

/// Whether two meshes are the same, ids, order and texture included.
inline testing::AssertionResult isSame(const Mesh& a, const Mesh& b)
{
  if (!(countsOf(a) == countsOf(b)))
  {
    return testing::AssertionFailure() << countsOf(a) << " against " << countsOf(b);
  }
  for (int i = 0; i < a.springCount(); ++i)
  {
    const Spring& one = a.spring({ i });
    const Spring& other = b.spring({ i });
    if (one.particles != other.particles || one.triangles != other.triangles)
    {
      return testing::AssertionFailure() << "spring " << i << " differs";
    }
  }
  for (int i = 0; i < a.triangleCount(); ++i)
  {
    const Triangle& one = a.triangle({ i });
    const Triangle& other = b.triangle({ i });
    if (one.particles != other.particles || one.springs != other.springs || one.uv != other.uv)
    {
      return testing::AssertionFailure() << "triangle " << i << " differs";
    }
  }
  for (int i = 0; i < a.particleCount(); ++i)
  {
    if (a.trianglesAt({ i }) != b.trianglesAt({ i }))
    {
      return testing::AssertionFailure() << "the triangles at particle " << i << " differ";
    }
  }
  return testing::AssertionSuccess();
}

/// Whether `touched` holds every triangle whose corners, springs or neighbours differ.
inline testing::AssertionResult touchesAllThatChanged(const Mesh& before, const Mesh& after,
                                                      const std::vector<TriangleId>& touched)
{
  const std::set<TriangleId> listed(touched.begin(), touched.end());
  if (listed.size() != touched.size())
  {
    return testing::AssertionFailure() << "a touched triangle is listed twice";
  }
  for (int i = 0; i < after.triangleCount(); ++i)
  {
    const TriangleId t{ i };
    bool changed = i >= before.triangleCount();
    if (!changed)
    {
      const Triangle& now = after.triangle(t);
      const Triangle& then = before.triangle(t);
      changed = now.particles != then.particles || now.springs != then.springs;
    }
    if (changed && listed.count(t) == 0)
    {
      return testing::AssertionFailure() << "triangle " << i << " changed and is not listed";
    }
  }
  return testing::AssertionSuccess();
}

inline double uvArea(const Triangle& t)
{
  const Vec2d u = t.uv[1] - t.uv[0];
  const Vec2d v = t.uv[2] - t.uv[0];
  return 0.5 * (u.x() * v.y() - u.y() * v.x());
}

inline double uvArea(const Mesh& mesh)
{
  double area = 0.0;
  for (int i = 0; i < mesh.triangleCount(); ++i)
  {
    area += uvArea(mesh.triangle({ i }));
  }
  return area;
}

inline double sumOf(const std::vector<double>& values)
{
  double sum = 0.0;
  for (double value : values)
  {
    sum += value;
  }
  return sum;
}

/// The cloth of a model, lengths as imported.
inline Cloth clothOf(const ClothModel& model, const std::vector<int>& pinned = {})
{
  return makeCloth(model, pinned, Material{}, RestShapeSource::IMPORTED, 0.0);
}

/// Moves a particle to `factor` times its place: its springs to particles at the origin stretch by
/// that.
inline void pullOut(Cloth& cloth, int particle, double factor)
{
  cloth.state.position[particle] *= static_cast<Real>(factor);
}

/// What one pass of tearing did.
struct Pass
{
  std::vector<TearEvent> tears;
  int postponed = 0;
  double max_strain = 0.0;
};

/// One step's tearing, without obstacles.
inline Pass tearOnce(Cloth& cloth, Tearing& tearing, std::vector<Grasp>& grasps)
{
  Pass pass;
  pass.max_strain = tearing.scan(cloth);
  pass.tears = tearing.tear(
      cloth, grasps, [](const Vec3&) { return false; }, pass.postponed);
  return pass;
}

inline Pass tearOnce(Cloth& cloth, const TearRules& rules)
{
  Tearing tearing(rules);
  std::vector<Grasp> grasps;
  return tearOnce(cloth, tearing, grasps);
}

/// The thesis to the letter: a spring tears on its own strain, without crack band or hem.
inline TearRules rulesOfTheThesis()
{
  TearRules rules;
  rules.tear_strain = 0.5;
  rules.weak_tear_strain = 0.25;
  rules.one_point_tear_strain = 0.25;
  rules.tear_radius = 0.0;
  rules.crack_length = 0.0;
  rules.hem_factor = 1.0;
  rules.min_length = 0.05;
  rules.min_altitude = 0.02;
  return rules;
}

}  // namespace cloth
