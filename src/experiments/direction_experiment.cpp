// Pulls a disc out of the cloth and measures crack and flap.
#include "cloth_tearing/experiments/direction_experiment.h"

#include <algorithm>
#include <cmath>

#include "cloth_tearing/experiments/torn_edges.h"

namespace cloth
{
namespace
{

constexpr double SETTLING = 4.0;     ///< a framed cloth is at rest after so long [s]
constexpr double EARLY = 2.0;        ///< torn length, both sides, of "the crack opens" [m]
constexpr double FLAP_LENGTH = 1.0;  ///< cloth so far from the disc, in the material, is flap [m]
const Vec2d SHEET(6.0, 8.0);         ///< thesisSheet() [m]

Vec2d inSheet(double degrees)
{
  return Vec2d(std::cos(degrees * M_PI / 180.0), std::sin(degrees * M_PI / 180.0));
}

Vec3d inWorld(const DirectionPull& pull)
{
  const double lift = pull.lift * M_PI / 180.0;
  const Vec2d along = std::cos(lift) * inSheet(pull.angle);
  return Vec3d(along.x(), -std::sin(lift), along.y());
}

Vec2d materialCentre(const Triangle& triangle)
{
  return (materialPosition(triangle, 0, SHEET) + materialPosition(triangle, 1, SHEET) +
          materialPosition(triangle, 2, SHEET)) /
         3.0;
}

/// Triangles that hang together with the gripper's, within `reach` [m] of `centre` in the material.
std::vector<TriangleId> clothAround(const Cloth& cloth, const Grasp& grasp, const Vec2d& centre,
                                    double reach)
{
  std::vector<char> met(cloth.mesh.triangleCount(), 0);
  std::vector<TriangleId> around;
  const auto meet = [&](ParticleId p)
  {
    cloth.mesh.forEachTriangleAt(p,
                                 [&](TriangleId t)
                                 {
                                   const Vec2d away =
                                       materialCentre(cloth.mesh.triangle(t)) - centre;
                                   if (!met[t.index] && away.norm() < reach)
                                   {
                                     met[t.index] = 1;
                                     around.push_back(t);
                                   }
                                 });
  };
  for (const Grasp::Held& held : grasp.held)
  {
    meet(held.particle);
  }
  for (std::size_t i = 0; i < around.size(); ++i)
  {
    for (ParticleId p : cloth.mesh.triangle(around[i]).particles)
    {
      meet(p);
    }
  }
  return around;
}

/// See DirectionOutcome::flap_angle [degrees].
std::optional<double> flapAngle(const Cloth& cloth, const Grasp& grasp, const Vec2d& centre,
                                const DirectionPull& pull)
{
  Vec3d sum = Vec3d::Zero();
  double area = 0.0;
  for (TriangleId t : clothAround(cloth, grasp, centre, pull.radius + FLAP_LENGTH))
  {
    const Triangle& triangle = cloth.mesh.triangle(t);
    if ((materialCentre(triangle) - centre).norm() < pull.radius)
    {
      continue;
    }
    for (ParticleId p : triangle.particles)
    {
      sum += cloth.rest.area[t.index] / 3.0 * cloth.state.position[p.index].cast<double>();
    }
    area += cloth.rest.area[t.index];
  }
  if (!(area > 0.0))
  {
    return std::nullopt;
  }
  const Vec3d way = grasp.pose.position - sum / area;
  const double cosine = std::abs(way.dot(inWorld(pull))) / way.norm();
  return std::acos(std::min(1.0, cosine)) * 180.0 / M_PI;
}

}  // namespace

Vec2d shiftOf(std::uint64_t seed)
{
  // Golden-ratio steps: spread evenly, never twice the same.
  const auto part = [](double x) { return x - std::floor(x); };
  const auto n = static_cast<double>(seed);
  return Vec2d(0.4 * part(0.7548776662466927 * n) - 0.2, 0.4 * part(0.5698402909980532 * n) - 0.2);
}

DirectionPull framedPull(double angle, const Vec2d& shift)
{
  DirectionPull pull;
  pull.angle = angle;
  pull.lift = 30.0;
  pull.shift = shift;
  return pull;
}

DirectionPull downwardPull(const Vec2d& shift)
{
  DirectionPull pull;
  pull.angle = 270.0;
  pull.lift = 5.0;
  pull.radius = 1.0;
  pull.way = 2.0;
  pull.shift = shift;
  return pull;
}

Simulation framedCloth(const Setting& setting)
{
  ClothModel model = rectangle(thesisSheet(setting));
  std::vector<int> frame;
  for (std::size_t i = 0; i < model.positions.size(); ++i)
  {
    Vec3d& x = model.positions[i];
    const double side = 0.5 * SHEET.x() - std::abs(x.x());
    const double end = std::min(-x.y(), SHEET.y() + x.y());
    if (std::min(side, end) < 1e-9)
    {
      frame.push_back(static_cast<int>(i));
    }
    x = Vec3d(x.x(), -x.z(), x.y());
  }
  Simulation simulation(model, frame, thesisParams(setting));
  settle(simulation, SETTLING);
  return simulation;
}

DirectionOutcome pullDisc(Simulation& simulation, const DirectionPull& pull, const Watch& watch)
{
  const Vec2d middle = 0.5 * SHEET + pull.shift;  // in the material
  GraspRequest hold;
  hold.point = Vec3d(middle.x() - 0.5 * SHEET.x(), 0.0,
                     hangingHeight(simulation) * (middle.y() / SHEET.y() - 1.0));
  hold.frame.position = hold.point;
  hold.radius = pull.radius;
  const std::uint64_t gripper = simulation.grasp(hold).id;
  DragTarget target;
  target.pose.position = hold.point + pull.way * inWorld(pull);
  target.linear_speed = pull.speed;
  simulation.drag(gripper, target);

  DirectionOutcome outcome;
  const auto measured = [&]()
  { return meanAngleTo(tornEdges(simulation.cloth(), SHEET), inSheet(pull.angle)); };
  const double dt = simulation.params().solver.time_step;
  const auto steps = std::lround(pull.way / pull.speed / dt);
  for (long i = 0; i < steps; ++i)
  {
    const StepReport report = stepOrThrow(simulation);
    if (!report.tears.empty())
    {
      const double torn = tornLength(simulation.cloth());
      outcome.first_tear = outcome.tears == 0 ? (i + 1) * dt * pull.speed : outcome.first_tear;
      outcome.tears += static_cast<int>(report.tears.size());
      for (const TearEvent& tear : report.tears)
      {
        outcome.released += tear.kind == TearKind::RELEASED ? 1 : 0;
      }
      if (torn >= EARLY && !outcome.crack_angle)
      {
        outcome.crack_angle = measured();
      }
      if (torn >= 2.0 * EARLY && !outcome.later_crack_angle)
      {
        outcome.later_crack_angle = measured();
      }
    }
    if (watch)
    {
      watch(simulation, report);
    }
  }
  if (outcome.tears > 0)
  {
    outcome.flap_angle = flapAngle(simulation.cloth(), simulation.grasps().front(), middle, pull);
  }
  outcome.torn_length = tornLength(simulation.cloth());
  outcome.pieces = simulation.cloth().damage.pieces;
  return outcome;
}

}  // namespace cloth
