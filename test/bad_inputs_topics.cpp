// Bad messages on topics, which ~status tells of, and bad goals of actions, each beside a good one.
#include <actionlib/client/simple_action_client.h>
#include <cloth_tearing/CollisionSpheres.h>
#include <cloth_tearing/Grasp.h>
#include <cloth_tearing/GraspTargets.h>
#include <cloth_tearing/PullAction.h>
#include <cloth_tearing/Step.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/InteractiveMarkerFeedback.h>

#include <limits>

#include "bad_inputs.h"

using namespace cloth_tearing;  // NOLINT: the messages are what all of this is about
using cloth::Range;
using Feedback = visualization_msgs::InteractiveMarkerFeedback;

namespace
{

constexpr std::uint64_t LARGEST_ID = std::numeric_limits<std::uint64_t>::max();

/// A topic of the node, on which all messages have to be refused.
template <class Message>
class Topic
{
public:
  explicit Topic(const std::string& name)
      : name_(name), publisher_(ros::NodeHandle().advertise<Message>("/cloth/" + name, 10))
  {
    EXPECT_TRUE(isSoon([this] { return publisher_.getNumSubscribers() > 0; })) << name;
  }

  void publish(const Message& message) { publisher_.publish(message); }

  /// @return why it was refused; empty if it was not
  std::string refusal(const Message& message)
  {
    const std::string told = watch_.after([&] { publish(message); });
    EXPECT_TRUE(told.empty() || told.rfind(name_ + ": ", 0) == 0) << told;
    return told;
  }

  std::function<std::string(const Message&)> refusals()
  {
    return [this](const Message& message) { return refusal(message); };
  }

  BadInput bad(const std::string& what, const Message& message,
               const std::vector<std::string>& words)
  {
    return { name_ + ": " + what, [this, message] { return refusal(message); }, words };
  }

private:
  std::string name_;
  RefusalWatch watch_;
  ros::Publisher publisher_;
};

std::uint64_t hashNow()
{
  return ask<Step>("/cloth/step").state_hash;
}

class BadMessages : public testing::Test
{
protected:
  void SetUp() override { resetCloth(); }
  void TearDown() override { resetCloth(); }
};

CollisionSpheres goodSpheres()
{
  CollisionSpheres message;
  message.header.frame_id = "world";
  message.spheres.resize(2);
  for (std::size_t i = 0; i < 2; ++i)
  {
    message.spheres[i].id = i + 1;
    message.spheres[i].center.y = -1.0 - static_cast<double>(i);
    message.spheres[i].radius = 0.1;
  }
  return message;
}

GraspTargets goodTargets(std::uint64_t grasp)
{
  GraspTargets message;
  message.header.frame_id = "world";
  message.targets.resize(1);
  message.targets[0].grasp_id = grasp;
  message.targets[0].pose.position.z = -0.4;
  message.targets[0].pose.orientation.w = 1.0;
  return message;
}

Feedback goodFeedback(std::uint8_t type)
{
  Feedback message;
  message.header.frame_id = "world";
  message.client_id = "test";
  message.marker_name = "hand";
  message.event_type = type;
  message.pose.position.z = -0.6;
  message.pose.orientation.w = 1.0;
  return message;
}

}  // namespace

// -- topics ---------------------------------------------------------------------------------------

TEST_F(BadMessages, OfSpheres)
{
  Topic<CollisionSpheres> topic("spheres");
  const CollisionSpheres base = goodSpheres();
  std::vector<Field<CollisionSpheres>> fields = coordinates<CollisionSpheres>(
      "center", [](auto& m) -> auto& { return m.spheres[1].center; }, cloth::MAX_COORDINATE);
  const auto velocity = coordinates<CollisionSpheres>(
      "velocity", [](auto& m) -> auto& { return m.spheres[1].velocity; }, cloth::MAX_SPHERE_SPEED);
  fields.insert(fields.end(), velocity.begin(), velocity.end());
  fields.push_back({ { "radius [m]" },
                     [](auto& m) -> double& { return m.spheres[1].radius; },
                     Range::between(1e-4, 100.0) });
  fields.push_back({ { "mass [kg]" },
                     [](auto& m) -> double& { return m.spheres[1].mass; },
                     Range::between(0.0, 1e6) });
  BadInputs inputs = badNumbersIn<CollisionSpheres>("spheres", base, fields, topic.refusals());
  append(inputs, badHeadersIn<CollisionSpheres>("spheres", base, topic.refusals()));
  for (const BadFrame& frame : badFrames())
  {
    CollisionSpheres message = base;
    message.spheres[1].frame = frame.name;
    inputs.push_back(topic.bad("frame " + frame.name.substr(0, 20), message, frame.words));
  }
  CollisionSpheres message = base;
  message.spheres[1].id = 1;
  inputs.push_back(topic.bad("the same id twice", message, { "sphere 1 is there twice" }));
  message = base;
  message.spheres[1].frame = "hand";
  message.spheres[1].velocity.x = 1.0;
  inputs.push_back(topic.bad("a frame and a velocity", message,
                             { "spheres[1].velocity must be 0", "frame hand" }));
  message = base;
  message.spheres[1].frame = "mad";
  inputs.push_back(topic.bad("an infinitely far frame", message, { "center [m].x is nan" }));
  message.spheres[1].frame = "far";
  inputs.push_back(topic.bad("a frame out of the world", message, { "center [m].x is 1e+06" }));
  for (const std::size_t count : { std::size_t{ 1001 }, std::size_t{ 20000 } })
  {
    message.spheres.assign(count, base.spheres[0]);
    inputs.push_back(
        topic.bad(std::to_string(count), message,
                  { "spheres has " + std::to_string(count) + " entries, must be at most 1000" }));
  }

  const std::uint64_t before = hashNow();
  topic.publish(base);
  ASSERT_TRUE(isSoon([&] { return hashNow() != before; })) << "the good one was not taken";

  expectRefused(inputs);
}

TEST_F(BadMessages, OfGraspTargets)
{
  Topic<GraspTargets> topic("grasp_targets");
  const std::uint64_t grasp = takeMiddle();
  const GraspTargets base = goodTargets(grasp);
  BadInputs inputs = badNumbersIn<GraspTargets>(
      "grasp_targets", base,
      coordinates<GraspTargets>(
          "position", [](auto& m) -> auto& { return m.targets[0].pose.position; },
          cloth::MAX_COORDINATE),
      topic.refusals());
  append(inputs,
         badRotationsIn<GraspTargets>(
             "grasp_targets", base, "targets[0].pose.orientation",
             [](auto& m) -> auto& { return m.targets[0].pose.orientation; }, topic.refusals()));
  append(inputs, badHeadersIn<GraspTargets>("grasp_targets", base, topic.refusals()));
  for (const std::uint64_t id : { std::uint64_t{ 0 }, grasp + 1, LARGEST_ID })
  {
    inputs.push_back(topic.bad("grasp " + std::to_string(id), goodTargets(id),
                               { "there is no grasp " + std::to_string(id) }));
  }
  GraspTargets message = base;
  message.targets.push_back(base.targets[0]);
  inputs.push_back(
      topic.bad("twice", message, { "grasp " + std::to_string(grasp) + " is there twice" }));
  for (const std::size_t count : { 0u, 1001u, 20000u })
  {
    message.targets.assign(count, base.targets[0]);
    inputs.push_back(topic.bad(std::to_string(count), message,
                               { "targets has " + std::to_string(count) +
                                 " entries, must be at least 1 and at most 1000" }));
  }
  message = base;
  message.header.frame_id = "mad";
  inputs.push_back(topic.bad("an infinitely far frame", message, { "position [m].x is nan" }));

  const std::uint64_t before = hashNow();
  GraspTargets good = base;
  good.targets[0].pose.position.z = -0.41;
  topic.publish(good);
  ASSERT_TRUE(isSoon([&] { return hashNow() != before; })) << "the good one was not taken";

  expectRefused(inputs);
}

TEST_F(BadMessages, OfHandles)
{
  Topic<Feedback> topic("handles/feedback");
  const Feedback base = goodFeedback(Feedback::POSE_UPDATE);
  BadInputs inputs = badNumbersIn<Feedback>(
      "handles/feedback", base,
      coordinates<Feedback>(
          "hand: pose.position", [](auto& m) -> auto& { return m.pose.position; },
          cloth::MAX_COORDINATE),
      topic.refusals());
  append(inputs, badRotationsIn<Feedback>(
                     "handles/feedback", base, "hand: pose.orientation",
                     [](auto& m) -> auto& { return m.pose.orientation; }, topic.refusals()));
  append(inputs, badHeadersIn<Feedback>("handles/feedback", base, topic.refusals()));
  for (const std::uint32_t type : { 6u, 200u, 255u })
  {
    inputs.push_back(topic.bad("event " + std::to_string(type),
                               goodFeedback(static_cast<std::uint8_t>(type)),
                               { "hand: there is no event_type " + std::to_string(type) }));
  }
  for (const std::uint32_t entry : { 0u, 1u, 99u, 4294967295u })
  {
    Feedback message = goodFeedback(Feedback::MENU_SELECT);
    message.menu_entry_id = entry;
    inputs.push_back(topic.bad("entry " + std::to_string(entry), message,
                               { "hand: its menu has no entry " + std::to_string(entry) }));
  }

  expectRefused(inputs);

  const std::uint64_t before = hashNow();
  topic.publish(base);
  Feedback thrown = goodFeedback(Feedback::MENU_SELECT);
  thrown.menu_entry_id = 6;  // throw a ball from where it is now
  topic.publish(thrown);
  EXPECT_TRUE(isSoon([&] { return hashNow() != before; })) << "the good one was not taken";
}

// -- actions --------------------------------------------------------------------------------------

namespace
{

PullGoal goodGoal(std::uint64_t grasp)
{
  PullGoal goal;
  goal.header.frame_id = "world";
  goal.grasp_id = grasp;
  goal.point.x = 0.2;
  goal.point.z = -0.4;
  goal.radius = 0.01;
  goal.direction.z = -1.0;
  goal.distance = 0.1;
  goal.linear_speed = 0.1;
  goal.angular_speed = 0.1;
  goal.stop_force = 100.0;
  goal.stop_tears = 1;
  return goal;
}

/// A goal whose target has a pose of its own.
PullGoal goodGoalTo(std::uint64_t grasp)
{
  PullGoal goal = goodGoal(grasp);
  goal.distance = 0.0;
  goal.target.position.z = -0.5;
  goal.target.orientation.w = 1.0;
  return goal;
}

/// @param grasp one that is there
BadInputs badGoals(std::uint64_t grasp, const std::string& name,
                   const std::function<std::string(const PullGoal&)>& send)
{
  const PullGoal base = goodGoal(grasp);
  std::vector<Field<PullGoal>> fields = {
    { { "linear_speed [m/s]" },
      [](auto& g) -> double& { return g.linear_speed; },
      Range::aboveUpTo(0.0, cloth::MAX_GRIPPER_SPEED) },
    { { "stop_force [N]" },
      [](auto& g) -> double& { return g.stop_force; },
      Range::between(0.0, cloth::MAX_FORCE) },
    { { "distance [m]" },
      [](auto& g) -> double& { return g.distance; },
      Range::between(0.0, 2.0 * cloth::MAX_COORDINATE) },
  };
  BadInputs inputs = badNumbersIn<PullGoal>(name, base, fields, send);
  append(inputs, badHeadersIn<PullGoal>(name, base, send));

  const PullGoal to = goodGoalTo(grasp);
  std::vector<Field<PullGoal>> of_target = coordinates<PullGoal>(
      "position", [](auto& g) -> auto& { return g.target.position; }, cloth::MAX_COORDINATE);
  of_target.push_back({ { "angular_speed [rad/s]" },
                        [](auto& g) -> double& { return g.angular_speed; },
                        Range::aboveUpTo(0.0, cloth::MAX_GRIPPER_TURN) });
  append(inputs, badNumbersIn<PullGoal>(name, to, of_target, send));
  append(inputs, badRotationsIn<PullGoal>(
                     name, to, "target.orientation",
                     [](auto& g) -> auto& { return g.target.orientation; }, send));

  std::vector<Field<PullGoal>> of_grasp = coordinates<PullGoal>(
      "point", [](auto& g) -> auto& { return g.point; }, cloth::MAX_COORDINATE);
  of_grasp.push_back({ { "radius [m]" },
                       [](auto& g) -> double& { return g.radius; },
                       Range::between(0.0, cloth::MAX_COORDINATE) });
  append(inputs, badNumbersIn<PullGoal>(name, goodGoal(0), of_grasp, send));

  const auto bad =
      [&](const std::string& what, const std::vector<std::string>& words, const auto& change)
  {
    PullGoal goal = base;
    change(goal);
    inputs.push_back({ name + ": " + what, [send, goal] { return send(goal); }, words });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double most = std::numeric_limits<double>::max();
  bad("direction nan", { "direction.x is nan, must be finite" },
      [nan](auto& g) { g.direction.x = nan; });
  bad("direction -inf", { "direction.y is -inf, must be finite" },
      [](auto& g) { g.direction.y = -std::numeric_limits<double>::infinity(); });
  bad("direction 0", { "direction: its length is 0, must be greater than 0" },
      [](auto& g) { g.direction.z = 0.0; });
  bad("direction beyond length", { "direction: its length is inf, must be" },
      [most](auto& g) { g.direction.x = g.direction.y = g.direction.z = most; });
  bad("stop_tears", { "stop_tears is 1000001, must be at most 1000000" },
      [](auto& g) { g.stop_tears = 1000001; });
  bad("stop_tears", { "stop_tears is 4294967295, must be at most 1000000" },
      [](auto& g) { g.stop_tears = 4294967295u; });
  bad("grasp 999", { "there is no grasp 999" }, [](auto& g) { g.grasp_id = 999; });
  bad("the largest grasp", { "there is no grasp " + std::to_string(LARGEST_ID) },
      [](auto& g) { g.grasp_id = LARGEST_ID; });
  bad("empty space", { "there is no particle within" },
      [](auto& g) { g.grasp_id = 0, g.point.x = 5.0; });
  bad("what is held", { "is held by grasp" }, [](auto& g) { g.grasp_id = 0, g.point.x = 0.0; });
  bad("a target out of the world", { "target position [m].z is -1500.4" },
      [](auto& g) { g.distance = 1500.0; });
  return inputs;
}

/// Why goals of an action are rejected.
class Goals
{
public:
  explicit Goals(const std::string& name) : client_("/cloth/" + name, true)
  {
    EXPECT_TRUE(client_.waitForServer(ros::Duration(PATIENCE))) << name;
  }

  std::string rejection(const PullGoal& goal)
  {
    client_.sendGoal(goal);
    if (!client_.waitForResult(ros::Duration(2.0)))
    {
      return "";
    }
    const auto state = client_.getState();
    EXPECT_TRUE(state != actionlib::SimpleClientGoalState::REJECTED ||
                client_.getResult()->outcome == PullResult::REFUSED);
    return state == actionlib::SimpleClientGoalState::REJECTED ? client_.getResult()->message : "";
  }

  std::function<std::string(const PullGoal&)> rejections()
  {
    return [this](const PullGoal& goal) { return rejection(goal); };
  }

  /// @return whether the goal is followed; it is cancelled then
  bool accepts(const PullGoal& goal)
  {
    client_.sendGoal(goal);
    const bool active =
        isSoon([this] { return client_.getState() != actionlib::SimpleClientGoalState::PENDING; });
    const bool accepted =
        active && client_.getState() != actionlib::SimpleClientGoalState::REJECTED;
    client_.cancelGoal();
    return accepted && client_.waitForResult(ros::Duration(PATIENCE));
  }

private:
  actionlib::SimpleActionClient<PullAction> client_;
};

}  // namespace

TEST_F(BadMessages, OfPulls)
{
  const std::uint64_t grasp = takeMiddle();
  Goals goals("pull");

  expectRefused(badGoals(grasp, "pull", goals.rejections()));

  EXPECT_TRUE(goals.accepts(goodGoal(grasp))) << "the good one";
  EXPECT_TRUE(goals.accepts(goodGoalTo(grasp))) << "the good one";
  EXPECT_TRUE(goals.accepts(goodGoal(0))) << "the good one";
}

TEST_F(BadMessages, OfPredictedPulls)
{
  const std::uint64_t grasp = takeMiddle();
  Goals goals("predict_pull");
  const std::uint64_t before = hashNow();

  expectRefused(badGoals(grasp, "predict_pull", goals.rejections()));

  EXPECT_TRUE(goals.accepts(goodGoal(grasp))) << "the good one";
  EXPECT_TRUE(goals.accepts(goodGoalTo(grasp))) << "the good one";
  EXPECT_EQ(hashNow(), before) << "nor does a good one change the cloth";
}

// -- tf -------------------------------------------------------------------------------------------

TEST_F(BadMessages, OfTfWhileAGraspFollows)
{
  Grasp::Request request;
  request.header.frame_id = "world";
  request.point.z = -0.4;
  request.gripper_frame = "led_astray";
  geometry_msgs::TransformStamped good;
  good.header.frame_id = "world";
  good.child_frame_id = "led_astray";
  good.transform.rotation.w = 1.0;
  ros::Publisher tf = ros::NodeHandle().advertise<tf2_msgs::TFMessage>("/tf", 100);
  const auto tell = [&tf](geometry_msgs::TransformStamped transform, const ros::Time& stamp)
  {
    transform.header.stamp = stamp;
    tf2_msgs::TFMessage message;
    message.transforms.push_back(transform);
    tf.publish(message);
  };
  ASSERT_TRUE(isSoon(
      [&]
      {
        tell(good, ros::Time::now());
        return refusalOf<Grasp>("grasp", request).empty();
      }));
  Collector<SimulationStatus> status("/cloth/status");
  Step::Request once;
  once.steps = 20;
  for (const double value :
       { 1e308, -1e308, 1e6, std::numeric_limits<double>::infinity(),
         -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN() })
  {
    geometry_msgs::TransformStamped bad = good;
    bad.transform.translation.x = value;
    tell(bad, ros::Time::now());
    const Step::Response done = ask<Step>("/cloth/step", once);
    EXPECT_TRUE(done.success) << value << ": " << done.message;
    EXPECT_EQ(done.steps_done, 20u);
  }
  for (const double stamp : { 1.0, 4e9, 4294967295.0, 0.0 })
  {
    good.transform.translation.x += 0.001;
    tell(good, ros::Time(stamp));
    EXPECT_EQ(ask<Step>("/cloth/step", once).steps_done, 20u) << "stamp " << stamp;
  }
  EXPECT_EQ(status.first().fault, "");
}
