// Looks for what is missing, out of range or contradicts itself in a state.
#include "cloth_tearing/core/state_checks.h"

#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/core/spring_blocks.h"

namespace cloth
{
namespace
{

constexpr int MOST_TEARS = 1000000000;  ///< that a pull may have counted

template <class Word>
std::string word(const Word& word)
{
  if constexpr (std::is_arithmetic<Word>::value)
  {
    return std::to_string(word);
  }
  else
  {
    return word;
  }
}

/// @param problem its words and numbers, put together only if they are needed
template <class... Words>
void refuseUnless(bool condition, const Words&... problem)
{
  if (!condition)
  {
    throw Refusal((... + word(problem)));
  }
}

template <class Values>
void refuseOtherSize(const Values& values, int count, const std::string& name)
{
  refuseUnless(values.size() == static_cast<std::size_t>(count), name, " has ", values.size(),
               " values, must have ", count);
}

/// Refuses values below 0, and 0 itself where they are to be above it.
template <class T>
void refuseSmall(const std::vector<T>& values, bool above, const std::string& name)
{
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    refuseUnless(above ? values[i] > T(0) : values[i] >= T(0), name, " ", i, " is ", values[i],
                 ", must be ", above ? "greater than 0" : "at least 0");
  }
}

void refuseSizes(const Cloth& cloth, const std::string& name)
{
  const int particles = cloth.mesh.particleCount();
  const int springs = cloth.mesh.springCount();
  const int triangles = cloth.mesh.triangleCount();
  refuseOtherSize(cloth.state.position, particles, name + "/state/position");
  refuseOtherSize(cloth.state.velocity, particles, name + "/state/velocity");
  refuseOtherSize(cloth.state.previous, particles, name + "/state/previous");
  refuseOtherSize(cloth.state.inverse_mass, particles, name + "/state/inverse_mass");
  refuseOtherSize(cloth.rest.mass, particles, name + "/rest/mass");
  refuseOtherSize(cloth.rest.length, springs, name + "/rest/length");
  refuseOtherSize(cloth.rest.bend_length, springs, name + "/rest/bend_length");
  refuseOtherSize(cloth.rest.area, triangles, name + "/rest/area");
  refuseOtherSize(cloth.rest.spacing, triangles, name + "/rest/spacing");
  refuseOtherSize(cloth.springs.structural, springs, name + "/springs/structural");
  refuseOtherSize(cloth.springs.bend_shear, springs, name + "/springs/bend_shear");
  refuseOtherSize(cloth.damage.weak, particles, name + "/damage/weak");
  refuseOtherSize(cloth.damage.hinge, particles, name + "/damage/hinge");
  refuseOtherSize(cloth.damage.at_rest, particles, name + "/damage/at_rest");
  refuseOtherSize(cloth.damage.hem, particles, name + "/damage/hem");
  refuseOtherSize(cloth.damage.parents, particles, name + "/damage/parents");
  refuseOtherSize(cloth.damage.strength, springs, name + "/damage/strength");
  refuseOtherSize(cloth.damage.outer, springs, name + "/damage/outer");
  refuseOtherSize(cloth.damage.released, springs, name + "/damage/released");
  refuseOtherSize(cloth.attachments, particles, name + "/attachments");
}

void refuseRestShape(const Cloth& cloth, const std::string& name)
{
  refuseUnless(cloth.rest.areal_density > 0.0, name, "/rest/areal_density is not above 0");
  refuseSmall(cloth.rest.mass, true, name + "/rest/mass");
  refuseSmall(cloth.rest.length, true, name + "/rest/length");
  refuseSmall(cloth.rest.bend_length, false, name + "/rest/bend_length");
  refuseSmall(cloth.rest.area, true, name + "/rest/area");
  refuseSmall(cloth.rest.spacing, true, name + "/rest/spacing");
  refuseSmall(cloth.state.inverse_mass, false, name + "/state/inverse_mass");
}

/// A law that carries something joins the particles `a` and `b`.
void refuseLaw(const SpringLaw& law, ParticleId a, ParticleId b, const std::string& table, int i)
{
  const bool none = law.a == -1 && law.b == -1;
  refuseUnless(none || (a.valid() && b.valid() && law.a == a.index && law.b == b.index), table, " ",
               i, " joins other particles than its spring");
  refuseUnless(none || law.rest > 0, table, " ", i, " has a rest length that is not above 0");
  refuseUnless(law.stiffness >= 0 && law.damping >= 0, table, " ", i,
               " has stiffness or damping below 0");
}

void refuseLaws(const Cloth& cloth, const std::string& name)
{
  const std::string structural = name + "/springs/structural";
  const std::string bend_shear = name + "/springs/bend_shear";
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    const SpringId s{ i };
    const auto& ends = cloth.mesh.spring(s).particles;
    refuseLaw(cloth.springs.structural[i], ends[0], ends[1], structural, i);
    refuseLaw(cloth.springs.bend_shear[i], cloth.mesh.opposite(s, 0), cloth.mesh.opposite(s, 1),
              bend_shear, i);
  }
}

void refuseDamage(const Cloth& cloth, const std::string& name)
{
  const int particles = cloth.mesh.particleCount();
  for (int i = 0; i < particles; ++i)
  {
    refuseUnless((cloth.damage.hinge[i] != 0) == (cloth.mesh.fanCount({ i }) > 1), name,
                 "/damage/hinge ", i, " contradicts the mesh");
    for (int parent : cloth.damage.parents[i])
    {
      refuseUnless(parent >= 0 && parent < particles, name, "/damage/parents ", i,
                   " names particle ", parent, ", which does not exist");
    }
  }
  refuseSmall(cloth.damage.strength, true, name + "/damage/strength");
  refuseUnless(cloth.damage.least_strength > 0.0, name, "/damage/least_strength is not above 0");
  std::vector<std::string> found;
  const int most = cloth.mesh.triangleCount();
  check(found, name + "/damage/pieces", cloth.damage.pieces, Range::between(1, most));
  check(found, name + "/damage/pieces_at_rest", cloth.damage.pieces_at_rest,
        Range::between(0, most));
  refuseIf(found);
}

/// Everything wrong with how a grasp stands and moves.
std::vector<std::string> problems(const Grasp& grasp, const std::string& name)
{
  std::vector<std::string> found;
  check(found, name + " orientation", grasp.pose.rotation);
  check(found, name + " force_limit [N]", grasp.force_limit, Range::atLeast(0.0));
  if (grasp.target)
  {
    const std::vector<std::string> wrong = problems(*grasp.target);
    found.insert(found.end(), wrong.begin(), wrong.end());
  }
  if (grasp.glide)
  {
    check(found, name + " glide orientation", grasp.glide->goal.rotation);
    check(found, name + " glide time_left [s]", grasp.glide->time_left, Range::atLeast(0.0));
  }
  if (grasp.pull)
  {
    check(found, name + " pull tears", grasp.pull->tears, Range::between(0, MOST_TEARS));
  }
  return found;
}

}  // namespace

void refuseUnsound(const Cloth& cloth, const std::string& name)
{
  refuseUnless(cloth.mesh.triangleCount() > 0, name, "/mesh is empty");
  const std::vector<std::string> found = defects(cloth.mesh);
  if (!found.empty())
  {
    throw Refusal(name + "/mesh: " + found.front());
  }
  refuseSizes(cloth, name);
  refuseRestShape(cloth, name);
  refuseLaws(cloth, name);
  refuseDamage(cloth, name);
}

void refuseUnsound(const Cloth& cloth, const std::vector<Grasp>& grasps)
{
  std::set<ParticleId> held_by_grasps;
  std::uint64_t before = 0;
  for (const Grasp& grasp : grasps)
  {
    const std::string name = "grasp " + std::to_string(grasp.id);
    refuseUnless(grasp.id > before, name, " comes after grasp ", before);
    before = grasp.id;
    refuseIf(problems(grasp, name));
    for (const Grasp::Held& held : grasp.held)
    {
      const int p = held.particle.index;
      refuseUnless(p >= 0 && p < cloth.mesh.particleCount() &&
                       cloth.attachments[p].kind == Attachment::Kind::GRASP &&
                       cloth.attachments[p].grasp == grasp.id,
                   name, " holds particle ", p, ", which says otherwise");
      refuseUnless(held_by_grasps.insert(held.particle).second, name, " holds particle ", p,
                   " twice");
    }
  }
  for (int i = 0; i < cloth.mesh.particleCount(); ++i)
  {
    refuseUnless(cloth.attachments[i].kind != Attachment::Kind::GRASP ||
                     held_by_grasps.count(ParticleId{ i }) > 0,
                 "particle ", i, " is held by no grasp, and says otherwise");
  }
}

void refuseUnsound(const std::vector<Sphere>& spheres)
{
  std::set<std::pair<SphereSource, std::uint64_t>> ids;
  for (const Sphere& sphere : spheres)
  {
    const std::string name = "sphere " + std::to_string(sphere.id);
    refuseUnless(ids.insert({ sphere.source, sphere.id }).second, name, " is there twice");
    std::vector<std::string> found;
    check(found, name + " radius [m]", sphere.radius, Range::above(0.0));
    check(found, name + " mass [kg]", sphere.mass, Range::atLeast(0.0));
    refuseIf(found);
  }
}

void refuseUnsound(const Cloth& cloth, const SolverMemory& memory, const SolverParams& params)
{
  std::vector<std::string> found;
  check(found, "solver/substeps", memory.substeps, Range::between(1, params.max_substeps));
  refuseIf(found);
  const bool limits = params.kind == SolverKind::FORCE_SPRINGS;
  refuseOtherSize(memory.inverse_mass_limit, limits ? cloth.mesh.particleCount() : 0,
                  "solver/inverse_mass_limit");
  refuseSmall(memory.inverse_mass_limit, true, "solver/inverse_mass_limit");
  const int particles = cloth.mesh.particleCount();
  refuseUnless(params.lines || memory.lines.empty(), "solver/lines", ": there are ",
               memory.lines.size(), " numbers of lines, must be 0 for a solver without lines");
  const SpringLines lines =
      memory.lines.empty() ? SpringLines() : SpringLines(cloth.springs, particles, memory.lines);
  if (!memory.blocks.empty())
  {
    SpringBlocks(cloth.springs, particles, memory.blocks, lines);  // which refuses
  }
}

}  // namespace cloth
