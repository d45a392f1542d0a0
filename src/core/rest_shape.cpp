// Rest lengths, areas and masses, from a model or by following an edit.
#include "cloth_tearing/core/rest_shape.h"

#include <algorithm>
#include <cmath>

#include "cloth_tearing/core/refusal.h"

namespace cloth
{
namespace
{

double springLength(const RestShape& rest, const Triangle& t, int side)
{
  return rest.length[t.springs[side].index];
}

double areaOf(const RestShape& rest, const Triangle& t)
{
  return triangleArea(springLength(rest, t, 0), springLength(rest, t, 1), springLength(rest, t, 2));
}

/// Flat distance between the corners opposite `s`; 0 on a border or if they are one particle.
double flatBendLength(const Mesh& mesh, const RestShape& rest, SpringId s)
{
  const Spring& spring = mesh.spring(s);
  if (spring.border() || mesh.opposite(s, 0) == mesh.opposite(s, 1))
  {
    return 0.0;
  }
  std::array<double, 2> at_start{};  // the side that leaves particles[0], in either triangle
  std::array<double, 2> at_end{};
  for (int i = 0; i < 2; ++i)
  {
    const Triangle& t = mesh.triangle(spring.triangles[i]);
    const int side = t.sideOf(s);
    const bool forward = t.particles[side] == spring.particles[0];
    const double after = springLength(rest, t, (side + 1) % 3);
    const double before = springLength(rest, t, (side + 2) % 3);
    at_start[i] = forward ? before : after;
    at_end[i] = forward ? after : before;
  }
  return bendShearLength(rest.length[s.index], at_end[0], at_start[0], at_end[1], at_start[1]);
}

void refreshMass(const Mesh& mesh, RestShape& rest, ParticleId p)
{
  double area = 0.0;
  mesh.forEachTriangleAt(p, [&](TriangleId t) { area += rest.area[t.index]; });
  rest.mass[p.index] = rest.areal_density * area / 3.0;
}

std::vector<double> importedLengths(const Mesh& mesh, const std::vector<Vec3d>& positions)
{
  std::vector<double> lengths;
  lengths.reserve(mesh.springCount());
  for (int i = 0; i < mesh.springCount(); ++i)
  {
    const auto& ends = mesh.spring(SpringId{ i }).particles;
    lengths.push_back((positions[ends[1].index] - positions[ends[0].index]).norm());
  }
  return lengths;
}

/// Lengths on the texture [-]; across a seam the mean of both sides.
std::vector<double> textureLengths(const Mesh& mesh)
{
  std::vector<double> sum(mesh.springCount(), 0.0);
  for (int i = 0; i < mesh.triangleCount(); ++i)
  {
    const Triangle& t = mesh.triangle(TriangleId{ i });
    for (int k = 0; k < 3; ++k)
    {
      const double share = mesh.spring(t.springs[k]).border() ? 1.0 : 0.5;
      sum[t.springs[k].index] += share * (t.uv[(k + 1) % 3] - t.uv[k]).norm();
    }
  }
  return sum;
}

std::vector<double> areas(const Mesh& mesh, const RestShape& rest)
{
  std::vector<double> all;
  all.reserve(mesh.triangleCount());
  for (int i = 0; i < mesh.triangleCount(); ++i)
  {
    all.push_back(areaOf(rest, mesh.triangle(TriangleId{ i })));
  }
  return all;
}

double sum(const std::vector<double>& values)
{
  double total = 0.0;
  for (double v : values)
  {
    total += v;
  }
  return total;
}

/// Scales texture lengths so that the whole has the area of the model.
void takeTextureLengths(const Mesh& mesh, RestShape& rest)
{
  const double modelled = sum(areas(mesh, rest));
  rest.length = textureLengths(mesh);
  const double on_texture = sum(areas(mesh, rest));
  if (!(on_texture > 0.0))
  {
    throw Refusal("rest_shape: the texture layout has no area, so no lengths can be taken from it");
  }
  const double scale = std::sqrt(modelled / on_texture);
  for (double& length : rest.length)
  {
    length *= scale;
  }
}

void refuseDegenerate(const Mesh& mesh, const RestShape& rest)
{
  std::vector<std::string> found;
  for (int i = 0; i < mesh.springCount() && found.size() < 10; ++i)
  {
    if (!(rest.length[i] > 0.0) || !std::isfinite(rest.length[i]))
    {
      const auto& ends = mesh.spring(SpringId{ i }).particles;
      found.push_back("the edge between particles " + std::to_string(ends[0].index) + " and " +
                      std::to_string(ends[1].index) + " has no rest length");
    }
  }
  for (int i = 0; i < mesh.triangleCount() && found.size() < 10; ++i)
  {
    if (!(rest.area[i] > 0.0) || !std::isfinite(rest.area[i]))
    {
      found.push_back("triangle " + std::to_string(i) + " has no rest area");
    }
  }
  refuseIf(found);
}

}  // namespace

double triangleArea(double a, double b, double c)
{
  if (a < b)
  {
    std::swap(a, b);
  }
  if (b < c)
  {
    std::swap(b, c);
  }
  if (a < b)
  {
    std::swap(a, b);
  }
  const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return product > 0.0 ? 0.25 * std::sqrt(product) : 0.0;
}

double medianLength(double a, double b, double c)
{
  return 0.5 * std::sqrt(std::max(0.0, 2.0 * a * a + 2.0 * b * b - c * c));
}

Vec2d apexOnPlane(double e, double from_start, double from_end)
{
  const double x = (e * e + from_start * from_start - from_end * from_end) / (2.0 * e);
  return { x, std::sqrt(std::max(0.0, from_start * from_start - x * x)) };
}

double bendShearLength(double e, double a, double b, double c, double d)
{
  const Vec2d one = apexOnPlane(e, b, a);
  const Vec2d other = apexOnPlane(e, d, c);
  return Vec2d(one.x() - other.x(), one.y() + other.y()).norm();
}

void RestShape::follow(const Mesh& mesh, const Edit& edit)
{
  const bool split = !edit.triangles.empty();
  double whole = 0.0;  // length of the torn spring
  for (const auto& added : edit.springs)
  {
    if (added.parent.valid())
    {
      double& parent = length[added.parent.index];
      whole = parent;
      parent = split ? 0.5 * whole : whole;
      length.push_back(parent);
    }
  }
  for (const auto& halved : edit.triangles)
  {
    area[halved.parent.index] *= 0.5;
    area.push_back(area[halved.parent.index]);
    spacing.push_back(spacing[halved.parent.index]);
    const SpringId near = edit.outerSide(mesh.triangle(halved.parent));
    const SpringId far = edit.outerSide(mesh.triangle(halved.id));
    length.insert(length.end(), 2, medianLength(length[near.index], length[far.index], whole));
  }

  bend_length.resize(length.size(), 0.0);
  mass.resize(mesh.particleCount(), 0.0);
  for (ParticleId p : edit.near_particles)
  {
    refreshMass(mesh, *this, p);
  }
  for (SpringId s : edit.near_springs)
  {
    bend_length[s.index] = flatBendLength(mesh, *this, s);
  }
}

void RestShape::weigh(const Mesh& mesh, double density)
{
  areal_density = density;
  mass.resize(mesh.particleCount());
  for (int i = 0; i < mesh.particleCount(); ++i)
  {
    refreshMass(mesh, *this, ParticleId{ i });
  }
}

RestShape makeRestShape(const Mesh& mesh, const std::vector<Vec3d>& positions,
                        RestShapeSource source, double areal_density)
{
  RestShape rest;
  rest.length = importedLengths(mesh, positions);
  if (source == RestShapeSource::UV)
  {
    takeTextureLengths(mesh, rest);
  }
  rest.area = areas(mesh, rest);
  refuseDegenerate(mesh, rest);

  rest.spacing.reserve(mesh.triangleCount());
  for (int i = 0; i < mesh.triangleCount(); ++i)
  {
    const Triangle& t = mesh.triangle(TriangleId{ i });
    rest.spacing.push_back(
        (springLength(rest, t, 0) + springLength(rest, t, 1) + springLength(rest, t, 2)) / 3.0);
  }
  rest.bend_length.resize(mesh.springCount());
  for (int i = 0; i < mesh.springCount(); ++i)
  {
    rest.bend_length[i] = flatBendLength(mesh, rest, SpringId{ i });
  }
  rest.weigh(mesh, areal_density);
  return rest;
}

}  // namespace cloth
