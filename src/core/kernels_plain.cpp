// The loops of kernels.h for every processor.
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "cloth_tearing/core/kernels.h"

#define REGISTER 16
#define NAME "plain"

namespace cloth
{
namespace kernels
{
namespace plain
{

#include "kernels.inl"

extern const Set& set;
const Set& set = SET;

}  // namespace plain
}  // namespace kernels
}  // namespace cloth
