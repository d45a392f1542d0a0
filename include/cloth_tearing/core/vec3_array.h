// Vectors of particles, their x, y and z in an array each.
#pragma once

#include <array>
#include <cstddef>
#include <iterator>
#include <vector>

#include "cloth_tearing/core/types.h"

namespace cloth
{

/// A sequence of vectors laid out for loops that work on many of them at a time: all x, then all y,
/// then all z. To others an element is like a Vec3 that lives elsewhere: what operator[] returns
/// reads and writes it, and stays good until the array grows.
class Vec3Array
{
public:
  using Reference = Eigen::Map<Vec3, Eigen::Unaligned, Eigen::InnerStride<>>;
  using ConstReference = Eigen::Map<const Vec3, Eigen::Unaligned, Eigen::InnerStride<>>;

  /// Goes over elements; those of a const array cannot be written.
  template <class Array, class Element>
  class Iterator
  {
  public:
    using iterator_category = std::input_iterator_tag;  // elements are no real references
    using value_type = Vec3;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = Element;

    Iterator(Array& array, std::size_t index) : array_(&array), index_(index) {}
    Element operator*() const { return (*array_)[index_]; }
    Iterator& operator++()
    {
      ++index_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return index_ == other.index_; }
    bool operator!=(const Iterator& other) const { return index_ != other.index_; }

  private:
    Array* array_;
    std::size_t index_;
  };

  Vec3Array() = default;
  Vec3Array(std::size_t size, const Vec3& value) { assign(size, value); }
  Vec3Array(
      const std::vector<Vec3>& vectors);  // NOLINT(google-explicit-constructor): the same data

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  Reference operator[](std::size_t i) { return Reference(&data_[i], stride()); }
  ConstReference operator[](std::size_t i) const { return ConstReference(&data_[i], stride()); }

  ConstReference back() const { return (*this)[size_ - 1]; }

  auto begin() { return Iterator<Vec3Array, Reference>(*this, 0); }
  auto end() { return Iterator<Vec3Array, Reference>(*this, size_); }
  auto begin() const { return Iterator<const Vec3Array, ConstReference>(*this, 0); }
  auto end() const { return Iterator<const Vec3Array, ConstReference>(*this, size_); }

  /// All x (0), y (1) or z (2).
  Real* axis(int axis) { return data_.data() + static_cast<std::size_t>(axis) * pitch_; }
  const Real* axis(int axis) const
  {
    return data_.data() + static_cast<std::size_t>(axis) * pitch_;
  }

  std::array<const Real*, 3> axes() const { return { { axis(0), axis(1), axis(2) } }; }

  /// New elements are zero.
  void resize(std::size_t size);
  void assign(std::size_t size, const Vec3& value);
  void push_back(const Vec3& value);

  /// Takes elements `begin` to `end` - 1 from another array that has them.
  void copy(const Vec3Array& from, std::size_t begin, std::size_t end);
  void setZero();
  void setZero(std::size_t begin, std::size_t end);  ///< elements `begin` to `end` - 1

  std::vector<Vec3> toVectors() const;

  bool operator==(const Vec3Array& other) const;
  bool operator!=(const Vec3Array& other) const { return !(*this == other); }

private:
  Eigen::InnerStride<> stride() const
  {
    return Eigen::InnerStride<>(static_cast<Eigen::Index>(pitch_));
  }
  void grow(std::size_t size);

  std::vector<Real> data_;
  std::size_t size_ = 0;
  std::size_t pitch_ = 0;  ///< from x to y and from y to z: what fits
};

}  // namespace cloth
