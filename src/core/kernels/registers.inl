// Registers of floats, and the ends of springs in them.

// NOLINTBEGIN

using Vector = float __attribute__((vector_size(REGISTER)));
using Mask = int __attribute__((vector_size(REGISTER)));
constexpr int WIDTH = REGISTER / static_cast<int>(sizeof(float));

// What lies in memory is aligned as its numbers are, no more; copies say so to each compiler.

inline Vector load(const float* from)
{
  Vector values;
  __builtin_memcpy(&values, from, sizeof(values));
  return values;
}

inline void store(float* to, Vector values)
{
  __builtin_memcpy(to, &values, sizeof(values));
}

#if defined(__AVX512F__)

inline Vector root(Vector x)
{
  return (Vector)_mm512_sqrt_ps((__m512)x);
}

inline bool any(Mask mask)
{
  return _mm512_test_epi32_mask((__m512i)mask, (__m512i)mask) != 0;
}

#elif defined(__AVX2__)

inline Vector root(Vector x)
{
  return (Vector)_mm256_sqrt_ps((__m256)x);
}

inline bool any(Mask mask)
{
  return _mm256_movemask_ps((__m256)mask) != 0;
}

#elif defined(__SSE2__)

inline Vector root(Vector x)
{
  return (Vector)_mm_sqrt_ps((__m128)x);
}

inline bool any(Mask mask)
{
  return _mm_movemask_ps((__m128)mask) != 0;
}

#else

inline Vector root(Vector x)
{
  Vector y;
  for (int i = 0; i < WIDTH; ++i)
  {
    y[i] = __builtin_sqrtf(x[i]);
  }
  return y;
}

inline bool any(Mask mask)
{
  int all = 0;
  for (int i = 0; i < WIDTH; ++i)
  {
    all |= mask[i];
  }
  return all != 0;
}

#endif

/// The ends of springs, one in each lane.
struct End
{
  Vector x, y, z;
};

inline End operator-(const End& a, const End& b)
{
  return { a.x - b.x, a.y - b.y, a.z - b.z };
}

inline Vector dot(const End& a, const End& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Adds `pull * d`: the way that it moves a particle of that much inverse mass.
inline End moved(const End& way, Vector pull, const End& d)
{
  return { way.x + pull * d.x, way.y + pull * d.y, way.z + pull * d.z };
}

/// The same bits of a mask in an integer.
__attribute__((noinline, cold)) unsigned bitsOf(const Mask& mask)
{
  int lanes[WIDTH];
  __builtin_memcpy(lanes, &mask, sizeof(mask));
  unsigned bits = 0;
  for (int i = 0; i < WIDTH; ++i)
  {
    bits |= lanes[i] != 0 ? 1u << i : 0u;
  }
  return bits;
}

inline End loadEnd(const float* const axes[3], int first)
{
  return { load(axes[0] + first), load(axes[1] + first), load(axes[2] + first) };
}

template <class Float>
inline void storeEnd(Float* const axes[3], int first, const End& end)
{
  store(axes[0] + first, end.x);
  store(axes[1] + first, end.y);
  store(axes[2] + first, end.z);
}

/// Zero where `below` is not above `least`: nothing is divided there, so that traps find real mistakes.
inline Vector quotient(Vector above, Vector below, float least = 0.0f)
{
  const Mask divides = below > Vector{} + least;
  return divides ? above / (divides ? below : Vector{} + 1.0f) : Vector{};
}

// NOLINTEND
