// Claim: what is published again and again does not allocate while nothing tears.
#include <gtest/gtest.h>

#include "allocations.h"
#include "cloth_tearing/core/snapshot_taker.h"
#include "cloth_tearing/node/cloth_markers.h"
#include "cloth_tearing/node/conversions.h"
#include "cloth_tearing/node/kept_message.h"
#include "scenes.h"

namespace cloth_tearing
{
namespace
{

const Placement PLACEMENT{ "map", cloth::Vec3d(0.0, 0.0, 2.0) };

/// A hanging sheet with a slit that a ball tore, held and moving.
class Conversions : public testing::Test
{
protected:
  Conversions() : simulation_(cloth::upright(flat_), cloth::edgeOf(flat_, "top"), cloth::tearable())
  {
    cloth::ThrowRequest thrown;
    thrown.center = cloth::Vec3d(0.02, -0.4, -0.4);
    thrown.velocity = cloth::Vec3d(0, 8, 0);
    thrown.radius = 0.12;
    thrown.lifetime = 1.0;
    simulation_.throwSphere(thrown);
    EXPECT_GT(cloth::run(simulation_, 3000).size(), 5u);
    cloth::GraspRequest request;
    request.point = simulation_.cloth().state.position[140].cast<double>();
    request.frame.position = request.point;
    simulation_.grasp(request);
    taker_.take(simulation_, snapshot_);
  }

  /// Steps on, lets `convert` do its work each time, and returns how often it allocated.
  template <class Convert>
  long allocatedBy(Convert convert)
  {
    long made = 0;
    for (int i = 0; i < 20; ++i)
    {
      EXPECT_TRUE(cloth::run(simulation_, 1).empty());
      const long before = allocations;
      convert();
      made += i > 0 ? allocations - before : 0;  // the first time asks for the memory
    }
    return made;
  }

  cloth::ClothModel flat_ = cloth::sheet(1.0, 1.0, 12, 12);
  cloth::Simulation simulation_;
  cloth::SnapshotTaker taker_;
  cloth::Snapshot snapshot_;
};

TEST_F(Conversions, TakeSnapshotsWithoutAllocating)
{
  EXPECT_EQ(allocatedBy([this] { taker_.take(simulation_, snapshot_); }), 0);
}

TEST_F(Conversions, DrawMarkersWithoutAllocating)
{
  for (const Coloring coloring :
       { Coloring::TEXTURE, Coloring::STRAIN, Coloring::PLAIN, Coloring::WIREFRAME })
  {
    MarkerStyle style;
    style.coloring = coloring;
    ClothMarkers painter(style, PLACEMENT);
    visualization_msgs::MarkerArray markers;
    painter.draw(snapshot_, markers);
    EXPECT_EQ(allocatedBy(
                  [&]
                  {
                    taker_.take(simulation_, snapshot_);
                    painter.draw(snapshot_, markers);
                  }),
              0);
  }
}

TEST_F(Conversions, FillSurfacesWithoutAllocating)
{
  ClothSurface message;
  fillTopology(message, *snapshot_.surface.topology);
  EXPECT_EQ(allocatedBy([&] { fillMotion(message, snapshot_.surface, PLACEMENT); }), 0);
}

TEST(KeptMessage, IsFilledAgainUnlessSomebodyHoldsIt)
{
  KeptMessage<ClothSurface> kept;
  EXPECT_TRUE(kept.renew());
  boost::shared_ptr<const ClothSurface> subscriber = kept.shared();
  kept->step = 1;

  EXPECT_TRUE(kept.renew()) << "a subscriber holds the first";
  kept->step = 2;
  EXPECT_EQ(subscriber->step, 1u);

  const ClothSurface* second = &*kept;
  subscriber = kept.shared();
  subscriber.reset();
  EXPECT_FALSE(kept.renew());
  EXPECT_EQ(&*kept, second);
  EXPECT_EQ(kept->step, 2u) << "its memory is kept as it is";
}

}  // namespace
}  // namespace cloth_tearing
