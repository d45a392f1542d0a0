// Where the particles are and how they move.
#pragma once

#include <vector>

#include "cloth_tearing/core/mesh.h"
#include "cloth_tearing/core/types.h"
#include "cloth_tearing/core/vec3_array.h"

namespace cloth
{

/// One contiguous array per quantity, indexed by ParticleId, because the step streams through them
/// (thesis 2.1.1). The cloth frame has its origin near the cloth, so that float is fine enough.
struct ParticleState
{
  Vec3Array position;              ///< [m], cloth frame
  Vec3Array velocity;              ///< [m/s], cloth frame
  Vec3Array previous;              ///< position at the start of the step [m]
  std::vector<Real> inverse_mass;  ///< [1/kg]; 0 pins the particle

  int size() const { return static_cast<int>(position.size()); }
  void resize(int particles);
};

}  // namespace cloth
