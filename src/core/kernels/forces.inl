// Forces of springs on both their ends.

// NOLINTBEGIN

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
  force.factor = quotient(above, squared);
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

// NOLINTEND
