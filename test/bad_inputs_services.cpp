// Bad requests to the services that move the cloth, each beside a good one.
#include <cloth_tearing/Drag.h>
#include <cloth_tearing/GetGraspEvents.h>
#include <cloth_tearing/GetTearEvents.h>
#include <cloth_tearing/Grasp.h>
#include <cloth_tearing/Pin.h>
#include <cloth_tearing/Release.h>
#include <cloth_tearing/Step.h>
#include <cloth_tearing/ThrowSphere.h>

#include <limits>

#include "bad_inputs.h"

using namespace cloth_tearing;  // NOLINT: the messages are what all of this is about
using cloth::Range;

namespace
{

constexpr std::uint64_t LARGEST_ID = std::numeric_limits<std::uint64_t>::max();

class BadRequests : public testing::Test
{
protected:
  void SetUp() override { resetCloth(); }
  void TearDown() override { resetCloth(); }
};

/// Frames that are named in a field of their own.
template <class Request>
BadInputs badFramesIn(const std::string& name, const Request& base, const std::string& field,
                      const std::function<void(Request&, const std::string&)>& set,
                      const std::function<std::string(const Request&)>& send)
{
  BadInputs inputs;
  for (const BadFrame& bad : badFrames())
  {
    Request request = base;
    set(request, bad.name);
    BadInput input{ name + ": " + field + " " + bad.name.substr(0, 20),
                    [send, request] { return send(request); }, bad.words };
    input.words.push_back(field);
    inputs.push_back(input);
  }
  return inputs;
}

/// One request and the words that refuse it.
template <class Service>
BadInput bad(const std::string& name, const std::string& what,
             const typename Service::Request& request, const std::vector<std::string>& words)
{
  return { name + ": " + what, [=] { return refusalOf<Service>(name, request); }, words };
}

// -- good requests --------------------------------------------------------------------------------

Grasp::Request goodGrasp()
{
  Grasp::Request request;
  request.header.frame_id = "world";
  request.point.x = 0.2;
  request.point.z = -0.4;
  request.radius = 0.01;
  return request;
}

Drag::Request goodDrag(std::uint64_t grasp)
{
  Drag::Request request;
  request.header.frame_id = "world";
  request.grasp_id = grasp;
  request.target.position.z = -0.4;
  request.target.orientation.w = 1.0;
  request.linear_speed = 0.1;
  request.angular_speed = 0.1;
  return request;
}

Pin::Request goodPin()
{
  Pin::Request request;
  request.header.frame_id = "world";
  request.point.z = -0.2;
  request.radius = 0.01;
  request.particles = { 30, 31 };
  return request;
}

ThrowSphere::Request goodThrow()
{
  ThrowSphere::Request request;
  request.header.frame_id = "world";
  request.center.y = -2.0;
  request.velocity.y = 1.0;
  request.radius = 0.1;
  request.mass = 0.1;
  request.lifetime = 1.0;
  return request;
}

}  // namespace

// -- grasps ---------------------------------------------------------------------------------------

TEST_F(BadRequests, OfAGrasp)
{
  const auto send = refusalsOf<Grasp>("grasp");
  const Grasp::Request base = goodGrasp();
  std::vector<Field<Grasp::Request>> fields = coordinates<Grasp::Request>(
      "point", [](auto& q) -> auto& { return q.point; }, cloth::MAX_COORDINATE);
  fields.push_back({ { "radius [m]" },
                     [](auto& q) -> double& { return q.radius; },
                     Range::between(0.0, cloth::MAX_COORDINATE) });
  fields.push_back({ { "force_limit [N]" },
                     [](auto& q) -> double& { return q.force_limit; },
                     Range::between(0.0, cloth::MAX_FORCE) });
  fields.push_back({ { "keep_alive [s]" },
                     [](auto& q) -> double& { return q.keep_alive; },
                     Range::between(0.0, 3600.0) });
  BadInputs inputs = badNumbersIn<Grasp::Request>("grasp", base, fields, send);
  append(inputs, badHeadersIn<Grasp::Request>("grasp", base, send));
  append(inputs, badFramesIn<Grasp::Request>(
                     "grasp", base, "gripper_frame",
                     [](auto& q, const std::string& frame) { q.gripper_frame = frame; }, send));
  const auto with = [&base](const auto& change)
  {
    Grasp::Request request = base;
    change(request);
    return request;
  };
  inputs.push_back(bad<Grasp>("grasp", "in empty space", with([](auto& q) { q.point.x = 5.0; }),
                              { "there is no particle within 0.01 m (radius) of the point" }));
  inputs.push_back(bad<Grasp>("grasp", "nothing near",
                              with([](auto& q) { q.point.x = 5.0, q.radius = 0.0; }),
                              { "there is no particle within 0.05 m (max_grasp_distance)" }));
  inputs.push_back(bad<Grasp>("grasp", "an infinitely far frame",
                              with([](auto& q) { q.header.frame_id = "mad"; }),
                              { "point [m].x is nan, must be" }));
  inputs.push_back(bad<Grasp>("grasp", "a frame out of the world",
                              with([](auto& q) { q.header.frame_id = "far"; }),
                              { "point [m].x is 1e+06, must be" }));
  inputs.push_back(bad<Grasp>("grasp", "a gripper infinitely far",
                              with([](auto& q) { q.gripper_frame = "mad"; }),
                              { "frame position [m].x is nan, must be" }));
  inputs.push_back(bad<Grasp>("grasp", "a gripper out of the world",
                              with([](auto& q) { q.gripper_frame = "far"; }),
                              { "frame position [m].x is 1e+06, must be" }));
  inputs.push_back(bad<Grasp>("grasp", "a gripper that is stale",
                              with([](auto& q) { q.gripper_frame = "old"; }),
                              { "gripper_frame old", "beyond frame_timeout = 0.5 s" }));
  takeMiddle();
  inputs.push_back(bad<Grasp>("grasp", "twice", with([](auto& q) { q.point.x = 0.0; }),
                              { "is held by grasp", "release that first" }));

  expectRefused(inputs);

  EXPECT_EQ(send(base), "") << "the good one";
}

TEST_F(BadRequests, OfMoreGraspsThanThereMayBe)
{
  for (int i = 0; i < 20; ++i)
  {
    Grasp::Request request = goodGrasp();
    request.radius = 0.0;
    request.point.x = -0.2 + 0.04 * (i % 11);
    request.point.z = -0.4 + 0.04 * (i / 11);
    ASSERT_EQ(refusalOf<Grasp>("grasp", request), "") << i;
  }
  Grasp::Request request = goodGrasp();
  request.point.z = -0.2;

  expectRefused({ bad<Grasp>("grasp", "one too many", request,
                             { "there would be 21 grasps, must be at most limits/grasps = 20" }) });
}

TEST_F(BadRequests, OfADrag)
{
  const auto send = refusalsOf<Drag>("drag");
  const Drag::Request base = goodDrag(takeMiddle());
  const auto position = [](auto& q) -> auto&
  {
    return q.target.position;
  };
  std::vector<Field<Drag::Request>> fields =
      coordinates<Drag::Request>("position", position, cloth::MAX_COORDINATE);
  fields.push_back({ { "linear_speed [m/s]" },
                     [](auto& q) -> double& { return q.linear_speed; },
                     Range::aboveUpTo(0.0, cloth::MAX_GRIPPER_SPEED) });
  fields.push_back({ { "angular_speed [rad/s]" },
                     [](auto& q) -> double& { return q.angular_speed; },
                     Range::aboveUpTo(0.0, cloth::MAX_GRIPPER_TURN) });
  BadInputs inputs = badNumbersIn<Drag::Request>("drag", base, fields, send);
  append(inputs, badRotationsIn<Drag::Request>(
                     "drag", base, "target.orientation",
                     [](auto& q) -> auto& { return q.target.orientation; }, send));
  append(inputs, badHeadersIn<Drag::Request>("drag", base, send));
  std::uint64_t stale = 0;
  {
    const Grasp::Response taken = ask<Grasp>("/cloth/grasp", goodGrasp());
    ASSERT_TRUE(taken.success) << taken.message;
    stale = taken.grasp_id;
    Release::Request release;
    release.grasp_id = stale;
    ASSERT_EQ(refusalOf<Release>("release", release), "");
  }
  Grasp::Request following = goodGrasp();
  following.gripper_frame = "hand";
  const std::uint64_t follower = ask<Grasp>("/cloth/grasp", following).grasp_id;
  ASSERT_NE(follower, 0u);
  for (const std::uint64_t id : { std::uint64_t{ 0 }, stale, std::uint64_t{ 999 }, LARGEST_ID })
  {
    inputs.push_back(bad<Drag>("drag", "grasp " + std::to_string(id), goodDrag(id),
                               { "there is no grasp " + std::to_string(id) }));
  }
  inputs.push_back(bad<Drag>("drag", "one that follows a frame", goodDrag(follower),
                             { "grasp " + std::to_string(follower), "follows", "hand" }));
  ASSERT_EQ(send(base), "") << "the good one, which goes on";

  expectRefused(inputs);
}

TEST_F(BadRequests, OfARelease)
{
  const std::uint64_t grasp = takeMiddle();
  Release::Request good;
  good.grasp_id = grasp;
  BadInputs inputs;
  for (const std::uint64_t id : { grasp - 1, grasp + 1, std::uint64_t{ 999 }, LARGEST_ID })
  {
    for (const bool pin : { false, true })
    {
      if (id != 0)  // that is all of them
      {
        Release::Request request;
        request.grasp_id = id;
        request.pin = pin;
        inputs.push_back(bad<Release>("release", std::to_string(id), request,
                                      { "there is no grasp " + std::to_string(id) }));
      }
    }
  }

  expectRefused(inputs);

  EXPECT_EQ(refusalOf<Release>("release", good), "") << "the good one";
  expectRefused(
      { bad<Release>("release", "stale", good, { "there is no grasp " + std::to_string(grasp) }) });
}

// -- pins -----------------------------------------------------------------------------------------

TEST_F(BadRequests, OfPins)
{
  takeMiddle();
  const Pin::Request base = goodPin();
  for (const std::string name : { "pin", "unpin" })
  {
    const auto send = refusalsOf<Pin>(name);
    std::vector<Field<Pin::Request>> fields = coordinates<Pin::Request>(
        "point", [](auto& q) -> auto& { return q.point; }, cloth::MAX_COORDINATE);
    fields.push_back({ { "radius [m]" },
                       [](auto& q) -> double& { return q.radius; },
                       Range::between(0.0, cloth::MAX_COORDINATE) });
    BadInputs inputs = badNumbersIn<Pin::Request>(name, base, fields, send);
    append(inputs, badHeadersIn<Pin::Request>(name, base, send));
    Pin::Request request;
    inputs.push_back(
        bad<Pin>(name, "of nothing", request, { "radius [m] is 0 and particles is empty" }));
    for (const std::uint32_t particle : { 121u, 2147483647u, 2147483648u, 4294967295u })
    {
      request = base;
      request.particles.push_back(particle);
      inputs.push_back(bad<Pin>(name, "of particle " + std::to_string(particle), request,
                                { "there is no particle " + std::to_string(particle) }));
    }
    request = base;
    request.particles.assign(100001, 30);
    inputs.push_back(bad<Pin>(name, "of too many", request,
                              { "particles has 100001 entries, must be at most 100000" }));
    request = base;
    request.point.x = 5.0;
    inputs.push_back(bad<Pin>(name, "in empty space", request,
                              { "there is no particle within 0.01 m (radius)" }));
    if (name == "pin")
    {
      request = base;
      request.point.z = -0.4;
      inputs.push_back(bad<Pin>(name, "of what is held", request, { "is held by grasp" }));
    }

    expectRefused(inputs);
  }
  EXPECT_EQ(refusalOf<Pin>("pin", base), "") << "the good one";
  EXPECT_EQ(refusalOf<Pin>("unpin", base), "") << "the good one";
}

// -- spheres --------------------------------------------------------------------------------------

TEST_F(BadRequests, OfThrowingASphere)
{
  const auto send = refusalsOf<ThrowSphere>("throw_sphere");
  const ThrowSphere::Request base = goodThrow();
  std::vector<Field<ThrowSphere::Request>> fields = coordinates<ThrowSphere::Request>(
      "center", [](auto& q) -> auto& { return q.center; }, cloth::MAX_COORDINATE);
  const auto velocity = coordinates<ThrowSphere::Request>(
      "velocity", [](auto& q) -> auto& { return q.velocity; }, cloth::MAX_SPHERE_SPEED);
  fields.insert(fields.end(), velocity.begin(), velocity.end());
  fields.push_back({ { "radius [m]" },
                     [](auto& q) -> double& { return q.radius; },
                     Range::between(1e-4, 100.0) });
  fields.push_back(
      { { "mass [kg]" }, [](auto& q) -> double& { return q.mass; }, Range::between(0.0, 1e6) });
  fields.push_back({ { "lifetime [s]" },
                     [](auto& q) -> double& { return q.lifetime; },
                     Range::between(0.0, 1e6) });
  BadInputs inputs = badNumbersIn<ThrowSphere::Request>("throw_sphere", base, fields, send);
  append(inputs, badHeadersIn<ThrowSphere::Request>("throw_sphere", base, send));

  expectRefused(inputs);

  EXPECT_EQ(send(base), "") << "the good one";
}

// -- questions and steps --------------------------------------------------------------------------

TEST_F(BadRequests, OfEventsThatWillNeverBeGetNone)
{
  const std::uint64_t before = ask<Step>("/cloth/step").state_hash;
  for (const std::uint64_t since : { std::uint64_t{ 1 } << 32, LARGEST_ID })
  {
    GetTearEvents::Request tears;
    tears.since = since;
    tears.max_count = std::numeric_limits<std::uint32_t>::max();
    const auto torn = ask<GetTearEvents>("/cloth/get_tear_events", tears);
    EXPECT_TRUE(torn.success) << torn.message;
    EXPECT_TRUE(torn.events.empty());
    GetGraspEvents::Request grasps;
    grasps.since = since;
    const auto taken = ask<GetGraspEvents>("/cloth/get_grasp_events", grasps);
    EXPECT_TRUE(taken.success) << taken.message;
    EXPECT_TRUE(taken.events.empty());
  }
  EXPECT_EQ(ask<Step>("/cloth/step").state_hash, before);
}
