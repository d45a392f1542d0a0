// Pieces of cloth that hang on one grasp alone.
#pragma once

#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/grasp.h"

namespace cloth
{

/// What one grasp holds that hangs on nothing else.
struct LooseHold
{
  int pieces = 0;
  double area = 0.0;  ///< rest area of them all [m^2]
  double mass = 0.0;  ///< [kg]
};

/// For each grasp the pieces that it holds without a pin or another grasp. Floods the pieces that
/// are held.
std::vector<LooseHold> looseHolds(const Cloth& cloth, const std::vector<Grasp>& grasps);

}  // namespace cloth
