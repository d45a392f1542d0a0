// What is in the lanes of a block of springs.
#pragma once

#include <array>
#include <cstdint>

#include "cloth_tearing/core/kernels.h"
#include "cloth_tearing/core/spring_table.h"

namespace cloth
{

/// Springs of lanes, see linkOf(); -1: none.
using Links = std::array<int, kernels::LANES>;

/// What a solver counts: two links for each SpringId, the second of them its bend-shear spring.
constexpr int linkOf(int spring, bool bend_shear)
{
  return 2 * spring + (bend_shear ? 1 : 0);
}

const SpringLaw& lawOf(const SpringTable& springs, int link);

constexpr std::uint64_t bitOf(int bit)
{
  return std::uint64_t{ 1 } << bit;
}

/// @param bits not 0
inline int lowestBit(std::uint64_t bits)
{
  return __builtin_ctzll(bits);
}

Links noLinks();

/// What a spring is like, into a lane.
/// @param watched squared length over squared rest length above which it is noted [-]
void writeLane(kernels::Lanes& lanes, int lane, const SpringLaw& law, Real watched);

/// Makes a lane one without a spring.
void clearLane(kernels::Lanes& lanes, int lane);
kernels::Lanes noLanes();

}  // namespace cloth
