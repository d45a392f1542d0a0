// How the node's process begins and ends: exit status, registration, and what it says.
#include <cloth_tearing/SimulationStatus.h>
#include <cloth_tearing/Step.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/xmlrpc_manager.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <future>
#include <thread>

#include "node_client.h"

extern char** environ;

namespace
{

const std::string NODE = "/victim";

/// A running node whose words are read as they come.
class NodeProcess
{
public:
  NodeProcess()
  {
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDERR_FILENO);
    posix_spawn_file_actions_addclose(&files, ends[0]);
    std::string program = CLOTH_TEARING_NODE;
    std::string name = "__name:=victim";
    char* arguments[] = { &program[0], &name[0], nullptr };
    EXPECT_EQ(posix_spawn(&pid_, program.c_str(), &files, nullptr, arguments, environ), 0);
    posix_spawn_file_actions_destroy(&files);
    close(ends[1]);
    reader_ = std::async(std::launch::async, [this, from = ends[0]] { readAll(from); });
    status_ = std::async(std::launch::async,
                         [this]
                         {
                           int status = -1;
                           waitpid(pid_, &status, 0);
                           return status;
                         });
  }

  ~NodeProcess()
  {
    if (status_.valid() && status_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    {
      kill(pid_, SIGKILL);
    }
  }

  void signal(int number) const { kill(pid_, number); }

  /// Waits for the end. @return the exit status, -1 if there is none in time
  int exitStatus()
  {
    if (status_.wait_for(std::chrono::duration<double>(PATIENCE)) != std::future_status::ready)
    {
      ADD_FAILURE() << "the node does not end";
      return -1;
    }
    const int status = status_.get();
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// Waits until it has said `text`.
  bool says(const std::string& text)
  {
    std::unique_lock<std::mutex> lock(mutex_);
    return said_more_.wait_for(lock, std::chrono::duration<double>(PATIENCE),
                               [&] { return words_.find(text) != std::string::npos; });
  }

  /// All it said; once it has ended.
  std::string words()
  {
    reader_.wait();
    const std::lock_guard<std::mutex> lock(mutex_);
    return words_;
  }

private:
  void readAll(int from)
  {
    char some[4096];
    for (ssize_t count = 0; (count = read(from, some, sizeof some)) > 0;)
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      words_.append(some, static_cast<std::size_t>(count));
      said_more_.notify_all();
    }
    close(from);
  }

  pid_t pid_ = -1;
  std::mutex mutex_;
  std::condition_variable said_more_;
  std::string words_;
  std::future<void> reader_;  // waits for its end when it goes
  std::future<int> status_;
};

bool registered()
{
  std::vector<std::string> nodes;
  EXPECT_TRUE(ros::master::getNodes(nodes));
  return std::count(nodes.begin(), nodes.end(), NODE) > 0;
}

cloth_tearing::Step::Response step(std::uint32_t steps)
{
  cloth_tearing::Step::Request request;
  request.steps = steps;
  return ask<cloth_tearing::Step>(NODE + "/step", request);
}

class NodeProcessTest : public testing::Test
{
protected:
  void SetUp() override
  {
    ros::param::del(NODE);
    ros::param::set(NODE + "/rectangle/columns", 5);
    ros::param::set(NODE + "/rectangle/rows", 5);
    ros::param::set(NODE + "/pace", "step");
  }
};

}  // namespace

TEST_F(NodeProcessTest, EndsCleanlyOnSigintAndSigterm)
{
  for (const int signal : { SIGINT, SIGTERM })
  {
    NodeProcess node;
    ASSERT_TRUE(step(0).success);
    EXPECT_TRUE(registered());

    node.signal(signal);

    EXPECT_EQ(node.exitStatus(), 0) << strsignal(signal);
    EXPECT_FALSE(registered()) << strsignal(signal);
  }
}

TEST_F(NodeProcessTest, EndsCleanlyWhileItRunsAsFastAsItCan)
{
  ros::param::set(NODE + "/pace", "free");
  NodeProcess node;
  step(0);

  node.signal(SIGTERM);

  EXPECT_EQ(node.exitStatus(), 0);
  EXPECT_FALSE(registered());
}

TEST_F(NodeProcessTest, EndsCleanlyWithinALongStep)
{
  NodeProcess node;
  const std::uint64_t begin = step(1).step;
  auto long_step =
      std::async(std::launch::async,
                 []
                 {
                   cloth_tearing::Step call;
                   call.request.steps = 4000000000U;
                   return ros::service::call(NODE + "/step", call) && call.response.success;
                 });
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(PATIENCE);
  std::uint64_t now = begin;
  {
    Collector<cloth_tearing::SimulationStatus> status(NODE + "/status");
    now = status.waitFor("the step is under way", [begin](const auto& s) { return s.step > begin; })
              .step;
  }
  ASSERT_GT(now, begin);

  node.signal(SIGINT);

  EXPECT_EQ(node.exitStatus(), 0);
  EXPECT_LT(ros::WallTime::now(), deadline);
  EXPECT_FALSE(registered());
  EXPECT_FALSE(long_step.get()) << "the step was not done";
}

TEST_F(NodeProcessTest, EndsWhenTheMasterAsksItTo)
{
  NodeProcess node;
  ASSERT_TRUE(step(0).success);
  std::string host;
  std::uint32_t port = 0;
  XmlRpc::XmlRpcValue lookup, answer, uri;
  lookup[0] = "/tester";
  lookup[1] = NODE;
  ASSERT_TRUE(ros::master::execute("lookupNode", lookup, answer, uri, false));
  ASSERT_TRUE(ros::network::splitURI(static_cast<std::string>(uri), host, port));
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue farewell;
  farewell[0] = "/tester";
  farewell[1] = "no more";

  ASSERT_TRUE(client.execute("shutdown", farewell, answer));

  EXPECT_EQ(node.exitStatus(), 0);
}

TEST_F(NodeProcessTest, CanBeEndedWhileItWaitsForAMaster)
{
  const std::string master = ros::master::getURI();
  setenv("ROS_MASTER_URI", "http://127.0.0.1:9", 1);  // nobody serves there
  NodeProcess node;
  setenv("ROS_MASTER_URI", master.c_str(), 1);
  ASSERT_TRUE(node.says("Waiting for the master"));

  node.signal(SIGTERM);

  EXPECT_EQ(node.exitStatus(), 0);
}

TEST_F(NodeProcessTest, RefusesToRunWithNonsenseAndNamesAllOfIt)
{
  ros::param::set(NODE + "/time_step", "fast");
  ros::param::set(NODE + "/material/stifness", 10.0);
  ros::param::set(NODE + "/tearing/tear_strain", -1.0);
  ros::param::set(NODE + "/pace", "clock");
  NodeProcess node;

  EXPECT_EQ(node.exitStatus(), 1);

  const std::string words = node.words();
  for (const char* expected :
       { "time_step is the text \"fast\"", "did you mean material/stiffness?",
         "tearing/tear_strain", "pace is \"clock\", which is not served yet" })
  {
    EXPECT_NE(words.find(expected), std::string::npos) << expected << " is not among:\n" << words;
  }
  EXPECT_FALSE(registered());
}

TEST_F(NodeProcessTest, RefusesToRunWithoutAModel)
{
  ros::param::set(NODE + "/model_file", "/nowhere/cloth.obj");
  NodeProcess node;

  EXPECT_EQ(node.exitStatus(), 1);
  EXPECT_NE(node.words().find("/nowhere/cloth.obj"), std::string::npos);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "node_process_rostest");
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
