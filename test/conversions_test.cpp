// Data keeps its meaning between the core's types and the messages.
#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "cloth_tearing/node/conversions.h"
#include "message_bytes.h"

using namespace cloth_tearing;  // NOLINT: the subject of every line below

namespace
{

const Placement PLACEMENT{ "map", cloth::Vec3d(10.0, 20.0, 30.0) };

/// Two triangles that share an edge; particle 3 was added by a tear.
cloth::Surface smallSurface()
{
  cloth::Surface surface;
  surface.time = 1.5;
  surface.step = 7;
  surface.epoch = 2;
  surface.position = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, { 1, 0, 1 } };
  surface.held = { { 0, 0 }, { 3, 9 } };
  cloth::SurfaceTopology topology;
  topology.revision = 1;
  topology.parents = { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 1, 2 } };
  topology.triangles = { { { 0, 1, 2 }, { { { 0, 0 }, { 1, 0 }, { 0, 1 } } } },
                         { { 1, 3, 2 }, { { { 0.5, 0 }, { 1, 1 }, { 0, 0.25 } } } } };
  topology.springs = { { { 0, 1 }, 1.25 }, { { 1, 3 }, 0.8 }, { { 2, 3 }, 0.5 } };
  topology.torn_edges = { { 1, 3 } };
  topology.weak_points = { 2 };
  surface.topology = std::make_shared<const cloth::SurfaceTopology>(topology);
  return surface;
}

Drag::Request dragRequest()
{
  Drag::Request request;
  request.grasp_id = 1;
  request.target.orientation.w = 1.0;
  request.linear_speed = 0.5;
  request.angular_speed = 0.25;
  return request;
}

ThrowSphere::Request throwRequest()
{
  ThrowSphere::Request request;
  request.radius = 0.1;
  return request;
}

CollisionSpheres oneSphere()
{
  CollisionSpheres message;
  message.spheres.resize(1);
  message.spheres[0].id = 5;
  message.spheres[0].radius = 0.2;
  return message;
}

std::string joined(const std::vector<std::string>& lines)
{
  std::string all;
  for (const std::string& line : lines)
  {
    all += line + "\n";
  }
  return all;
}

/// A quarter turn about z and a shift.
cloth::Pose quarterTurn()
{
  cloth::Pose pose;
  pose.position = cloth::Vec3d(1.0, 0.0, 0.0);
  pose.rotation = cloth::Quatd(std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5));
  return pose;
}

}  // namespace

TEST(SurfaceMessage, HoldsTheMeshFromItsOriginInTheFrameOfItsHeader)
{
  const ClothSurface message = toMessage(smallSurface(), PLACEMENT);

  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.time, 1.5);
  EXPECT_EQ(message.step, 7u);
  EXPECT_EQ(message.epoch, 2u);
  EXPECT_EQ(message.revision, 1u);
  ASSERT_EQ(message.positions.size(), 12u);
  EXPECT_EQ(message.origin.x, 10.0);
  EXPECT_EQ(message.origin.y, 20.0);
  EXPECT_EQ(message.origin.z, 30.0);
  EXPECT_EQ(message.positions[9], 1.0F);
  EXPECT_EQ(message.positions[10], 0.0F);
  EXPECT_EQ(message.positions[11], 1.0F);
  EXPECT_EQ(message.strain, (std::vector<float>{ 0.0F, 0.25F, 1.0F, 1.0F }));
  EXPECT_EQ(message.parents, (std::vector<std::uint32_t>{ 0, 0, 1, 1, 2, 2, 1, 2 }));
  EXPECT_EQ(message.triangles, (std::vector<std::uint32_t>{ 0, 1, 2, 1, 3, 2 }));
  EXPECT_EQ(message.uv, (std::vector<float>{ 0, 0, 1, 0, 0, 1, 0.5F, 0, 1, 1, 0, 0.25F }));
  EXPECT_EQ(message.torn_edges, (std::vector<std::uint32_t>{ 1, 3 }));
  EXPECT_EQ(message.weak_points, (std::vector<std::uint32_t>{ 2 }));
  ASSERT_EQ(message.held.size(), 2u);
  EXPECT_EQ(message.held[0].grasp, 0u) << "0 = pinned";
  EXPECT_EQ(message.held[1].particle, 3u);
  EXPECT_EQ(message.held[1].grasp, 9u);
}

TEST(SurfaceMessage, IsTheSameWhenOneOfAnotherClothIsWrittenOver)
{
  ClothSurface message = toMessage(smallSurface(), PLACEMENT);
  const cloth::Surface nothing;

  fillTopology(message, *nothing.topology);
  fillMotion(message, nothing, PLACEMENT);
  EXPECT_TRUE(sameBytes(message, toMessage(nothing, PLACEMENT)));

  fillTopology(message, *smallSurface().topology);
  fillMotion(message, smallSurface(), PLACEMENT);
  EXPECT_TRUE(sameBytes(message, toMessage(smallSurface(), PLACEMENT)));
}

TEST(SurfaceMessage, IsAsFineFarAwayAsAtHome)
{
  const Placement far{ "map", cloth::Vec3d(500000.0, 0.0, 0.0) };
  cloth::Surface surface = smallSurface();
  surface.position[1].x() = 1.0001F;

  const ClothSurface message = toMessage(surface, far);

  EXPECT_EQ(message.origin.x, 500000.0);
  EXPECT_EQ(message.positions[3], 1.0001F);
}

TEST(TearEventMessage, TellsWhatTheCoreTold)
{
  cloth::TearEvent event;
  event.sequence = 4;
  event.epoch = 1;
  event.step = 9;
  event.time = 0.25;
  event.kind = cloth::TearKind::WEAK_POINT;
  event.particles = { { cloth::ParticleId{ 8 },
                        { cloth::ParticleId{ 2 }, cloth::ParticleId{ 3 } } } };
  event.spring = cloth::SpringId{ 6 };
  event.path = cloth::SpringId{ 5 };
  event.triangles = { cloth::TriangleId{ 1 }, cloth::TriangleId{ 2 } };
  event.position = cloth::Vec3d(0.5, 0.0, -1.0);
  event.uv = cloth::Vec2d(0.25, 0.75);
  event.strain = 0.3;
  event.threshold = 0.2;
  event.tension = 12.5;
  event.cause = { cloth::CauseKind::SPHERE, 77, 0.125 };
  event.pieces = 2;
  event.loose_area = 0.5;
  event.loose_mass = 0.05;

  const TearEvent message = toMessage(event, PLACEMENT);

  EXPECT_EQ(message.sequence, 4u);
  EXPECT_EQ(message.epoch, 1u);
  EXPECT_EQ(message.step, 9u);
  EXPECT_EQ(message.time, 0.25);
  EXPECT_EQ(message.kind, TearEvent::WEAK_POINT);
  EXPECT_EQ(message.particles, (std::vector<std::uint32_t>{ 8 }));
  EXPECT_EQ(message.parents, (std::vector<std::uint32_t>{ 2, 3 }));
  EXPECT_EQ(message.spring, 6u);
  EXPECT_EQ(message.path, 5);
  EXPECT_EQ(message.triangles, (std::vector<std::uint32_t>{ 1, 2 }));
  EXPECT_EQ(message.position.x, 10.5);
  EXPECT_EQ(message.position.z, 29.0);
  EXPECT_EQ(message.uv[1], 0.75);
  EXPECT_EQ(message.strain, 0.3);
  EXPECT_EQ(message.threshold, 0.2);
  EXPECT_EQ(message.tension, 12.5);
  EXPECT_EQ(message.cause, TearEvent::SPHERE);
  EXPECT_EQ(message.cause_id, 77u);
  EXPECT_EQ(message.cause_distance, 0.125);
  EXPECT_EQ(message.pieces, 2u);
  EXPECT_EQ(message.loose_area, 0.5);
  EXPECT_EQ(message.loose_mass, 0.05);
}

TEST(TearEventMessage, NamesEachKind)
{
  const std::vector<std::pair<cloth::TearKind, int>> kinds = {
    { cloth::TearKind::BASIC, TearEvent::BASIC },
    { cloth::TearKind::WEAK_POINT, TearEvent::WEAK_POINT },
    { cloth::TearKind::ONE_POINT, TearEvent::ONE_POINT },
    { cloth::TearKind::RELEASED, TearEvent::RELEASED },
  };
  for (const auto& kind : kinds)
  {
    cloth::TearEvent event;
    event.kind = kind.first;
    EXPECT_EQ(toMessage(event, PLACEMENT).kind, kind.second);
  }
  EXPECT_EQ(toMessage(cloth::TearEvent(), PLACEMENT).path, -1) << "no path";
}

TEST(TearEventMessage, IsMadeOfEachTearInTheirOrder)
{
  std::vector<cloth::TearEvent> events(3);
  for (std::size_t i = 0; i < events.size(); ++i)
  {
    events[i].sequence = 7 + i;
  }
  const std::vector<TearEvent> messages = toMessages(events, PLACEMENT);
  ASSERT_EQ(messages.size(), events.size());
  for (std::size_t i = 0; i < messages.size(); ++i)
  {
    EXPECT_EQ(messages[i].sequence, 7 + i);
  }
}

TEST(StatusMessage, CountsTearsByKind)
{
  StatusSource source;
  source.summary.tears = { 1, 2, 3, 4 };
  source.summary.utilisation_at = cloth::Vec3d(1.0, 1.0, 1.0);
  source.loop.pace = cloth::Pace::FREE;
  source.loop.speed = 0.25;
  source.loop.clock_jumps = 6;
  source.refusals = 5;
  source.last_refusal = "grasp: no";

  const SimulationStatus message = toMessage(source, PLACEMENT);

  EXPECT_EQ(message.basic_tears, 1u);
  EXPECT_EQ(message.weak_point_tears, 2u);
  EXPECT_EQ(message.one_point_tears, 3u);
  EXPECT_EQ(message.released_springs, 4u);
  EXPECT_EQ(message.utilisation_at.y, 21.0);
  EXPECT_EQ(message.pace, "free");
  EXPECT_EQ(message.speed, 0.25);
  EXPECT_EQ(message.clock_jumps, 6u);
  EXPECT_EQ(message.refusals, 5u);
  EXPECT_EQ(message.last_refusal, "grasp: no");
}

TEST(Requests, ArriveInTheClothFrame)
{
  Grasp::Request grasp;
  grasp.point.x = 2.0;
  EXPECT_TRUE(toCore(grasp, quarterTurn()).point.isApprox(cloth::Vec3d(1.0, 2.0, 0.0)));
  EXPECT_TRUE(toCore(grasp, quarterTurn()).frame.position.isApprox(cloth::Vec3d(1.0, 2.0, 0.0)));
  EXPECT_EQ(toCore(grasp, quarterTurn()).frame.rotation.w(), 1.0) << "axes of frame_id";

  Drag::Request drag = dragRequest();
  drag.target.position.x = 2.0;
  const Destination destination = toCore(drag, quarterTurn());
  EXPECT_TRUE(destination.target.pose.position.isApprox(cloth::Vec3d(1.0, 2.0, 0.0)));
  EXPECT_NEAR(destination.target.pose.rotation.z(), std::sqrt(0.5), 1e-12);
  EXPECT_EQ(destination.target.linear_speed, 0.5);
  EXPECT_EQ(destination.target.angular_speed, 0.25);
  EXPECT_FALSE(destination.keeps_rotation);

  ThrowSphere::Request ball = throwRequest();
  ball.velocity.x = 3.0;
  EXPECT_TRUE(toCore(ball, quarterTurn()).velocity.isApprox(cloth::Vec3d(0.0, 3.0, 0.0)));
  EXPECT_EQ(toCore(ball, quarterTurn()).lifetime, 10.0) << "0 = 10 s";

  CollisionSphere sphere = oneSphere().spheres[0];
  sphere.center.x = 2.0;
  sphere.frame = "finger";
  const cloth::Sphere converted = toCore(sphere, quarterTurn());
  EXPECT_EQ(converted.id, 5u);
  EXPECT_TRUE(converted.center.isApprox(cloth::Vec3d(1.0, 2.0, 0.0)));
  EXPECT_EQ(converted.source, cloth::SphereSource::STREAMED);
  EXPECT_EQ(converted.frame, "finger");
  EXPECT_EQ(converted.center_in_frame, cloth::Vec3d(2.0, 0.0, 0.0));
}

TEST(ClothFrame, IsNamedInWordsThatTellAnyTwoPlacesApart)
{
  EXPECT_EQ(toWords({ "world", cloth::Vec3d(0.0, -0.0, 1.5) }), "world at (0, 0, 1.5)");
  EXPECT_NE(toWords({ "utm", cloth::Vec3d(4000000.25, 0.0, 0.0) }),
            toWords({ "utm", cloth::Vec3d(4000000.5, 0.0, 0.0) }));
}

TEST(ClothFrame, LiesAtItsOriginWithTheAxesOfFrameId)
{
  geometry_msgs::Transform from_table;  // a quarter turn about z
  from_table.translation.x = 11.0;
  from_table.rotation.z = std::sqrt(0.5);
  from_table.rotation.w = std::sqrt(0.5);

  const cloth::Pose pose = toClothFrame(from_table, PLACEMENT);

  EXPECT_TRUE(pose.apply(cloth::Vec3d(2.0, 0.0, 0.0)).isApprox(cloth::Vec3d(1.0, -18.0, -30.0)));
}

TEST(Requests, KeepTheRotationWhenTheOrientationIsZero)
{
  Drag::Request drag = dragRequest();
  drag.target.orientation.w = 0.0;
  drag.angular_speed = 0.0;

  EXPECT_EQ(joined(problems(drag)), "");
  EXPECT_TRUE(toCore(drag, cloth::Pose()).keeps_rotation);
}

TEST(Requests, OfGoodValuesHaveNoProblems)
{
  EXPECT_EQ(joined(problems(Grasp::Request())), "");
  EXPECT_EQ(joined(problems(dragRequest())), "");
  EXPECT_EQ(joined(problems(throwRequest())), "");
  EXPECT_EQ(joined(problems(oneSphere())), "");
  EXPECT_EQ(joined(problems(CollisionSpheres())), "");
}

TEST(Requests, LeaveRangesToTheCore)
{
  Grasp::Request grasp;
  grasp.radius = -1.0;
  EXPECT_EQ(joined(problems(grasp)), "");
  EXPECT_EQ(toCore(grasp, cloth::Pose()).radius, -1.0);

  Drag::Request drag = dragRequest();
  drag.linear_speed = 0.0;
  drag.angular_speed = 0.0;
  EXPECT_EQ(joined(problems(drag)), "");
  EXPECT_EQ(joined(cloth::problems(toCore(drag, cloth::Pose()).target)),
            "linear_speed [m/s] is 0, must be greater than 0 and at most 100\n"
            "angular_speed [rad/s] is 0, must be greater than 0 and at most 100\n");

  ThrowSphere::Request ball = throwRequest();
  ball.mass = -1.0;
  EXPECT_EQ(joined(problems(ball)), "");
  EXPECT_EQ(toCore(ball, cloth::Pose()).mass, -1.0);
}

TEST(Requests, NameEachFieldThatIsWrong)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<std::pair<std::string, std::string>> cases;  // what has to be said, what is said
  const auto grasp = [&cases](const std::string& expected, auto change)
  {
    Grasp::Request request;
    change(request);
    cases.emplace_back(expected, joined(problems(request)));
  };
  grasp("point.x is nan", [&](auto& r) { r.point.x = nan; });
  grasp("point.z is inf", [&](auto& r) { r.point.z = infinity; });
  grasp("radius [m] is nan", [&](auto& r) { r.radius = nan; });
  grasp("gripper_frame is \"/hand\", must not begin with a slash",
        [&](auto& r) { r.gripper_frame = "/hand"; });
  grasp("force_limit [N] is nan", [&](auto& r) { r.force_limit = nan; });
  const auto drag = [&cases](const std::string& expected, auto change)
  {
    Drag::Request request = dragRequest();
    change(request);
    cases.emplace_back(expected, joined(problems(request)));
  };
  drag("target.position.y is nan", [&](auto& r) { r.target.position.y = nan; });
  drag("target.orientation has length 2", [&](auto& r) { r.target.orientation.w = 2.0; });
  drag("target.orientation has length nan", [&](auto& r) { r.target.orientation.x = nan; });
  drag("angular_speed [rad/s] is nan", [&](auto& r) { r.angular_speed = nan; });
  drag("linear_speed [m/s] is inf", [&](auto& r) { r.linear_speed = infinity; });
  const auto ball = [&cases](const std::string& expected, auto change)
  {
    ThrowSphere::Request request = throwRequest();
    change(request);
    cases.emplace_back(expected, joined(problems(request)));
  };
  ball("center.x is nan", [&](auto& r) { r.center.x = nan; });
  ball("velocity.z is nan", [&](auto& r) { r.velocity.z = nan; });
  const auto sphere = [&cases](const std::string& expected, auto change)
  {
    CollisionSpheres message = oneSphere();
    change(message.spheres[0]);
    cases.emplace_back(expected, joined(problems(message)));
  };
  sphere("spheres[0].center.x is nan", [&](auto& s) { s.center.x = nan; });
  sphere("spheres[0].velocity.y is inf", [&](auto& s) { s.velocity.y = infinity; });
  sphere("spheres[0].radius [m] is nan", [&](auto& s) { s.radius = nan; });
  sphere("spheres[0].mass [kg] is nan", [&](auto& s) { s.mass = nan; });
  sphere("spheres[0].frame is \"/hand\", must not begin with a slash",
         [&](auto& s) { s.frame = "/hand"; });
  sphere("spheres[0].velocity must be 0",
         [&](auto& s)
         {
           s.frame = "hand";
           s.velocity.x = 1.0;
         });

  for (const auto& c : cases)
  {
    EXPECT_NE(c.second.find(c.first), std::string::npos)
        << "no '" << c.first << "' in: " << c.second;
  }
  CollisionSpheres many;
  many.spheres.resize(1001, oneSphere().spheres[0]);
  EXPECT_EQ(joined(problems(many)), "spheres has 1001 entries, must be at most 1000\n");
}
