// Claims of pins by edge, region and list.
#include "cloth_tearing/core/pins.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace cloth
{
namespace
{

// 4 x 3 particles.
//
//   0  1  2  3    y =  0
//   4  5  6  7    y = -1
//   8  9 10 11    y = -2
const ClothModel MODEL = sheet(3.0, 2.0, 4, 3);

using Particles = std::vector<int>;

PinParams edges(const std::vector<std::string>& names)
{
  PinParams pins;
  pins.edges = names;
  return pins;
}

TEST(Pins, HoldTheNamedEdges)
{
  EXPECT_EQ(pinnedParticles(MODEL, edges({ "top" })), (Particles{ 0, 1, 2, 3 }));
  EXPECT_EQ(pinnedParticles(MODEL, edges({ "bottom" })), (Particles{ 8, 9, 10, 11 }));
  EXPECT_EQ(pinnedParticles(MODEL, edges({ "left" })), (Particles{ 0, 4, 8 }));
  EXPECT_EQ(pinnedParticles(MODEL, edges({ "right" })), (Particles{ 3, 7, 11 }));
}

TEST(Pins, HoldWhatIsWithinAHundredthOfTheSizeOfTheEdge)
{
  ClothModel model = MODEL;
  model.positions[1].y() -= 0.019;
  model.positions[2].y() -= 0.021;
  EXPECT_EQ(pinnedParticles(model, edges({ "top" })), (Particles{ 0, 1, 3 }));
}

TEST(Pins, HoldWhatLiesInARegion)
{
  PinParams pins;
  pins.regions.push_back({ Vec3d(0.5, -1.0, 0.0), 1.1 });
  EXPECT_EQ(pinnedParticles(MODEL, pins), (Particles{ 2, 5, 6, 7, 10 }));
}

TEST(Pins, AddUpAscendingAndOnceEach)
{
  PinParams pins = edges({ "left", "top" });
  pins.regions.push_back({ Vec3d(-1.5, 0.0, 0.0), 0.1 });
  pins.particles = { 10, 3, 0, 10 };
  EXPECT_EQ(pinnedParticles(MODEL, pins), (Particles{ 0, 1, 2, 3, 4, 8, 10 }));
  EXPECT_TRUE(pinnedParticles(MODEL, PinParams()).empty());
}

TEST(Pins, AreRefusedWithAllThatIsWrong)
{
  PinParams pins = edges({ "middle" });
  pins.regions.push_back({ Vec3d(9, 0, 0), 0.5 });
  pins.regions.push_back({ Vec3d(0, 0, 0), -1.0 });
  pins.regions.push_back({ Vec3d(std::nan(""), 0, 0), 1.0 });
  pins.particles = { 12, -1 };
  try
  {
    pinnedParticles(MODEL, pins);
    FAIL() << "must be refused";
  }
  catch (const Refusal& refusal)
  {
    const std::string what = refusal.what();
    for (const char* part :
         { "pin edge \"middle\" is not one of top, bottom, left, right",
           "pin region at (9, 0, 0) with radius 0.5 m holds no particle of the model",
           "pin region radius [m] is -1, must be greater than 0", "pin region center [m].x is nan",
           "pinned particle 12 does not exist: the model has 12", "pinned particle -1" })
    {
      EXPECT_NE(what.find(part), std::string::npos) << part << "\nnot in\n" << what;
    }
  }
}

}  // namespace
}  // namespace cloth
