// The springs as the solvers stream through them.
#pragma once

#include <cstdint>
#include <vector>

#include "cloth_tearing/core/material.h"
#include "cloth_tearing/core/mesh.h"
#include "cloth_tearing/core/rest_shape.h"

namespace cloth
{

/// One damped spring between two particles.
struct SpringLaw
{
  int a = -1;  ///< particle indices; -1: carries nothing (border without bend-shear, released)
  int b = -1;
  Real rest = 0;       ///< rest length [m]
  Real stiffness = 0;  ///< [N/m]
  Real damping = 0;    ///< [N s/m]

  bool active() const { return a >= 0; }
};

/// Which springs were written, one after the other, for those who keep something by spring.
class ChangeLog
{
public:
  void add(SpringId s) { springs_.push_back(s.index); }

  /// Everybody has followed: those so far are not kept any more.
  void forget();

  std::uint64_t count() const { return forgotten_ + springs_.size(); }

  /// How many are kept.
  std::size_t size() const { return springs_.size(); }

  /// Those after the first `seen`, by SpringId, maybe more than once.
  /// @return false if they are not known any more
  bool since(std::uint64_t seen, std::vector<int>& springs) const;

private:
  std::vector<int> springs_;
  std::uint64_t forgotten_ = 0;
};

/// Structural and bend-shear springs, both indexed by SpringId: a bend-shear spring belongs to the
/// interior spring that it crosses (3.1.2).
///
/// Stiffness and damping are the material's, shared out by its StiffnessLaw.
struct SpringTable
{
  std::vector<SpringLaw> structural;
  std::vector<SpringLaw> bend_shear;
  ChangeLog changes;

  /// Writes these again.
  void refresh(const Mesh& mesh, const RestShape& rest, const Material& material,
               const std::vector<SpringId>& some);

  /// The structural spring carries no load any more.
  void release(SpringId s);

  /// The bend-shear spring that crosses `s` carries no load any more.
  void releaseBendShear(SpringId s);
};

SpringTable makeSpringTable(const Mesh& mesh, const RestShape& rest, const Material& material);

/// Sum of the rest areas of the triangles at `s` [m^2].
double adjacentArea(const Mesh& mesh, const RestShape& rest, SpringId s);

}  // namespace cloth
