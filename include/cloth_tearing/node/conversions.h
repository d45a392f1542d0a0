// Moves data between the core's types and the messages. Pure functions: no node, no clock, no tf.
#pragma once

#include <cloth_tearing/ClothSurface.h>
#include <cloth_tearing/CollisionSpheres.h>
#include <cloth_tearing/Drag.h>
#include <cloth_tearing/GetTearEvents.h>
#include <cloth_tearing/Grasp.h>
#include <cloth_tearing/SimulationStatus.h>
#include <cloth_tearing/Step.h>
#include <cloth_tearing/TearEvents.h>
#include <cloth_tearing/ThrowSphere.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Transform.h>

#include <string>
#include <vector>

#include "cloth_tearing/core/simulation.h"
#include "cloth_tearing/core/simulation_loop.h"

namespace cloth_tearing
{

/// Where the core's coordinates are at home: the cloth frame has the axes of `frame_id`.
struct Placement
{
  std::string frame_id;
  cloth::Vec3d origin = cloth::Vec3d::Zero();  ///< of the cloth frame, in frame_id [m]
};

/// "world at (0, 0, 1.5)": with all digits, so that different places never read the same.
std::string toWords(const Placement& placement);

// -- out -----------------------------------------------------------------------------------------

/// `x` [m] of the cloth frame, in frame_id.
inline geometry_msgs::Point toPoint(const cloth::Vec3d& x, const Placement& placement)
{
  geometry_msgs::Point p;
  p.x = x.x() + placement.origin.x();
  p.y = x.y() + placement.origin.y();
  p.z = x.z() + placement.origin.z();
  return p;
}

geometry_msgs::Vector3 toVector3(const cloth::Vec3d& v);

/// In frame_id.
geometry_msgs::Pose toPose(const cloth::Pose& pose, const Placement& placement);

/// The header has no stamp yet.
ClothSurface toMessage(const cloth::Surface& surface, const Placement& placement);

/// The two parts of that, each written over what `message` had of it: what stays while the topology
/// does, and the rest.
void fillTopology(ClothSurface& message, const cloth::SurfaceTopology& topology);
void fillMotion(ClothSurface& message, const cloth::Surface& surface, const Placement& placement);

TearEvent toMessage(const cloth::TearEvent& event, const Placement& placement);

std::vector<TearEvent> toMessages(const std::vector<cloth::TearEvent>& events,
                                  const Placement& placement);

/// What ~status is made of.
struct StatusSource
{
  cloth::Summary summary;
  cloth::LoopState loop;
  double time_step = 0.0;  ///< [s]
  int postponed = 0;
  int grasps = 0;
  int spheres = 0;
  std::string fault;
  std::uint64_t refusals = 0;
  std::string last_refusal;
  std::string recording;          ///< path; empty = the run is not recorded
  std::string recording_problem;  ///< why it is not recorded any more; empty = all is well
};

/// The header has no stamp yet.
SimulationStatus toMessage(const StatusSource& source, const Placement& placement);

void fill(Step::Response& response, const cloth::StepAnswer& answer);

const char* name(cloth::Pace pace);

// -- in ------------------------------------------------------------------------------------------

/// Everything wrong with a request or message by itself, whatever the cloth: values that are not
/// finite, fields that contradict each other. One sentence each, naming field, value and limit.
std::vector<std::string> problems(const Grasp::Request& request);
std::vector<std::string> problems(const Drag::Request& request);
std::vector<std::string> problems(const ThrowSphere::Request& request);
std::vector<std::string> problems(const CollisionSpheres& message);

/// A quaternion of zeros means: as it is.
bool isZero(const geometry_msgs::Quaternion& q);

/// Adds a sentence to `found` unless `q` is zero or a unit quaternion, to a thousandth.
void checkOrientation(std::vector<std::string>& found, const std::string& field,
                      const geometry_msgs::Quaternion& q);

cloth::Vec3d toVector(const geometry_msgs::Point& p);
cloth::Vec3d toVector(const geometry_msgs::Vector3& v);

/// A pose of some frame in the cloth frame; its rotation only if it has one.
cloth::Pose toClothFrame(const geometry_msgs::Pose& pose, const cloth::Pose& to_cloth);

/// A transform as a pose: x -> translation + rotation * x, into the cloth frame.
cloth::Pose toClothFrame(const geometry_msgs::Transform& transform, const Placement& placement);

/// The following take requests without problems; `to_cloth` leads from the frame of their header
/// into the cloth frame.
cloth::GraspRequest toCore(const Grasp::Request& request, const cloth::Pose& to_cloth);

/// Where a drag leads. An orientation of zeros keeps the one the grasp has.
struct Destination
{
  cloth::DragTarget target;
  bool keeps_rotation = false;  ///< `target` has no rotation of its own
};
Destination toCore(const Drag::Request& request, const cloth::Pose& to_cloth);

cloth::ThrowRequest toCore(const ThrowSphere::Request& request, const cloth::Pose& to_cloth);

cloth::Sphere toCore(const CollisionSphere& sphere, const cloth::Pose& to_cloth);

}  // namespace cloth_tearing
