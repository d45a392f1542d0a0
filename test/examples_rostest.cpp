// The example programs do what they say, beside the cloth that cloth.launch starts.
#include <ros/ros.h>

#include <string>

#include "child_process.h"
#include "cloth_tearing/client/cloth_client.h"

using cloth_tearing::ClothClient;
using cloth_tearing::TearEvent;

namespace
{

constexpr int DEADLINE = 90;  // of an example [s]

/// All tears of the cloth since the test began, and only those.
class Example : public testing::Test
{
protected:
  void SetUp() override
  {
    cloth_.reset();
    before_ = cloth_.tears().size();
  }

  /// Runs it to its end: it says by its exit status whether all went as it should.
  void expectItTearsOnPurpose(const std::string& program)
  {
    ChildProcess example({ program }, DEADLINE);
    const std::string said = example.rest();
    EXPECT_EQ(example.exitStatus(), 0) << said;
    EXPECT_NE(said.find("nothing tore yet"), std::string::npos) << said;

    const auto tears = cloth_.tears(before_ + 1);
    ASSERT_GE(tears.size(), 5u) << said;
    EXPECT_EQ(tears.front().cause, TearEvent::GRASP);
    EXPECT_EQ(cloth_.graspEvents().back().kind, cloth_tearing::GraspEvent::RELEASED) << said;
  }

  ClothClient cloth_;
  std::size_t before_ = 0;
};

TEST_F(Example, InCppPullsInStepsAndTearsOnPurpose)
{
  expectItTearsOnPurpose(PULL_IN_STEPS);
}

TEST_F(Example, InPythonPullsInStepsAndTearsOnPurpose)
{
  expectItTearsOnPurpose(CLOTH_TEARING_SOURCE_DIR "/examples/pull_in_steps.py");
}

}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "examples_rostest");
  const ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
