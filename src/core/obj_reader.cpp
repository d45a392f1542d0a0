// The way from an OBJ file to a sound model, step by step.
#include "cloth_tearing/core/obj_reader.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/mesh.h"
#include "cloth_tearing/core/obj_parser.h"
#include "cloth_tearing/core/polygon.h"
#include "cloth_tearing/core/triangle_soup.h"
#include "cloth_tearing/core/vertex_joiner.h"

namespace cloth
{
namespace
{

constexpr double ZERO = 1e-6;      // of the diagonal of the box around the faces
constexpr double MIN_SIZE = 1e-6;  // of that diagonal [m]
constexpr double FLAT_UV = 1e-12;  // of the square of the longest texture side

struct Box
{
  Vec3d lowest = Vec3d::Constant(std::numeric_limits<double>::infinity());
  Vec3d highest = -lowest;

  void add(const Vec3d& place)
  {
    lowest = lowest.cwiseMin(place);
    highest = highest.cwiseMax(place);
  }
  Vec3d size() const { return highest - lowest; }
};

// Makes up texture coordinates by looking at the model from its broad side.
class Projection
{
public:
  explicit Projection(const Box& box) : box_(box)
  {
    const Vec3d size = box.size();
    const int thinnest = size.z() <= std::min(size.x(), size.y()) ? 2
                         : size.x() <= size.y()                   ? 0
                                                                  : 1;
    across_ = thinnest == 0 ? 2 : 0;
    up_ = thinnest == 1 ? 2 : 1;
    extent_ = std::max(size[across_], size[up_]);
  }

  Vec2d operator()(const Vec3d& place) const
  {
    return Vec2d((place[across_] - box_.lowest[across_]) / extent_,
                 (place[up_] - box_.lowest[up_]) / extent_);
  }

private:
  Box box_;
  int across_;
  int up_;
  double extent_;
};

// A face after vertices were joined.
struct Outline
{
  std::vector<int> vertices;
  std::vector<Vec2d> uv;
};

std::pair<int, int> edge(int a, int b)
{
  return std::minmax(a, b);
}

class Importer
{
public:
  Importer(ObjContent content, const std::string& name, const ImportOptions& options)
      : content_(std::move(content)), options_(options), problems_(name), sets_(0)
  {
  }

  ObjImport run()
  {
    report_.vertices = static_cast<int>(content_.positions.size());
    report_.texture_vertices = static_cast<int>(content_.uvs.size());
    report_.faces = static_cast<int>(content_.faces.size());
    report_.findings = content_.ignored;
    scalePositions();
    measure();
    joinVertices();
    cutFaces();
    dropCrowdedFlatTriangles(content_.positions, tolerance_, triangles_, report_);
    findOverlaps(triangles_, problems_);
    problems_.refuseIfAny();
    windAlike(triangles_, report_, problems_);
    problems_.refuseIfAny();
    removeFlatTriangles(content_.positions, tolerance_, triangles_, report_);
    if (triangles_.empty())
    {
      problems_.refuse(0, "no face is left that has an area");
    }
    ObjImport result;
    result.model = compact();
    try
    {
      describe(result.model);
    }
    catch (const TopologyError& error)
    {
      problems_.refuse(0, error.what());
    }
    std::stable_sort(report_.findings.begin(), report_.findings.end(),
                     [](const ImportFinding& a, const ImportFinding& b)
                     { return a.line < b.line; });
    result.report = std::move(report_);
    return result;
  }

private:
  void scalePositions()
  {
    for (std::size_t i = 0; i < content_.positions.size(); ++i)
    {
      Vec3d& place = content_.positions[i];
      place *= options_.scale;
      const double largest = place.cwiseAbs().maxCoeff();
      if (!(largest <= options_.max_coordinate))
      {
        problems_.add(content_.lines[i], "a coordinate of " + text(largest) +
                                             " m, must be at most " +
                                             text(options_.max_coordinate) +
                                             " m: scale it down (--scale, import/scale)");
      }
    }
    problems_.refuseIfAny();
  }

  void measure()
  {
    for (const ObjFace& face : content_.faces)
    {
      for (int i = 0; i < face.corner_count; ++i)
      {
        box_.add(content_.positions[content_.corners[face.first_corner + i].vertex]);
      }
    }
    const double diagonal = box_.size().stableNorm();  // also of a size whose square is 0
    if (!(diagonal >= MIN_SIZE))
    {
      problems_.refuse(0, "the model is " + text(diagonal) + " m across, must be at least " +
                              text(MIN_SIZE) + " m (scale)");
    }
    tolerance_ = ZERO * diagonal;
  }

  void joinVertices()
  {
    refuseRepeatedCorners();
    sets_ = VertexSets(content_.positions.size());
    if (options_.weld_distance > 0)
    {
      weld(content_.positions, content_.lines, options_.weld_distance, sets_, report_);
    }
    if (!collapseShortEdges(content_.positions, content_, tolerance_, sets_, report_))
    {
      problems_.refuse(0, "edges without length cannot be collapsed: each makes another one");
    }
  }

  void refuseRepeatedCorners()
  {
    for (const ObjFace& face : content_.faces)
    {
      std::vector<int> vertices;
      for (int i = 0; i < face.corner_count; ++i)
      {
        vertices.push_back(content_.corners[face.first_corner + i].vertex);
      }
      const int repeated = firstRepeated(vertices);
      if (repeated >= 0)
      {
        problems_.add(face.line,
                      "the face names vertex " + std::to_string(repeated + 1) + " twice");
      }
    }
    problems_.refuseIfAny();
  }

  static int firstRepeated(std::vector<int> vertices)
  {
    std::sort(vertices.begin(), vertices.end());
    const auto twice = std::adjacent_find(vertices.begin(), vertices.end());
    return twice == vertices.end() ? -1 : *twice;
  }

  void cutFaces()
  {
    const Projection projection(box_);
    std::vector<std::pair<Outline, int>> outlines;  // with their lines
    for (const ObjFace& face : content_.faces)
    {
      Outline outline = outlineOf(face, projection);
      if (outline.vertices.size() < 3)
      {
        reportFinding(report_, report_.dropped_faces, face.line,
                      "the face has no area, vertices of it are joined; dropped");
      }
      else if (const int repeated = firstRepeated(outline.vertices); repeated >= 0)
      {
        problems_.add(face.line, "the face touches itself at vertex " +
                                     std::to_string(repeated + 1) +
                                     " since vertices of it were joined");
      }
      else
      {
        outlines.emplace_back(std::move(outline), face.line);
      }
    }
    refuseRepeatedPolygons(outlines);
    noteSides(outlines);
    for (const auto& [outline, line] : outlines)
    {
      cutFace(outline, line);
    }
  }

  // Joined neighbours become one corner.
  Outline outlineOf(const ObjFace& face, const Projection& projection)
  {
    Outline outline;
    if (!face.textured)
    {
      first_untextured_line_ = report_.untextured_faces == 0 ? face.line : first_untextured_line_;
      ++report_.untextured_faces;
    }
    for (int i = 0; i < face.corner_count; ++i)
    {
      const ObjCorner& corner = content_.corners[face.first_corner + i];
      const int vertex = sets_.lowest(corner.vertex);
      if (outline.vertices.empty() || outline.vertices.back() != vertex)
      {
        outline.vertices.push_back(vertex);
        outline.uv.push_back(face.textured ? content_.uvs[corner.texture]
                                           : projection(content_.positions[vertex]));
      }
    }
    while (outline.vertices.size() > 1 && outline.vertices.front() == outline.vertices.back())
    {
      outline.vertices.pop_back();
      outline.uv.pop_back();
    }
    return outline;
  }

  // Two polygons with the same corners; triangles are looked at when all are cut.
  void refuseRepeatedPolygons(const std::vector<std::pair<Outline, int>>& outlines)
  {
    std::map<std::vector<int>, int> seen;
    for (const auto& [outline, line] : outlines)
    {
      if (outline.vertices.size() == 3)
      {
        continue;
      }
      std::vector<int> key = outline.vertices;
      std::sort(key.begin(), key.end());
      const auto [first, is_new] = seen.emplace(std::move(key), line);
      if (!is_new)
      {
        problems_.add(line, "the same face as in line " + std::to_string(first->second) +
                                " again; cloth has one layer with two sides, keep one face");
      }
    }
    problems_.refuseIfAny();
  }

  // Edges of the file: a quad had better not be cut along one of them.
  void noteSides(const std::vector<std::pair<Outline, int>>& outlines)
  {
    const bool has_quads =
        std::any_of(outlines.begin(), outlines.end(),
                    [](const auto& entry) { return entry.first.vertices.size() == 4; });
    if (!has_quads)
    {
      return;
    }
    for (const auto& entry : outlines)
    {
      const std::vector<int>& v = entry.first.vertices;
      for (std::size_t i = 0; i < v.size(); ++i)
      {
        taken_.insert(edge(v[i], v[(i + 1) % v.size()]));
      }
    }
  }

  void cutFace(const Outline& outline, int line)
  {
    PolygonCut cut;
    cut.triangles = { { 0, 1, 2 } };
    if (outline.vertices.size() > 3)
    {
      cut = cutPolygon(cornersOf(outline), tolerance_);
    }
    if (cut.verdict == PolygonVerdict::CROSSES_ITSELF)
    {
      problems_.add(line, "the polygon crosses or touches itself, seen along its normal");
      return;
    }
    if (cut.verdict == PolygonVerdict::NO_AREA)
    {
      reportFinding(report_, report_.dropped_faces, line,
                    "the polygon has no area, its vertices lie on a line; dropped");
      return;
    }
    if (outline.vertices.size() == 4)
    {
      avoidTakenDiagonal(outline, cut.triangles);
    }
    for (const FlatTriangle& corners : cut.triangles)
    {
      SoupTriangle triangle;
      triangle.line = line;
      for (int k = 0; k < 3; ++k)
      {
        triangle.vertices[k] = outline.vertices[corners[k]];
        triangle.uv[k] = outline.uv[corners[k]];
      }
      triangles_.push_back(triangle);
    }
  }

  std::vector<Vec3d> cornersOf(const Outline& outline) const
  {
    std::vector<Vec3d> corners;
    for (const int vertex : outline.vertices)
    {
      corners.push_back(content_.positions[vertex]);
    }
    return corners;
  }

  // Uses the other diagonal of a quad where an edge already runs along the better one.
  void avoidTakenDiagonal(const Outline& outline, std::vector<FlatTriangle>& triangles)
  {
    const std::vector<int>& v = outline.vertices;
    const FlatTriangle& first = triangles[0];
    const bool from_zero = std::count(first.begin(), first.end(), 0) > 0 &&
                           std::count(first.begin(), first.end(), 2) > 0;
    auto diagonal = from_zero ? edge(v[0], v[2]) : edge(v[1], v[3]);
    const auto other = from_zero ? edge(v[1], v[3]) : edge(v[0], v[2]);
    if (taken_.count(diagonal) > 0 && taken_.count(other) == 0 && isConvex(cornersOf(outline)))
    {
      triangles = from_zero ? std::vector<FlatTriangle>{ { 0, 1, 3 }, { 1, 2, 3 } }
                            : std::vector<FlatTriangle>{ { 0, 1, 2 }, { 0, 2, 3 } };
      diagonal = other;
    }
    taken_.insert(diagonal);
  }

  bool isConvex(const std::vector<Vec3d>& quad) const
  {
    const Vec3d normal = (quad[2] - quad[0]).cross(quad[3] - quad[1]);
    for (int i = 0; i < 4; ++i)
    {
      const Vec3d in = quad[(i + 1) % 4] - quad[i];
      const Vec3d out = quad[(i + 2) % 4] - quad[(i + 1) % 4];
      const double turn = in.cross(out).dot(normal) / normal.norm();
      if (!(turn > tolerance_ * (in + out).norm()))
      {
        return false;
      }
    }
    return true;
  }

  ClothModel compact()
  {
    std::vector<int> new_index(content_.positions.size(), -1);
    std::vector<bool> named(content_.positions.size(), false);
    for (const ObjCorner& corner : content_.corners)
    {
      named[corner.vertex] = true;
    }
    for (const SoupTriangle& triangle : triangles_)
    {
      for (const int vertex : triangle.vertices)
      {
        new_index[vertex] = 0;
      }
    }
    ClothModel model;
    for (std::size_t i = 0; i < new_index.size(); ++i)
    {
      if (new_index[i] == 0)
      {
        new_index[i] = static_cast<int>(model.positions.size());
        model.positions.push_back(content_.positions[i]);
      }
      else if (!named[i])
      {
        reportFinding(report_, report_.unused_vertices, content_.lines[i],
                      "vertex " + std::to_string(i + 1) + " is in no face, left out");
      }
    }
    for (const SoupTriangle& triangle : triangles_)
    {
      ModelTriangle face;
      for (int k = 0; k < 3; ++k)
      {
        face.vertices[k] = new_index[triangle.vertices[k]];
        face.uv[k] = triangle.uv[k];
      }
      model.triangles.push_back(face);
    }
    judgeTexture(model);
    return model;
  }

  void describe(const ClothModel& model)
  {
    const Mesh mesh(static_cast<int>(model.positions.size()), model.triangles);
    report_.particles = mesh.particleCount();
    report_.springs = mesh.springCount();
    report_.triangles = mesh.triangleCount();
    report_.pieces = countPieces(mesh);
    describeEdges(model, mesh);
    describeTriangles(model);
    report_.borders = countBorders(mesh);
    Box box;
    for (const Vec3d& place : model.positions)
    {
      box.add(place);
    }
    report_.lowest = box.lowest;
    report_.highest = box.highest;
  }

  // Coordinates that some tools write for every corner alike are no texture either.
  void judgeTexture(ClothModel& model)
  {
    int first_flat_line = 0;
    for (std::size_t t = 0; t < model.triangles.size(); ++t)
    {
      if (isFlatTexture(model.triangles[t]))
      {
        first_flat_line = first_flat_line == 0 ? triangles_[t].line : first_flat_line;
        ++report_.flat_texture;
      }
    }
    if (report_.flat_texture == static_cast<int>(model.triangles.size()))
    {
      makeUpTexture(model);
      noteTexture(first_flat_line, report_.faces, "texture coordinates that span no area; others");
      report_.untextured_faces = report_.faces;
      report_.flat_texture = 0;
    }
    else if (report_.flat_texture > 0)
    {
      report_.findings.push_back(
          { first_flat_line, "the texture coordinates of the face span no area" +
                                 likeMore(report_.flat_texture) + "; kept" });
    }
    if (first_untextured_line_ > 0)
    {
      noteTexture(first_untextured_line_, report_.untextured_faces, "no texture coordinates; they");
    }
  }

  void makeUpTexture(ClothModel& model) const
  {
    const Projection projection(box_);
    for (ModelTriangle& triangle : model.triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        triangle.uv[k] = projection(model.positions[triangle.vertices[k]]);
      }
    }
  }

  void noteTexture(int line, int count, const std::string& what)
  {
    report_.findings.push_back(
        { line, "the face" + likeMore(count) + ", has " + what +
                    " are made up by projection along the model's thinnest axis" });
  }

  static std::string likeMore(int count)
  {
    return count == 1 ? "" : ", like " + std::to_string(count - 1) + " more";
  }

  static int countPieces(const Mesh& mesh)
  {
    VertexSets sets(static_cast<std::size_t>(mesh.particleCount()));
    int pieces = mesh.particleCount();
    for (int t = 0; t < mesh.triangleCount(); ++t)
    {
      const auto& particles = mesh.triangle(TriangleId{ t }).particles;
      pieces -= sets.join(particles[0].index, particles[1].index) ? 1 : 0;
      pieces -= sets.join(particles[0].index, particles[2].index) ? 1 : 0;
    }
    return pieces;
  }

  // An open fan is where a border comes in along its one end and leaves along the other.
  static int countBorders(const Mesh& mesh)
  {
    VertexSets sets(static_cast<std::size_t>(mesh.springCount()));
    int borders = 0;
    for (int s = 0; s < mesh.springCount(); ++s)
    {
      borders += mesh.spring(SpringId{ s }).border() ? 1 : 0;
    }
    for (int p = 0; p < mesh.particleCount(); ++p)
    {
      if (!mesh.onBorder(ParticleId{ p }))
      {
        continue;
      }
      for (const Fan& fan : mesh.fans(ParticleId{ p }))
      {
        const bool joined =
            !fan.closed && sets.join(fan.springs.front().index, fan.springs.back().index);
        borders -= joined ? 1 : 0;
      }
    }
    return borders;
  }

  void describeEdges(const ClothModel& model, const Mesh& mesh)
  {
    report_.shortest_edge = std::numeric_limits<double>::infinity();
    for (int s = 0; s < mesh.springCount(); ++s)
    {
      const Spring& spring = mesh.spring(SpringId{ s });
      const double length =
          (model.positions[spring.particles[1].index] - model.positions[spring.particles[0].index])
              .norm();
      report_.shortest_edge = std::min(report_.shortest_edge, length);
      report_.longest_edge = std::max(report_.longest_edge, length);
      report_.border_springs += spring.border() ? 1 : 0;
      report_.seam_edges += !spring.border() && isSeam(mesh, spring) ? 1 : 0;
    }
  }

  static bool isSeam(const Mesh& mesh, const Spring& spring)
  {
    const Triangle& one = mesh.triangle(spring.triangles[0]);
    const Triangle& other = mesh.triangle(spring.triangles[1]);
    return std::any_of(spring.particles.begin(), spring.particles.end(),
                       [&](ParticleId p)
                       { return one.uv[one.cornerOf(p)] != other.uv[other.cornerOf(p)]; });
  }

  void describeTriangles(const ClothModel& model)
  {
    report_.least_altitude = std::numeric_limits<double>::infinity();
    for (const ModelTriangle& triangle : model.triangles)
    {
      const Vec3d& a = model.positions[triangle.vertices[0]];
      const Vec3d& b = model.positions[triangle.vertices[1]];
      const Vec3d& c = model.positions[triangle.vertices[2]];
      const double twice_area = (b - a).cross(c - a).norm();
      const double longest = std::max({ (b - a).norm(), (c - b).norm(), (a - c).norm() });
      report_.area += twice_area / 2;
      report_.least_altitude = std::min(report_.least_altitude, twice_area / longest);
    }
  }

  static bool isFlatTexture(const ModelTriangle& triangle)
  {
    const double longest = std::max({ (triangle.uv[1] - triangle.uv[0]).squaredNorm(),
                                      (triangle.uv[2] - triangle.uv[1]).squaredNorm(),
                                      (triangle.uv[0] - triangle.uv[2]).squaredNorm() });
    return std::abs(signedArea2(triangle.uv[0], triangle.uv[1], triangle.uv[2])) <=
           FLAT_UV * longest;
  }

  ObjContent content_;
  const ImportOptions& options_;
  ImportProblems problems_;
  ImportReport report_;
  Box box_;
  double tolerance_ = 0;
  int first_untextured_line_ = 0;
  VertexSets sets_;
  std::set<std::pair<int, int>> taken_;
  std::vector<SoupTriangle> triangles_;
};

std::string readAll(std::istream& stream, const std::string& name, const ImportOptions& options)
{
  std::string text;
  std::vector<char> block(1 << 20);
  while (stream.good() && text.size() <= options.max_bytes)
  {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad() || (stream.fail() && !stream.eof()))
  {
    ImportProblems(name).refuse(0, "it cannot be read");
  }
  if (text.size() > options.max_bytes)
  {
    ImportProblems(name).refuse(
        0, "it has more than " + std::to_string(options.max_bytes) + " bytes (max_bytes)");
  }
  return text;
}

}  // namespace

ObjImport readObj(std::istream& stream, const std::string& name, const ImportOptions& options)
{
  const std::vector<std::string> wrong = problems(options);
  if (!wrong.empty())
  {
    throw std::invalid_argument("import options: " + wrong.front());
  }
  return Importer(parseObj(readAll(stream, name, options), name, options), name, options).run();
}

ObjImport readObjFile(const std::string& path, const ImportOptions& options)
{
  std::ifstream file(path, std::ios::binary);
  if (!file)
  {
    ImportProblems(path).refuse(0, "it cannot be opened");
  }
  return readObj(file, path, options);
}

}  // namespace cloth
