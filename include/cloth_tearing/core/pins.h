// Which particles of a model are pinned from the start.
#pragma once

#include <string>
#include <vector>

#include "cloth_tearing/core/cloth_model.h"

namespace cloth
{

/// Pins by edge, region and list; all of them together. Coordinates are the model's own.
struct PinParams
{
  struct Region
  {
    Vec3d center = Vec3d::Zero();  ///< [m], model frame
    double radius = 0.0;           ///< [m], > 0
  };

  /// "top", "bottom", "left", "right": the model's particles at its greatest or least y or x,
  /// within a hundredth of its size there.
  std::vector<std::string> edges;
  std::vector<Region> regions;
  std::vector<int> particles;  ///< vertex indices of the imported model
};

/// Everything wrong with `pins` by themselves, whatever the model.
std::vector<std::string> problems(const PinParams& pins);

/// The particles that `pins` names, ascending, each once.
///
/// @throws Refusal naming an unknown edge, a region without particles, an index out of range
std::vector<int> pinnedParticles(const ClothModel& model, const PinParams& pins);

}  // namespace cloth
