// What is wrong with messages of the node, whatever it is doing.
#include "message_checks.h"

#include <algorithm>

using namespace cloth_tearing;  // NOLINT: the messages are what all of this is about

namespace soak
{

namespace
{

void expect(bool right, const std::string& what, Problems& found)
{
  if (!right)
  {
    found.push_back(what);
  }
}

void expectBelow(const std::vector<std::uint32_t>& ids, std::size_t count, const std::string& what,
                 Problems& found)
{
  expect(std::all_of(ids.begin(), ids.end(), [count](std::uint32_t id) { return id < count; }),
         what + " has an index that is none of " + std::to_string(count) + " particles", found);
}

}  // namespace

void look(const ClothSurface& surface, Problems& found)
{
  const std::size_t particles = surface.positions.size() / 3;
  expect(surface.positions.size() == 3 * particles, "positions are not threes", found);
  expect(surface.strain.size() == particles, "there is not one strain for each particle", found);
  expect(surface.parents.size() == 2 * particles, "there are not two parents each", found);
  expect(surface.triangles.size() % 3 == 0, "triangles are not threes", found);
  expect(surface.uv.size() == 2 * surface.triangles.size(), "not one uv for each corner", found);
  expect(surface.torn_edges.size() % 2 == 0, "torn_edges are not twos", found);
  expectBelow(surface.parents, particles, "parents", found);
  expectBelow(surface.triangles, particles, "triangles", found);
  expectBelow(surface.torn_edges, particles, "torn_edges", found);
  expectBelow(surface.weak_points, particles, "weak_points", found);
  for (const HeldParticle& held : surface.held)
  {
    expectBelow({ held.particle }, particles, "held", found);
  }
}

void look(const SimulationStatus& status, Problems& found)
{
  expect(status.particles > 0 && status.triangles > 0, "there is no cloth", found);
  expect(status.pieces_at_rest <= status.pieces, "more pieces at rest than pieces", found);
  expect(status.rest_area > 0.0 && status.mass > 0.0, "the cloth is nothing", found);
}

void look(const GraspStates& states, Problems& found)
{
  for (std::size_t i = 0; i < states.grasps.size(); ++i)
  {
    expect(states.grasps[i].grasp_id != 0, "a grasp has no number", found);
    expect(i == 0 || states.grasps[i].grasp_id > states.grasps[i - 1].grasp_id,
           "grasps are not ascending", found);
  }
}

void look(const GraspEvent& event, Problems& found)
{
  expect(event.sequence != 0 && event.grasp_id != 0, "an event of a grasp has no number", found);
  expect(event.kind <= GraspEvent::FRAME_FOUND, "an event of a grasp is of no kind", found);
}

void look(const TearEvent& event, Problems& found)
{
  expect(event.sequence != 0, "a tear has no number", found);
  expect(event.kind <= TearEvent::RELEASED, "a tear is of no kind", found);
  expect(event.cause <= TearEvent::THROWN_SPHERE, "a tear has no kind of cause", found);
  expect(event.parents.size() == 2 * event.particles.size(), "not two parents each", found);
  expect((event.path >= 0) == (event.kind == TearEvent::WEAK_POINT), "path and kind differ", found);
  expect(event.strain > event.threshold, "a tear below its threshold", found);
}

void look(const PullResult& result, Problems& found)
{
  expect(result.outcome <= PullResult::REFUSED, "a pull has no outcome", found);
  expect(result.outcome != PullResult::REFUSED || !result.message.empty(),
         "a pull is refused without a reason", found);
  look(result.events, found);
}

void look(const visualization_msgs::MarkerArray& markers, Problems& found)
{
  using visualization_msgs::Marker;
  for (const Marker& marker : markers.markers)
  {
    const std::string name = marker.ns + "/" + std::to_string(marker.id);
    const std::size_t points = marker.points.size();
    const bool list = marker.type == Marker::TRIANGLE_LIST || marker.type == Marker::LINE_LIST ||
                      marker.type == Marker::POINTS || marker.type == Marker::SPHERE_LIST;
    if (marker.action != Marker::ADD)
    {
      continue;
    }
    expect(!list || points > 0, name + " is an empty list", found);
    expect(marker.type != Marker::TRIANGLE_LIST || points % 3 == 0, name + ": no threes", found);
    expect(marker.type != Marker::LINE_LIST || points % 2 == 0, name + ": no twos", found);
    expect(marker.colors.empty() || marker.colors.size() == points, name + ": colours", found);
  }
}

}  // namespace soak
