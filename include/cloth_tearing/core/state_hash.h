// A number that two states share only if they are the same, bit for bit.
#pragma once

#include <cstdint>
#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/grasp.h"
#include "cloth_tearing/core/obstacles.h"

namespace cloth
{

/// Over positions, velocities, topology, damage, attachments, grasps and spheres.
std::uint64_t stateHash(const Cloth& cloth, const std::vector<Grasp>& grasps,
                        const std::vector<Sphere>& spheres);

}  // namespace cloth
