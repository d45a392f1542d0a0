// Lines of springs solved as wholes.

// NOLINTBEGIN

constexpr int VECTORS = LANES / WIDTH;

/// The smallest number that is not subnormal.
constexpr float SMALLEST = 0x1p-126f;

/// Particles of a node, as many as a register has.
struct Places
{
  End way;
  End start;
  Vector w;
};

inline Places loadPlaces(const Particles& particles, int first)
{
  return { { load(particles.way[0] + first), load(particles.way[1] + first),
             load(particles.way[2] + first) },
           { load(particles.start[0] + first), load(particles.start[1] + first),
             load(particles.start[2] + first) },
           load(particles.inverse_mass + first) };
}

/// From one node to the next, now.
inline End between(const Places& from, const Places& to)
{
  const End moved = to.way - from.way;
  const End before = to.start - from.start;
  return { before.x + moved.x, before.y + moved.y, before.z + moved.z };
}

/// What the way up takes from rung to rung.
struct Climb
{
  Places at;
  End d;           ///< of the rung before
  Vector give;     ///< stiffness and damping of it, by dt: what a spring pulls for its length
  Vector inverse;  ///< of its pivot
  Vector pull;
};

/// Row by row of the system: the pull p over its length of spring k is such that
/// d_k^2 (1 + s (w_a + w_b)) p_k - s w_a (d_k-1 d_k) p_k-1 - s w_b (d_k d_k+1) p_k+1 is what
/// pullOf() has above the line, s being stiffness and damping.
/// @return a bit for each lane of the register that has a spring longer than its limit
inline unsigned climb(Climb& below, const Places& next, const Lanes& lanes, int lane, float dt,
                      Rung* before, Rung& rung)
{
  const Vector zero = Vector{};
  const End moved = next.way - below.at.way;
  const End started = next.start - below.at.start;
  const End d = { started.x + moved.x, started.y + moved.y, started.z + moved.z };
  const Vector squared = dot(d, d);
  const Vector squared_before = dot(started, started);
  const Vector stiffness = load(lanes.stiffness + lane) * (dt * dt);
  const Vector damping = load(lanes.damping + lane) * dt;
  const Vector length = root(squared);
  const Vector stretch = length * (length - load(lanes.rest + lane));
  const Vector give = stiffness + damping;
  const Vector coupling = below.at.w * dot(below.d, d);
  const Vector share = below.give * coupling * below.inverse;
  const Vector answer = give * coupling;
  const Vector pivot = squared * (give * (below.at.w + next.w) + 1.0f) - answer * share;
  const Vector inverse = quotient(zero + 1.0f, pivot, SMALLEST);  // never infinite
  const Vector pull =
      (stiffness * stretch + damping * dot(d, moved) + answer * below.pull) * inverse;
  if (before != nullptr)
  {
    store(before->share + lane, share);
  }
  store(rung.pull + lane, pull);
  store(rung.share + lane, zero);
  below = { next, d, give, inverse, pull };
  const Vector longest = squared_before > squared ? squared_before : squared;
  const Mask over = ~(longest <= load(lanes.limit + lane));  // a NaN must not hide
  return __builtin_expect(any(over), 0) ? bitsOf(over) << lane : 0;
}

/// Sums up pulls on those of inverse mass 0.
__attribute__((noinline, cold)) void noteHeldNode(const Vector& w, const End& pull,
                                                  const int* particle, float* const held[3])
{
  for (int i = 0; i < WIDTH; ++i)
  {
    if (w[i] == 0 && particle[i] >= 0)
    {
      held[0][particle[i]] += pull.x[i];
      held[1][particle[i]] += pull.y[i];
      held[2][particle[i]] += pull.z[i];
    }
  }
}

/// Moves particles of a node by the springs above and below it.
inline void pullNode(const Ladder& ladder, const Particles& particles, int node, int lane,
                     const Places& places, const End& pull)
{
  const Vector zero = Vector{};
  const int first = ladder.first + node * ladder.step + lane;
  storeEnd(particles.way, first, moved(places.way, places.w, pull));
  if (__builtin_expect(any(places.w == zero), 0))
  {
    if (ladder.particle != nullptr)
    {
      noteHeldNode(places.w, pull, ladder.particle + node * LANES + lane, particles.held);
    }
    else
    {
      addHeld(particles.held, first, places.w, zero + 1.0f, pull);
    }
  }
}

int sweepLadder(const Ladder& ladder, const Particles& particles, float dt, Rung* rungs,
                Note* notes)
{
  const Vector zero = Vector{};
  int noted = 0;
  Climb climbs[VECTORS];
  for (int v = 0; v < VECTORS; ++v)
  {
    climbs[v] = {
      loadPlaces(particles, ladder.first + v * WIDTH), { zero, zero, zero }, zero, zero, zero
    };
  }
  for (int k = 0; k < ladder.rungs; ++k)
  {
    const int next = ladder.first + (k + 1) * ladder.step;
    unsigned over = 0;
    for (int v = 0; v < VECTORS; ++v)
    {
      over |= climb(climbs[v], loadPlaces(particles, next + v * WIDTH), ladder.lanes[k], v * WIDTH,
                    dt, k > 0 ? rungs + k - 1 : nullptr, rungs[k]);
    }
    if (__builtin_expect(over != 0, 0))
    {
      notes[noted++] = { k, over };
    }
  }
  for (int v = 0; v < VECTORS; ++v)
  {
    const int lane = v * WIDTH;
    Places above = climbs[v].at;
    End from_above = { zero, zero, zero };
    Vector pull = zero;
    for (int k = ladder.rungs - 1; k >= 0; --k)
    {
      const Places below = loadPlaces(particles, ladder.first + k * ladder.step + lane);
      const End d = between(below, above);
      pull = load(rungs[k].pull + lane) + load(rungs[k].share + lane) * pull;
      const End here = { pull * d.x, pull * d.y, pull * d.z };
      pullNode(ladder, particles, k + 1, lane, above, from_above - here);
      above = below;
      from_above = here;
    }
    pullNode(ladder, particles, 0, lane, above, from_above);
  }
  return noted;
}

// Registers of four, whatever the instruction set.

using Four = float __attribute__((vector_size(16)));

using FourInts = int __attribute__((vector_size(16)));

#if defined(__clang__)
#define SHUFFLED(x, y, a, b, c, d) __builtin_shufflevector(x, y, a, b, c, d)
#else  // before version 12, gcc knows but this one
#define SHUFFLED(x, y, a, b, c, d) __builtin_shuffle(x, y, FourInts{ a, b, c, d })
#endif

inline void transposeFour(Four& r0, Four& r1, Four& r2, Four& r3)
{
  const Four t0 = SHUFFLED(r0, r1, 0, 4, 1, 5);
  const Four t1 = SHUFFLED(r0, r1, 2, 6, 3, 7);
  const Four t2 = SHUFFLED(r2, r3, 0, 4, 1, 5);
  const Four t3 = SHUFFLED(r2, r3, 2, 6, 3, 7);
  r0 = SHUFFLED(t0, t2, 0, 1, 4, 5);
  r1 = SHUFFLED(t0, t2, 2, 3, 6, 7);
  r2 = SHUFFLED(t1, t3, 0, 1, 4, 5);
  r3 = SHUFFLED(t1, t3, 2, 3, 6, 7);
}

#undef SHUFFLED

inline Four loadFour(const float* from)
{
  Four values;
  __builtin_memcpy(&values, from, sizeof(values));
  return values;
}

inline void storeFour(float* to, Four values)
{
  __builtin_memcpy(to, &values, sizeof(values));
}

/// From a number of one node to that of the next.
constexpr int STRIDE = sizeof(Node) / sizeof(float);

/// One number of four particles that follow one another in each of four lanes, to four nodes.
/// @param to of the first node
inline void packRows(const float* from, const int* particle, float* to)
{
  Four r0 = loadFour(from + particle[0]);
  Four r1 = loadFour(from + particle[1]);
  Four r2 = loadFour(from + particle[2]);
  Four r3 = loadFour(from + particle[3]);
  transposeFour(r0, r1, r2, r3);
  storeFour(to, r0);
  storeFour(to + STRIDE, r1);
  storeFour(to + 2 * STRIDE, r2);
  storeFour(to + 3 * STRIDE, r3);
}

inline void unpackRows(const float* from, const int* particle, float* to)
{
  Four r0 = loadFour(from);
  Four r1 = loadFour(from + STRIDE);
  Four r2 = loadFour(from + 2 * STRIDE);
  Four r3 = loadFour(from + 3 * STRIDE);
  transposeFour(r0, r1, r2, r3);
  storeFour(to + particle[0], r0);
  storeFour(to + particle[1], r1);
  storeFour(to + particle[2], r2);
  storeFour(to + particle[3], r3);
}

/// What nobody holds and no spring pulls.
inline void clearNode(Node& node)
{
  for (int lane = 0; lane < LANES; ++lane)
  {
    for (int k = 0; k < 3; ++k)
    {
      node.way[k][lane] = 0.0f;
      node.start[k][lane] = 0.0f;
    }
    node.inverse_mass[lane] = 1.0f;
  }
}

inline void packNode(const Particles& particles, const int* particle, int first, int end,
                     Node& node)
{
  for (int lane = first; lane < end; ++lane)
  {
    const int p = particle[lane];
    const bool there = p >= 0;
    for (int k = 0; k < 3; ++k)
    {
      node.way[k][lane] = there ? particles.way[k][p] : 0.0f;
      node.start[k][lane] = there ? particles.start[k][p] : 0.0f;
    }
    node.inverse_mass[lane] = there ? particles.inverse_mass[p] : 1.0f;
  }
}

void packNodes(const Particles& particles, const NodeList& list, Node* nodes)
{
  for (int i = 0; i < list.count && list.lanes < LANES; ++i)
  {
    clearNode(nodes[i]);
  }
  for (int i = 0; i < list.count; i += 4)
  {
    const int* four = list.particle + i * LANES;
    const int rows = list.in_rows[i / 4] != 0 ? list.lanes / 4 * 4 : 0;  // lanes copied by rows
    for (int lane = 0; lane < rows; lane += 4)
    {
      for (int k = 0; k < 3; ++k)
      {
        packRows(particles.way[k], four + lane, nodes[i].way[k] + lane);
        packRows(particles.start[k], four + lane, nodes[i].start[k] + lane);
      }
      packRows(particles.inverse_mass, four + lane, nodes[i].inverse_mass + lane);
    }
    for (int node = i; node < i + 4 && node < list.count; ++node)
    {
      packNode(particles, list.particle + node * LANES, rows, list.lanes, nodes[node]);
    }
  }
}

inline void unpackNode(const Particles& particles, const int* particle, int first, int end,
                       const Node& node)
{
  for (int lane = first; lane < end; ++lane)
  {
    const int p = particle[lane];
    for (int k = 0; k < 3 && p >= 0; ++k)
    {
      particles.way[k][p] = node.way[k][lane];
    }
  }
}

void unpackNodes(const Particles& particles, const NodeList& list, const Node* nodes)
{
  for (int i = 0; i < list.count; i += 4)
  {
    const int* four = list.particle + i * LANES;
    const int rows = list.in_rows[i / 4] != 0 ? list.lanes / 4 * 4 : 0;
    for (int lane = 0; lane < rows; lane += 4)
    {
      for (int k = 0; k < 3; ++k)
      {
        unpackRows(nodes[i].way[k] + lane, four + lane, particles.way[k]);
      }
    }
    for (int node = i; node < i + 4 && node < list.count; ++node)
    {
      unpackNode(particles, list.particle + node * LANES, rows, list.lanes, nodes[node]);
    }
  }
}

// NOLINTEND
