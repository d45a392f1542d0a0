// Takes cloths apart by random edits and derives after each what must still hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/pieces.h"
#include "float_traps.h"
#include "small_meshes.h"

namespace cloth
{
namespace
{

constexpr int EDITS = 1000000;            // that succeed, in an ordinary run
constexpr int THOROUGH_EDITS = 10000000;  // with CLOTH_TEARING_THOROUGH=1
constexpr std::uint64_t SEEDS = 8;
constexpr int SMALL = 200;          // meshes of fewer triangles are checked whole after every edit
constexpr int BATCH = 250;          // others after so many
constexpr int PATIENCE = 60;        // attempts in a row that fail before a kind of edit is given up
constexpr double MIN_LENGTH = 0.2;  // floor of a split, in spacings of the untorn mesh
constexpr double MIN_ALTITUDE = 0.1;  // the same for the lowest triangle
constexpr double WIDTH = 1.5;         // [m]
constexpr double HEIGHT = 0.8;

/// Random numbers that are the same with every standard library.
class Random
{
public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }

private:
  std::mt19937_64 engine_;
};

enum EditKind
{
  SPLIT,
  DETACH,
  OPEN,
  FANS,
  EDIT_KINDS
};
const char* const EDIT_NAMES[EDIT_KINDS] = { "splitSpring", "detachAlong", "openAlong",
                                             "separateFans or detachFan" };

// Opening needs a sound particle, which every edit uses up: it is tried more often than the rest.
const std::array<EditKind, 6> PICKS = { SPLIT, DETACH, OPEN, OPEN, OPEN, FANS };

ClothModel randomSheet(int columns, int rows, RectanglePattern pattern, std::uint64_t seed)
{
  RectangleParams params;
  params.width = WIDTH;
  params.height = HEIGHT;
  params.columns = columns;
  params.rows = rows;
  params.pattern = pattern;
  params.seed = seed;
  return rectangle(params);
}

/// Meshes of 50 to 2,000 triangles in every pattern.
std::vector<Cloth> untornCloths(std::uint64_t seed)
{
  std::vector<Cloth> cloths;
  for (const auto& size : { std::array<int, 2>{ 6, 6 }, { 9, 8 }, { 16, 13 }, { 26, 41 } })
  {
    for (const RectanglePattern pattern :
         { RectanglePattern::ONE_DIAGONAL, RectanglePattern::ALTERNATING,
           RectanglePattern::IRREGULAR })
    {
      cloths.push_back(clothOf(randomSheet(size[0], size[1], pattern, seed)));
    }
  }
  return cloths;
}

/// A cloth and what is known of it apart from its own records: the sheet is flat at rest and its
/// texture spans it, so every length and area at rest can be read from the texture.
class Checked
{
public:
  Checked(const Cloth& untorn, Random& random) : cloth(untorn)
  {
    for (int i = 0; i < cloth.mesh.particleCount() / 10; ++i)
    {
      const auto kind = i % 2 == 0 ? Attachment::Kind::PIN : Attachment::Kind::GRASP;
      cloth.attach({ random.below(cloth.mesh.particleCount()) }, { kind, 1 });
    }
    for (int i = 0; i < cloth.mesh.triangleCount(); ++i)
    {
      uv_.push_back(cloth.mesh.triangle({ i }).uv);
    }
    mass_ = sumOf(cloth.rest.mass);
    area_ = sumOf(cloth.rest.area);
    seen_.resize(cloth.mesh.springCount(), 0);
  }

  /// The first thing wrong near an edit that added `added`; empty if there is none.
  std::string problemAfter(const Edit& edit, const Counts& added, const Counts& expected)
  {
    if (!(added == expected))
    {
      return "the edit added other elements than the table says";
    }
    std::string problem = followTexture(edit);
    collectRing(edit);
    for (std::size_t i = 0; i < particles_.size() && problem.empty(); ++i)
    {
      problem = problemOf(particles_[i]);
    }
    for (std::size_t i = 0; i < triangles_.size() && problem.empty(); ++i)
    {
      problem = problemOf(triangles_[i]);
    }
    for (std::size_t i = 0; i < springs_.size() && problem.empty(); ++i)
    {
      problem = problemOf(springs_[i]);
    }
    return problem;
  }

  /// The first thing wrong anywhere; empty if there is none.
  std::string problem() const
  {
    const std::vector<std::string> found = defects(cloth.mesh);
    std::string problem = found.empty() ? sizeProblem() : found.front();
    for (int i = 0; i < cloth.mesh.particleCount() && problem.empty(); ++i)
    {
      problem = problemOf(ParticleId{ i });
    }
    for (int i = 0; i < cloth.mesh.triangleCount() && problem.empty(); ++i)
    {
      problem = problemOf(TriangleId{ i });
    }
    for (int i = 0; i < cloth.mesh.springCount() && problem.empty(); ++i)
    {
      problem = problemOf(SpringId{ i });
    }
    if (problem.empty() && !(std::abs(uvArea(cloth.mesh) - 1.0) < 1e-12))
    {
      problem = "the texture area changed";
    }
    if (problem.empty() && !(std::abs(sumOf(cloth.rest.mass) - mass_) < 1e-12 * mass_))
    {
      problem = "the mass changed";
    }
    if (problem.empty() && !(std::abs(sumOf(cloth.rest.area) - area_) < 1e-12 * area_))
    {
      problem = "the rest area changed";
    }
    return problem;
  }

  Cloth cloth;

private:
  /// Place of a corner on the flat sheet [m].
  Vec2d place(const Triangle& t, int k) const
  {
    return { WIDTH * t.uv[k].x(), HEIGHT * t.uv[k].y() };
  }

  static bool near(double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(b); }

  /// Midpoints are exact means, all other texture corners as they were.
  std::string followTexture(const Edit& edit)
  {
    for (const auto& added : edit.triangles)
    {
      const auto old = uv_[added.parent.index];
      const auto& kept = cloth.mesh.triangle(added.parent).uv;
      const auto& made = cloth.mesh.triangle(added.id).uv;
      const auto moved = [&](const std::array<Vec2d, 3>& now)
      {
        int corner = -1;
        for (int k = 0; k < 3; ++k)
        {
          corner = now[k] == old[k] ? corner : k;
        }
        return corner;
      };
      const int far = moved(kept);
      const int near = moved(made);
      if (far < 0 || near < 0 || far == near)
      {
        return "a half has the wrong texture corners";
      }
      const Vec2d middle = 0.5 * (old[far] + old[near]);
      if (kept[far] != middle || made[near] != middle)
      {
        return "a midpoint is not the mean of the texture corners";
      }
      uv_[added.parent.index][far] = middle;
      uv_.push_back(old);
      uv_.back()[near] = middle;
    }
    return {};
  }

  /// Everything whose records the edit may have had to change, and one ring more.
  void collectRing(const Edit& edit)
  {
    particles_.clear();
    triangles_.clear();
    springs_.clear();
    for (TriangleId t : edit.touched)
    {
      const auto& corners = cloth.mesh.triangle(t).particles;
      particles_.insert(particles_.end(), corners.begin(), corners.end());
    }
    for (const auto& added : edit.particles)
    {
      particles_.push_back(added.parents[0]);
    }
    unique(particles_);
    for (ParticleId p : particles_)
    {
      cloth.mesh.forEachTriangleAt(p, [&](TriangleId t) { triangles_.push_back(t); });
    }
    unique(triangles_);
    ++reading_;
    seen_.resize(cloth.mesh.springCount(), 0);
    for (TriangleId t : triangles_)
    {
      for (SpringId s : cloth.mesh.triangle(t).springs)
      {
        if (seen_[s.index] != reading_)
        {
          seen_[s.index] = reading_;
          springs_.push_back(s);
        }
      }
    }
  }

  template <class Element>
  static void unique(std::vector<Element>& elements)
  {
    std::sort(elements.begin(), elements.end());
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  }

  std::string problemOf(ParticleId p) const
  {
    const std::string name = "particle " + std::to_string(p.index);
    double area = 0.0;
    int corners = 0;
    bool listed = true;
    cloth.mesh.forEachTriangleAt(p,
                                 [&](TriangleId t)
                                 {
                                   area += cloth.rest.area[t.index];
                                   ++corners;
                                   listed = listed && cloth.mesh.triangle(t).cornerOf(p) >= 0;
                                 });
    if (corners == 0 || !listed)
    {
      return name + " lists triangles that are not its own";
    }
    const double mass = cloth.rest.mass[p.index];
    if (!near(mass, cloth.rest.areal_density * area / 3.0))
    {
      return name + " has not a third of its triangles' mass";
    }
    const Real inverse = cloth.state.inverse_mass[p.index];
    if (inverse != (cloth.attachments[p.index].held() ? Real(0) : static_cast<Real>(1.0 / mass)))
    {
      return name + " has the wrong inverse mass";
    }
    if ((cloth.damage.hinge[p.index] != 0) != (cloth.mesh.fanCount(p) > 1))
    {
      return name + " does not know whether it is a one-point connection";
    }
    if (!cloth.state.position[p.index].allFinite() || !cloth.state.velocity[p.index].allFinite())
    {
      return name + " is not finite";
    }
    return {};
  }

  std::string problemOf(TriangleId id) const
  {
    const std::string name = "triangle " + std::to_string(id.index);
    const Triangle& t = cloth.mesh.triangle(id);
    for (int k = 0; k < 3; ++k)
    {
      const Spring& s = cloth.mesh.spring(t.springs[k]);
      if (!s.joins(t.particles[k]) || s.other(t.particles[k]) != t.particles[(k + 1) % 3])
      {
        return name + " has a spring that does not match its corners";
      }
      if (s.triangles[0] != id && s.triangles[1] != id)
      {
        return name + " has a spring that does not know it";
      }
    }
    if (t.uv != uv_[id.index])
    {
      return name + " has a texture corner that moved";
    }
    if (!(uvArea(t) > 0.0))
    {
      return name + " is turned over";
    }
    return near(cloth.rest.area[id.index], uvArea(t) * WIDTH * HEIGHT)
               ? ""
               : name + " has the wrong rest area";
  }

  std::string problemOf(SpringId id) const
  {
    const std::string name = "spring " + std::to_string(id.index);
    const Spring& s = cloth.mesh.spring(id);
    double area = 0.0;
    std::array<Vec2d, 2> corner;
    for (int i = 0; i < (s.border() ? 1 : 2); ++i)
    {
      const Triangle& t = cloth.mesh.triangle(s.triangles[i]);
      const int k = t.sideOf(id);
      if (k < 0)
      {
        return name + " knows a triangle that does not know it";
      }
      area += cloth.rest.area[s.triangles[i].index];
      corner[i] = place(t, (k + 2) % 3);
      if (!near(cloth.rest.length[id.index], (place(t, k) - place(t, (k + 1) % 3)).norm()))
      {
        return name + " has the wrong rest length";
      }
    }
    const double bend = s.border() ? 0.0 : (corner[1] - corner[0]).norm();
    if (!near(cloth.rest.bend_length[id.index], bend))
    {
      return name + " has the wrong bend-shear length";
    }
    return lawProblem(name, id, area);
  }

  std::string lawProblem(const std::string& name, SpringId id, double area) const
  {
    const Spring& s = cloth.mesh.spring(id);
    const SpringLaw& law = cloth.springs.structural[id.index];
    const double length = cloth.rest.length[id.index];
    if (law.a != s.particles[0].index || law.b != s.particles[1].index ||
        law.rest != static_cast<Real>(length) ||
        !(std::abs(law.stiffness * length * length / (cloth.material.stiffness * area) - 1.0) <
          1e-5))
    {
      return name + " is not as the table of springs has it";
    }
    const SpringLaw& bend = cloth.springs.bend_shear[id.index];
    if (s.border())
    {
      return bend.active() ? name + " is a border with a bend-shear spring" : "";
    }
    const double reach = cloth.rest.bend_length[id.index];
    if (bend.a != cloth.mesh.opposite(id, 0).index || bend.b != cloth.mesh.opposite(id, 1).index ||
        bend.rest != static_cast<Real>(reach) ||
        !(std::abs(bend.stiffness * reach * reach / (cloth.material.bend_shear_stiffness * area) -
                   1.0) < 1e-5))
    {
      return name + " has a bend-shear spring that was left behind";
    }
    return {};
  }

  std::string sizeProblem() const
  {
    const std::set<std::size_t> by_particle = {
      static_cast<std::size_t>(cloth.mesh.particleCount()),
      cloth.state.position.size(),
      cloth.state.velocity.size(),
      cloth.state.previous.size(),
      cloth.state.inverse_mass.size(),
      cloth.rest.mass.size(),
      cloth.attachments.size(),
      cloth.damage.weak.size(),
      cloth.damage.hinge.size(),
      cloth.damage.at_rest.size(),
      cloth.damage.hem.size(),
      cloth.damage.parents.size(),
    };
    const std::set<std::size_t> by_spring = {
      static_cast<std::size_t>(cloth.mesh.springCount()),
      cloth.rest.length.size(),
      cloth.rest.bend_length.size(),
      cloth.springs.structural.size(),
      cloth.springs.bend_shear.size(),
      cloth.damage.outer.size(),
      cloth.damage.released.size(),
      cloth.damage.strength.size(),
    };
    const std::set<std::size_t> by_triangle = {
      static_cast<std::size_t>(cloth.mesh.triangleCount()),
      cloth.rest.area.size(),
      cloth.rest.spacing.size(),
      uv_.size(),
    };
    return by_particle.size() == 1 && by_spring.size() == 1 && by_triangle.size() == 1
               ? ""
               : "an array did not follow";
  }

  std::vector<std::array<Vec2d, 3>> uv_;  // of each triangle, by our own reckoning
  double mass_ = 0.0;
  double area_ = 0.0;
  std::vector<ParticleId> particles_;
  std::vector<TriangleId> triangles_;
  std::vector<SpringId> springs_;
  std::vector<unsigned> seen_;
  unsigned reading_ = 0;
};

/// Whether the halves of `s` and of its triangles stay above the floor.
bool splittable(const Cloth& cloth, SpringId s)
{
  for (TriangleId t : cloth.mesh.spring(s).triangles)
  {
    if (!t.valid())
    {
      continue;
    }
    const Triangle& triangle = cloth.mesh.triangle(t);
    const int k = triangle.sideOf(s);
    const double whole = cloth.rest.length[s.index];
    const double a = cloth.rest.length[triangle.springs[(k + 1) % 3].index];
    const double b = cloth.rest.length[triangle.springs[(k + 2) % 3].index];
    const double median = medianLength(a, b, whole);
    const double altitude = cloth.rest.area[t.index] / std::max({ whole, a, b });
    const double spacing = cloth.rest.spacing[t.index];
    if (std::min(0.5 * whole, median) < MIN_LENGTH * spacing || altitude < MIN_ALTITUDE * spacing)
    {
      return false;
    }
  }
  return true;
}

/// Makes random edits on one cloth after another.
class Driver
{
public:
  explicit Driver(std::uint64_t seed) : random_(seed), untorn_(untornCloths(seed)) {}

  /// Makes `edits` edits. @return the first thing found wrong, with its place; empty if all is well
  std::string run(int edits)
  {
    int made = 0;
    while (made < edits)
    {
      const Cloth& untorn = untorn_[random_.below(static_cast<int>(untorn_.size()))];
      Checked checked(untorn, random_);
      hinges_.clear();
      const std::string problem = tearUp(checked, edits, made);
      if (!problem.empty())
      {
        return "after edit " + std::to_string(made) + ": " + problem;
      }
      ++cloths;
    }
    return {};
  }

  std::array<int, EDIT_KINDS> made_by_kind{};
  int cloths = 0;

private:
  /// Tears one cloth until hardly any edit is possible, or as often as it had triangles.
  std::string tearUp(Checked& checked, int edits, int& made)
  {
    const int triangles = checked.cloth.mesh.triangleCount();
    const int end = std::min(edits, made + triangles);
    std::array<int, EDIT_KINDS> failed{};
    while (made < end && *std::min_element(failed.begin(), failed.end()) < PATIENCE)
    {
      const EditKind kind = PICKS[random_.below(static_cast<int>(PICKS.size()))];
      const Counts before = countsOf(checked.cloth.mesh);
      Edit edit;
      Counts expected;
      if (failed[kind] >= PATIENCE || !attempt(checked.cloth, kind, edit, expected))
      {
        ++failed[kind];
        continue;
      }
      failed[kind] = 0;
      ++made;
      ++made_by_kind[kind];
      checked.cloth.follow(edit);
      noteHinges(checked.cloth, edit);
      std::string problem =
          checked.problemAfter(edit, countsOf(checked.cloth.mesh) - before, expected);
      if (problem.empty() && (triangles < SMALL || made % BATCH == 0))
      {
        problem = checked.problem();
      }
      if (!problem.empty())
      {
        return problem + ", by " + EDIT_NAMES[kind];
      }
    }
    return checked.problem();
  }

  bool attempt(Cloth& cloth, EditKind kind, Edit& edit, Counts& expected)
  {
    switch (kind)
    {
      case SPLIT:
        return split(cloth, edit, expected);
      case DETACH:
        return detach(cloth, edit, expected);
      case OPEN:
        return open(cloth, edit, expected);
      default:
        return parting(cloth, edit, expected);
    }
  }

  bool split(Cloth& cloth, Edit& edit, Counts& expected)
  {
    const SpringId s{ random_.below(cloth.mesh.springCount()) };
    if (!splittable(cloth, s))
    {
      return false;
    }
    expected = cloth.mesh.spring(s).border() ? Counts{ 2, 3, 1 } : Counts{ 2, 5, 2 };
    edit = cloth.mesh.splitSpring(s);
    return true;
  }

  bool detach(Cloth& cloth, Edit& edit, Counts& expected)
  {
    const SpringId s{ random_.below(cloth.mesh.springCount()) };
    const ParticleId p = cloth.mesh.spring(s).particles[random_.below(2)];
    if (cloth.mesh.spring(s).border() ||
        cloth.mesh.fanAt(p, cloth.mesh.spring(s).triangles[0]).closed)
    {
      return false;
    }
    expected = { 1, 1, 0 };
    edit = cloth.mesh.detachAlong(p, s);
    return true;
  }

  bool open(Cloth& cloth, Edit& edit, Counts& expected)
  {
    const SpringId from{ random_.below(cloth.mesh.springCount()) };
    const ParticleId p = cloth.mesh.spring(from).particles[random_.below(2)];
    const Fan fan = cloth.mesh.fanAt(p, cloth.mesh.spring(from).triangles[0]);
    const SpringId to = fan.springs[random_.below(static_cast<int>(fan.springs.size()))];
    if (!fan.closed || to == from)
    {
      return false;
    }
    expected = { 1, 2, 0 };
    edit = cloth.mesh.openAlong(p, from, to);
    return true;
  }

  bool parting(Cloth& cloth, Edit& edit, Counts& expected)
  {
    while (!hinges_.empty())
    {
      const int i = random_.below(static_cast<int>(hinges_.size()));
      const ParticleId p = hinges_[i];
      hinges_[i] = hinges_.back();
      hinges_.pop_back();
      const std::vector<Fan> fans = cloth.mesh.fans(p);
      if (fans.size() < 2)
      {
        continue;  // parted meanwhile
      }
      const bool all = random_.below(2) == 0;
      const Fan& one = fans[random_.below(static_cast<int>(fans.size()))];
      expected = { all ? static_cast<int>(fans.size()) - 1 : 1, 0, 0 };
      edit = all ? cloth.mesh.separateFans(p) : cloth.mesh.detachFan(p, one.triangles.front());
      return true;
    }
    return false;
  }

  /// Remembers the one-point connections that the edit has made or left.
  void noteHinges(const Cloth& cloth, const Edit& edit)
  {
    const auto note = [&](ParticleId p)
    {
      if (cloth.damage.hinge[p.index])
      {
        hinges_.push_back(p);
      }
    };
    for (TriangleId t : edit.touched)
    {
      const auto& corners = cloth.mesh.triangle(t).particles;
      std::for_each(corners.begin(), corners.end(), note);
    }
    note(edit.particles.front().parents[0]);
  }

  Random random_;
  std::vector<Cloth> untorn_;
  std::vector<ParticleId> hinges_;  // some of them parted since, some twice
};

TEST(RandomEdits, KeepEveryInvariantOfTheCloth)
{
  const FloatTraps traps;
  const char* const thorough = std::getenv("CLOTH_TEARING_THOROUGH");
  const int total = thorough != nullptr && std::string(thorough) == "1" ? THOROUGH_EDITS : EDITS;
  std::array<int, EDIT_KINDS> by_kind{};
  int cloths = 0;
  for (std::uint64_t seed = 1; seed <= SEEDS; ++seed)
  {
    Driver driver(seed);
    ASSERT_EQ(driver.run(total / static_cast<int>(SEEDS)), "") << "seed " << seed;
    for (int kind = 0; kind < EDIT_KINDS; ++kind)
    {
      by_kind[kind] += driver.made_by_kind[kind];
    }
    cloths += driver.cloths;
  }

  for (int kind = 0; kind < EDIT_KINDS; ++kind)
  {
    EXPECT_GE(by_kind[kind], total / 10) << EDIT_NAMES[kind];
    std::printf("%d x %s\n", by_kind[kind], EDIT_NAMES[kind]);
  }
  std::printf("on %d cloths\n", cloths);
}

/// One edit that takes the cloth further apart; none left if every triangle is alone.
bool takeApart(Cloth& cloth, SpringId& next)
{
  for (; next.index < cloth.mesh.springCount(); ++next.index)
  {
    if (cloth.mesh.spring(next).border())
    {
      continue;
    }
    const ParticleId p = cloth.mesh.spring(next).particles[0];
    const Fan fan = cloth.mesh.fanAt(p, cloth.mesh.spring(next).triangles[0]);
    const SpringId after = fan.springs[(fan.indexOf(next) + 1) % fan.springs.size()];
    cloth.follow(fan.closed ? cloth.mesh.openAlong(p, next, after)
                            : cloth.mesh.detachAlong(p, next));
    return true;
  }
  for (int i = 0; i < cloth.mesh.particleCount(); ++i)
  {
    if (cloth.damage.hinge[i])
    {
      cloth.follow(cloth.mesh.separateFans({ i }));
      return true;
    }
  }
  return false;
}

TEST(Cloth, MayBeTakenApartUntilEveryTriangleIsAlone)
{
  const FloatTraps traps;
  for (const RectanglePattern pattern :
       { RectanglePattern::ONE_DIAGONAL, RectanglePattern::ALTERNATING,
         RectanglePattern::IRREGULAR })
  {
    Random random(1);
    Checked checked(clothOf(randomSheet(9, 8, pattern, 1)), random);
    const int triangles = checked.cloth.mesh.triangleCount();
    SpringId next{ 0 };
    int edits = 0;
    while (edits < 10 * triangles && takeApart(checked.cloth, next))
    {
      ++edits;
      ASSERT_EQ(checked.problem(), "") << "after edit " << edits;
    }

    EXPECT_EQ(countsOf(checked.cloth.mesh), (Counts{ 3 * triangles, 3 * triangles, triangles }));
    EXPECT_EQ(countPieces(checked.cloth.mesh), triangles);
  }
}

}  // namespace
}  // namespace cloth
