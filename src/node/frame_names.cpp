// Judges names of tf frames that come from outside.
#include "cloth_tearing/node/frame_names.h"

#include "cloth_tearing/core/limits.h"

namespace cloth_tearing
{

void checkFrameName(std::vector<std::string>& found, const std::string& field,
                    const std::string& frame)
{
  if (frame.size() > static_cast<std::size_t>(cloth::MAX_FRAME_NAME))
  {
    found.push_back(field + " is a name of " + std::to_string(frame.size()) +
                    " characters, must be at most " + std::to_string(cloth::MAX_FRAME_NAME));
  }
  else if (!frame.empty() && frame.front() == '/')
  {
    found.push_back(field + " is \"" + frame + "\", must not begin with a slash");
  }
}

}  // namespace cloth_tearing
