// Mixes words into one number.
#pragma once

#include <cstdint>

namespace cloth
{

/// FNV-1a over words, with the high half folded in. Each step is a bijection of the value and of
/// the word: inputs of equal length that differ in one word only never have the same hash.
class WordHash
{
public:
  void add(std::uint64_t word)
  {
    value_ = (value_ ^ word) * 0x100000001b3ull;
    value_ ^= value_ >> 32;
  }

  std::uint64_t value() const { return value_; }

private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

}  // namespace cloth
