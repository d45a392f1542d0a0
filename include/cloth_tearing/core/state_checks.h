// Whether a state that was read belongs together.
#pragma once

#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/grasp.h"
#include "cloth_tearing/core/obstacles.h"
#include "cloth_tearing/core/solver.h"

namespace cloth
{

/// Ids and flags may be anything that ArchiveReader lets pass; `name` is what messages call the
/// cloth.
/// @throws Refusal naming the first thing that is missing, out of range or contradicts another
void refuseUnsound(const Cloth& cloth, const std::string& name);

/// The same for what acts on a sound cloth.
void refuseUnsound(const Cloth& cloth, const std::vector<Grasp>& grasps);
void refuseUnsound(const std::vector<Sphere>& spheres);
void refuseUnsound(const Cloth& cloth, const SolverMemory& memory, const SolverParams& params);

}  // namespace cloth
