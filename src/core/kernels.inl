// The loops of kernels.h. Included once for each instruction set, into a namespace of its own.

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

struct Pull
{
  End d;          ///< from end to end
  Vector factor;  ///< what draws the ends together, by d and each one's inverse mass
  Mask over;      ///< longer than the limit, when the step began or now
  Mask held;      ///< at least one end does not move
};

/// Lengths and speeds come from ways, not from differences of places: these are too coarse for a
/// short step.
inline Pull pullOf(const End& way_a, const End& way_b, const End& start_a, const End& start_b,
                   Vector wa, Vector wb, const Lanes& lanes, int lane, float dt)
{
  const Vector zero = Vector{};
  const End moved = way_b - way_a;
  const End before = start_b - start_a;
  const End d = { before.x + moved.x, before.y + moved.y, before.z + moved.z };
  const Vector squared = dot(d, d);
  const Vector squared_before = dot(before, before);
  const Vector stiffness = load(lanes.stiffness + lane) * (dt * dt);
  const Vector damping = load(lanes.damping + lane) * dt;

  // Of the length l: lambda / l, where lambda is (stiffness (l - rest) + damping moved d / l) over
  // (stiffness + damping) w + 1; one division for all.
  const Vector length = root(squared);
  const Vector stretch = length * (length - load(lanes.rest + lane));
  const Vector above = stiffness * stretch + damping * dot(d, moved);
  const Vector below = squared * ((stiffness + damping) * (wa + wb) + 1.0f);

  Pull pull;
  pull.d = d;
  pull.factor = below > zero ? above / below : zero;
  const Vector longest = squared_before > squared ? squared_before : squared;
  pull.over = ~(longest <= load(lanes.limit + lane));  // a NaN must not hide
  pull.held = (wa * wb == zero) & (stiffness > zero);
  return pull;
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

/// Sums up the pulls on ends that do not move.
/// @param a, b particle of lane i
template <class ParticleOf>
__attribute__((noinline, cold)) void noteHeld(const Pull& pull, const Vector& wa, const Vector& wb,
                                              const ParticleOf& a, const ParticleOf& b,
                                              float* const held[3])
{
  const unsigned lanes = bitsOf(pull.held);
  for (int i = 0; i < WIDTH; ++i)
  {
    if ((lanes >> i & 1u) == 0)
    {
      continue;
    }
    const float by[3] = { pull.factor[i] * pull.d.x[i], pull.factor[i] * pull.d.y[i],
                          pull.factor[i] * pull.d.z[i] };
    for (int k = 0; k < 3; ++k)
    {
      if (wa[i] == 0)
      {
        held[k][a(i)] += by[k];
      }
      if (wb[i] == 0)
      {
        held[k][b(i)] -= by[k];
      }
    }
  }
}

// -- springs in runs -----------------------------------------------------------------------------

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

struct FromFirst
{
  int first;
  int operator()(int lane) const { return first + lane; }
};

int sweepRuns(const Particles& particles, const RunEnds* ends, const Lanes* lanes, int count,
              float dt, Note* notes)
{
  int noted = 0;
  float* const way[3] = { particles.way[0], particles.way[1], particles.way[2] };
  const float* const start[3] = { particles.start[0], particles.start[1], particles.start[2] };
  const float* const inverse_mass = particles.inverse_mass;
  for (int i = 0; i < count; ++i)
  {
    unsigned over = 0;
    for (int lane = 0; lane < LANES; lane += WIDTH)
    {
      const int a = ends[i].a + lane;
      const int b = ends[i].b + lane;
      const Vector wa = load(inverse_mass + a);
      const Vector wb = load(inverse_mass + b);
      const End way_a = loadEnd(way, a);
      const Pull pull = pullOf(way_a, loadEnd(way, b), loadEnd(start, a), loadEnd(start, b), wa, wb,
                               lanes[i], lane, dt);
      storeEnd(way, a, moved(way_a, wa * pull.factor, pull.d));
      // Once more: the two stretches may overlap, though no two springs share a particle.
      storeEnd(way, b, moved(loadEnd(way, b), -wb * pull.factor, pull.d));
      if (__builtin_expect(any(pull.over), 0))
      {
        over |= bitsOf(pull.over) << lane;
      }
      if (__builtin_expect(any(pull.held), 0))
      {
        noteHeld(pull, wa, wb, FromFirst{ a }, FromFirst{ b }, particles.held);
      }
    }
    if (__builtin_expect(over != 0, 0))
    {
      notes[noted++] = { i, over };
    }
  }
  return noted;
}

// -- springs between any particles -----------------------------------------------------------------

struct FourVectors
{
  Vector x, y, z, w;
};

inline End endOf(const FourVectors& v)
{
  return { v.x, v.y, v.z };
}

#if defined(__AVX512F__)

inline __m512 fourRecords(const Record* records, const int* index)
{
  __m512 r = _mm512_castps128_ps512(_mm_load_ps(&records[index[0]].x));
  r = _mm512_insertf32x4(r, _mm_load_ps(&records[index[4]].x), 1);
  r = _mm512_insertf32x4(r, _mm_load_ps(&records[index[8]].x), 2);
  return _mm512_insertf32x4(r, _mm_load_ps(&records[index[12]].x), 3);
}

inline void storeFour(Record* records, const int* index, __m512 r)
{
  _mm_store_ps(&records[index[0]].x, _mm512_castps512_ps128(r));
  _mm_store_ps(&records[index[4]].x, _mm512_extractf32x4_ps(r, 1));
  _mm_store_ps(&records[index[8]].x, _mm512_extractf32x4_ps(r, 2));
  _mm_store_ps(&records[index[12]].x, _mm512_extractf32x4_ps(r, 3));
}

inline void transpose(__m512& r0, __m512& r1, __m512& r2, __m512& r3)
{
  const __m512d t0 = _mm512_castps_pd(_mm512_unpacklo_ps(r0, r1));
  const __m512d t1 = _mm512_castps_pd(_mm512_unpackhi_ps(r0, r1));
  const __m512d t2 = _mm512_castps_pd(_mm512_unpacklo_ps(r2, r3));
  const __m512d t3 = _mm512_castps_pd(_mm512_unpackhi_ps(r2, r3));
  r0 = _mm512_castpd_ps(_mm512_unpacklo_pd(t0, t2));
  r1 = _mm512_castpd_ps(_mm512_unpackhi_pd(t0, t2));
  r2 = _mm512_castpd_ps(_mm512_unpacklo_pd(t1, t3));
  r3 = _mm512_castpd_ps(_mm512_unpackhi_pd(t1, t3));
}

using Row = __m512;

#elif defined(__AVX2__)

inline __m256 fourRecords(const Record* records, const int* index)
{
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(&records[index[0]].x)),
                              _mm_load_ps(&records[index[4]].x), 1);
}

inline void storeFour(Record* records, const int* index, __m256 r)
{
  _mm_store_ps(&records[index[0]].x, _mm256_castps256_ps128(r));
  _mm_store_ps(&records[index[4]].x, _mm256_extractf128_ps(r, 1));
}

inline void transpose(__m256& r0, __m256& r1, __m256& r2, __m256& r3)
{
  const __m256d t0 = _mm256_castps_pd(_mm256_unpacklo_ps(r0, r1));
  const __m256d t1 = _mm256_castps_pd(_mm256_unpackhi_ps(r0, r1));
  const __m256d t2 = _mm256_castps_pd(_mm256_unpacklo_ps(r2, r3));
  const __m256d t3 = _mm256_castps_pd(_mm256_unpackhi_ps(r2, r3));
  r0 = _mm256_castpd_ps(_mm256_unpacklo_pd(t0, t2));
  r1 = _mm256_castpd_ps(_mm256_unpackhi_pd(t0, t2));
  r2 = _mm256_castpd_ps(_mm256_unpacklo_pd(t1, t3));
  r3 = _mm256_castpd_ps(_mm256_unpackhi_pd(t1, t3));
}

using Row = __m256;

#elif defined(__SSE2__)

inline __m128 fourRecords(const Record* records, const int* index)
{
  return _mm_load_ps(&records[index[0]].x);
}

inline void storeFour(Record* records, const int* index, __m128 r)
{
  _mm_store_ps(&records[index[0]].x, r);
}

inline void transpose(__m128& r0, __m128& r1, __m128& r2, __m128& r3)
{
  _MM_TRANSPOSE4_PS(r0, r1, r2, r3);
}

using Row = __m128;

#endif

#if defined(__SSE2__)

inline FourVectors loadRecords(const Record* records, const int* index)
{
  Row r0 = fourRecords(records, index);
  Row r1 = fourRecords(records, index + 1);
  Row r2 = fourRecords(records, index + 2);
  Row r3 = fourRecords(records, index + 3);
  transpose(r0, r1, r2, r3);
  return { (Vector)r0, (Vector)r1, (Vector)r2, (Vector)r3 };
}

inline void storeRecords(Record* records, const int* index, const End& end, Vector w)
{
  Row r0 = (Row)end.x;
  Row r1 = (Row)end.y;
  Row r2 = (Row)end.z;
  Row r3 = (Row)w;
  transpose(r0, r1, r2, r3);
  storeFour(records, index, r0);
  storeFour(records, index + 1, r1);
  storeFour(records, index + 2, r2);
  storeFour(records, index + 3, r3);
}

#else

inline FourVectors loadRecords(const Record* records, const int* index)
{
  FourVectors v;
  for (int i = 0; i < WIDTH; ++i)
  {
    v.x[i] = records[index[i]].x;
    v.y[i] = records[index[i]].y;
    v.z[i] = records[index[i]].z;
    v.w[i] = records[index[i]].w;
  }
  return v;
}

inline void storeRecords(Record* records, const int* index, const End& end, Vector w)
{
  for (int i = 0; i < WIDTH; ++i)
  {
    records[index[i]] = { end.x[i], end.y[i], end.z[i], w[i] };
  }
}

#endif

struct FromRecords
{
  const int* index;
  const int* particle;
  int operator()(int lane) const { return particle[index[lane]]; }
};

int sweepRecords(const Records& records, float* const held[3], const RecordEnds* ends,
                 const Lanes* lanes, int count, float dt, Note* notes)
{
  int noted = 0;
  for (int i = 0; i < count; ++i)
  {
    unsigned over = 0;
    for (int lane = 0; lane < LANES; lane += WIDTH)
    {
      const int* a = ends[i].a + lane;
      const int* b = ends[i].b + lane;
      const FourVectors way_a = loadRecords(records.way, a);
      const FourVectors way_b = loadRecords(records.way, b);
      const FourVectors start_a = loadRecords(records.start, a);
      const FourVectors start_b = loadRecords(records.start, b);
      const Pull pull = pullOf(endOf(way_a), endOf(way_b), endOf(start_a), endOf(start_b), way_a.w,
                               way_b.w, lanes[i], lane, dt);
      storeRecords(records.way, a, moved(endOf(way_a), way_a.w * pull.factor, pull.d), way_a.w);
      storeRecords(records.way, b, moved(endOf(way_b), -way_b.w * pull.factor, pull.d), way_b.w);
      if (__builtin_expect(any(pull.over), 0))
      {
        over |= bitsOf(pull.over) << lane;
      }
      if (__builtin_expect(any(pull.held), 0))
      {
        noteHeld(pull, way_a.w, way_b.w, FromRecords{ a, records.particle },
                 FromRecords{ b, records.particle }, held);
      }
    }
    if (__builtin_expect(over != 0, 0))
    {
      notes[noted++] = { i, over };
    }
  }
  return noted;
}

// -- forces of springs -----------------------------------------------------------------------------

struct Force
{
  End d;          ///< from end to end
  Vector factor;  ///< by d, the force on the first end [N/m]
  Mask over;      ///< longer than the limit
};

inline Force forceOf(const End& a, const End& b, const End& velocity_a, const End& velocity_b,
                     const Lanes& lanes, int lane)
{
  Force force;
  force.d = b - a;
  const Vector squared = dot(force.d, force.d);
  const Vector length = root(squared);
  const Vector above = load(lanes.stiffness + lane) * (length * (length - load(lanes.rest + lane))) +
                       load(lanes.damping + lane) * dot(force.d, velocity_b - velocity_a);
  force.factor = squared > Vector{} ? above / squared : Vector{};
  force.over = ~(squared <= load(lanes.limit + lane));  // a NaN must not hide
  return force;
}

int pullRuns(const Bodies& bodies, const RunEnds* ends, const Lanes* lanes, int count, Note* notes)
{
  int noted = 0;
  for (int i = 0; i < count; ++i)
  {
    unsigned over = 0;
    for (int lane = 0; lane < LANES; lane += WIDTH)
    {
      const int a = ends[i].a + lane;
      const int b = ends[i].b + lane;
      const Force force =
          forceOf(loadEnd(bodies.position, a), loadEnd(bodies.position, b),
                  loadEnd(bodies.velocity, a), loadEnd(bodies.velocity, b), lanes[i], lane);
      storeEnd(bodies.force, a, moved(loadEnd(bodies.force, a), force.factor, force.d));
      storeEnd(bodies.force, b, moved(loadEnd(bodies.force, b), -force.factor, force.d));
      if (__builtin_expect(any(force.over), 0))
      {
        over |= bitsOf(force.over) << lane;
      }
    }
    if (__builtin_expect(over != 0, 0))
    {
      notes[noted++] = { i, over };
    }
  }
  return noted;
}

int pullRecords(const BodyRecords& records, const RecordEnds* ends, const Lanes* lanes, int count,
                Note* notes)
{
  int noted = 0;
  for (int i = 0; i < count; ++i)
  {
    unsigned over = 0;
    for (int lane = 0; lane < LANES; lane += WIDTH)
    {
      const int* a = ends[i].a + lane;
      const int* b = ends[i].b + lane;
      const Force force = forceOf(
          endOf(loadRecords(records.position, a)), endOf(loadRecords(records.position, b)),
          endOf(loadRecords(records.velocity, a)), endOf(loadRecords(records.velocity, b)),
          lanes[i], lane);
      const End on_a = endOf(loadRecords(records.force, a));
      const End on_b = endOf(loadRecords(records.force, b));
      storeRecords(records.force, a, moved(on_a, force.factor, force.d), Vector{});
      storeRecords(records.force, b, moved(on_b, -force.factor, force.d), Vector{});
      if (__builtin_expect(any(force.over), 0))
      {
        over |= bitsOf(force.over) << lane;
      }
    }
    if (__builtin_expect(over != 0, 0))
    {
      notes[noted++] = { i, over };
    }
  }
  return noted;
}

// -- wind ------------------------------------------------------------------------------------------

inline End cross(const End& a, const End& b)
{
  return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

struct Push
{
  End normal;     ///< of a triangle, as long as twice its area [m^2]
  Vector factor;  ///< by it, the force on each corner [N/m^2]
};

/// Corners and their velocities.
struct Corners
{
  End a, b, c, velocity_a, velocity_b, velocity_c;
};

inline Push pushOf(const Corners& corners, const Air& air, Vector rest_area)
{
  const Vector zero = Vector{};
  const End& va = corners.velocity_a;
  const End& vb = corners.velocity_b;
  const End& vc = corners.velocity_c;
  const float third = 1.0f / 3.0f;
  const End against = { air.wind[0] - third * (va.x + vb.x + vc.x),
                        air.wind[1] - third * (va.y + vb.y + vc.y),
                        air.wind[2] - third * (va.z + vb.z + vc.z) };
  Push push;
  push.normal = cross(corners.b - corners.a, corners.c - corners.a);
  const Vector squared = dot(push.normal, push.normal);
  // Overstretched cloth has grown by its holes: no more than its rest area resists the air.
  const Vector area = 0.5f * root(squared);
  const Vector resists = area < rest_area ? area : rest_area;
  push.factor = squared > zero ? air.drag * third * resists * dot(against, push.normal) / squared
                               : zero;
  return push;
}

void blowRuns(const Air& air, const TriangleRun* runs, const Areas* areas, int count)
{
  constexpr int REGISTERS = LANES / WIDTH;
  for (int i = 0; i < count; ++i)
  {
    Push pushes[REGISTERS];
    for (int r = 0; r < REGISTERS; ++r)
    {
      const int a = runs[i].a + r * WIDTH;
      const int b = runs[i].b + r * WIDTH;
      const int c = runs[i].c + r * WIDTH;
      pushes[r] = pushOf({ loadEnd(air.position, a), loadEnd(air.position, b),
                           loadEnd(air.position, c), loadEnd(air.velocity, a),
                           loadEnd(air.velocity, b), loadEnd(air.velocity, c) },
                         air, load(areas[i].area + r * WIDTH));
    }
    // One after the other, and all lanes of each: the three stretches may overlap, and what is added
    // first must not depend on the width.
    const int corners[3] = { runs[i].a, runs[i].b, runs[i].c };
    for (int first : corners)
    {
      for (int r = 0; r < REGISTERS; ++r)
      {
        const int corner = first + r * WIDTH;
        storeEnd(air.force, corner,
                 moved(loadEnd(air.force, corner), pushes[r].factor, pushes[r].normal));
      }
    }
  }
}

inline End gather(const float* const axes[3], const int* index)
{
  End end;
  for (int i = 0; i < WIDTH; ++i)
  {
    end.x[i] = axes[0][index[i]];
    end.y[i] = axes[1][index[i]];
    end.z[i] = axes[2][index[i]];
  }
  return end;
}

void blowEnds(const Air& air, const TriangleEnds& ends, const Areas& areas)
{
  for (int lane = 0; lane < LANES; lane += WIDTH)
  {
    const int* a = ends.a + lane;
    const int* b = ends.b + lane;
    const int* c = ends.c + lane;
    const Push push = pushOf({ gather(air.position, a), gather(air.position, b),
                               gather(air.position, c), gather(air.velocity, a),
                               gather(air.velocity, b), gather(air.velocity, c) },
                             air, load(areas.area + lane));
    float force[3][WIDTH];
    store(force[0], push.factor * push.normal.x);
    store(force[1], push.factor * push.normal.y);
    store(force[2], push.factor * push.normal.z);
    for (int i = 0; i < WIDTH; ++i)
    {
      const int corners[3] = { a[i], b[i], c[i] };
      for (int corner : corners)
      {
        for (int k = 0; k < 3; ++k)
        {
          air.force[k][corner] += force[k][i];
        }
      }
    }
  }
}

// -- particle by particle --------------------------------------------------------------------------

void predict(float* __restrict way, const float* __restrict velocity,
             const float* __restrict acceleration, const float* __restrict inverse_mass,
             const float* __restrict start, const float* __restrict position, float dt, int count)
{
  for (int i = 0; i < count; ++i)
  {
    const float free = dt * (velocity[i] + dt * acceleration[i]);
    const float led = position[i] - start[i];
    way[i] = (inverse_mass[i] > 0 ? free : led) + 0.0f;  // no -0: lanes without a spring add 0
  }
}

void finish(const float* __restrict way, const float* __restrict start,
            const float* __restrict inverse_mass, float dt, float* __restrict position,
            float* __restrict velocity, int count)
{
  for (int i = 0; i < count; ++i)
  {
    position[i] = inverse_mass[i] > 0 ? start[i] + way[i] : position[i];
    velocity[i] = inverse_mass[i] > 0 ? way[i] / dt : velocity[i];
  }
}

void accelerate(float* __restrict acceleration, const float* __restrict velocity, float outer,
                float friction, int count)
{
  for (int i = 0; i < count; ++i)
  {
    acceleration[i] = outer - friction * velocity[i];
  }
}

void addForce(float* __restrict acceleration, const float* __restrict force,
              const float* __restrict inverse_mass, int count)
{
  for (int i = 0; i < count; ++i)
  {
    acceleration[i] += inverse_mass[i] * force[i];
  }
}

unsigned sides(const float* const start[3], const float* const position[3], const float low[3],
               const float high[3], unsigned char* __restrict sides, int count)
{
  for (int i = 0; i < count; ++i)
  {
    sides[i] = 0;
  }
  for (int k = 0; k < 3; ++k)
  {
    const float* __restrict from = start[k];
    const float* __restrict to = position[k];
    const int below = 1 << (2 * k);
    const int above = 2 << (2 * k);
    for (int i = 0; i < count; ++i)
    {
      const int is_below = (from[i] < low[k]) & (to[i] < low[k]) ? below : 0;
      const int is_above = (from[i] > high[k]) & (to[i] > high[k]) ? above : 0;
      sides[i] = static_cast<unsigned char>(sides[i] | is_below | is_above);
    }
  }
  unsigned all = 0xff;
  for (int i = 0; i < count; ++i)
  {
    all &= sides[i];
  }
  return all;
}

bool calm(const float* const position[3], const float* const velocity[3], float limit, int count)
{
  int wild = 0;
  for (int i = 0; i < count; ++i)
  {
    const float x = position[0][i] + position[1][i] + position[2][i];
    const float squared = velocity[0][i] * velocity[0][i] + velocity[1][i] * velocity[1][i] +
                          velocity[2][i] * velocity[2][i];
    wild |= static_cast<int>(!(squared <= limit)) | static_cast<int>(!(x - x == 0.0f));
  }
  return wild == 0;
}

bool above(const float* __restrict values, const float* __restrict limits, int count)
{
  int found = 0;
  for (int i = 0; i < count; ++i)
  {
    found |= static_cast<int>(values[i] > limits[i]);
  }
  return found != 0;
}

void integrate(float* __restrict position, float* __restrict velocity,
               const float* __restrict acceleration, const float* __restrict force,
               const float* __restrict inverse_mass, const float* __restrict limit,
               float* __restrict held, float dt, int count)
{
  for (int i = 0; i < count; ++i)
  {
    const bool moves = inverse_mass[i] > 0;
    const float w = inverse_mass[i] < limit[i] ? inverse_mass[i] : limit[i];
    const float after = velocity[i] + dt * (acceleration[i] + w * force[i]);
    const float there = position[i] + dt * after;
    velocity[i] = moves ? after : velocity[i];
    position[i] = moves ? there : position[i];
    held[i] = moves ? held[i] : held[i] + force[i];
  }
}

constexpr Set SET = { NAME,     sweepRuns, sweepRecords, pullRuns, pullRecords, 
                      blowRuns, blowEnds, accelerate, addForce, sides, calm, predict, finish, above, integrate };

// NOLINTEND
