// The promises of the running node: every test talks to it as its users do.
#include <cloth_tearing/ClothSurface.h>
#include <cloth_tearing/CollisionSpheres.h>
#include <cloth_tearing/Drag.h>
#include <cloth_tearing/GetTearEvents.h>
#include <cloth_tearing/Grasp.h>
#include <cloth_tearing/Release.h>
#include <cloth_tearing/SimulationStatus.h>
#include <cloth_tearing/Step.h>
#include <cloth_tearing/TearEvents.h>
#include <cloth_tearing/ThrowSphere.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <iterator>
#include <limits>
#include <set>

#include "node_client.h"

using namespace cloth_tearing;  // NOLINT: the messages are what all of this is about
using std_srvs::Trigger;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

namespace
{

constexpr double BOTTOM = 1.5 - 0.4;  // height of the untouched cloth's lower edge [m]

Step::Response step(std::uint32_t steps, const std::string& node = "/cloth")
{
  Step::Request request;
  request.steps = steps;
  return ask<Step>(node + "/step", request);
}

Grasp::Request graspAt(double x, double y, double z, double radius = 0.0)
{
  Grasp::Request request;
  request.header.frame_id = "world";
  request.point.x = x;
  request.point.y = y;
  request.point.z = z;
  request.radius = radius;
  return request;
}

Drag::Request dragTo(std::uint64_t grasp, double x, double y, double z)
{
  Drag::Request request;
  request.header.frame_id = "world";
  request.grasp_id = grasp;
  request.target.position.x = x;
  request.target.position.y = y;
  request.target.position.z = z;
  request.linear_speed = 1.0;
  return request;
}

CollisionSpheres sphereAt(double y, double speed)
{
  CollisionSpheres message;
  message.header.frame_id = "world";
  message.spheres.resize(1);
  message.spheres[0].id = 1;
  message.spheres[0].center.y = y;
  message.spheres[0].center.z = 1.3;
  message.spheres[0].velocity.y = speed;
  message.spheres[0].radius = 0.05;
  return message;
}

/// The particle whose y differs most from where an untouched cloth hangs.
double farthestFromPlane(const ClothSurface& surface)
{
  double farthest = 0.0;
  for (std::size_t i = 1; i < surface.positions.size(); i += 3)
  {
    farthest = std::max(farthest, std::abs(static_cast<double>(surface.positions[i])));
  }
  return farthest;
}

double areaOf(const geometry_msgs::Point& a, const geometry_msgs::Point& b,
              const geometry_msgs::Point& c)
{
  const double u[] = { b.x - a.x, b.y - a.y, b.z - a.z };
  const double v[] = { c.x - a.x, c.y - a.y, c.z - a.z };
  return 0.5 * std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                          u[0] * v[1] - u[1] * v[0]);
}

std::size_t graspedParticles(const ClothSurface& surface)
{
  return static_cast<std::size_t>(std::count_if(surface.held.begin(), surface.held.end(),
                                                [](const HeldParticle& held)
                                                { return held.grasp != 0; }));
}

bool drawsAGrasp(const MarkerArray& array)
{
  return std::any_of(array.markers.begin(), array.markers.end(),
                     [](const Marker& m) { return m.ns == "grasps" && m.action == Marker::ADD; });
}

/// Sums of the sorts of things that tears add, by the events' own account.
struct Account
{
  std::vector<std::uint64_t> sequences;
  std::size_t particles = 0;
};

Account accountOf(const std::vector<TearEvent>& events)
{
  Account account;
  for (const TearEvent& event : events)
  {
    account.sequences.push_back(event.sequence);
    account.particles += event.particles.size();
  }
  return account;
}

GetTearEvents::Response eventsSince(std::uint64_t sequence, std::uint32_t max_count = 0,
                                    const std::string& node = "/cloth")
{
  GetTearEvents::Request request;
  request.since = sequence;
  request.max_count = max_count;
  return ask<GetTearEvents>(node + "/get_tear_events", request);
}

/// Every test begins with the cloth as it was built.
class ClothNode : public testing::Test
{
protected:
  void SetUp() override
  {
    ASSERT_TRUE(ask<Trigger>("/cloth/reset").success);
    epoch_ = step(0).epoch;
    first_event_ = eventsSince(0).newest + 1;
  }

  /// Takes the middle of the lower edge and drags it down until something tears.
  void tear()
  {
    const Grasp::Response grasp = ask<Grasp>("/cloth/grasp", graspAt(0.0, 0.0, BOTTOM, 0.06));
    ASSERT_TRUE(grasp.success) << grasp.message;
    const Drag::Response drag =
        ask<Drag>("/cloth/drag", dragTo(grasp.grasp_id, 0.0, 0.0, BOTTOM - 0.5));
    ASSERT_TRUE(drag.success) << drag.message;
    std::uint64_t tears = 0;
    for (int i = 0; i < 20 && tears < 10; ++i)
    {
      const Step::Response done = step(50);
      ASSERT_TRUE(done.success) << done.message;
      tears += done.tears;
    }
    ASSERT_GE(tears, 10u) << "the cloth does not tear";
  }

  std::uint32_t epoch_ = 0;
  std::uint64_t first_event_ = 0;
};

}  // namespace

// -- steps ---------------------------------------------------------------------------------------

TEST_F(ClothNode, StepsExactlyAsOftenAsAsked)
{
  const Step::Response before = step(0);
  const Step::Response after = step(25);

  ASSERT_TRUE(after.success) << after.message;
  EXPECT_EQ(after.steps_done, 25u);
  EXPECT_EQ(after.step, before.step + 25);
  EXPECT_NEAR(after.time, before.time + 0.025, 1e-9);
  EXPECT_NE(after.state_hash, before.state_hash);
  EXPECT_EQ(step(0).state_hash, after.state_hash) << "no step, no change";
}

TEST_F(ClothNode, GivesTheSameClothForTheSameSteps)
{
  const std::uint64_t once = step(100).state_hash;
  ASSERT_TRUE(ask<Trigger>("/cloth/reset").success);
  step(40);

  EXPECT_EQ(step(60).state_hash, once);
}

TEST_F(ClothNode, ServesTheStepsOfTwoClientsOneAfterTheOther)
{
  const std::uint64_t begin = step(0).step;
  auto other = std::async(std::launch::async, [] { return step(300); });

  const Step::Response mine = step(200);

  const Step::Response theirs = other.get();
  EXPECT_TRUE(mine.success && theirs.success) << mine.message << theirs.message;
  EXPECT_EQ(step(0).step, begin + 500);
  EXPECT_EQ(std::max(mine.step, theirs.step), begin + 500);
  EXPECT_TRUE(std::min(mine.step, theirs.step) == begin + 200 ||
              std::min(mine.step, theirs.step) == begin + 300)
      << "one of them had to wait for the other";
}

TEST_F(ClothNode, AnswersOthersWhileALongStepRunsAndCutsItShortByReset)
{
  auto long_step = std::async(std::launch::async, [] { return step(100000000); });
  Collector<SimulationStatus> status("/cloth/status");
  status.waitFor("the long step is under way",
                 [this](const SimulationStatus& s) { return s.epoch == epoch_ && s.step > 10; });

  const Grasp::Response grasp = ask<Grasp>("/cloth/grasp", graspAt(0.0, 0.0, BOTTOM, 0.06));
  EXPECT_TRUE(grasp.success) << grasp.message;
  EXPECT_TRUE(ask<Release>("/cloth/release").success);
  EXPECT_EQ(long_step.wait_for(std::chrono::seconds(0)), std::future_status::timeout);

  ASSERT_TRUE(ask<Trigger>("/cloth/reset").success);
  ASSERT_EQ(long_step.wait_for(std::chrono::duration<double>(PATIENCE)), std::future_status::ready);
  const Step::Response cut = long_step.get();
  EXPECT_FALSE(cut.success);
  EXPECT_NE(cut.message.find("reset"), std::string::npos) << cut.message;
  EXPECT_GT(cut.steps_done, 10u);
}

// -- grasp, drag, tear ----------------------------------------------------------------------------

TEST_F(ClothNode, TearsWhenDraggedAndTellsEveryTearOnTopicAndInLog)
{
  Collector<TearEvents> topic("/cloth/tear_events");
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(PATIENCE);
  while (topic.all().empty() && ros::WallTime::now() < deadline)  // until the node knows of us
  {
    tear();
    SetUp();
  }

  tear();

  const GetTearEvents::Response log = eventsSince(first_event_);
  ASSERT_TRUE(log.success) << log.message;
  ASSERT_GE(log.events.size(), 10u);
  topic.waitFor("the last tear", [&log](const TearEvents& message)
                { return message.events.back().sequence == log.newest; });
  std::vector<TearEvent> told;
  for (const TearEvents& message : topic.all())
  {
    EXPECT_FALSE(message.events.empty());
    EXPECT_EQ(message.header.frame_id, "world");
    std::copy_if(message.events.begin(), message.events.end(), std::back_inserter(told),
                 [this](const TearEvent& event) { return event.sequence >= first_event_; });
  }
  EXPECT_EQ(accountOf(told).sequences, accountOf(log.events).sequences);
  for (std::size_t i = 0; i < log.events.size(); ++i)
  {
    EXPECT_EQ(log.events[i].sequence, first_event_ + i) << "no gap";
    EXPECT_EQ(log.events[i].epoch, epoch_);
    EXPECT_GT(log.events[i].strain, log.events[i].threshold);
    EXPECT_EQ(log.events[i].parents.size(), 2 * log.events[i].particles.size());
  }
  EXPECT_EQ(log.events[0].cause, TearEvent::GRASP);
  EXPECT_NE(log.events[0].cause_id, 0u);
}

TEST_F(ClothNode, ShowsTheSameTearsInSurfaceMarkersAndStatusAsInTheLog)
{
  Collector<ClothSurface> surfaces("/cloth/surface");
  Collector<MarkerArray> markers("/cloth/markers");
  Collector<SimulationStatus> statuses("/cloth/status");
  const ClothSurface whole =
      surfaces.waitFor("the whole cloth", [](const ClothSurface& s) { return s.revision == 0; });
  ASSERT_EQ(whole.positions.size(), 3 * 121u);
  EXPECT_TRUE(whole.torn_edges.empty());

  tear();

  const Account account = accountOf(eventsSince(first_event_).events);
  const std::uint64_t last_step = step(0).step;
  const ClothSurface torn = surfaces.waitFor("the torn cloth", [&](const ClothSurface& s)
                                             { return s.epoch == epoch_ && s.step == last_step; });
  EXPECT_EQ(torn.revision, account.sequences.size());
  EXPECT_EQ(torn.positions.size(), whole.positions.size() + 3 * account.particles);
  EXPECT_EQ(torn.strain.size(), torn.positions.size() / 3);
  EXPECT_EQ(torn.parents.size(), 2 * torn.strain.size());
  EXPECT_EQ(torn.uv.size(), 2 * torn.triangles.size());
  EXPECT_GE(torn.torn_edges.size(), 2u);
  EXPECT_GT(graspedParticles(torn), 0u);
  for (const float x : torn.positions)
  {
    ASSERT_TRUE(std::isfinite(x));
  }
  for (const auto* ids : { &torn.triangles, &torn.parents, &torn.torn_edges, &torn.weak_points })
  {
    for (const std::uint32_t id : *ids)
    {
      ASSERT_LT(id, torn.strain.size());
    }
  }

  const SimulationStatus status =
      statuses.waitFor("its status", [&](const SimulationStatus& s)
                       { return s.epoch == epoch_ && s.step == last_step; });
  EXPECT_EQ(status.revision, torn.revision);
  EXPECT_EQ(status.particles, torn.strain.size());
  EXPECT_EQ(status.basic_tears + status.weak_point_tears + status.one_point_tears +
                status.released_springs,
            account.sequences.size());
  EXPECT_EQ(status.grasps, 1u);
  EXPECT_EQ(status.state_hash, step(0).state_hash);

  const auto edges = [&torn](const MarkerArray& array)
  {
    return std::any_of(array.markers.begin(), array.markers.end(),
                       [&torn](const Marker& m) {
                         return m.ns == "torn_edges" && m.points.size() == torn.torn_edges.size();
                       });
  };
  const MarkerArray drawn = markers.waitFor("torn edges", edges);
  std::set<std::string> namespaces;
  for (const Marker& m : drawn.markers)
  {
    namespaces.insert(m.ns);
    EXPECT_EQ(m.header.frame_id, "world");
    const bool is_list = m.type == Marker::TRIANGLE_LIST || m.type == Marker::LINE_LIST ||
                         m.type == Marker::SPHERE_LIST;
    EXPECT_FALSE(is_list && m.action == Marker::ADD && m.points.empty()) << m.ns;
    EXPECT_TRUE(m.colors.empty() || m.colors.size() == m.points.size()) << m.ns;
    for (std::size_t i = 0; m.type == Marker::TRIANGLE_LIST && i < m.points.size(); i += 3)
    {
      EXPECT_GT(areaOf(m.points[i], m.points[i + 1], m.points[i + 2]), 0.0);
    }
    for (const geometry_msgs::Point& p : m.points)
    {
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << m.ns;
    }
  }
  EXPECT_EQ(namespaces.count("cloth"), 1u);
  EXPECT_EQ(namespaces.count("weak_points"), 1u);
  EXPECT_EQ(namespaces.count("grasps"), 1u);
}

TEST_F(ClothNode, MovesAGraspToItsTargetInSimulationTime)
{
  const Grasp::Response grasp = ask<Grasp>("/cloth/grasp", graspAt(0.0, 0.0, BOTTOM));
  ASSERT_TRUE(grasp.success) << grasp.message;
  EXPECT_EQ(grasp.held_particles, 1u);
  EXPECT_LT(grasp.distance, 0.05);
  ASSERT_TRUE(ask<Drag>("/cloth/drag", dragTo(grasp.grasp_id, 0.0, -0.1, BOTTOM)).success);

  step(50);  // half of the way at 1 m/s

  Collector<ClothSurface> surfaces("/cloth/surface");
  const auto held_y = [&](const ClothSurface& s)
  {
    for (const HeldParticle& held : s.held)
    {
      if (held.grasp == grasp.grasp_id)
      {
        return static_cast<double>(s.positions[3 * held.particle + 1]);
      }
    }
    return std::numeric_limits<double>::quiet_NaN();
  };
  EXPECT_NEAR(held_y(surfaces.first()), -0.05, 1e-4);
  const std::uint64_t arrived = step(100).step;
  EXPECT_NEAR(
      held_y(surfaces.waitFor("arrival", [&](const ClothSurface& s) { return s.step == arrived; })),
      -0.1, 1e-4);
}

TEST_F(ClothNode, LetsGoWhenReleased)
{
  const Grasp::Response first = ask<Grasp>("/cloth/grasp", graspAt(-0.2, 0.0, BOTTOM));
  const Grasp::Response second = ask<Grasp>("/cloth/grasp", graspAt(0.2, 0.0, BOTTOM));
  ASSERT_TRUE(first.success && second.success) << first.message << second.message;
  Release::Request one;
  one.grasp_id = first.grasp_id;

  EXPECT_EQ(ask<Release>("/cloth/release", one).released, 1u);
  EXPECT_EQ(ask<Release>("/cloth/release").released, 1u) << "0 = all that are left";
  const Release::Response none = ask<Release>("/cloth/release");
  EXPECT_TRUE(none.success) << "none is no error";
  EXPECT_EQ(none.released, 0u);
  EXPECT_FALSE(ask<Release>("/cloth/release", one).success);

  Collector<ClothSurface> surfaces("/cloth/surface");
  EXPECT_EQ(graspedParticles(surfaces.first()), 0u);
}

// -- spheres --------------------------------------------------------------------------------------

TEST_F(ClothNode, IsPushedByASphereOnTheTopic)
{
  Collector<SimulationStatus> status("/cloth/status");
  ros::Publisher spheres = ros::NodeHandle().advertise<CollisionSpheres>("/cloth/spheres", 1, true);
  spheres.publish(sphereAt(-0.15, 0.5));
  status.waitFor("a sphere",
                 [this](const SimulationStatus& s) { return s.epoch == epoch_ && s.spheres == 1; });

  const Step::Response pushed = step(400);

  EXPECT_EQ(pushed.tears, 0u);
  Collector<ClothSurface> surfaces("/cloth/surface");
  EXPECT_GT(farthestFromPlane(surfaces.first()), 0.05);

  spheres.publish(CollisionSpheres());
  status.waitFor("no sphere any more", [&](const SimulationStatus& s)
                 { return s.epoch == epoch_ && s.step == pushed.step && s.spheres == 0; });
}

TEST_F(ClothNode, IsTornByAFastSphereOnTheTopic)
{
  Collector<SimulationStatus> status("/cloth/status");
  ros::Publisher spheres = ros::NodeHandle().advertise<CollisionSpheres>("/cloth/spheres", 1, true);
  spheres.publish(sphereAt(-0.3, 20.0));
  status.waitFor("a sphere",
                 [this](const SimulationStatus& s) { return s.epoch == epoch_ && s.spheres == 1; });

  EXPECT_GT(step(100).tears, 0u);
  const GetTearEvents::Response log = eventsSince(first_event_);
  ASSERT_FALSE(log.events.empty());
  EXPECT_EQ(log.events[0].cause, TearEvent::SPHERE);
  EXPECT_EQ(log.events[0].cause_id, 1u);
}

TEST_F(ClothNode, IsTornByAThrownSphereThatIsGoneAfterItsLifetime)
{
  ThrowSphere::Request ball;
  ball.header.frame_id = "world";
  ball.center.y = -0.3;
  ball.center.z = 1.3;
  ball.velocity.y = 20.0;
  ball.radius = 0.05;
  ball.lifetime = 0.2;
  const ThrowSphere::Response thrown = ask<ThrowSphere>("/cloth/throw_sphere", ball);
  ASSERT_TRUE(thrown.success) << thrown.message;
  EXPECT_NE(thrown.sphere_id, 0u);

  EXPECT_GT(step(100).tears, 0u);
  const GetTearEvents::Response log = eventsSince(first_event_);
  ASSERT_FALSE(log.events.empty());
  EXPECT_EQ(log.events[0].cause, TearEvent::THROWN_SPHERE);
  EXPECT_EQ(log.events[0].cause_id, thrown.sphere_id);

  Collector<SimulationStatus> status("/cloth/status");
  EXPECT_EQ(status.first().spheres, 1u);
  const std::uint64_t later = step(150).step;
  const SimulationStatus after = status.waitFor(
      "the end of its life", [&](const SimulationStatus& s) { return s.step == later; });
  EXPECT_EQ(after.spheres, 0u);
}

// -- refusals -------------------------------------------------------------------------------------

/// A request that must be refused, and what the answer must say.
template <class Service>
void expectRefusal(const std::string& name, const typename Service::Request& request,
                   const std::string& reason)
{
  const typename Service::Response response = ask<Service>(name, request);
  EXPECT_FALSE(response.success) << name << " was to be refused: " << reason;
  EXPECT_NE(response.message.find(reason), std::string::npos)
      << name << " says '" << response.message << "', not '" << reason << "'";
}

TEST_F(ClothNode, SaysWhyItRefusesAndChangesNothing)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Grasp::Response held = ask<Grasp>("/cloth/grasp", graspAt(0.2, 0.0, BOTTOM));
  ASSERT_TRUE(held.success) << held.message;
  const Step::Response before = step(0);
  Collector<SimulationStatus> status("/cloth/status");
  const std::uint64_t refusals = status.first().refusals;

  Grasp::Request grasp = graspAt(100.0, 0.0, 0.0);
  expectRefusal<Grasp>("/cloth/grasp", grasp, "no particle within");
  expectRefusal<Grasp>("/cloth/grasp", graspAt(0.0, 0.0, -1e7), "must be");
  expectRefusal<Grasp>("/cloth/grasp", graspAt(nan, 0.0, BOTTOM), "point.x is nan");
  expectRefusal<Grasp>("/cloth/grasp", graspAt(0.0, 0.0, BOTTOM, -0.1), "radius [m] is -0.1");
  expectRefusal<Grasp>("/cloth/grasp", graspAt(0.2, 0.0, BOTTOM), "held by grasp");
  grasp = graspAt(0.0, 0.0, BOTTOM);
  grasp.gripper_frame = "hand";
  expectRefusal<Grasp>("/cloth/grasp", grasp, "gripper_frame: no transform from hand to world");
  grasp = graspAt(0.0, 0.0, BOTTOM);
  grasp.force_limit = -10.0;
  expectRefusal<Grasp>("/cloth/grasp", grasp, "force_limit [N] is -10");
  grasp = graspAt(0.0, 0.0, BOTTOM);
  grasp.header.frame_id = "";
  expectRefusal<Grasp>("/cloth/grasp", grasp, "header.frame_id is empty");
  grasp.header.frame_id = "atlantis";
  expectRefusal<Grasp>("/cloth/grasp", grasp, "no transform from atlantis to world");
  grasp.header.frame_id = "/world";
  expectRefusal<Grasp>("/cloth/grasp", grasp, "must not begin with a slash");

  expectRefusal<Drag>("/cloth/drag", dragTo(999999, 0.0, 0.0, 1.0), "there is no grasp 999999");
  Drag::Request drag = dragTo(held.grasp_id, 0.0, 0.0, 1.0);
  drag.linear_speed = 0.0;
  expectRefusal<Drag>("/cloth/drag", drag, "linear_speed [m/s] is 0");
  drag = dragTo(held.grasp_id, 0.0, nan, 1.0);
  expectRefusal<Drag>("/cloth/drag", drag, "target.position.y is nan");
  drag = dragTo(held.grasp_id, 0.0, 0.0, 1.0);
  drag.header.frame_id = "atlantis";
  expectRefusal<Drag>("/cloth/drag", drag, "no transform from atlantis");

  Release::Request release;
  release.grasp_id = 999999;
  expectRefusal<Release>("/cloth/release", release, "there is no grasp 999999");

  ThrowSphere::Request ball;
  ball.header.frame_id = "world";
  expectRefusal<ThrowSphere>("/cloth/throw_sphere", ball, "radius [m] is 0");
  ball.radius = 0.1;
  ball.mass = -1.0;
  expectRefusal<ThrowSphere>("/cloth/throw_sphere", ball, "mass [kg] is -1");
  ball.mass = 0.0;
  ball.velocity.x = 1e6;
  expectRefusal<ThrowSphere>("/cloth/throw_sphere", ball, "velocity");

  EXPECT_EQ(step(0).state_hash, before.state_hash);
  const SimulationStatus after = status.waitFor(
      "all are counted", [&](const SimulationStatus& s) { return s.refusals >= refusals + 18; });
  EXPECT_EQ(after.refusals, refusals + 18);
  EXPECT_NE(after.last_refusal.find("throw_sphere: "), std::string::npos) << after.last_refusal;
}

TEST_F(ClothNode, CountsTheMessagesThatItRefuses)
{
  Collector<SimulationStatus> status("/cloth/status");
  const std::uint64_t refusals = status.first().refusals;
  ros::Publisher spheres = ros::NodeHandle().advertise<CollisionSpheres>("/cloth/spheres", 1, true);
  CollisionSpheres twice = sphereAt(-1.0, 0.0);
  twice.spheres.push_back(twice.spheres[0]);

  spheres.publish(twice);

  const SimulationStatus after = status.waitFor(
      "the refusal", [&](const SimulationStatus& s) { return s.refusals == refusals + 1; });
  EXPECT_NE(after.last_refusal.find("spheres: "), std::string::npos) << after.last_refusal;
  EXPECT_EQ(after.spheres, 0u);
}

TEST_F(ClothNode, TransformsWhatComesInAnotherFrame)
{
  static tf2_ros::StaticTransformBroadcaster broadcaster;
  geometry_msgs::TransformStamped table;
  table.header.frame_id = "world";
  table.header.stamp = ros::Time::now();
  table.child_frame_id = "table";
  table.transform.translation.z = 1.0;
  table.transform.rotation.z = std::sqrt(0.5);  // a quarter turn: its y points to world's -x
  table.transform.rotation.w = std::sqrt(0.5);
  broadcaster.sendTransform(table);
  Grasp::Request request = graspAt(0.0, -0.2, BOTTOM - 1.0);
  request.header.frame_id = "table";
  Grasp::Response grasp;
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(PATIENCE);

  while (!grasp.success && ros::WallTime::now() < deadline)  // until tf has arrived
  {
    grasp = ask<Grasp>("/cloth/grasp", request);
  }

  ASSERT_TRUE(grasp.success) << grasp.message;
  EXPECT_LT(grasp.distance, 0.01);
  Collector<ClothSurface> surfaces("/cloth/surface");
  const ClothSurface surface =
      surfaces.waitFor("the grasp", [](const ClothSurface& s) { return graspedParticles(s) == 1; });
  const HeldParticle held = *std::find_if(surface.held.begin(), surface.held.end(),
                                          [](const HeldParticle& h) { return h.grasp != 0; });
  EXPECT_NEAR(surface.positions[3 * held.particle], 0.2, 0.01);
}

// -- topics and time ------------------------------------------------------------------------------

TEST_F(ClothNode, GivesALateSubscriberTheStateOfNow)
{
  {
    Collector<ClothSurface> early("/cloth/surface");
    EXPECT_EQ(early.first().step, 0u);
  }
  const std::uint64_t now = step(30).step;  // nobody listens

  Collector<ClothSurface> surfaces("/cloth/surface");
  Collector<SimulationStatus> statuses("/cloth/status");
  Collector<MarkerArray> markers("/cloth/markers");

  EXPECT_EQ(surfaces.first().step, now);
  EXPECT_EQ(statuses.first().step, now);
  EXPECT_FALSE(markers.first().markers.empty());
}

TEST_F(ClothNode, ShowsThoseWhoListenAlreadyWhatARequestChangedThoughNoStepFollows)
{
  Collector<ClothSurface> surfaces("/cloth/surface");
  Collector<MarkerArray> markers("/cloth/markers");
  surfaces.first();
  markers.first();
  ASSERT_TRUE(ask<Grasp>("/cloth/grasp", graspAt(0.0, 0.0, BOTTOM)).success);
  surfaces.waitFor("the grasp", [](const ClothSurface& s) { return graspedParticles(s) == 1; });
  markers.waitFor("the drawn grasp", drawsAGrasp);

  ASSERT_TRUE(ask<Release>("/cloth/release").success);

  bool held = false;
  surfaces.waitFor("the release",
                   [&held](const ClothSurface& s)
                   {
                     held |= graspedParticles(s) == 1;
                     return held && graspedParticles(s) == 0;
                   });
  bool drawn = false;
  markers.waitFor("no drawn grasp",
                  [&drawn](const MarkerArray& array)
                  {
                    drawn |= drawsAGrasp(array);
                    return drawn && !drawsAGrasp(array);
                  });
  ASSERT_TRUE(ask<Trigger>("/cloth/reset").success);
  surfaces.waitFor("the reset", [this](const ClothSurface& s) { return s.epoch == epoch_ + 1; });
}

TEST_F(ClothNode, RaisesTheEpochByAResetAndKeepsTheLog)
{
  tear();
  const GetTearEvents::Response before = eventsSince(first_event_);
  const double time = step(0).time;

  ASSERT_TRUE(ask<Trigger>("/cloth/reset").success);

  const Step::Response state = step(0);
  EXPECT_EQ(state.epoch, epoch_ + 1);
  EXPECT_EQ(state.step, 0u);
  EXPECT_EQ(state.time, time) << "time goes on";
  Collector<ClothSurface> surfaces("/cloth/surface");
  const ClothSurface whole = surfaces.first();
  EXPECT_EQ(whole.epoch, epoch_ + 1);
  EXPECT_EQ(whole.revision, 0u);
  EXPECT_EQ(whole.positions.size(), 3 * 121u);
  EXPECT_EQ(graspedParticles(whole), 0u);
  EXPECT_EQ(eventsSince(first_event_).newest, before.newest) << "the log goes on, too";
  tear();
  const GetTearEvents::Response after = eventsSince(before.newest + 1);
  ASSERT_FALSE(after.events.empty());
  EXPECT_EQ(after.events[0].sequence, before.newest + 1);
  EXPECT_EQ(after.events[0].epoch, epoch_ + 1);
}

TEST_F(ClothNode, TellsTearEventsInPortions)
{
  tear();
  const GetTearEvents::Response all = eventsSince(first_event_);

  const GetTearEvents::Response portion = eventsSince(first_event_ + 2, 3);

  ASSERT_EQ(portion.events.size(), 3u);
  EXPECT_EQ(portion.events[0].sequence, first_event_ + 2);
  EXPECT_EQ(portion.events[0].spring, all.events[2].spring);
  EXPECT_EQ(portion.newest, all.newest);
  EXPECT_EQ(portion.oldest, 1u);
  EXPECT_TRUE(eventsSince(all.newest + 1).events.empty());
}

TEST_F(ClothNode, SharesTheMasterWithAnotherClothOfAnotherName)
{
  const Step::Response other = step(0, "/second/sheet");
  tear();
  EXPECT_EQ(step(0, "/second/sheet").state_hash, other.state_hash) << "it heard nothing of this";

  Grasp::Request request = graspAt(100.2, 0.0, 5.0 - 0.4);
  request.header.frame_id = "map";
  const Grasp::Response grasp = ask<Grasp>("/second/sheet/grasp", request);
  EXPECT_TRUE(grasp.success) << grasp.message;
  Collector<ClothSurface> surfaces("/second/sheet/surface");
  const ClothSurface surface = surfaces.first();
  EXPECT_EQ(surface.header.frame_id, "map");
  EXPECT_EQ(surface.positions.size(), 3 * 25u);
  EXPECT_EQ(surface.origin.x, 100.0);
  EXPECT_EQ(surface.origin.z, 5.0);
  EXPECT_NEAR(surface.positions[2], 0.0, 1e-5) << "relative to the origin";

  Collector<SimulationStatus> status("/second/sheet/status");
  ros::Publisher balls = ros::NodeHandle().advertise<CollisionSpheres>("/balls", 1, true);
  CollisionSpheres message = sphereAt(-1.0, 0.0);
  message.header.frame_id = "map";
  balls.publish(message);
  status.waitFor("the remapped sphere", [](const SimulationStatus& s) { return s.spheres == 1; });
}

TEST(LiveClothNode, RunsInRealTimeUntilPausedAndIsSteppedOnlyThen)
{
  Collector<SimulationStatus> status("/live/status");
  const SimulationStatus begin = status.first();
  EXPECT_EQ(begin.pace, "wall");
  status.waitFor("time goes by", [&begin](const SimulationStatus& s)
                 { return s.time > begin.time + 1.0 && s.real_time_factor > 0.5; });
  const Step::Response refused = step(1, "/live");
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("pause it"), std::string::npos) << refused.message;

  EXPECT_TRUE(ask<Trigger>("/live/pause").success);
  EXPECT_TRUE(ask<Trigger>("/live/pause").success) << "twice is once";
  const std::uint64_t paused = step(0, "/live").step;
  EXPECT_EQ(step(5, "/live").step, paused + 5) << "nothing but ~step moves it";
  status.waitFor("it says so", [](const SimulationStatus& s) { return s.paused; });

  EXPECT_TRUE(ask<Trigger>("/live/resume").success);
  EXPECT_TRUE(ask<Trigger>("/live/resume").success) << "twice is once";
  status.waitFor("it runs again", [paused](const SimulationStatus& s)
                 { return !s.paused && s.step > paused + 100; });
}

TEST(RunawayClothNode, PausesByItselfAndSaysWhy)
{
  Collector<SimulationStatus> statuses("/nervous/status");

  const SimulationStatus status = statuses.waitFor(
      "a fault", [](const SimulationStatus& s) { return !s.fault.empty() && s.paused; });

  EXPECT_NE(status.fault.find("speed"), std::string::npos) << status.fault;
  EXPECT_GT(status.step, 10u);
  EXPECT_EQ(step(0, "/nervous").step, status.step) << "it stands";
  ASSERT_TRUE(ask<Trigger>("/nervous/reset").success);
  statuses.waitFor("a new beginning", [&status](const SimulationStatus& s)
                   { return s.epoch == status.epoch + 1 && s.fault.empty(); });
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "cloth_node_rostest");
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
