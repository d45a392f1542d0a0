// Runs a ClothNode until SIGINT, SIGTERM or the master ends it.
#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/node_handle.h>

#include <csignal>
#include <ctime>
#include <exception>

#include "cloth_tearing/node/make_cloth_node.h"

namespace
{

/// The signals that end the node. Blocked in every thread and taken in order by the main one, so
/// that nothing has to be safe inside a signal handler.
sigset_t endingSignals()
{
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

/// Waits a moment for a signal. @return whether one came
bool signalled(const sigset_t& signals)
{
  const timespec moment = { 0, 100000000 };
  return sigtimedwait(&signals, nullptr, &moment) > 0;
}

/// @return false if a signal came first
bool waitForMaster(const sigset_t& signals)
{
  while (!ros::master::check())
  {
    ROS_WARN_STREAM_ONCE("Waiting for the master at " << ros::master::getURI());
    if (signalled(signals))
    {
      return false;
    }
  }
  return true;
}

void waitForEnd(const sigset_t& signals)
{
  while (ros::ok() && !signalled(signals))
  {
  }
}

/// @return exit status
int run(const sigset_t& signals)
{
  const ros::NodeHandle node("~");  // outlives the complaint: without one, roscpp is mute
  try
  {
    const auto cloth = cloth_tearing::makeClothNode(node);
    waitForEnd(signals);
  }
  catch (const std::exception& error)
  {
    ROS_FATAL_STREAM(error.what());
    return 1;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv)
{
  const sigset_t signals = endingSignals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);  // before there are threads: they inherit it
  try
  {
    ros::init(argc, argv, "cloth", ros::init_options::NoSigintHandler);
  }
  catch (const ros::Exception& error)
  {
    ROS_FATAL_STREAM(error.what());
    return 1;
  }
  if (!waitForMaster(signals))
  {
    return 0;
  }
  const int status = run(signals);
  ros::shutdown();
  return status;
}
