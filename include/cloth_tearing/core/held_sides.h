// Which side of a tear a gripper goes on holding.
#pragma once

#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/grasp.h"

namespace cloth
{

/// A held particle that was doubled stays held on the side where the gripper has neighbours of it
/// that the other side has not: on both, if the tear runs through its patch, on one along the edge,
/// where the sides have those in common between which it runs. If there are none such, on the side
/// that the pull does not take away.
///
/// @param edit that doubled a particle, which the cloth has followed
/// @param stretched the spring that tore
void keepHeld(Cloth& cloth, std::vector<Grasp>& grasps, const Edit& edit, SpringId stretched);

}  // namespace cloth
