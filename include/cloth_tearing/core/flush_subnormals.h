// Keeps numbers too small to matter from slowing a step.
#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace cloth
{

/// While it lives, this thread's numbers below the normal range count as zero.
///
/// Cloth that comes to rest in a plane moves across it by ever less, down to where each operation
/// takes a hundred cycles. Zero is as good there, and the same on every x86-64.
class FlushSubnormals
{
public:
#if defined(__SSE2__)
  FlushSubnormals() : before_(_mm_getcsr())
  {
    _mm_setcsr(before_ | FLUSH_TO_ZERO | INPUTS_ARE_ZERO);
  }
  ~FlushSubnormals()
  {
    _mm_setcsr(before_);
  }
#else
  FlushSubnormals()
  {
  }
#endif
  FlushSubnormals(const FlushSubnormals&) = delete;
  FlushSubnormals& operator=(const FlushSubnormals&) = delete;

private:
#if defined(__SSE2__)
  static constexpr unsigned FLUSH_TO_ZERO = 0x8000;
  static constexpr unsigned INPUTS_ARE_ZERO = 0x0040;
  unsigned before_;
#endif
};

}  // namespace cloth
