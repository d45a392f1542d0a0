// Finds the way from any frame into the cloth frame, or says why there is none.
#include "cloth_tearing/node/frames.h"

#include <tf2/exceptions.h>

#include <thread>

#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/node/frame_names.h"

namespace cloth_tearing
{

namespace
{

constexpr std::chrono::milliseconds LOOK_AGAIN(5);

}  // namespace

Frames::Frames(const Placement& placement, std::chrono::duration<double> patience)
    : placement_(placement), patience_(patience)
{
}

cloth::Pose Frames::toCloth(const std_msgs::Header& header) const
{
  return toCloth(header.frame_id, header.stamp, "header.frame_id");
}

cloth::Pose Frames::toCloth(const std::string& frame, const ros::Time& stamp,
                            const std::string& field) const
{
  if (frame.empty())
  {
    throw cloth::Refusal(field + " is empty, must name the frame of the values (the cloth's is " +
                         placement_.frame_id + ")");
  }
  std::vector<std::string> found;
  checkFrameName(found, field, frame);
  cloth::refuseIf(found);
  if (frame == placement_.frame_id)
  {
    return { -placement_.origin, cloth::Quatd::Identity() };
  }
  // tf2 itself is never asked to wait: it would on ROS time, which may stand still.
  const auto deadline = std::chrono::steady_clock::now() + patience_;
  std::string why;
  while (!canTransform(frame, stamp, why))
  {
    if (!waiting_ || std::chrono::steady_clock::now() > deadline)
    {
      throw cloth::Refusal(field + ": no transform from " + frame + " to " + placement_.frame_id +
                           ": " + why);
    }
    why.clear();  // tf2 appends to it
    std::this_thread::sleep_for(LOOK_AGAIN);
  }
  try
  {
    return toClothFrame(buffer_.lookupTransform(placement_.frame_id, frame, stamp).transform,
                        placement_);
  }
  catch (const std::exception& error)  // it went out of the buffer just now
  {
    throw cloth::Refusal(field + ": " + std::string(error.what()));
  }
}

/// @param why is told why not
bool Frames::canTransform(const std::string& frame, const ros::Time& stamp, std::string& why) const
{
  try
  {
    return buffer_.canTransform(placement_.frame_id, frame, stamp, &why);
  }
  catch (const std::exception& error)  // stamps further apart than a ros::Duration holds
  {
    why = error.what();
    return false;
  }
}

Frames::Latest Frames::latest(const std::string& frame) const
{
  Latest latest;
  if (frame == placement_.frame_id)
  {
    latest.pose.position = -placement_.origin;
    return latest;
  }
  try
  {
    const auto found = buffer_.lookupTransform(placement_.frame_id, frame, ros::Time(0));
    latest.pose = toClothFrame(found.transform, placement_);
    latest.stamp = found.header.stamp;
  }
  catch (const std::exception& error)
  {
    latest.problem = error.what();
  }
  return latest;
}

}  // namespace cloth_tearing
