// Pulls a disc out of the cloth and measures crack and flap.
#include "cloth_tearing/experiments/direction_experiment.h"

#include <algorithm>
#include <cmath>

#include "cloth_tearing/core/pieces.h"
#include "cloth_tearing/experiments/torn_edges.h"

namespace cloth
{
namespace
{

constexpr double SETTLING = 4.0;     ///< a framed cloth is at rest after so long [s]
constexpr double EARLY = 2.0;        ///< torn length, both sides, of "the crack opens" [m]
constexpr double FLAP_LENGTH = 1.0;  ///< cloth so far from the disc, in the material, is flap [m]
const Vec2d SHEET = thesisSheetSize();  ///< [m]

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

/// Of the disc, before it is pulled.
Vec2d materialMiddle(const DirectionPull& pull)
{
  return 0.5 * SHEET + pull.shift;
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
std::optional<double> flapAngle(const Cloth& cloth, const Grasp& grasp, const DirectionPull& pull)
{
  const Vec2d centre = materialMiddle(pull);
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
  const double cosine = way.dot(inWorld(pull)) / way.norm();
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / M_PI;
}

bool hangsFromPin(const Cloth& cloth, const Grasp& grasp)
{
  Pieces pieces;
  const std::vector<ParticleId> piece = pieces.pieceOf(cloth.mesh, grasp.held.front().particle);
  return std::any_of(piece.begin(), piece.end(),
                     [&](ParticleId p) { return cloth.attachments[p.index].pinned(); });
}

/// Follows a crack while it grows.
class CrackGauge
{
public:
  explicit CrackGauge(const Vec2d& pull) : pull_(pull) {}

  /// To be called after each step that tore.
  void read(const Cloth& cloth, DirectionOutcome& outcome)
  {
    const double torn = tornLength(cloth);
    if (torn >= EARLY && !outcome.crack)
    {
      early_ = tornEdges(cloth, SHEET);
      outcome.crack = anglesOf(early_);
    }
    if (torn >= 2.0 * EARLY && !outcome.later_crack)
    {
      outcome.later_crack = anglesOf(tornEdges(cloth, SHEET));
    }
  }

  std::optional<TearCourse> course(const Cloth& cloth) const
  {
    const std::vector<TornEdge> all = tornEdges(cloth, SHEET);
    const double late_length = lengthOf(all) - lengthOf(early_);
    if (early_.empty() || !(late_length > 0.0))
    {
      return std::nullopt;
    }
    const Vec2d early = middleOf(early_);
    const Vec2d late = (lengthOf(all) * middleOf(all) - lengthOf(early_) * early) / late_length;
    const Vec2d way = late - early;
    return TearCourse{ way.dot(pull_), pull_.x() * way.y() - pull_.y() * way.x() };
  }

private:
  CrackAngles anglesOf(const std::vector<TornEdge>& edges) const
  {
    return { lineAngleTo(edges, pull_), meanAngleTo(edges, pull_) };
  }

  Vec2d pull_;                   ///< its direction in the material
  std::vector<TornEdge> early_;  ///< of the first metre
};

void holdDisc(Simulation& simulation, const DirectionPull& pull)
{
  const Vec2d middle = materialMiddle(pull);
  GraspRequest hold;
  hold.point = Vec3d(middle.x() - 0.5 * SHEET.x(), 0.0,
                     hangingHeight(simulation) * (middle.y() / SHEET.y() - 1.0));
  hold.frame.position = hold.point;
  hold.radius = pull.radius;
  DragTarget target;
  target.pose.position = hold.point + pull.way * inWorld(pull);
  target.linear_speed = pull.speed;
  simulation.drag(simulation.grasp(hold).id, target);
}

void countTears(const StepReport& report, double way, DirectionOutcome& outcome)
{
  outcome.first_tear = outcome.tears == 0 ? way : outcome.first_tear;
  outcome.tears += static_cast<int>(report.tears.size());
  for (const TearEvent& tear : report.tears)
  {
    outcome.released += tear.kind == TearKind::RELEASED ? 1 : 0;
  }
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

DirectionPull outwardPull(const Vec2d& shift)
{
  DirectionPull pull = framedPull(0.0, shift);
  pull.lift = 90.0;
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

Simulation withoutTearing(const Simulation& simulation)
{
  Simulation untorn = simulation;
  TearRules off = untorn.params().tearing;
  off.enabled = false;
  untorn.setTearRules(off);
  return untorn;
}

double TearCourse::angle() const
{
  return std::atan2(std::abs(across), along) * 180.0 / M_PI;
}

DirectionOutcome pullDisc(Simulation& simulation, const DirectionPull& pull, const Watch& watch)
{
  holdDisc(simulation, pull);
  DirectionOutcome outcome;
  CrackGauge gauge(inSheet(pull.angle));
  const auto flap = [&]()
  { return flapAngle(simulation.cloth(), simulation.grasps().front(), pull); };
  const double dt = simulation.params().solver.time_step;
  const auto steps = std::lround(pull.way / pull.speed / dt);
  for (long i = 0; i < steps; ++i)
  {
    const StepReport report = stepOrThrow(simulation);
    if (!report.tears.empty())
    {
      countTears(report, (i + 1) * dt * pull.speed, outcome);
      gauge.read(simulation.cloth(), outcome);
    }
    outcome.flap_angle = i == steps / 2 ? flap() : outcome.flap_angle;
    if (watch)
    {
      watch(simulation, report);
    }
  }
  outcome.last_flap_angle = flap();
  outcome.course = gauge.course(simulation.cloth());
  outcome.loose = !hangsFromPin(simulation.cloth(), simulation.grasps().front());
  outcome.torn_length = tornLength(simulation.cloth());
  outcome.pieces = simulation.cloth().damage.pieces;
  return outcome;
}

}  // namespace cloth
