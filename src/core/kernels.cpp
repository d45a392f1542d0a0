// Chooses the loops that this processor runs fastest.
#include "cloth_tearing/core/kernels.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace cloth
{
namespace kernels
{

namespace plain
{
extern const Set& set;
}
#if defined(CLOTH_TEARING_X86)
namespace avx2
{
extern const Set& set;
}
namespace avx512
{
extern const Set& set;
}
#endif

namespace
{

/// Those that this processor runs, the plainest first.
struct Available
{
  const Set* sets[3] = {};
  std::size_t count = 0;

  Available()
  {
    sets[count++] = &plain::set;
#if defined(CLOTH_TEARING_X86)
    if (__builtin_cpu_supports("avx2"))
    {
      sets[count++] = &avx2::set;
    }
    if (__builtin_cpu_supports("avx512f"))
    {
      sets[count++] = &avx512::set;
    }
#endif
  }
};

}  // namespace

std::size_t available(const Set* const*& sets)
{
  static const Available found;
  sets = found.sets;
  return found.count;
}

namespace
{

const char* wish()
{
  return std::getenv("CLOTH_TEARING_SIMD");
}

/// @return nullptr if this processor has none of that name
const Set* find(const char* name)
{
  const Set* const* sets = nullptr;
  const std::size_t count = available(sets);
  const Set* const* const found = std::find_if(
      sets, sets + count, [name](const Set* set) { return std::strcmp(set->name, name) == 0; });
  return found != sets + count ? *found : nullptr;
}

const Set& choose()
{
  const Set* const* sets = nullptr;
  const std::size_t count = available(sets);
  const Set* const wanted = wish() != nullptr ? find(wish()) : nullptr;
  return wanted != nullptr ? *wanted : *sets[count - 1];
}

}  // namespace

const char* ignoredWish()
{
  return wish() != nullptr && find(wish()) == nullptr ? wish() : nullptr;
}

const Set& best()
{
  static const Set& chosen = choose();
  return chosen;
}

}  // namespace kernels
}  // namespace cloth
