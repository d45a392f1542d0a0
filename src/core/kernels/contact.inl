// Which particles are near a ball, and those that lie on the floor.

// NOLINTBEGIN

void tileSides(const float* const start[3], const float* const position[3], const Ball& ball,
               unsigned char* sides, int tiles)
{
  for (int tile = 0; tile < tiles; ++tile)
  {
    unsigned found = 0;
    for (int k = 0; k < 3; ++k)
    {
      Mask not_below = Mask{};
      Mask not_above = Mask{};
      for (int i = tile * TILE; i < (tile + 1) * TILE; i += WIDTH)
      {
        const Vector from = load(start[k] + i);
        const Vector to = load(position[k] + i);
        not_below |= ~((from < ball.low[k]) & (to < ball.low[k]));
        not_above |= ~((from > ball.high[k]) & (to > ball.high[k]));
      }
      found |= any(not_below) ? 0u : 1u << (2 * k);
      found |= any(not_above) ? 0u : 2u << (2 * k);
    }
    sides[tile] = static_cast<unsigned char>(found);
  }
}

/// Bit `shift` where both are above `limit`, which is more than 0, and the next one where both are
/// below its negative.
inline Mask beyond(Vector from, Vector to, Vector limit, int shift)
{
  const Mask above = (from > limit) & (to > limit);
  const Mask below = (from < -limit) & (to < -limit);
  return (above & static_cast<int>(1u << shift)) | (below & static_cast<int>(2u << shift));
}

inline Vector magnitude(Vector x)
{
  return x < 0.0f ? -x : x;
}

void particleSides(const float* const start[3], const float* const position[3], const Ball& ball,
                   unsigned* sides)
{
  const float root2 = 1.41421356f;
  const float root3 = 1.73205081f;
  for (int i = 0; i < TILE; i += WIDTH)
  {
    Mask found = Mask{};
    End from;
    End to;
    Vector size = Vector{};
    for (int k = 0; k < 3; ++k)
    {
      const Vector s = load(start[k] + i);
      const Vector p = load(position[k] + i);
      found |= (s < ball.low[k]) & (p < ball.low[k]) & (1 << (2 * k));
      found |= (s > ball.high[k]) & (p > ball.high[k]) & (2 << (2 * k));
      const Vector a = s - ball.start[k];
      const Vector b = p - ball.end[k];
      size += magnitude(a) + magnitude(b);
      (k == 0 ? from.x : k == 1 ? from.y : from.z) = a;
      (k == 0 ? to.x : k == 1 ? to.y : to.z) = b;
    }
    const Vector reach = ball.reach + 4e-6f * size;  // whoever measures it again rounds otherwise
    const Vector reach2 = root2 * reach;
    const Vector reach3 = root3 * reach;
    const End& f = from;
    const End& t = to;
    found |= beyond(f.x, t.x, reach, 6);
    found |= beyond(f.y, t.y, reach, 8);
    found |= beyond(f.z, t.z, reach, 10);
    found |= beyond(f.x + f.y, t.x + t.y, reach2, 12);
    found |= beyond(f.x - f.y, t.x - t.y, reach2, 14);
    found |= beyond(f.x + f.z, t.x + t.z, reach2, 16);
    found |= beyond(f.x - f.z, t.x - t.z, reach2, 18);
    found |= beyond(f.y + f.z, t.y + t.z, reach2, 20);
    found |= beyond(f.y - f.z, t.y - t.z, reach2, 22);
    found |= beyond(f.x + f.y + f.z, t.x + t.y + t.z, reach3, 24);
    found |= beyond(f.x + f.y - f.z, t.x + t.y - t.z, reach3, 26);
    found |= beyond(f.x - f.y + f.z, t.x - t.y + t.z, reach3, 28);
    found |= beyond(f.x - f.y - f.z, t.x - t.y - t.z, reach3, 30);
    __builtin_memcpy(sides + i, &found, sizeof(found));
  }
}

inline Vector least(Vector a, Vector b)
{
  return b < a ? b : a;
}

void land(float* const position[3], float* const velocity[3], const float* const start[3],
          const float* inverse_mass, const Floor& floor, float* const change[3], unsigned* landed,
          int tiles)
{
  const Vector zero = Vector{};
  for (int tile = 0; tile < tiles; ++tile)
  {
    landed[tile] = 0;
    for (int r = 0; r < TILE; r += WIDTH)
    {
      const int i = tile * TILE + r;
      const Vector z = load(position[2] + i);
      const Mask lands = (z < floor.height) & (load(inverse_mass + i) > zero);
      if (!any(lands))
      {
        continue;
      }
      landed[tile] |= bitsOf(lands) << r;
      const End v = loadEnd(velocity, i);
      // Products with the floor's normal, zeros and all: what is no number on one axis stays none.
      const Vector approach = -(v.x * 0.0f + (v.y * 0.0f + v.z));
      const Vector slip_x = v.x + approach * 0.0f;
      const Vector slip_y = v.y + approach * 0.0f;
      const Vector slip = root(slip_x * slip_x + slip_y * slip_y);
      const Vector rubbed = least(slip, floor.friction * approach);
      const Vector share = quotient(rubbed, slip);
      const Mask hits = approach > zero;
      const End turn = { hits ? zero - share * slip_x : zero, hits ? zero - share * slip_y : zero,
                         hits ? approach : zero };
      const End after = { v.x + turn.x, v.y + turn.y, v.z + turn.z };
      // What rubs off the speed rubs off the way too; what sticks has not moved at all.
      const Mask sticks = (after.x == zero) & (after.y == zero);
      const End from = loadEnd(start, i);
      const End x = loadEnd(position, i);
      const Vector there_x = sticks ? from.x : x.x + floor.dt * turn.x;
      const Vector there_y = sticks ? from.y : x.y + floor.dt * turn.y;
      const Vector up = least(Vector{} + floor.height, from.z + floor.push);
      const Vector there_z = z < up ? up : z;
      storeEnd(position, i, { lands ? there_x : x.x, lands ? there_y : x.y, lands ? there_z : z });
      storeEnd(velocity, i,
               { lands ? after.x : v.x, lands ? after.y : v.y, lands ? after.z : v.z });
      storeEnd(change, i, turn);
    }
  }
}

// NOLINTEND
