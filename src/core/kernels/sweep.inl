// A sweep of XPBD over blocks of springs.

// NOLINTBEGIN

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
  pull.factor = quotient(above, below);
  const Vector longest = squared_before > squared ? squared_before : squared;
  pull.over = ~(longest <= load(lanes.limit + lane));  // a NaN must not hide
  pull.held = (wa * wb == zero) & (stiffness > zero);
  return pull;
}

/// Sums up the pulls on ends that lie side by side; those that move take nothing.
inline void addHeld(float* const held[3], int first, Vector inverse_mass, Vector factor,
                    const End& d)
{
  const Vector zero = Vector{};
  storeEnd(held, first, moved(loadEnd(held, first), inverse_mass == zero ? factor : zero, d));
}

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
        addHeld(particles.held, a, wa, pull.factor, pull.d);
        addHeld(particles.held, b, wb, -pull.factor, pull.d);
      }
    }
    if (__builtin_expect(over != 0, 0))
    {
      notes[noted++] = { i, over };
    }
  }
  return noted;
}

/// The same for ends anywhere.
/// @param a, b records of the ends
__attribute__((noinline, cold)) void noteHeld(const Pull& pull, const Vector& wa, const Vector& wb,
                                              const int* a, const int* b, const int* particle,
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
        held[k][particle[a[i]]] += by[k];
      }
      if (wb[i] == 0)
      {
        held[k][particle[b[i]]] -= by[k];
      }
    }
  }
}

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
        noteHeld(pull, way_a.w, way_b.w, a, b, records.particle, held);
      }
    }
    if (__builtin_expect(over != 0, 0))
    {
      notes[noted++] = { i, over };
    }
  }
  return noted;
}

// NOLINTEND
