// Recordings of a running node, whatever ends it, and the state that a fault leaves behind.
#include <cloth_tearing/Drag.h>
#include <cloth_tearing/Grasp.h>
#include <cloth_tearing/NamedState.h>
#include <cloth_tearing/SimulationStatus.h>
#include <cloth_tearing/Step.h>
#include <cloth_tearing/ThrowSphere.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/xmlrpc_manager.h>
#include <std_srvs/Trigger.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

#include "child_process.h"
#include "cloth_tearing/core/replay.h"
#include "node_client.h"
#include "process_of.h"

using namespace cloth_tearing;  // NOLINT: the messages are what all of this is about

namespace
{

const std::string NODE = "/recorded";
const bool THOROUGH = std::getenv("CLOTH_TEARING_THOROUGH") != nullptr;

Step::Response step(std::uint32_t steps)
{
  Step::Request request;
  request.steps = steps;
  return ask<Step>(NODE + "/step", request);
}

class RecordingNode : public testing::Test
{
protected:
  void SetUp() override
  {
    ros::param::del(NODE);
    ros::param::set(NODE + "/rectangle/columns", 7);
    ros::param::set(NODE + "/rectangle/rows", 7);
    ros::param::set(NODE + "/pace", "step");
    ros::param::set(NODE + "/recording_folder", folder());
    std::filesystem::remove_all(folder());
  }

  void TearDown() override { std::filesystem::remove_all(folder()); }

  static std::string folder()
  {
    return testing::TempDir() + "recording_rostest_" + std::to_string(getpid());
  }

  /// @param before what a shell does first
  void start(const std::string& before = "")
  {
    node_ = std::make_unique<ChildProcess>(
        std::vector<std::string>{ "bash", "-c",
                                  before + "exec '" CLOTH_TEARING_NODE "' __name:=recorded" },
        static_cast<int>(4 * PATIENCE));
    step(0);
  }

  /// Nothing of it runs on.
  void kill()
  {
    const pid_t process = processOf(NODE);
    ASSERT_GT(process, 0);
    ::kill(process, SIGKILL);
    EXPECT_NE(node_->exitStatus(), 0);
  }

  int end()
  {
    node_->signal(SIGTERM);
    return node_->exitStatus();
  }

  /// The only file in the folder.
  static std::string file()
  {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder()))
    {
      files.push_back(entry.path().string());
    }
    EXPECT_EQ(files.size(), 1u);
    return files.empty() ? "" : files.front();
  }

  struct Replayed
  {
    std::uint64_t steps = 0;
    std::uint64_t tears = 0;
    std::uint64_t faults = 0;
    std::uint64_t hash = 0;
  };

  static Replayed replayed()
  {
    std::ifstream bytes(file(), std::ios::binary);
    cloth::Replay replay(bytes);
    while (replay.step())
    {
    }
    return { replay.steps(), replay.tears(), replay.faults(), replay.simulation().stateHash() };
  }

private:
  std::unique_ptr<ChildProcess> node_;
};

/// At the middle of the cloth. @param speed [m/s]
void throwBall(double speed)
{
  ThrowSphere::Request ball;
  ball.header.frame_id = "world";
  ball.center.y = -0.5;
  ball.center.z = 1.2;
  ball.velocity.y = speed;
  ball.radius = 0.1;
  ball.lifetime = 1.0;
  EXPECT_TRUE(ask<ThrowSphere>(NODE + "/throw_sphere", ball).success);
}

/// A gripper tears the cloth, a ball flies in.
void grip()
{
  Grasp::Request grasp;
  grasp.header.frame_id = "world";
  grasp.point.z = 1.0;
  grasp.radius = 0.3;
  const Grasp::Response taken = ask<Grasp>(NODE + "/grasp", grasp);
  ASSERT_TRUE(taken.success) << taken.message;
  Drag::Request drag;
  drag.header.frame_id = "world";
  drag.grasp_id = taken.grasp_id;
  drag.target.position.y = -1.5;
  drag.target.orientation.w = 1.0;
  drag.linear_speed = 3.0;
  drag.angular_speed = 1.0;
  const Drag::Response dragged = ask<Drag>(NODE + "/drag", drag);
  ASSERT_TRUE(dragged.success) << dragged.message;
  throwBall(6.0);
}

}  // namespace

TEST_F(RecordingNode, LeavesTheWholeRunWhenItIsKilled)
{
  const int kills = THOROUGH ? 50 : 3;
  for (int i = 0; i < kills; ++i)
  {
    std::filesystem::remove_all(folder());
    start();
    grip();
    const Step::Response done = step(200 + 37 * i);
    EXPECT_GT(done.tears, 0u);

    kill();

    const Replayed again = replayed();
    EXPECT_EQ(again.steps, done.step);
    EXPECT_EQ(again.hash, done.state_hash);
    EXPECT_EQ(again.tears, done.tears);
  }
}

/// Between two states that it tells, nobody knows how far it was: at least as far as it told.
TEST_F(RecordingNode, LosesNothingThatItToldOfWhenItIsKilledAtFullSpeed)
{
  ros::param::set(NODE + "/pace", "free");
  start();
  grip();
  std::uint64_t told = 0;
  {
    Collector<SimulationStatus> status(NODE + "/status");
    told = status.waitFor("steps", [](const auto& s) { return s.step > 2000; }).step;
  }

  kill();

  EXPECT_GE(replayed().steps, told);
}

TEST_F(RecordingNode, LeavesTheWholeRunWhenItEnds)
{
  start();
  grip();
  step(100);
  ASSERT_TRUE(ask<std_srvs::Trigger>(NODE + "/reset").success);
  const Step::Response done = step(50);

  EXPECT_EQ(end(), 0);

  const Replayed again = replayed();
  EXPECT_EQ(again.steps, 150u);
  EXPECT_EQ(again.hash, done.state_hash);
}

TEST_F(RecordingNode, GoesOnWithoutARecordingThatIsFull)
{
  ros::param::set(NODE + "/recording_limit", 1.0);
  start();
  Collector<SimulationStatus> status(NODE + "/status");
  EXPECT_EQ(
      status.waitFor("the file", [](const auto& s) { return !s.recording.empty(); }).recording,
      file());

  const std::uint32_t more_than_fit = 70000;
  const Step::Response done = step(more_than_fit);

  EXPECT_EQ(done.step, more_than_fit);
  const SimulationStatus full =
      status.waitFor("that it is full", [](const auto& s) { return !s.recording_problem.empty(); });
  EXPECT_NE(full.recording_problem.find("1000000"), std::string::npos) << full.recording_problem;
  EXPECT_LE(std::filesystem::file_size(file()), 1000000u);
  EXPECT_EQ(end(), 0);
  EXPECT_GT(replayed().steps, 30000u);
}

TEST_F(RecordingNode, GoesOnWhereTheSystemLetsFilesGrowNoMore)
{
  start("ulimit -f 100; ");

  EXPECT_EQ(step(10000).step, 10000u);

  EXPECT_EQ(end(), 0);
  const Replayed again = replayed();
  EXPECT_GT(again.steps, 1000u);
  EXPECT_LT(again.steps, 10000u);
}

TEST_F(RecordingNode, RefusesToRunWhereItCannotRecord)
{
  std::ofstream(folder()) << "no folder";
  ChildProcess node({ CLOTH_TEARING_NODE, "__name:=recorded" }, static_cast<int>(PATIENCE));
  EXPECT_TRUE(node.says("recording_folder " + folder()));
  EXPECT_EQ(node.exitStatus(), 1);
}

TEST_F(RecordingNode, KeepsTheStateBeforeAFaultWhichComesAgainFromThere)
{
  ros::param::set(NODE + "/max_speed", 4.0);
  start();
  Collector<SimulationStatus> status(NODE + "/status");
  throwBall(9.0);
  const Step::Response stopped = step(1000);
  ASSERT_LT(stopped.step, 1000u) << "a fault cuts it short";
  const SimulationStatus fault =
      status.waitFor("the fault", [](const auto& s) { return !s.fault.empty(); });
  ASSERT_TRUE(ask<std_srvs::Trigger>(NODE + "/reset").success);

  NamedState::Request request;
  request.name = "fault";
  const NamedState::Response restored = ask<NamedState>(NODE + "/restore_state", request);
  ASSERT_TRUE(restored.success) << restored.message;
  EXPECT_EQ(restored.step, stopped.step);
  EXPECT_EQ(restored.state_hash, stopped.state_hash);
  const Step::Response again = step(1);

  EXPECT_EQ(again.state_hash, stopped.state_hash);
  status.waitFor("the same fault", [&](const auto& s)
                 { return s.epoch == fault.epoch + 2 && s.fault == fault.fault; });
  EXPECT_EQ(end(), 0);
  EXPECT_EQ(replayed().faults, 2u);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "recording_rostest");
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
