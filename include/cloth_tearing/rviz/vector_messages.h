// Points and vectors of the tools as messages.
#pragma once

#include "cloth_tearing/core/types.h"

namespace cloth_tearing
{

/// @tparam Message geometry_msgs/Point or Vector3
template <class Message>
Message toMessage(const cloth::Vec3d& x)
{
  Message message;
  message.x = x.x();
  message.y = x.y();
  message.z = x.z();
  return message;
}

}  // namespace cloth_tearing
