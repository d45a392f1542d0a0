// The loops of kernels.h for processors with AVX-512.
#if defined(__AVX512F__)
#include <immintrin.h>

#include "cloth_tearing/core/kernels.h"

#define REGISTER 64
#define NAME "avx512"

namespace cloth
{
namespace kernels
{
namespace avx512
{

#include "kernels.inl"

extern const Set& set;
const Set& set = SET;

}  // namespace avx512
}  // namespace kernels
}  // namespace cloth
#endif
