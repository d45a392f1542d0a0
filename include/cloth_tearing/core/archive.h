// Values as bytes, and bytes as values that have been looked at.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "cloth_tearing/core/types.h"
#include "cloth_tearing/core/vec3_array.h"

namespace cloth
{

/// Unsigned number as wide as T, to carry its bits.
template <class T>
using BitsOf = std::conditional_t<
    sizeof(T) == 8, std::uint64_t,
    std::conditional_t<sizeof(T) == 4, std::uint32_t,
                       std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint8_t>>>;

/// Writes values one after the other: little-endian, each as wide as its type, containers after
/// their length (64 bits). Names are not written.
///
/// Structures are written by `transfer(archive, structure)`, which ArchiveReader shares: it calls
/// `archive(name, member)` for each member.
class ArchiveWriter
{
public:
  static constexpr bool READS = false;

  template <class T>
  void operator()(const char* /*name*/, const T& value)
  {
    write(value);
  }

  /// An enumeration whose last value is `last`.
  template <class Enum>
  void choice(const char* /*name*/, const Enum& value, Enum /*last*/)
  {
    write(static_cast<std::uint8_t>(value));
  }

  const std::string& bytes() const { return bytes_; }
  std::string take() { return std::move(bytes_); }

private:
  template <class T>
  std::enable_if_t<std::is_arithmetic<T>::value> write(T value)
  {
    BitsOf<T> bits;
    std::memcpy(&bits, &value, sizeof bits);
    char raw[sizeof bits];
    for (std::size_t i = 0; i < sizeof bits; ++i)
    {
      raw[i] = static_cast<char>(bits >> 8 * i & 0xff);
    }
    bytes_.append(raw, sizeof raw);
  }

  template <class Scalar, int ROWS, int OPTIONS>
  void write(const Eigen::Matrix<Scalar, ROWS, 1, OPTIONS>& vector)
  {
    for (int i = 0; i < ROWS; ++i)
    {
      write(vector[i]);
    }
  }

  void write(const Quatd& rotation)
  {
    for (int i = 0; i < 4; ++i)
    {
      write(rotation.coeffs()[i]);
    }
  }

  template <class Tag>
  void write(Id<Tag> id)
  {
    write(id.index);
  }

  template <class T, std::size_t SIZE>
  void write(const std::array<T, SIZE>& values)
  {
    for (const T& value : values)
    {
      write(value);
    }
  }

  template <class T>
  void write(const std::vector<T>& values)
  {
    write(static_cast<std::uint64_t>(values.size()));
    for (const T& value : values)
    {
      write(value);
    }
  }

  void write(const Vec3Array& vectors) { write(vectors.toVectors()); }

  void write(const std::string& text)
  {
    write(static_cast<std::uint64_t>(text.size()));
    bytes_ += text;
  }

  template <class T>
  void write(const std::optional<T>& value)
  {
    write(value.has_value());
    if (value)
    {
      write(*value);
    }
  }

  template <class T>
  std::enable_if_t<std::is_class<T>::value> write(const T& structure)
  {
    transfer(*this, const_cast<T&>(structure));  // NOLINT: written, not changed
  }

  std::string bytes_;
};

/// Reads what ArchiveWriter wrote. Whatever the bytes are, it refuses or reads: no length
/// is believed before as many bytes are there, numbers are finite, flags 0 or 1, enumerations
/// within their range, ids -1 or more. What ids refer to is for others to check.
class ArchiveReader
{
public:
  static constexpr bool READS = true;

  /// @param bytes outlives the reader
  ArchiveReader(const char* bytes, std::size_t size) : next_(bytes), end_(bytes + size) {}

  /// @throws Refusal naming the place
  template <class T>
  void operator()(const char* name, T& value)
  {
    place_.push_back(name);
    read(value);
    place_.pop_back();
  }

  /// An enumeration whose last value is `last`. @throws Refusal naming the place
  template <class Enum>
  void choice(const char* name, Enum& value, Enum last)
  {
    place_.push_back(name);
    std::uint8_t index = 0;
    read(index);
    if (index > static_cast<int>(last))
    {
      refuse("is " + std::to_string(index) + ", must be at most " +
             std::to_string(static_cast<int>(last)));
    }
    value = static_cast<Enum>(index);
    place_.pop_back();
  }

  /// @throws Refusal if not everything has been read
  void expectEnd() const;

private:
  std::size_t left() const { return static_cast<std::size_t>(end_ - next_); }

  [[noreturn]] void refuse(const std::string& why) const;
  void refuseShort(std::uint64_t count, std::size_t size) const;

  template <class T>
  std::enable_if_t<std::is_arithmetic<T>::value> read(T& value)
  {
    BitsOf<T> bits = 0;
    if (left() < sizeof bits)
    {
      refuseShort(1, sizeof bits);
    }
    for (std::size_t i = 0; i < sizeof bits; ++i)
    {
      bits = static_cast<BitsOf<T>>(
          bits | static_cast<BitsOf<T>>(static_cast<unsigned char>(next_[i])) << 8 * i);
    }
    next_ += sizeof bits;
    look(value, bits);
  }

  template <class T>
  void look(T& value, BitsOf<T> bits) const
  {
    const bool flag = std::is_same<T, bool>::value || std::is_same<T, char>::value;
    if (flag && bits > 1)
    {
      refuse("is " + std::to_string(bits) + ", must be 0 or 1");
    }
    std::memcpy(&value, &bits, sizeof bits);
    if constexpr (std::is_floating_point<T>::value)
    {
      if (!std::isfinite(value))
      {
        refuse("is not finite");
      }
    }
  }

  template <class Scalar, int ROWS, int OPTIONS>
  void read(Eigen::Matrix<Scalar, ROWS, 1, OPTIONS>& vector)
  {
    for (int i = 0; i < ROWS; ++i)
    {
      read(vector[i]);
    }
  }

  void read(Quatd& rotation)
  {
    for (int i = 0; i < 4; ++i)
    {
      read(rotation.coeffs()[i]);
    }
  }

  template <class Tag>
  void read(Id<Tag>& id)
  {
    read(id.index);
    if (id.index < -1)
    {
      refuse("names element " + std::to_string(id.index) + ", must be at least -1");
    }
  }

  template <class T, std::size_t SIZE>
  void read(std::array<T, SIZE>& values)
  {
    for (T& value : values)
    {
      read(value);
    }
  }

  template <class T>
  void read(std::vector<T>& values)
  {
    const std::size_t count = readCount();
    values.clear();
    values.reserve(std::min(count, left() / sizeof(T)));
    for (std::size_t i = 0; i < count; ++i)
    {
      read(values.emplace_back());
    }
  }

  void read(Vec3Array& vectors)
  {
    std::vector<Vec3> read_vectors;
    read(read_vectors);
    vectors = read_vectors;
  }

  void read(std::string& text)
  {
    const std::size_t count = readCount();
    text.assign(next_, count);
    next_ += count;
  }

  /// Of elements that take a byte each at least.
  std::size_t readCount()
  {
    std::uint64_t count = 0;
    read(count);
    if (count > left())
    {
      refuseShort(count, 1);
    }
    return static_cast<std::size_t>(count);
  }

  template <class T>
  void read(std::optional<T>& value)
  {
    bool there = false;
    read(there);
    value.reset();
    if (there)
    {
      read(value.emplace());
    }
  }

  template <class T>
  std::enable_if_t<std::is_class<T>::value> read(T& structure)
  {
    transfer(*this, structure);
  }

  const char* next_;
  const char* end_;
  std::vector<const char*> place_;  ///< names from the outermost structure to the member
};

/// A number that tells whether bytes are what they were: any damage within eight of them shows,
/// other damage but for one case in 2^64.
std::uint64_t checksum(const char* bytes, std::size_t size);

}  // namespace cloth
