// Tries every edit on every element of every small triangulation there is.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "cloth_tearing/core/mesh.h"
#include "small_meshes.h"

namespace cloth
{
namespace
{

constexpr int MOST_TRIANGLES = 6;

int particlesOf(const Faces& faces)
{
  int highest = -1;
  for (const auto& face : faces)
  {
    highest = std::max(highest, *std::max_element(face.begin(), face.end()));
  }
  return highest + 1;
}

// -- every pattern -------------------------------------------------------------------------------

bool runs(const std::array<int, 3>& face, int from, int to)
{
  for (int k = 0; k < 3; ++k)
  {
    if (face[k] == from && face[(k + 1) % 3] == to)
    {
      return true;
    }
  }
  return false;
}

/// The face that runs from `from` to `to`; -1 if none does.
int faceThatRuns(const Faces& faces, int from, int to)
{
  for (std::size_t f = 0; f < faces.size(); ++f)
  {
    if (runs(faces[f], from, to))
    {
      return static_cast<int>(f);
    }
  }
  return -1;
}

std::array<int, 3> sorted(std::array<int, 3> face)
{
  std::sort(face.begin(), face.end());
  return face;
}

/// Whether `face` may lie beside the others: each side runs one way once, no corners twice.
bool fits(const Faces& faces, const std::array<int, 3>& face)
{
  for (int k = 0; k < 3; ++k)
  {
    if (face[k] == face[(k + 1) % 3] || faceThatRuns(faces, face[k], face[(k + 1) % 3]) >= 0)
    {
      return false;
    }
  }
  return std::none_of(faces.begin(), faces.end(),
                      [&](const auto& other) { return sorted(other) == sorted(face); });
}

/// The faces as they are met when one walks over sides from side `k` of face `root`, particles
/// numbered in the order of meeting: the walk leaves no choice.
Faces walked(const Faces& faces, std::size_t root, int k)
{
  std::vector<int> number(particlesOf(faces), -1);
  int numbers = 0;
  std::vector<bool> met(faces.size(), false);
  std::vector<std::array<int, 3>> queue;
  const auto meet = [&](int f, int first)
  {
    met[f] = true;
    queue.push_back({ faces[f][first], faces[f][(first + 1) % 3], faces[f][(first + 2) % 3] });
  };
  meet(static_cast<int>(root), k);
  Faces result;
  for (std::size_t next = 0; next < queue.size(); ++next)
  {
    const std::array<int, 3> face = queue[next];
    for (int particle : face)
    {
      number[particle] = number[particle] < 0 ? numbers++ : number[particle];
    }
    result.push_back({ number[face[0]], number[face[1]], number[face[2]] });
    for (int side = 0; side < 3; ++side)
    {
      const int from = face[(side + 1) % 3];
      const int to = face[side];
      const int beyond = faceThatRuns(faces, from, to);
      if (beyond >= 0 && !met[beyond])
      {
        const auto& corners = faces[beyond];
        meet(beyond,
             static_cast<int>(std::find(corners.begin(), corners.end(), from) - corners.begin()));
      }
    }
  }
  return result;
}

/// The same for all patterns that differ in the numbers of their particles and faces alone.
Faces canonical(const Faces& faces)
{
  Faces least = walked(faces, 0, 0);
  for (std::size_t root = 0; root < faces.size(); ++root)
  {
    for (int k = 0; k < 3; ++k)
    {
      least = std::min(least, walked(faces, root, k));
    }
  }
  return least;
}

/// Glues one more triangle to each free side of each pattern; its third corner is a new particle
/// or any that is there, so that rings, closed fans, pinches and closed surfaces come about.
std::set<Faces> grown(const std::set<Faces>& patterns)
{
  std::set<Faces> result;
  for (const Faces& pattern : patterns)
  {
    for (const auto& face : pattern)
    {
      for (int k = 0; k < 3; ++k)
      {
        for (int third = 0; third <= particlesOf(pattern); ++third)
        {
          const std::array<int, 3> added = { face[(k + 1) % 3], face[k], third };
          if (fits(pattern, added))
          {
            Faces larger = pattern;
            larger.push_back(added);
            result.insert(canonical(larger));
          }
        }
      }
    }
  }
  return result;
}

/// All patterns whose triangles hang together through springs, by number of triangles.
std::vector<std::set<Faces>> patternsInOnePart()
{
  std::vector<std::set<Faces>> patterns = { {}, { { { 0, 1, 2 } } } };
  while (patterns.size() <= MOST_TRIANGLES)
  {
    patterns.push_back(grown(patterns.back()));
  }
  return patterns;
}

/// Two patterns that touch in one point: particle `q` of the second is `p` of the first.
Faces hinged(Faces first, int p, const Faces& second, int q)
{
  const int offset = particlesOf(first);
  for (std::array<int, 3> face : second)
  {
    for (int& particle : face)
    {
      particle = particle == q ? p : offset + particle - (particle > q ? 1 : 0);
    }
    first.push_back(face);
  }
  return first;
}

void forEveryHingedPair(const std::vector<std::set<Faces>>& patterns,
                        const std::function<void(const Faces&)>& visit)
{
  for (int triangles = 1; triangles < MOST_TRIANGLES; ++triangles)
  {
    for (int others = triangles; triangles + others <= MOST_TRIANGLES; ++others)
    {
      for (const Faces& first : patterns[triangles])
      {
        for (const Faces& second : patterns[others])
        {
          for (int p = 0; p < particlesOf(first); ++p)
          {
            for (int q = 0; q < particlesOf(second); ++q)
            {
              visit(hinged(first, p, second, q));
            }
          }
        }
      }
    }
  }
}

// -- every edit ----------------------------------------------------------------------------------

/// Triangles of one particle that hang together, found without the mesh's own walk.
struct Part
{
  std::set<int> triangles;
  std::set<int> springs;  ///< that end at the particle

  bool closed() const { return springs.size() == triangles.size(); }
};

std::vector<Part> partsAt(const Mesh& mesh, ParticleId p)
{
  std::vector<Part> parts;
  for (int t = 0; t < mesh.triangleCount(); ++t)
  {
    const Triangle& triangle = mesh.triangle({ t });
    if (triangle.cornerOf(p) < 0)
    {
      continue;
    }
    Part merged;
    merged.triangles.insert(t);
    for (SpringId s : triangle.springs)
    {
      if (mesh.spring(s).joins(p))
      {
        merged.springs.insert(s.index);
      }
    }
    for (std::size_t i = parts.size(); i-- > 0;)
    {
      if (std::any_of(parts[i].springs.begin(), parts[i].springs.end(),
                      [&](int s) { return merged.springs.count(s) > 0; }))
      {
        merged.triangles.insert(parts[i].triangles.begin(), parts[i].triangles.end());
        merged.springs.insert(parts[i].springs.begin(), parts[i].springs.end());
        parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(i));
      }
    }
    parts.push_back(merged);
  }
  return parts;
}

/// Makes edits on copies of one mesh and remembers the first that did not do what it should.
class World
{
public:
  explicit World(const Faces& faces) : untorn_(meshOf(modelOf(faces)))
  {
    for (const auto& face : faces)
    {
      name_ += (name_.empty() ? "" : " ") + std::to_string(face[0]) + "-" +
               std::to_string(face[1]) + "-" + std::to_string(face[2]);
    }
    expect(defects(untorn_).empty(), "the pattern is not sound");
  }

  void tryEveryEdit()
  {
    for (int s = 0; s < untorn_.springCount(); ++s)
    {
      const Counts added = untorn_.spring({ s }).border() ? Counts{ 2, 3, 1 } : Counts{ 2, 5, 2 };
      make("splitSpring " + std::to_string(s), true, added,
           [s](Mesh& mesh) { return mesh.splitSpring({ s }); });
    }
    for (int p = 0; p < untorn_.particleCount(); ++p)
    {
      const std::vector<Part> parts = partsAt(untorn_, { p });
      tryCuts(p, parts);
      tryParting(p, parts);
    }
  }

  const std::string& problem() const { return problem_; }

  int made = 0;
  int refused = 0;

private:
  static ClothModel modelOf(const Faces& faces)
  {
    const int particles = particlesOf(faces);
    std::vector<Vec2d> places;
    for (int i = 0; i < particles; ++i)
    {
      places.push_back(polar(1.0 + 0.1 * i, 360.0 * i / particles));
    }
    return flatModel(places, faces);
  }

  void tryCuts(int p, const std::vector<Part>& parts)
  {
    const std::string at = " " + std::to_string(p) + " ";
    for (int from = 0; from < untorn_.springCount(); ++from)
    {
      const auto part = std::find_if(parts.begin(), parts.end(),
                                     [&](const Part& one) { return one.springs.count(from) > 0; });
      const bool ends_here = part != parts.end();
      make("detachAlong" + at + std::to_string(from),
           ends_here && !part->closed() && !untorn_.spring({ from }).border(), { 1, 1, 0 },
           [=](Mesh& mesh) { return mesh.detachAlong({ p }, { from }); });
      for (int to = 0; to < untorn_.springCount(); ++to)
      {
        make("openAlong" + at + std::to_string(from) + " " + std::to_string(to),
             ends_here && part->closed() && to != from && part->springs.count(to) > 0, { 1, 2, 0 },
             [=](Mesh& mesh) { return mesh.openAlong({ p }, { from }, { to }); });
      }
    }
  }

  void tryParting(int p, const std::vector<Part>& parts)
  {
    const int fans = static_cast<int>(parts.size());
    make("separateFans " + std::to_string(p), fans > 1, { fans - 1, 0, 0 },
         [=](Mesh& mesh) { return mesh.separateFans({ p }); });
    for (int t = 0; t < untorn_.triangleCount(); ++t)
    {
      make("detachFan " + std::to_string(p) + " " + std::to_string(t),
           fans > 1 && untorn_.triangle({ t }).cornerOf({ p }) >= 0, { 1, 0, 0 },
           [=](Mesh& mesh) { return mesh.detachFan({ p }, { t }); });
    }
  }

  template <class Act>
  void make(const std::string& edit, bool allowed, const Counts& expected, Act&& act)
  {
    Mesh mesh = untorn_;
    try
    {
      const Edit result = act(mesh);
      ++made;
      expect(allowed, edit + " was made");
      expect(countsOf(mesh) - countsOf(untorn_) == expected, edit + " adds something else");
      expect(defects(mesh).empty(), edit + " leaves a defect");
      expect(std::abs(uvArea(mesh) - uvArea(untorn_)) < 1e-12, edit + " changes the texture");
      expect(touchesAllThatChanged(untorn_, mesh, result.touched), edit + " hides what it touched");
    }
    catch (const TopologyError& error)
    {
      ++refused;
      expect(!allowed, edit + " was refused");
      expect(isSame(mesh, untorn_), edit + " was refused and changed something");
    }
  }

  void expect(bool holds, const std::string& what)
  {
    if (!holds && problem_.empty())
    {
      problem_ = what + ", on triangles " + name_;
    }
  }

  Mesh untorn_;
  std::string name_;
  std::string problem_;
};

/// Worlds of one kind and what was done in them.
struct Tally
{
  int worlds = 0;
  int made = 0;
  int refused = 0;

  void play(const Faces& faces)
  {
    World world(faces);
    world.tryEveryEdit();
    ++worlds;
    made += world.made;
    refused += world.refused;
    EXPECT_EQ(world.problem(), "");
  }

  void print(const char* kind) const
  {
    std::printf("%d %s: %d edits made, %d refused\n", worlds, kind, made, refused);
  }
};

TEST(SmallWorlds, AreAsManyAsThereAreTriangulations)
{
  const std::vector<std::set<Faces>> patterns = patternsInOnePart();

  // Cut polygons of 3 to 8 corners into triangles, up to rotation: sequence A001683 of the OEIS.
  // They are the patterns in which nothing meets again.
  const std::vector<int> polygons = { 0, 1, 1, 1, 4, 6, 19 };
  for (int triangles = 1; triangles <= MOST_TRIANGLES; ++triangles)
  {
    EXPECT_EQ(
        std::count_if(patterns[triangles].begin(), patterns[triangles].end(),
                      [&](const Faces& faces) { return particlesOf(faces) == triangles + 2; }),
        polygons[triangles]);
  }
  const Faces closed_fan = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 1 } };
  const Faces tetrahedron = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 1 }, { 1, 3, 2 } };
  const Faces ring = {
    { 0, 1, 3 }, { 1, 4, 3 }, { 1, 2, 4 }, { 2, 5, 4 }, { 2, 0, 5 }, { 0, 3, 5 }
  };
  EXPECT_EQ(patterns[3].count(canonical(closed_fan)), 1u);
  EXPECT_EQ(patterns[4].count(canonical(tetrahedron)), 1u);
  EXPECT_EQ(patterns[6].count(canonical(ring)), 1u);
}

TEST(SmallWorlds, StaySoundUnderEveryEditOfEveryElement)
{
  Tally tally;
  for (const std::set<Faces>& patterns : patternsInOnePart())
  {
    for (const Faces& faces : patterns)
    {
      tally.play(faces);
      ASSERT_FALSE(HasFailure());
    }
  }
  tally.print("patterns in one part");
}

TEST(SmallWorlds, StaySoundWhereTwoOfThemTouchInAPoint)
{
  Tally tally;
  forEveryHingedPair(patternsInOnePart(), [&](const Faces& faces) { tally.play(faces); });
  tally.print("pairs of patterns that touch in a point");
}

}  // namespace
}  // namespace cloth
