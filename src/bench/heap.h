// How much memory the process has asked for, and how often.
#pragma once

#include <cstdint>

namespace cloth_bench
{

/// Bytes that are in use on the heap; 0 where the C library does not tell [B].
double heapInUse();

/// How often operator new was called so far.
std::int64_t allocations();

}  // namespace cloth_bench
