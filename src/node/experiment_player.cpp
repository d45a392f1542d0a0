// Plays an experiment of the thesis for those who watch: the very code that the tables are made by.
#include <cloth_tearing/TearEvents.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>
#include <ros/param.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <functional>
#include <future>
#include <stdexcept>
#include <thread>

#include "cloth_tearing/core/simulation.h"
#include "cloth_tearing/experiments/plays.h"
#include "cloth_tearing/node/cloth_markers.h"
#include "cloth_tearing/node/conversions.h"
#include "cloth_tearing/node/params_loader.h"
#include "cloth_tearing/node/player_params.h"
#include "cloth_tearing/node/tear_words.h"

namespace cloth_tearing
{
namespace
{

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t TEAR_QUEUE = 1000;

/// Time lost beyond this is not made up for: a machine that is too slow runs late, not wild [s].
constexpr double CATCH_UP = 0.1;

/// Before a picture the cloth is sent so often, so far apart [s]: rviz may be slow to draw it.
constexpr int SHOWINGS = 8;
constexpr double SHOWING = 0.15;

/// How often somebody who waits looks up [s].
constexpr double GLANCE = 0.05;

/// The play has so long to end by itself [s]; a cloth that still settles does not look up.
constexpr double LEAVE = 1.0;

Clock::duration toDuration(double seconds)
{
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

/// The node is to end: leaves the experiment through its Watch.
class Interrupted : public std::exception
{
};

/// Holds time in the experiment to the steady clock.
class Pacemaker
{
public:
  /// The experiment is `played` seconds old now.
  void start(double played) { zero_ = Clock::now() - toDuration(played); }

  /// Waits until the experiment may be `played` seconds old.
  void keep(double played)
  {
    zero_ = std::max(zero_, Clock::now() - toDuration(played + CATCH_UP));
    std::this_thread::sleep_until(zero_ + toDuration(played));
  }

private:
  Clock::time_point zero_;  ///< when the experiment began
};

class ExperimentPlayer
{
public:
  ExperimentPlayer(ros::NodeHandle node, const PlayerParams& params)
      : params_(params)
      , play_(cloth::findPlay(params.experiment))
      , painter_(params.markers, params.placement)
  {
    markers_ = node.advertise<visualization_msgs::MarkerArray>("markers", 1, true);
    tear_events_ = node.advertise<TearEvents>("tear_events", TEAR_QUEUE);
  }

  /// Plays from beginning to end. @return exit status
  int play()
  {
    try
    {
      waitUntil([this] { return heard(); }, params_.viewer_patience);
      say(play_.title);
      play_.run(params_.setting,
                [this](const cloth::Simulation& simulation, const cloth::StepReport& report)
                { onStep(simulation, report); });
    }
    catch (const Interrupted&)
    {
      say("ended before its end");
    }
    catch (const std::exception& error)
    {
      std::fprintf(stderr, "scene: %s\n", error.what());
      return 1;
    }
    summarise();
    return 0;
  }

private:
  void onStep(const cloth::Simulation& simulation, const cloth::StepReport& report)
  {
    if (!ros::ok())
    {
      throw Interrupted();
    }
    if (played_ == 0.0)
    {
      pacemaker_.start(0.0);
    }
    played_ += simulation.params().solver.time_step;
    pieces_ = simulation.cloth().damage.pieces;
    if (!report.tears.empty())
    {
      announce(report.tears);
    }
    if (Clock::now() >= next_frame_)
    {
      next_frame_ = Clock::now() + toDuration(1.0 / params_.marker_rate);
      show(simulation);
    }
    for (; next_moment_ < play_.moments.size() && reached(play_.moments[next_moment_]);
         ++next_moment_)
    {
      if (params_.stop_at_moments)
      {
        stopForPicture(simulation, play_.moments[next_moment_].name);
      }
    }
    if (params_.pace == cloth::Pace::WALL)
    {
      pacemaker_.keep(played_);
    }
  }

  bool reached(const cloth::Play::Moment& moment) const
  {
    return played_ > moment.time - 1e-9;  // sums of time steps
  }

  void announce(const std::vector<cloth::TearEvent>& tears)
  {
    TearEvents message;
    message.header.frame_id = params_.placement.frame_id;
    message.header.stamp = ros::Time::now();
    message.events = toMessages(tears, params_.placement);
    tear_events_.publish(message);
    for (const TearEvent& event : message.events)
    {
      ++kinds_.at(event.kind);
      std::printf("%s\n", inWords(event).c_str());
    }
  }

  void show(const cloth::Simulation& simulation)
  {
    visualization_msgs::MarkerArray message = painter_.draw(simulation.snapshot());
    for (visualization_msgs::Marker& marker : message.markers)
    {
      marker.header.stamp = ros::Time::now();
    }
    markers_.publish(message);
  }

  void stopForPicture(const cloth::Simulation& simulation, const std::string& moment)
  {
    for (int i = 0; i < SHOWINGS; ++i)
    {
      show(simulation);
      rest(SHOWING);
    }
    say("ready for the picture " + play_.name + "_" + moment);
    rest(params_.picture_pause);
    pacemaker_.start(played_);
  }

  bool heard() const
  {
    return markers_.getNumSubscribers() > 0 || tear_events_.getNumSubscribers() > 0;
  }

  static void rest(double seconds)
  {
    waitUntil([] { return false; }, seconds);
  }

  /// Waits until `done`, at most for `patience` [s].
  static void waitUntil(const std::function<bool()>& done, double patience)
  {
    const Clock::time_point deadline = Clock::now() + toDuration(patience);
    while (Clock::now() < deadline && !done())
    {
      if (!ros::ok())
      {
        throw Interrupted();
      }
      std::this_thread::sleep_until(std::min(deadline, Clock::now() + toDuration(GLANCE)));
    }
  }

  void summarise() const
  {
    std::printf("tears: %llu basic, %llu weak point, %llu one point, %llu released; pieces: %d\n",
                kinds_[0], kinds_[1], kinds_[2], kinds_[3], pieces_);
  }

  static void say(const std::string& what) { std::printf("scene: %s\n", what.c_str()); }

  PlayerParams params_;
  const cloth::Play& play_;
  ClothMarkers painter_;
  ros::Publisher markers_;
  ros::Publisher tear_events_;
  Pacemaker pacemaker_;
  Clock::time_point next_frame_;
  double played_ = 0.0;                                        ///< since the cloth hung still [s]
  std::size_t next_moment_ = 0;                                ///< in play_.moments
  std::array<unsigned long long, cloth::TEAR_KINDS> kinds_{};  ///< tears by kind
  int pieces_ = 1;
};

/// Plays on a thread of its own, because the cloth settles before there is a step to watch, and
/// that may take long. @return exit status
int playUntilToldToEnd(ExperimentPlayer& player, bool exit_when_done)
{
  std::packaged_task<int()> task([&player] { return player.play(); });
  std::future<int> status = task.get_future();
  std::thread(std::move(task)).detach();
  while (ros::ok() && status.wait_for(toDuration(GLANCE)) != std::future_status::ready)
  {
  }
  if (status.wait_for(toDuration(LEAVE)) != std::future_status::ready)
  {
    std::fflush(nullptr);
    std::_Exit(0);
  }
  const int result = status.get();
  while (ros::ok() && !exit_when_done && result == 0)
  {
    std::this_thread::sleep_for(toDuration(GLANCE));
  }
  return result;
}

/// One line a play: name, where its camera is best, as rviz has it, and what it shows.
void listPlays()
{
  const cloth::Vec3d origin = PlayerParams().placement.origin;
  for (const cloth::Play& play : cloth::plays())
  {
    const cloth::Camera& camera = play.camera;
    const cloth::Vec3d focus = origin + camera.focus;
    std::printf("%s %g %g %g %g %g %g %s\n", play.name.c_str(), camera.yaw, camera.pitch,
                camera.distance, focus.x(), focus.y(), focus.z(), play.title.c_str());
  }
}

/// @return exit status
int run()
{
  ros::NodeHandle node("~");
  XmlRpc::XmlRpcValue tree;
  ros::param::get(node.getNamespace(), tree);
  const LoadedPlayerParams loaded = loadPlayerParams(tree);
  try
  {
    refuseWrongParams(node.getNamespace(), loaded.problems);
  }
  catch (const std::invalid_argument& error)
  {
    ROS_FATAL_STREAM(error.what());
    return 1;
  }
  ExperimentPlayer player(node, loaded.params);
  return playUntilToldToEnd(player, loaded.params.exit_when_done);
}

}  // namespace
}  // namespace cloth_tearing

int main(int argc, char** argv)
{
  if (argc == 2 && std::strcmp(argv[1], "--list") == 0)
  {
    cloth_tearing::listPlays();
    return 0;
  }
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  ros::init(argc, argv, "experiment_player");
  return cloth_tearing::run();
}
