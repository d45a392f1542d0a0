// Reads messages from bytes whose counts may lie.
#pragma once

#include <ros/serialization.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace cloth_tearing
{

/// Bytes that are no message of the type that they should be.
class MalformedMessage : public std::runtime_error
{
public:
  explicit MalformedMessage(const std::string& reason) : std::runtime_error("malformed: " + reason)
  {
  }
};

/// A stream for ros::serialization. roscpp's own makes room for as many elements as an array says
/// it has before it looks whether there are so many bytes: eight of them take gigabytes. This one
/// looks first: what a message takes in memory is in proportion to what was sent. Messages with
/// arrays of a fixed length are none of ours.
class BoundedStream
{
public:
  BoundedStream(std::uint8_t* data, std::size_t length) : data_(data), left_(length) {}

  /// Reads `message`, which is all of the bytes or their beginning.
  /// @throws MalformedMessage
  template <class Message>
  static void read(std::uint8_t* data, std::size_t length, Message& message)
  {
    BoundedStream(data, length).next(message);
  }

  // What ros::serialization::Serializer asks a stream for.

  template <class T>
  void next(T& value)
  {
    ros::serialization::Serializer<T>::read(*this, value);
  }

  template <class T, class Allocator>
  void next(std::vector<T, Allocator>& values)
  {
    std::uint32_t count = 0;
    next(count);
    const std::size_t least =
        std::max<std::size_t>(ros::serialization::serializationLength(T()), 1);
    if (count > left_ / least)
    {
      throw MalformedMessage("there have to be " + std::to_string(count) +
                             " elements of at least " + std::to_string(least) + " bytes, but " +
                             std::to_string(left_) + " bytes are left");
    }
    values.resize(count);
    for (T& value : values)
    {
      next(value);
    }
  }

  /// @return where the next `length` bytes are
  std::uint8_t* advance(std::uint32_t length)
  {
    if (length > left_)
    {
      throw MalformedMessage("there have to be " + std::to_string(length) + " more bytes, but " +
                             std::to_string(left_) + " are left");
    }
    std::uint8_t* const at = data_;
    data_ += length;
    left_ -= length;
    return at;
  }

private:
  std::uint8_t* data_;
  std::size_t left_;  ///< bytes
};

}  // namespace cloth_tearing
