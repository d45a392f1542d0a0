// What a careful pull does to the cloth, to the bit: the cloth moves only in step().
#include <cloth_tearing/client/cloth_client.h>
#include <gtest/gtest.h>
#include <ros/ros.h>

using cloth_tearing::ClothClient;

namespace
{

geometry_msgs::Point below(double z)
{
  geometry_msgs::Point point;
  point.z = z;
  return point;
}

/// Stands for the program under test: takes hold of the lower edge, which is at 0.6 m, and draws it
/// down to `height` [m], with two seconds for it. Returns the grasp.
std::uint64_t pullDownTo(const ClothClient& cloth, double height)
{
  const std::uint64_t grasp = cloth.grasp(below(0.6), 0.04).grasp_id;
  cloth.drag(grasp, below(height), 0.2);
  cloth.step(2000);
  return grasp;
}

}  // namespace

class Pull : public testing::Test
{
protected:
  void SetUp() override
  {
    cloth_.reset();  // each test begins with the same cloth
    first_tear_ = cloth_.tears().size() + 1;
  }

  ClothClient cloth_;
  std::uint64_t first_tear_ = 1;
};

TEST_F(Pull, OfTwoCentimetresTearsNothing)
{
  pullDownTo(cloth_, 0.58);

  EXPECT_TRUE(cloth_.tears(first_tear_).empty());
}

TEST_F(Pull, OfTwentyCentimetresTearsTheClothAtTheGripper)
{
  const std::uint64_t grasp = pullDownTo(cloth_, 0.4);

  const auto tears = cloth_.tears(first_tear_);
  ASSERT_FALSE(tears.empty());
  EXPECT_EQ(tears.front().cause, cloth_tearing::TearEvent::GRASP);
  EXPECT_EQ(tears.front().cause_id, grasp);
  EXPECT_LT(tears.front().cause_distance, 0.1);  // [m]
}

TEST_F(Pull, DoesTheSameToTheBitEachTime)
{
  pullDownTo(cloth_, 0.4);
  const std::uint64_t once = cloth_.step(0).state_hash;
  cloth_.reset();

  pullDownTo(cloth_, 0.4);

  EXPECT_EQ(cloth_.step(0).state_hash, once);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "pull_test");
  const ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
