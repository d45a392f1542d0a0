// Runs a ClothNode until SIGINT, SIGTERM or the master ends it.
#include <malloc.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/node_handle.h>

#include <chrono>
#include <exception>

#include "cloth_tearing/node/ending.h"
#include "cloth_tearing/node/make_cloth_node.h"
#include "cloth_tearing/node/xmlrpc_peer.h"

namespace
{

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

/// How many heaps the node's threads share. glibc would give one to each thread up to eight a core,
/// and what is allocated as users come and go would fragment all of them.
constexpr int HEAPS = 2;

bool masterAnswers(const std::atomic<bool>& giving_up)
{
  try
  {
    return cloth_tearing::XmlRpcPeer(ros::master::getURI(), 2s, giving_up)
        .call("getPid", {})
        .has_value();
  }
  catch (const cloth_tearing::NoAnswer&)
  {
    return false;
  }
}

/// @return false if the end came first
bool waitForMaster(cloth_tearing::Ending& ending)
{
  while (!masterAnswers(ending.begun()))
  {
    ROS_WARN_STREAM_ONCE("Waiting for the master at " << ros::master::getURI());
    if (ending.waitFor(100ms))
    {
      return false;
    }
  }
  return true;
}

void waitForEnd(cloth_tearing::Ending& ending)
{
  while (ros::ok() && !ending.waitFor(100ms))
  {
  }
  ending.begin();
}

/// @return exit status
int run(cloth_tearing::Ending& ending)
{
  const ros::NodeHandle node("~");  // outlives the complaint: without one, roscpp is mute
  try
  {
    const auto cloth = cloth_tearing::makeClothNode(node);
    // What is opened later does not wait for a master that is gone: the watchdog registers it.
    ros::master::setRetryTimeout(ros::WallDuration(0.1));
    waitForEnd(ending);
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
  mallopt(M_ARENA_MAX, HEAPS);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that gets too long is an error of its own writing
  cloth_tearing::Ending ending(2s);
  try
  {
    ros::init(argc, argv, "cloth", ros::init_options::NoSigintHandler);
  }
  catch (const ros::Exception& error)
  {
    ROS_FATAL_STREAM(error.what());
    return 1;
  }
  if (!waitForMaster(ending))
  {
    return 0;
  }
  const int status = run(ending);
  ros::shutdown();
  return status;
}
