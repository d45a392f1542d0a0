// Moves data between the core's types and the messages.
#include "cloth_tearing/node/conversions.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/node/frame_names.h"

namespace cloth_tearing
{

using cloth::check;
using cloth::Range;

namespace
{

/// Of a number as it is sent, in whatever frame: the core knows the limits, in the cloth frame.
const Range FINITE;

constexpr double LONGEST_KEEP_ALIVE = 3600.0;  // [s]

cloth::Quatd toQuaternion(const geometry_msgs::Quaternion& q)
{
  return { q.w, q.x, q.y, q.z };
}

/// `value` as short as it reads back the very same.
std::string inFull(double value)
{
  char digits[32];
  const double unsigned_zero = value == 0.0 ? 0.0 : value;
  return { digits, std::to_chars(digits, digits + sizeof digits, unsigned_zero).ptr };
}

std::uint32_t toId(cloth::ParticleId p)
{
  return static_cast<std::uint32_t>(p.index);
}

std::uint8_t toMessage(cloth::TearKind kind)
{
  switch (kind)
  {
    case cloth::TearKind::BASIC:
      return TearEvent::BASIC;
    case cloth::TearKind::WEAK_POINT:
      return TearEvent::WEAK_POINT;
    case cloth::TearKind::ONE_POINT:
      return TearEvent::ONE_POINT;
    case cloth::TearKind::RELEASED:
      break;
  }
  return TearEvent::RELEASED;
}

std::uint8_t toMessage(cloth::CauseKind kind)
{
  switch (kind)
  {
    case cloth::CauseKind::GRASP:
      return TearEvent::GRASP;
    case cloth::CauseKind::SPHERE:
      return TearEvent::SPHERE;
    case cloth::CauseKind::THROWN_SPHERE:
      return TearEvent::THROWN_SPHERE;
    case cloth::CauseKind::NONE:
      break;
  }
  return TearEvent::NO_CAUSE;
}

/// Writes pairs one after the other over `list`.
void fillPairs(std::vector<std::uint32_t>& list, const std::vector<std::array<int, 2>>& pairs)
{
  list.clear();
  list.reserve(2 * pairs.size());
  for (const std::array<int, 2>& pair : pairs)
  {
    list.insert(list.end(), pair.begin(), pair.end());
  }
}

void fillTriangles(ClothSurface& message, const std::vector<cloth::SurfaceTriangle>& triangles)
{
  message.triangles.clear();
  message.triangles.reserve(3 * triangles.size());
  message.uv.clear();
  message.uv.reserve(6 * triangles.size());
  for (const cloth::SurfaceTriangle& t : triangles)
  {
    message.triangles.insert(message.triangles.end(), t.particles.begin(), t.particles.end());
    for (const cloth::Vec2d& uv : t.uv)
    {
      message.uv.push_back(static_cast<float>(uv.x()));
      message.uv.push_back(static_cast<float>(uv.y()));
    }
  }
}

void fillPositions(ClothSurface& message, const std::vector<cloth::Vec3>& positions)
{
  message.positions.resize(3 * positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    std::copy_n(positions[i].data(), 3, &message.positions[3 * i]);
  }
}

void fillHeld(ClothSurface& message, const std::vector<cloth::HeldParticle>& held)
{
  message.held.resize(held.size());
  for (std::size_t i = 0; i < held.size(); ++i)
  {
    message.held[i].particle = static_cast<std::uint32_t>(held[i].particle);
    message.held[i].grasp = held[i].grasp;
  }
}

}  // namespace

// -- out -----------------------------------------------------------------------------------------

std::string toWords(const Placement& placement)
{
  std::string words = placement.frame_id + " at (";
  for (int i = 0; i < 3; ++i)
  {
    words += (i > 0 ? ", " : "") + inFull(placement.origin[i]);
  }
  return words + ")";
}

geometry_msgs::Vector3 toVector3(const cloth::Vec3d& v)
{
  geometry_msgs::Vector3 vector;
  vector.x = v.x();
  vector.y = v.y();
  vector.z = v.z();
  return vector;
}

geometry_msgs::Pose toPose(const cloth::Pose& pose, const Placement& placement)
{
  geometry_msgs::Pose message;
  message.position = toPoint(pose.position, placement);
  message.orientation.x = pose.rotation.x();
  message.orientation.y = pose.rotation.y();
  message.orientation.z = pose.rotation.z();
  message.orientation.w = pose.rotation.w();
  return message;
}

ClothSurface toMessage(const cloth::Surface& surface, const Placement& placement)
{
  ClothSurface message;
  fillTopology(message, *surface.topology);
  fillMotion(message, surface, placement);
  return message;
}

void fillTopology(ClothSurface& message, const cloth::SurfaceTopology& topology)
{
  message.revision = topology.revision;
  fillPairs(message.parents, topology.parents);
  fillTriangles(message, topology.triangles);
  fillPairs(message.torn_edges, topology.torn_edges);
  message.weak_points.assign(topology.weak_points.begin(), topology.weak_points.end());
}

void fillMotion(ClothSurface& message, const cloth::Surface& surface, const Placement& placement)
{
  message.header.frame_id = placement.frame_id;
  message.time = surface.time;
  message.step = surface.step;
  message.epoch = surface.epoch;
  message.origin = toPoint(cloth::Vec3d::Zero(), placement);
  fillPositions(message, surface.position);
  findParticleStrains(surface, message.strain);
  fillHeld(message, surface.held);
}

TearEvent toMessage(const cloth::TearEvent& event, const Placement& placement)
{
  TearEvent message;
  message.sequence = event.sequence;
  message.epoch = event.epoch;
  message.step = event.step;
  message.time = event.time;
  message.kind = toMessage(event.kind);
  for (const cloth::TearEvent::Added& added : event.particles)
  {
    message.particles.push_back(toId(added.id));
    message.parents.push_back(toId(added.parents[0]));
    message.parents.push_back(toId(added.parents[1]));
  }
  message.spring = static_cast<std::uint32_t>(event.spring.index);
  message.path = event.path.index;
  for (const cloth::TriangleId t : event.triangles)
  {
    message.triangles.push_back(static_cast<std::uint32_t>(t.index));
  }
  message.position = toPoint(event.position, placement);
  message.uv[0] = event.uv.x();
  message.uv[1] = event.uv.y();
  message.strain = event.strain;
  message.threshold = event.threshold;
  message.tension = event.tension;
  message.cause = toMessage(event.cause.kind);
  message.cause_id = event.cause.id;
  message.cause_distance = event.cause.distance;
  message.pieces = static_cast<std::uint32_t>(event.pieces);
  message.loose_area = event.loose_area;
  message.loose_mass = event.loose_mass;
  return message;
}

std::vector<TearEvent> toMessages(const std::vector<cloth::TearEvent>& events,
                                  const Placement& placement)
{
  std::vector<TearEvent> messages;
  messages.reserve(events.size());
  for (const cloth::TearEvent& event : events)
  {
    messages.push_back(toMessage(event, placement));
  }
  return messages;
}

SimulationStatus toMessage(const StatusSource& source, const Placement& placement)
{
  const cloth::Summary& summary = source.summary;
  SimulationStatus message;
  message.header.frame_id = placement.frame_id;
  message.time = summary.time;
  message.step = summary.step;
  message.epoch = summary.epoch;
  message.revision = summary.revision;
  message.pace = name(source.loop.pace);
  message.paused = source.loop.paused;
  message.fault = source.fault;
  message.time_step = source.time_step;
  message.speed = source.loop.speed;
  message.real_time_factor = source.loop.real_time_factor;
  message.clock_jumps = source.loop.clock_jumps;
  const auto tears = [&summary](cloth::TearKind kind)
  { return summary.tears[static_cast<std::size_t>(kind)]; };
  message.basic_tears = tears(cloth::TearKind::BASIC);
  message.weak_point_tears = tears(cloth::TearKind::WEAK_POINT);
  message.one_point_tears = tears(cloth::TearKind::ONE_POINT);
  message.released_springs = tears(cloth::TearKind::RELEASED);
  message.postponed_tears = static_cast<std::uint32_t>(source.postponed);
  message.particles = static_cast<std::uint32_t>(summary.particles);
  message.springs = static_cast<std::uint32_t>(summary.springs);
  message.bend_shear_springs = static_cast<std::uint32_t>(summary.bend_shear_springs);
  message.triangles = static_cast<std::uint32_t>(summary.triangles);
  message.pieces = static_cast<std::uint32_t>(summary.pieces);
  message.pieces_at_rest = static_cast<std::uint32_t>(summary.pieces_at_rest);
  message.grasps = static_cast<std::uint32_t>(source.grasps);
  message.spheres = static_cast<std::uint32_t>(source.spheres);
  message.rest_area = summary.rest_area;
  message.mass = summary.mass;
  message.max_strain = summary.max_strain;
  message.utilisation = summary.utilisation;
  message.utilisation_at = toPoint(summary.utilisation_at, placement);
  message.refusals = source.refusals;
  message.last_refusal = source.last_refusal;
  message.recording = source.recording;
  message.recording_problem = source.recording_problem;
  message.state_hash = summary.state_hash;
  return message;
}

void fill(Step::Response& response, const cloth::StepAnswer& answer)
{
  response.success = answer.cut_short.empty();
  response.message = answer.cut_short;
  response.steps_done = answer.steps;
  response.time = answer.time;
  response.step = answer.step;
  response.epoch = answer.epoch;
  response.state_hash = answer.state_hash;
  response.tears = answer.tears;
}

const char* name(cloth::Pace pace)
{
  switch (pace)
  {
    case cloth::Pace::WALL:
      return "wall";
    case cloth::Pace::FREE:
      return "free";
    case cloth::Pace::CLOCK:
      return "clock";
    case cloth::Pace::STEP:
      break;
  }
  return "step";
}

// -- in ------------------------------------------------------------------------------------------

cloth::Vec3d toVector(const geometry_msgs::Point& p)
{
  return { p.x, p.y, p.z };
}

cloth::Vec3d toVector(const geometry_msgs::Vector3& v)
{
  return { v.x, v.y, v.z };
}

bool isZero(const geometry_msgs::Quaternion& q)
{
  return q.x == 0.0 && q.y == 0.0 && q.z == 0.0 && q.w == 0.0;
}

void checkOrientation(std::vector<std::string>& found, const std::string& field,
                      const geometry_msgs::Quaternion& q)
{
  if (!isZero(q))
  {
    cloth::check(found, field, toQuaternion(q));
  }
}

cloth::Pose toClothFrame(const geometry_msgs::Pose& pose, const cloth::Pose& to_cloth)
{
  cloth::Pose placed;
  placed.position = to_cloth.apply(toVector(pose.position));
  if (!isZero(pose.orientation))
  {
    placed.rotation = (to_cloth.rotation * toQuaternion(pose.orientation)).normalized();
  }
  return placed;
}

std::vector<std::string> problems(const Grasp::Request& request)
{
  std::vector<std::string> found;
  check(found, "point", toVector(request.point), FINITE.high);
  check(found, "radius [m]", request.radius, FINITE);
  check(found, "force_limit [N]", request.force_limit, FINITE);
  check(found, "keep_alive [s]", request.keep_alive, Range::between(0.0, LONGEST_KEEP_ALIVE));
  checkFrameName(found, "gripper_frame", request.gripper_frame);
  return found;
}

std::vector<std::string> problems(const Drag::Request& request)
{
  std::vector<std::string> found;
  check(found, "target.position", toVector(request.target.position), FINITE.high);
  checkOrientation(found, "target.orientation", request.target.orientation);
  check(found, "linear_speed [m/s]", request.linear_speed, FINITE);
  check(found, "angular_speed [rad/s]", request.angular_speed, FINITE);
  return found;
}

std::vector<std::string> problems(const ThrowSphere::Request& request)
{
  std::vector<std::string> found;
  check(found, "center", toVector(request.center), FINITE.high);
  check(found, "velocity", toVector(request.velocity), FINITE.high);
  check(found, "radius [m]", request.radius, FINITE);
  check(found, "mass [kg]", request.mass, FINITE);
  check(found, "lifetime [s]", request.lifetime, Range::between(0.0, cloth::MAX_LIFETIME));
  return found;
}

std::vector<std::string> problems(const CollisionSpheres& message)
{
  std::vector<std::string> found;
  if (message.spheres.size() > cloth::MAX_SPHERES)
  {
    return { "spheres has " + std::to_string(message.spheres.size()) +
             " entries, must be at most " + std::to_string(cloth::MAX_SPHERES) };
  }
  for (std::size_t i = 0; i < message.spheres.size(); ++i)
  {
    const CollisionSphere& sphere = message.spheres[i];
    const std::string field = "spheres[" + std::to_string(i) + "].";
    check(found, field + "center", toVector(sphere.center), FINITE.high);
    check(found, field + "velocity", toVector(sphere.velocity), FINITE.high);
    check(found, field + "radius [m]", sphere.radius, FINITE);
    check(found, field + "mass [kg]", sphere.mass, FINITE);
    if (!sphere.frame.empty() && !toVector(sphere.velocity).isZero(0.0))
    {
      found.push_back(field + "velocity must be 0: the sphere moves as its frame " + sphere.frame +
                      " does");
    }
    checkFrameName(found, field + "frame", sphere.frame);
  }
  return found;
}

cloth::Pose toClothFrame(const geometry_msgs::Transform& transform, const Placement& placement)
{
  cloth::Pose pose;
  pose.position = toVector(transform.translation) - placement.origin;
  pose.rotation = toQuaternion(transform.rotation).normalized();
  return pose;
}

cloth::GraspRequest toCore(const Grasp::Request& request, const cloth::Pose& to_cloth)
{
  cloth::GraspRequest grasp;
  grasp.point = to_cloth.apply(toVector(request.point));
  grasp.radius = request.radius;
  grasp.frame.position = grasp.point;
  grasp.force_limit = request.force_limit;
  grasp.followed = request.gripper_frame;
  return grasp;
}

Destination toCore(const Drag::Request& request, const cloth::Pose& to_cloth)
{
  Destination destination;
  destination.keeps_rotation = isZero(request.target.orientation);
  cloth::DragTarget& target = destination.target;
  target.pose = toClothFrame(request.target, to_cloth);
  target.linear_speed = request.linear_speed;
  if (!destination.keeps_rotation || request.angular_speed != 0.0)
  {
    target.angular_speed = request.angular_speed;
  }
  return destination;
}

cloth::ThrowRequest toCore(const ThrowSphere::Request& request, const cloth::Pose& to_cloth)
{
  cloth::ThrowRequest sphere;
  sphere.center = to_cloth.apply(toVector(request.center));
  sphere.velocity = to_cloth.rotation * toVector(request.velocity);
  sphere.radius = request.radius;
  sphere.mass = request.mass;
  if (request.lifetime != 0.0)
  {
    sphere.lifetime = request.lifetime;
  }
  return sphere;
}

cloth::Sphere toCore(const CollisionSphere& sphere, const cloth::Pose& to_cloth)
{
  cloth::Sphere converted;
  converted.source = cloth::SphereSource::STREAMED;
  converted.id = sphere.id;
  converted.center = to_cloth.apply(toVector(sphere.center));
  converted.previous = converted.center;
  converted.velocity = to_cloth.rotation * toVector(sphere.velocity);
  converted.radius = sphere.radius;
  converted.mass = sphere.mass;
  converted.frame = sphere.frame;
  converted.center_in_frame = toVector(sphere.center);
  return converted;
}

}  // namespace cloth_tearing
