// The wind on triangles.

// NOLINTBEGIN

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
  push.factor = quotient(air.drag * third * resists * dot(against, push.normal), squared);
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
      pushes[r] =
          pushOf({ loadEnd(air.position, a), loadEnd(air.position, b), loadEnd(air.position, c),
                   loadEnd(air.velocity, a), loadEnd(air.velocity, b), loadEnd(air.velocity, c) },
                 air, load(areas[i].area + r * WIDTH));
    }
    // One after the other, and all lanes of each: the three stretches may overlap, and what is
    // added first must not depend on the width.
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

void blowEnds(const Air& air, const TriangleEnds* ends, const Areas* areas, int count)
{
  for (int lane = 0; lane < count * LANES; lane += WIDTH)
  {
    const int block = lane / LANES;
    const int first = lane % LANES;
    const int* a = ends[block].a + first;
    const int* b = ends[block].b + first;
    const int* c = ends[block].c + first;
    const Push push =
        pushOf({ gather(air.position, a), gather(air.position, b), gather(air.position, c),
                 gather(air.velocity, a), gather(air.velocity, b), gather(air.velocity, c) },
               air, load(areas[block].area + first));
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

// NOLINTEND
