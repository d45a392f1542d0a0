// Particles in motion for tests of sweeps.
#pragma once

#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/kernels.h"

namespace cloth
{

/// Particles that a sweep works on, some of them held.
struct Motion
{
  std::vector<float> way[3];
  std::vector<float> start[3];
  std::vector<float> held[3];
  std::vector<float> inverse_mass;

  explicit Motion(const Cloth& cloth, std::uint64_t seed)
  {
    std::mt19937_64 random(seed);
    const auto small = [&random] { return 1e-3F * (float(random() % 2001) - 1000.0F) / 1000.0F; };
    for (int i = 0; i < cloth.state.size(); ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        way[k].push_back(small());
        start[k].push_back(cloth.state.position[i][k] + small());
        held[k].push_back(0.0F);
      }
      inverse_mass.push_back(random() % 20 == 0 ? 0.0F : 100.0F + float(random() % 100));
    }
  }

  /// Appends the bits that a sweep may have written.
  void appendTo(std::vector<unsigned>& bits) const
  {
    for (int k = 0; k < 3; ++k)
    {
      for (const std::vector<float>* values : { &way[k], &held[k] })
      {
        const std::size_t before = bits.size();
        bits.resize(before + values->size());
        std::memcpy(&bits[before], values->data(), values->size() * sizeof(float));
      }
    }
  }

  kernels::Particles particles()
  {
    return { { way[0].data(), way[1].data(), way[2].data() },
             { start[0].data(), start[1].data(), start[2].data() },
             inverse_mass.data(),
             { held[0].data(), held[1].data(), held[2].data() } };
  }
};

}  // namespace cloth
