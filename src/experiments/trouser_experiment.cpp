// Pulls the legs of a cut sheet apart and measures the tear and the force.
#include "cloth_tearing/experiments/trouser_experiment.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cloth_tearing/experiments/torn_edges.h"

namespace cloth
{
namespace
{

const Vec2d SHEET = thesisSheetSize();   ///< [m]
constexpr double CUT = 4.0;              ///< its length [m]
constexpr double FAR = 3.0;              ///< the tear is long enough [m]
constexpr double MOST_ANGLE = 25.0;      ///< of a tear that runs on, end to end [degrees]
constexpr double MOST_STRAYING = 1.2;    ///< and its distance from the line of the cut [m]
constexpr double RADIUS = 0.75;          ///< of the discs that are held [m]
constexpr double SPEED = 0.5;            ///< of each gripper [m/s]
const Vec3d LEG(1.5, 0.0, -7.25);        ///< where the right one is held [m]
const Vec3d WAY(0.0, 7.0, 5.25);         ///< of the right gripper; the left goes to the front [m]
const Vec2d ALONG_CUT = Vec2d::UnitY();  ///< in the material

struct Leg
{
  std::uint64_t grasp;
  Vec3d pull;  ///< unit
};

Leg holdLeg(Simulation& simulation, double side, const Vec2d& shift)
{
  GraspRequest hold;
  hold.point = Vec3d(side * LEG.x() + shift.x(), LEG.y(), LEG.z() + shift.y());
  hold.frame.position = hold.point;
  hold.radius = RADIUS;
  const Vec3d way(WAY.x(), side * WAY.y(), WAY.z());
  DragTarget target;
  target.pose.position = hold.point + way;
  target.linear_speed = SPEED;
  const Leg leg{ simulation.grasp(hold).id, way.normalized() };
  simulation.drag(leg.grasp, target);
  return leg;
}

/// Material place of the particle that ends the cut: the one nearest to where it was to end.
Vec2d endOfCut(const Cloth& cloth)
{
  const Vec2d wanted(0.5 * SHEET.x(), CUT);
  Vec2d nearest = Vec2d::Zero();
  for (int i = 0; i < cloth.mesh.triangleCount(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Vec2d place = materialPosition(cloth.mesh.triangle({ i }), k, SHEET);
      nearest = (place - wanted).norm() < (nearest - wanted).norm() ? place : nearest;
    }
  }
  return nearest;
}

/// The torn point that lies farthest in the direction of the cut.
Vec2d endOfTear(const std::vector<TornEdge>& edges, const Vec2d& start)
{
  Vec2d farthest = start;
  for (const TornEdge& edge : edges)
  {
    for (const Vec2d& place : { edge.start, edge.end })
    {
      farthest = place.y() > farthest.y() ? place : farthest;
    }
  }
  return farthest;
}

void measureTear(const Cloth& cloth, const Vec2d& start, TrouserOutcome& outcome)
{
  const std::vector<TornEdge> edges = tornEdges(cloth, SHEET);
  const Vec2d way = endOfTear(edges, start) - start;
  outcome.advance = way.y();
  if (!(outcome.advance > 0.0))
  {
    return;
  }
  outcome.angle = std::atan2(std::abs(way.x()), way.y()) * 180.0 / M_PI;
  outcome.edge_angle = meanAngleTo(edges, ALONG_CUT);
  double length = 0.0;
  double squares = 0.0;
  for (const TornEdge& edge : edges)
  {
    const double aside = 0.5 * (edge.start + edge.end).x() - start.x();
    length += edge.length();
    squares += edge.length() * aside * aside;
  }
  outcome.straying = std::sqrt(squares / length);
  outcome.tortuosity = 0.5 * length / outcome.advance;
}

double meanEdge(const Cloth& cloth)
{
  double sum = 0.0;
  for (double length : cloth.rest.length)
  {
    sum += length;
  }
  return sum / static_cast<double>(cloth.rest.length.size());
}

/// The force of one spring on its end `held`.
Vec3d forceOn(const ParticleState& state, const SpringLaw& law, int held)
{
  const int free = law.a == held ? law.b : law.a;
  const Vec3d way = (state.position[free] - state.position[held]).cast<double>();
  const Vec3d slip = (state.velocity[free] - state.velocity[held]).cast<double>();
  const double length = way.norm();
  const double tension = law.stiffness * (length - law.rest) + law.damping * slip.dot(way) / length;
  return tension / length * way;
}

}  // namespace

Vec3d forceOnGrasp(const Simulation& simulation, std::uint64_t grasp)
{
  const Cloth& cloth = simulation.cloth();
  const auto holds = [&](int p)
  {
    const Attachment& attachment = cloth.attachments[p];
    return attachment.kind == Attachment::Kind::GRASP && attachment.grasp == grasp;
  };
  Vec3d force = Vec3d::Zero();
  for (const auto* table : { &cloth.springs.structural, &cloth.springs.bend_shear })
  {
    for (const SpringLaw& law : *table)
    {
      if (law.active() && holds(law.a) != holds(law.b))
      {
        force += forceOn(cloth.state, law, holds(law.a) ? law.a : law.b);
      }
    }
  }
  return force;
}

bool TrouserOutcome::runsOn() const
{
  return advance >= FAR && angle <= MOST_ANGLE && straying <= MOST_STRAYING;
}

Simulation trousers(const Setting& setting)
{
  RectangleParams sheet = thesisSheet(setting);
  sheet.slits = { { Vec2d(0.0, -SHEET.y()), Vec2d(0.0, CUT - SHEET.y()) } };
  SimulationParams params = thesisParams(setting);
  params.environment.gravity = Vec3d::Zero();
  return hungSheet(sheet, params);
}

TrouserOutcome pullLegs(Simulation& simulation, const Vec2d& shift, const Watch& watch)
{
  const std::array<Leg, 2> legs = { holdLeg(simulation, 1.0, shift),
                                    holdLeg(simulation, -1.0, shift) };
  const Vec2d start = endOfCut(simulation.cloth());
  TrouserOutcome outcome;
  outcome.edge_length = meanEdge(simulation.cloth());
  const auto steps = std::lround(WAY.norm() / SPEED / simulation.params().solver.time_step);
  double sum = 0.0;
  int samples = 0;
  for (long i = 0; i < steps && outcome.advance < FAR; ++i)
  {
    const StepReport report = stepOrThrow(simulation);
    for (const TearEvent& tear : report.tears)
    {
      ++outcome.tears;
      outcome.released += tear.kind == TearKind::RELEASED ? 1 : 0;
    }
    if (!report.tears.empty())
    {
      measureTear(simulation.cloth(), start, outcome);
    }
    if (outcome.tears > 0)
    {
      for (const Leg& leg : legs)
      {
        const double force = -leg.pull.dot(forceOnGrasp(simulation, leg.grasp));
        outcome.peak_force = std::max(outcome.peak_force, force);
        sum += force;
        ++samples;
      }
    }
    if (watch)
    {
      watch(simulation, report);
    }
  }
  outcome.mean_force = samples > 0 ? sum / samples : 0.0;
  outcome.pieces = simulation.cloth().damage.pieces;
  return outcome;
}

}  // namespace cloth
