// Compares messages as they go over the wire.
#pragma once

#include <ros/serialization.h>

#include <algorithm>

namespace cloth_tearing
{

template <class Message>
bool sameBytes(const Message& a, const Message& b)
{
  const ros::SerializedMessage one = ros::serialization::serializeMessage(a);
  const ros::SerializedMessage other = ros::serialization::serializeMessage(b);
  return std::equal(one.buf.get(), one.buf.get() + one.num_bytes, other.buf.get(),
                    other.buf.get() + other.num_bytes);
}

}  // namespace cloth_tearing
