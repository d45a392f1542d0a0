// Judges names of tf frames that come from outside.
#pragma once

#include <string>
#include <vector>

namespace cloth_tearing
{

/// Adds a sentence to `found` if `frame` cannot name a tf frame: it begins with a slash, for which
/// tf would look in vain, or is longer than MAX_FRAME_NAME. What an empty one means is the field's.
void checkFrameName(std::vector<std::string>& found, const std::string& field,
                    const std::string& frame);

}  // namespace cloth_tearing
