// Draws the scatter and lays the map over the springs.
#include "cloth_tearing/core/strength.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/point_grid.h"
#include "cloth_tearing/core/refusal.h"

namespace cloth
{
namespace
{

/// Regular meshes have springs exactly at the end of a round width: they count as touched, and
/// rounding, as by the rotation of a model, is not to decide it. As a part of the width or pitch.
constexpr double TOLERANCE = 1e-9;

constexpr std::size_t MOST_ENTRIES = 1000;  // each is compared with every spring

using Spot = StrengthParams::Spot;
using Line = StrengthParams::Line;
using Perforation = StrengthParams::Perforation;

/// A straight piece of line in space [m]; may be a point.
struct Segment
{
  Vec3d from;
  Vec3d to;

  Vec3d along() const { return to - from; }
};

/// Where on `segment` it is nearest to `place`: 0 at its beginning, 1 at its end.
double nearestFraction(const Segment& segment, const Vec3d& place)
{
  const Vec3d along = segment.along();
  const double squared_length = along.squaredNorm();
  return squared_length > 0.0
             ? std::clamp((place - segment.from).dot(along) / squared_length, 0.0, 1.0)
             : 0.0;
}

double squaredDistance(const Segment& segment, const Vec3d& place)
{
  const double fraction = nearestFraction(segment, place);
  return (segment.from + fraction * segment.along() - place).squaredNorm();
}

/// Two pieces of line are nearest where one of them ends, or where they cross in the view along
/// their common perpendicular.
double squaredDistance(const Segment& one, const Segment& other)
{
  double least = std::min({ squaredDistance(one, other.from), squaredDistance(one, other.to),
                            squaredDistance(other, one.from), squaredDistance(other, one.to) });
  const Vec3d normal = one.along().cross(other.along());
  const double denominator = normal.squaredNorm();
  if (denominator > 0.0)
  {
    const Vec3d between = other.from - one.from;
    const double s = between.cross(other.along()).dot(normal) / denominator;
    const double t = between.cross(one.along()).dot(normal) / denominator;
    if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0)
    {
      least = std::min(least, (between + t * other.along() - s * one.along()).squaredNorm());
    }
  }
  return least;
}

bool within(double squared_distance, double reach)
{
  return squared_distance <= reach * reach * (1.0 + TOLERANCE);
}

bool touches(const Spot& spot, const Segment& spring)
{
  return within(squaredDistance(spring, spot.center), spot.radius);
}

bool touches(const Line& line, const Segment& spring)
{
  return within(squaredDistance({ line.from, line.to }, spring), 0.5 * line.width);
}

bool touches(const Perforation& perforation, const Segment& spring)
{
  const Segment line{ perforation.line.from, perforation.line.to };
  if (!touches(perforation.line, spring))
  {
    return false;
  }
  const double pitches_of_line = line.along().norm() / perforation.pitch;
  const double place = nearestFraction(line, 0.5 * (spring.from + spring.to)) * pitches_of_line;
  const double pitches = std::min(place + TOLERANCE, pitches_of_line - TOLERANCE);
  return pitches - std::floor(pitches) < perforation.duty;
}

double factorOf(const Spot& spot)
{
  return spot.factor;
}
double factorOf(const Line& line)
{
  return line.factor;
}
double factorOf(const Perforation& perforation)
{
  return perforation.line.factor;
}

/// Multiplies the strengths of the springs that each entry touches.
template <class Entry>
void lay(const std::vector<Entry>& entries, const std::string& name,
         const std::vector<Segment>& springs, std::vector<double>& strengths,
         std::vector<std::string>& found)
{
  for (std::size_t i = 0; i < entries.size(); ++i)
  {
    bool any = false;
    for (std::size_t s = 0; s < springs.size(); ++s)
    {
      if (touches(entries[i], springs[s]))
      {
        strengths[s] *= factorOf(entries[i]);
        any = true;
      }
    }
    if (!any)
    {
      found.push_back("strength " + name + "[" + std::to_string(i) +
                      "] touches no spring of the model: move it, make it larger, or take a finer "
                      "mesh");
    }
  }
}

void hemBorders(const Mesh& mesh, const std::vector<Vec3d>& positions, const StrengthParams& params,
                std::vector<double>& strengths)
{
  std::vector<int> border;
  for (int i = 0; i < mesh.springCount(); ++i)
  {
    const Spring& spring = mesh.spring({ i });
    if (spring.border())
    {
      border.push_back(spring.particles[0].index);
      border.push_back(spring.particles[1].index);
    }
  }
  const std::vector<char> hem = positionsNear(positions, border, params.border_width);
  for (int i = 0; i < mesh.springCount(); ++i)
  {
    const auto& ends = mesh.spring({ i }).particles;
    if (hem[ends[0].index] || hem[ends[1].index])
    {
      strengths[i] *= params.border_factor;
    }
  }
}

/// From 0 up to, not including, 1. Our own mapping: the library's differs between libraries.
double uniform(std::mt19937_64& random)
{
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

void scatter(const StrengthParams& params, std::vector<double>& strengths)
{
  std::mt19937_64 random(params.seed);
  for (double& strength : strengths)
  {
    const double first = uniform(random);
    strength *= 1.0 + params.scatter * (first + uniform(random) - 1.0);
  }
}

void checkFactor(std::vector<std::string>& found, const std::string& name, double factor)
{
  check(found, name + " [-]", factor, Range::between(LEAST_STRENGTH, MOST_STRENGTH));
}

void checkEntry(std::vector<std::string>& found, const std::string& name, const Spot& spot)
{
  check(found, name + " center [m]", spot.center, MAX_COORDINATE);
  check(found, name + " radius [m]", spot.radius, Range::aboveUpTo(0.0, MAX_COORDINATE));
  checkFactor(found, name + " factor", spot.factor);
}

void checkEntry(std::vector<std::string>& found, const std::string& name, const Line& line)
{
  check(found, name + " begin [m]", line.from, MAX_COORDINATE);
  check(found, name + " end [m]", line.to, MAX_COORDINATE);
  if (line.from == line.to)
  {
    found.push_back(name + " begins and ends at the same place, must have a length");
  }
  check(found, name + " width [m]", line.width, Range::aboveUpTo(0.0, MAX_COORDINATE));
  checkFactor(found, name + " factor", line.factor);
}

void checkEntry(std::vector<std::string>& found, const std::string& name,
                const Perforation& perforation)
{
  checkEntry(found, name, perforation.line);
  check(found, name + " pitch [m]", perforation.pitch, Range::between(1e-6, MAX_COORDINATE));
  check(found, name + " duty [-]", perforation.duty, Range::aboveUpTo(0.0, 1.0));
}

template <class Entry>
void checkEntries(std::vector<std::string>& found, const std::string& name,
                  const std::vector<Entry>& entries)
{
  if (entries.size() > MOST_ENTRIES)
  {
    found.push_back(name + " has " + std::to_string(entries.size()) + " entries, must be at most " +
                    std::to_string(MOST_ENTRIES));
  }
  for (std::size_t i = 0; i < std::min(entries.size(), MOST_ENTRIES); ++i)
  {
    checkEntry(found, name + "[" + std::to_string(i) + "]", entries[i]);
  }
}

}  // namespace

std::vector<std::string> problems(const StrengthParams& params)
{
  std::vector<std::string> found;
  check(found, "scatter [-]", params.scatter, Range::between(0.0, 0.9));
  checkEntries(found, "spots", params.spots);
  checkEntries(found, "lines", params.lines);
  checkEntries(found, "perforations", params.perforations);
  checkFactor(found, "border_factor", params.border_factor);
  check(found, "border_width [m]", params.border_width, Range::between(0.0, 100.0));
  return found;
}

StrengthParams turned(StrengthParams params, const Quatd& rotation)
{
  const auto turn = [&](Line& line)
  {
    line.from = rotation * line.from;
    line.to = rotation * line.to;
  };
  for (Spot& spot : params.spots)
  {
    spot.center = rotation * spot.center;
  }
  for (Line& line : params.lines)
  {
    turn(line);
  }
  for (Perforation& perforation : params.perforations)
  {
    turn(perforation.line);
  }
  return params;
}

std::vector<double> springStrengths(const Mesh& mesh, const std::vector<Vec3d>& positions,
                                    const StrengthParams& params)
{
  std::vector<Segment> springs;
  springs.reserve(mesh.springCount());
  for (int i = 0; i < mesh.springCount(); ++i)
  {
    const auto& ends = mesh.spring({ i }).particles;
    springs.push_back({ positions[ends[0].index], positions[ends[1].index] });
  }
  std::vector<double> strengths(springs.size(), 1.0);
  std::vector<std::string> found;
  lay(params.spots, "spots", springs, strengths, found);
  lay(params.lines, "lines", springs, strengths, found);
  lay(params.perforations, "perforations", springs, strengths, found);
  refuseIf(found);
  if (params.border_factor != 1.0)
  {
    hemBorders(mesh, positions, params, strengths);
  }
  if (params.scatter > 0.0)
  {
    scatter(params, strengths);
  }
  for (double& strength : strengths)
  {
    strength = std::clamp(strength, LEAST_STRENGTH, MOST_STRENGTH);
  }
  return strengths;
}

void followStrengths(std::vector<double>& strengths, const Mesh& mesh, const Edit& edit)
{
  for (const auto& added : edit.springs)
  {
    if (added.parent.valid())
    {
      strengths.push_back(strengths[added.parent.index]);
    }
  }
  for (const auto& halved : edit.triangles)
  {
    const double torn = strengths[edit.springs.front().parent.index];
    const double near = strengths[edit.outerSide(mesh.triangle(halved.parent)).index];
    const double far = strengths[edit.outerSide(mesh.triangle(halved.id)).index];
    strengths.insert(strengths.end(), 2, (torn + near + far) / 3.0);
  }
}

}  // namespace cloth
