// What is in the lanes of a block of springs.
#include "cloth_tearing/core/spring_lanes.h"

#include <limits>

namespace cloth
{

using kernels::LANES;

const SpringLaw& lawOf(const SpringTable& springs, int link)
{
  return link % 2 == 0 ? springs.structural[link / 2] : springs.bend_shear[link / 2];
}

Links noLinks()
{
  Links links;
  links.fill(-1);
  return links;
}

void writeLane(kernels::Lanes& lanes, int lane, const SpringLaw& law, Real watched)
{
  lanes.rest[lane] = law.rest;
  lanes.stiffness[lane] = law.stiffness;
  lanes.damping[lane] = law.damping;
  lanes.limit[lane] = watched * (law.rest * law.rest);
}

void clearLane(kernels::Lanes& lanes, int lane)
{
  lanes.rest[lane] = 0;
  lanes.stiffness[lane] = 0;
  lanes.damping[lane] = 0;
  lanes.limit[lane] = std::numeric_limits<float>::infinity();
}

kernels::Lanes noLanes()
{
  kernels::Lanes lanes;
  for (int lane = 0; lane < LANES; ++lane)
  {
    clearLane(lanes, lane);
  }
  return lanes;
}

}  // namespace cloth
