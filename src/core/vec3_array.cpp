// Vectors of particles, their x, y and z in an array each.
#include "cloth_tearing/core/vec3_array.h"

#include <algorithm>

#include "cloth_tearing/core/kernels.h"

namespace cloth
{

Vec3Array::Vec3Array(const std::vector<Vec3>& vectors)
{
  resize(vectors.size());
  for (std::size_t i = 0; i < size_; ++i)
  {
    (*this)[i] = vectors[i];
  }
}

void Vec3Array::resize(std::size_t size)
{
  grow(size);
  for (int k = 0; k < 3; ++k)
  {
    Real* values = axis(k);
    std::fill(values + std::min(size, size_), values + std::max(size, size_), Real(0));
  }
  size_ = size;
}

void Vec3Array::assign(std::size_t size, const Vec3& value)
{
  resize(size);
  for (int k = 0; k < 3; ++k)
  {
    std::fill(axis(k), axis(k) + size, value[k]);
  }
}

void Vec3Array::push_back(const Vec3& value)
{
  const Vec3 kept = value;  // which may be one of our own
  resize(size_ + 1);
  (*this)[size_ - 1] = kept;
}

void Vec3Array::copy(const Vec3Array& from, std::size_t begin, std::size_t end)
{
  for (int k = 0; k < 3; ++k)
  {
    std::copy(from.axis(k) + begin, from.axis(k) + end, axis(k) + begin);
  }
}

void Vec3Array::setZero()
{
  std::fill(data_.begin(), data_.end(), Real(0));
}

void Vec3Array::setZero(std::size_t begin, std::size_t end)
{
  for (int k = 0; k < 3; ++k)
  {
    std::fill(axis(k) + begin, axis(k) + end, Real(0));
  }
}

std::vector<Vec3> Vec3Array::toVectors() const
{
  return { begin(), end() };
}

bool Vec3Array::operator==(const Vec3Array& other) const
{
  return size_ == other.size_ && std::equal(begin(), end(), other.begin());
}

/// Makes room for so many, twice as much as before if it takes more: torn cloth grows in small
/// steps. Whole tiles may be read of each axis.
void Vec3Array::grow(std::size_t size)
{
  if (size <= pitch_)
  {
    return;
  }
  const std::size_t tiles = (std::max(size, 2 * size_) + kernels::TILE - 1) / kernels::TILE;
  const std::size_t pitch = tiles * kernels::TILE;
  std::vector<Real> data(3 * pitch, Real(0));
  for (std::size_t k = 0; k < 3; ++k)
  {
    std::copy_n(data_.begin() + static_cast<std::ptrdiff_t>(k * pitch_), size_,
                data.begin() + static_cast<std::ptrdiff_t>(k * pitch));
  }
  data_.swap(data);
  pitch_ = pitch;
}

}  // namespace cloth
