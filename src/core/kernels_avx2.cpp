// The loops of kernels.h for processors with AVX2.
#if defined(__AVX2__)
#include <immintrin.h>

#include "cloth_tearing/core/kernels.h"

#define REGISTER 32
#define NAME "avx2"

namespace cloth
{
namespace kernels
{
namespace avx2
{

#include "kernels.inl"

extern const Set& set;
const Set& set = SET;

}  // namespace avx2
}  // namespace kernels
}  // namespace cloth
#endif
