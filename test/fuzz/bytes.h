// What the fuzzers share: bytes as choices, and how a broken promise is reported.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace cloth
{
namespace fuzz
{

/// Takes choices from the bytes of a fuzzer, one after the other; 0 when they are used up.
class Bytes
{
public:
  /// @param data outlives this
  Bytes(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size) {}

  bool empty() const { return next_ == end_; }

  /// A number from 0 to `n` - 1, of one byte, or of two if `n` is more than 256; `n` up to 65536.
  int below(int n)
  {
    int value = take();
    if (n > 256)
    {
      value = 256 * value + take();
    }
    return value % n;
  }

  /// The next `count` bytes, fewer if there are not so many.
  std::string text(int count)
  {
    const std::ptrdiff_t there = std::min<std::ptrdiff_t>(count, end_ - next_);
    const std::string taken(next_, next_ + there);
    next_ += there;
    return taken;
  }

private:
  int take() { return empty() ? 0 : *next_++; }

  const std::uint8_t* next_;
  const std::uint8_t* end_;
};

/// Ends the fuzzer with a finding unless the promise holds.
inline void expect(bool holds, const std::string& broken)
{
  if (!holds)
  {
    std::fprintf(stderr, "broken promise: %s\n", broken.c_str());
    std::abort();
  }
}

}  // namespace fuzz
}  // namespace cloth
