// Stiffness, damping and ends of every spring, from mesh, rest shape and material.
#include "cloth_tearing/core/spring_table.h"

namespace cloth
{
namespace
{

/// What a spring of this length gets of the material's stiffness and damping [-].
double shareOf(const Material& material, double area, double length)
{
  return material.stiffness_law == StiffnessLaw::PER_SPRING ? 1.0 : area / (length * length);
}

void refreshSpring(SpringTable& table, const Mesh& mesh, const RestShape& rest,
                   const Material& material, SpringId s)
{
  const double area = adjacentArea(mesh, rest, s);
  const Spring& spring = mesh.spring(s);
  SpringLaw& structural = table.structural[s.index];
  const bool released = structural.rest > 0 && !structural.active();
  const double length = rest.length[s.index];
  structural.rest = static_cast<Real>(length);
  const double share = shareOf(material, area, length);
  structural.stiffness = static_cast<Real>(material.stiffness * share);
  structural.damping = static_cast<Real>(material.damping * share);
  if (!released)
  {
    structural.a = spring.particles[0].index;
    structural.b = spring.particles[1].index;
  }

  SpringLaw& bend = table.bend_shear[s.index];
  bend = SpringLaw{};
  const double reach = rest.bend_length[s.index];
  if (reach > 0.0)
  {
    const double bend_share = shareOf(material, area, reach);
    const double bend_damping =
        material.damping * material.bend_shear_stiffness / material.stiffness;
    bend.a = mesh.opposite(s, 0).index;
    bend.b = mesh.opposite(s, 1).index;
    bend.rest = static_cast<Real>(reach);
    bend.stiffness = static_cast<Real>(material.bend_shear_stiffness * bend_share);
    bend.damping = static_cast<Real>(bend_damping * bend_share);
  }
}

}  // namespace

void ChangeLog::forget()
{
  forgotten_ += springs_.size();
  springs_.clear();
}

bool ChangeLog::since(std::uint64_t seen, std::vector<int>& springs) const
{
  if (seen < forgotten_ || seen > count())
  {
    return false;
  }
  springs.assign(springs_.begin() + static_cast<std::ptrdiff_t>(seen - forgotten_), springs_.end());
  return true;
}

double adjacentArea(const Mesh& mesh, const RestShape& rest, SpringId s)
{
  double area = 0.0;
  for (TriangleId t : mesh.spring(s).triangles)
  {
    area += t.valid() ? rest.area[t.index] : 0.0;
  }
  return area;
}

void SpringTable::refresh(const Mesh& mesh, const RestShape& rest, const Material& material,
                          const std::vector<SpringId>& some)
{
  structural.resize(mesh.springCount());
  bend_shear.resize(mesh.springCount());
  for (SpringId s : some)
  {
    refreshSpring(*this, mesh, rest, material, s);
    changes.add(s);
  }
}

void SpringTable::release(SpringId s)
{
  structural[s.index].a = -1;
  structural[s.index].b = -1;
  changes.add(s);
}

void SpringTable::releaseBendShear(SpringId s)
{
  bend_shear[s.index] = SpringLaw{};
  changes.add(s);
}

SpringTable makeSpringTable(const Mesh& mesh, const RestShape& rest, const Material& material)
{
  SpringTable table;
  table.structural.resize(mesh.springCount());
  table.bend_shear.resize(mesh.springCount());
  for (int i = 0; i < mesh.springCount(); ++i)
  {
    refreshSpring(table, mesh, rest, material, SpringId{ i });
  }
  return table;
}

}  // namespace cloth
