// Loops from particle to particle.

// NOLINTBEGIN

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

// NOLINTEND
