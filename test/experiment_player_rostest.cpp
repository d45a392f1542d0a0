// What the player shows is what the experiment does by itself; it names what it cannot play.
#include <cloth_tearing/TearEvents.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <chrono>

#include "child_process.h"
#include "cloth_tearing/experiments/plays.h"
#include "cloth_tearing/node/conversions.h"
#include "cloth_tearing/node/player_params.h"
#include "cloth_tearing/node/tear_words.h"
#include "node_client.h"

using cloth_tearing::TearEvent;
using cloth_tearing::TearEvents;

namespace
{

const std::string NODE = "/player";
constexpr int RESOLUTION = 20;  // coarse: quick
constexpr int DEADLINE = 60;    // [s]

class ExperimentPlayer : public testing::Test
{
protected:
  void SetUp() override
  {
    ros::param::del(NODE);
    ros::param::set(NODE + "/experiment", "balls_1");
    ros::param::set(NODE + "/resolution", RESOLUTION);
    ros::param::set(NODE + "/pace", "free");
    ros::param::set(NODE + "/exit_when_done", true);
  }
};

/// The player with the parameters that are set.
ChildProcess player()
{
  return { { EXPERIMENT_PLAYER, "__name:=player" }, DEADLINE };
}

/// The tears of an experiment that nobody plays, placed where the player places them.
std::vector<TearEvent> tearsByItself(const std::string& experiment, cloth::SolverKind solver)
{
  cloth::Setting setting;
  setting.resolution = RESOLUTION;
  setting.solver = solver;
  const cloth_tearing::Placement placement = cloth_tearing::PlayerParams().placement;
  std::vector<TearEvent> tears;
  cloth::findPlay(experiment)
      .run(setting,
           [&](const cloth::Simulation&, const cloth::StepReport& report)
           {
             for (const TearEvent& event : cloth_tearing::toMessages(report.tears, placement))
             {
               tears.push_back(event);
             }
           });
  return tears;
}

std::vector<std::string> inWords(const std::vector<TearEvent>& tears)
{
  std::vector<std::string> lines;
  for (const TearEvent& tear : tears)
  {
    lines.push_back(cloth_tearing::inWords(tear));
  }
  return lines;
}

std::vector<std::string> tearsAmong(const std::vector<std::string>& lines)
{
  std::vector<std::string> tears;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(tears),
               [](const std::string& line) { return line.compare(0, 5, "tear ") == 0; });
  return tears;
}

std::string closingLine(const std::vector<TearEvent>& tears)
{
  std::array<int, 4> kinds{};
  for (const TearEvent& tear : tears)
  {
    ++kinds.at(tear.kind);
  }
  return "tears: " + std::to_string(kinds[0]) + " basic, " + std::to_string(kinds[1]) +
         " weak point, " + std::to_string(kinds[2]) + " one point, " + std::to_string(kinds[3]) +
         " released; pieces: " + std::to_string(tears.back().pieces);
}

std::string joined(const std::vector<std::string>& lines)
{
  std::string all;
  for (const std::string& line : lines)
  {
    all += line + "\n";
  }
  return all;
}

}  // namespace

TEST_F(ExperimentPlayer, TearsWhatTheExperimentTearsByItself)
{
  const std::vector<TearEvent> expected = tearsByItself("balls_1", cloth::SolverKind::XPBD);
  ASSERT_GE(expected.size(), 3u);

  ChildProcess process = player();
  const std::vector<std::string> lines = process.lines();

  EXPECT_EQ(tearsAmong(lines), inWords(expected)) << joined(lines);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), closingLine(expected)), 1) << joined(lines);
  EXPECT_EQ(process.exitStatus(), 0);
}

TEST_F(ExperimentPlayer, TearsAlikeWithTheOtherSolver)
{
  const std::vector<TearEvent> expected =
      tearsByItself("balls_5", cloth::SolverKind::FORCE_SPRINGS);
  ASSERT_GE(expected.size(), 3u);
  ros::param::set(NODE + "/experiment", "balls_5");
  ros::param::set(NODE + "/solver", "force_springs");

  ChildProcess process = player();

  EXPECT_EQ(tearsAmong(process.lines()), inWords(expected));
  EXPECT_EQ(process.exitStatus(), 0);
}

TEST_F(ExperimentPlayer, KeepsToTheClock)
{
  ros::param::set(NODE + "/experiment", "balls_5");  // two seconds and 0.7 more
  ros::param::set(NODE + "/pace", "wall");
  const auto start = std::chrono::steady_clock::now();

  ChildProcess process = player();
  process.lines();

  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(2600));
  EXPECT_EQ(process.exitStatus(), 0);
}

TEST_F(ExperimentPlayer, TellsEachTearToThoseWhoListen)
{
  const std::vector<TearEvent> expected = tearsByItself("balls_1", cloth::SolverKind::XPBD);
  ros::param::set(NODE + "/viewer_patience", PATIENCE);
  Collector<TearEvents> heard(NODE + "/tear_events");

  ChildProcess process = player();
  heard.waitFor("the last tear", [&](const TearEvents& message)
                { return message.events.back().sequence == expected.back().sequence; });

  std::vector<TearEvent> events;
  for (const TearEvents& message : heard.all())
  {
    EXPECT_EQ(message.header.frame_id, "world");
    events.insert(events.end(), message.events.begin(), message.events.end());
  }
  EXPECT_EQ(inWords(events), inWords(expected));
}

TEST_F(ExperimentPlayer, StopsForAPictureAtEachMomentWithoutATearMoreOrLess)
{
  const std::vector<TearEvent> expected = tearsByItself("balls_1", cloth::SolverKind::XPBD);
  ros::param::set(NODE + "/stop_at_moments", true);
  ros::param::set(NODE + "/picture_pause", 0.0);

  ChildProcess process = player();
  const std::vector<std::string> lines = process.lines();

  for (const cloth::Play::Moment& moment : cloth::findPlay("balls_1").moments)
  {
    const std::string ready = std::string("scene: ready for the picture balls_1_") + moment.name;
    EXPECT_EQ(std::count(lines.begin(), lines.end(), ready), 1) << ready;
  }
  EXPECT_EQ(tearsAmong(lines), inWords(expected));
}

TEST_F(ExperimentPlayer, ShowsTheEndToThoseWhoComeLate)
{
  ros::param::set(NODE + "/exit_when_done", false);
  ros::param::set(NODE + "/markers/coloring", "wireframe");
  ChildProcess process = player();
  ASSERT_TRUE(process.says("tears: "));

  Collector<visualization_msgs::MarkerArray> markers(NODE + "/markers");
  const visualization_msgs::MarkerArray last = markers.first();

  int lists = 0;
  for (const visualization_msgs::Marker& marker : last.markers)
  {
    EXPECT_EQ(marker.header.frame_id, "world");
    lists += marker.ns == "cloth" && marker.type == visualization_msgs::Marker::LINE_LIST &&
             !marker.points.empty();
  }
  EXPECT_EQ(lists, 1);
}

TEST_F(ExperimentPlayer, EndsInTheMiddleWhenItIsInterrupted)
{
  ros::param::set(NODE + "/pace", "wall");
  ChildProcess process = player();
  ASSERT_TRUE(process.says("tear 1 "));

  process.signal(SIGINT);

  EXPECT_TRUE(process.says("ended before its end"));
  EXPECT_EQ(process.exitStatus(), 0);
}

TEST_F(ExperimentPlayer, EndsWithinAPauseWhenItIsInterrupted)
{
  ros::param::set(NODE + "/stop_at_moments", true);
  ros::param::set(NODE + "/picture_pause", 600.0);
  ChildProcess process = player();
  ASSERT_TRUE(process.says("ready for the picture"));

  process.signal(SIGINT);

  EXPECT_TRUE(process.says("ended before its end"));
  EXPECT_EQ(process.exitStatus(), 0);
}

TEST_F(ExperimentPlayer, EndsWithoutWaitingForAClothThatSettles)
{
  ros::param::set(NODE + "/resolution", 200);  // most of a minute
  ros::param::set(NODE + "/time_step", 0.0005);
  ChildProcess process = player();
  ASSERT_TRUE(process.says("scene: "));
  const auto start = std::chrono::steady_clock::now();

  process.signal(SIGINT);

  EXPECT_EQ(process.exitStatus(), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST_F(ExperimentPlayer, RefusesAnUnknownExperimentAndNamesThoseThereAre)
{
  ros::param::set(NODE + "/experiment", "bowls_1");
  ChildProcess process = player();

  const std::string words = joined(process.lines());

  EXPECT_EQ(process.exitStatus(), 1);
  EXPECT_NE(words.find("\"bowls_1\""), std::string::npos) << words;
  for (const cloth::Play& play : cloth::plays())
  {
    EXPECT_NE(words.find(play.name), std::string::npos) << words;
  }
}

TEST_F(ExperimentPlayer, RefusesNonsenseAndNamesAllOfIt)
{
  ros::param::set(NODE + "/resolution", 3);
  ros::param::set(NODE + "/mesh", "knitted");
  ros::param::set(NODE + "/time_step", -1.0);
  ros::param::set(NODE + "/markers/point_size", 0.0);
  ros::param::set(NODE + "/frame_id", "/world");
  ros::param::set(NODE + "/colouring", "plain");
  ChildProcess process = player();

  const std::string words = joined(process.lines());

  EXPECT_EQ(process.exitStatus(), 1);
  for (const char* expected :
       { "resolution is 3", "mesh is the text \"knitted\"", "time_step", "markers/point_size",
         "must not begin with a slash", "did you mean markers/coloring?" })
  {
    EXPECT_NE(words.find(expected), std::string::npos) << expected << " is not among:\n" << words;
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "experiment_player_rostest");
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
