// Puts pieces of cloth to rest that have left the world.
#pragma once

#include <string>
#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/obstacles.h"
#include "cloth_tearing/core/pieces.h"

namespace cloth
{

/// Finds loose pieces beyond the bounds, which are then no longer stepped or drawn.
class LoosePieces
{
public:
  /// @return a note for each piece put to rest
  std::vector<std::string> rest(Cloth& cloth, const ContactParams& params);

private:
  Pieces pieces_;
};

}  // namespace cloth
