// The springs as the solvers stream through them.
#pragma once

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

/// Structural and bend-shear springs, both indexed by SpringId: a bend-shear spring belongs to the
/// interior spring that it crosses (3.1.2).
///
/// Stiffness and damping are the material's, shared out by its StiffnessLaw.
struct SpringTable
{
  std::vector<SpringLaw> structural;
  std::vector<SpringLaw> bend_shear;

  /// Writes every spring of `triangles` again.
  void refresh(const Mesh& mesh, const RestShape& rest, const Material& material,
               const std::vector<TriangleId>& triangles);

  /// The spring carries no load any more.
  void release(SpringId s);
};

SpringTable makeSpringTable(const Mesh& mesh, const RestShape& rest, const Material& material);

/// Sum of the rest areas of the triangles at `s` [m^2].
double adjacentArea(const Mesh& mesh, const RestShape& rest, SpringId s);

}  // namespace cloth
