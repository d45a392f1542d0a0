// Those who move the cloth: grippers, pulls, balls, pins and other parameters.
#include "users.h"

#include <actionlib/client/action_client.h>
#include <cloth_tearing/CollisionSpheres.h>
#include <cloth_tearing/Drag.h>
#include <cloth_tearing/Grasp.h>
#include <cloth_tearing/GraspTargets.h>
#include <cloth_tearing/Pin.h>
#include <cloth_tearing/PullAction.h>
#include <cloth_tearing/Release.h>
#include <cloth_tearing/ThrowSphere.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <tf2_ros/transform_broadcaster.h>

#include <limits>
#include <set>

using namespace cloth_tearing;  // NOLINT: the messages are what all of this is about

namespace soak
{

namespace
{

const std::string HAND = "soak_hand";  // frame that somebody moves
const std::vector<std::string> FRAMES = { "world", "world", "world", HAND };
constexpr int BAD = 8;  // one request of so many is wrong

constexpr double LONGEST_PULL = 60.0;  // on a busy machine; some seconds of the cloth's time [s]

using Time = std::chrono::duration<double>;

// -- grippers -------------------------------------------------------------------------------------

class Gripper : public User
{
public:
  Gripper(World& world, std::uint64_t seed)
      : User(world, seed)
      , targets_(ros::NodeHandle().advertise<GraspTargets>(world.node() + "/grasp_targets", 10))
  {
  }

private:
  void act() override
  {
    if (dice_.oneIn(BAD))
    {
      askWrongly();
      return;
    }
    const std::uint64_t grasp = take();
    if (grasp == 0)
    {
      return;
    }
    for (int moves = 1 + dice_.below(4); moves > 0 && !world_.isOver(); --moves)
    {
      dice_.oneIn(2) ? drag(grasp) : stream(grasp);
      world_.pause(Time(dice_.between(0.0, 0.1)));
    }
    if (!dice_.oneIn(6))  // else somebody else's reset, or its keep_alive, ends it
    {
      release(grasp);
    }
  }

  void leave() override { world_.ask<Release>("release"); }

  std::uint64_t take()
  {
    Grasp::Request request;
    request.header.frame_id = "world";
    request.point = onTheCloth();
    request.radius = dice_.oneIn(3) ? 0.0 : dice_.between(0.01, 0.08);
    request.force_limit = dice_.oneIn(3) ? dice_.between(0.5, 20.0) : 0.0;
    request.keep_alive = dice_.oneIn(2) ? dice_.between(0.1, 1.0) : 0.0;
    request.gripper_frame = dice_.oneIn(5) ? HAND : "";
    return world_.ask<Grasp>("grasp", request).grasp_id;
  }

  void drag(std::uint64_t grasp)
  {
    Drag::Request request;
    request.header.frame_id = "world";
    request.grasp_id = grasp;
    request.target.position = somewhere();
    request.linear_speed = dice_.between(0.05, 5.0);
    request.angular_speed = dice_.between(0.0, 10.0);
    world_.ask<Drag>("drag", request);
  }

  void stream(std::uint64_t grasp)
  {
    geometry_msgs::Point at = onTheCloth();
    for (int i = 0; i < 20 && world_.pause(Time(0.005)); ++i)
    {
      GraspTargets message;
      message.header.frame_id = "world";
      message.targets.resize(1 + static_cast<std::size_t>(dice_.oneIn(20)));
      at.x += dice_.between(-0.03, 0.03);
      at.y += dice_.between(-0.03, 0.03);
      at.z += dice_.between(-0.03, 0.03);
      for (GraspTarget& target : message.targets)  // the same grasp twice is refused
      {
        target.grasp_id = grasp;
        target.pose.position = at;
      }
      message.targets[0].pose.position.y = dice_.oneIn(20) ? badNumber() : at.y;
      targets_.publish(message);
      world_.count("grasp_targets sent");
    }
  }

  void release(std::uint64_t grasp)
  {
    Release::Request request;
    request.grasp_id = grasp;
    request.pin = dice_.oneIn(8);
    world_.ask<Release>("release", request);
  }

  void askWrongly()
  {
    Grasp::Request grasp;
    grasp.header.frame_id = dice_.oneIn(3) ? "nowhere" : "world";
    grasp.point = onTheCloth();
    grasp.radius = grasp.header.frame_id == "world" ? badNumber() : 0.01;
    world_.ask<Grasp>("grasp", grasp, Expect::REFUSAL);
    Drag::Request drag;
    drag.header.frame_id = "world";
    drag.grasp_id = ~std::uint64_t{ 0 };
    drag.linear_speed = 1.0;
    world_.ask<Drag>("drag", drag, Expect::REFUSAL);
    Release::Request release;
    release.grasp_id = ~std::uint64_t{ 0 };
    world_.ask<Release>("release", release, Expect::REFUSAL);
  }

  ros::Publisher targets_;
};

// -- pulls ----------------------------------------------------------------------------------------

class Puller : public User
{
public:
  Puller(World& world, std::uint64_t seed)
      : User(world, seed)
      , pull_(world.node() + "/pull")
      , predict_pull_(world.node() + "/predict_pull")
  {
  }

private:
  using Client = actionlib::ActionClient<PullAction>;
  using Goal = Client::GoalHandle;

  void act() override
  {
    const std::string name = dice_.oneIn(8) ? "predict_pull" : "pull";
    Client& client = name == "pull" ? pull_ : predict_pull_;
    if (!client.waitForActionServerToStart(ros::Duration(PATIENCE)))
    {
      world_.fail(name, "has no server");
      return;
    }
    for (int goals = 1 + dice_.below(5); goals > 0 && !world_.isOver(); --goals)
    {
      if (dice_.oneIn(BAD))
      {
        pullWrongly(client, name);
      }
      else if (name == "pull" && dice_.oneIn(3))
      {
        pullTwice(client);
      }
      else
      {
        pullOnce(client, name);
      }
    }
  }

  PullGoal somePull()
  {
    PullGoal goal;
    goal.header.frame_id = "world";
    goal.point = onTheCloth();
    goal.radius = dice_.between(0.01, 0.06);
    goal.direction.x = dice_.between(-1.0, 1.0);
    goal.direction.y = dice_.between(-1.0, 1.0);
    goal.direction.z = dice_.between(-1.0, -0.1);
    goal.distance = dice_.oneIn(3) ? 0.0 : dice_.between(0.05, 1.0);
    goal.target.position = somewhere();
    goal.linear_speed = dice_.between(0.2, 5.0);
    goal.angular_speed = 1.0;
    goal.stop_tears = static_cast<std::uint32_t>(dice_.oneIn(2) ? dice_.below(5) : 0);
    goal.stop_force = dice_.oneIn(4) ? dice_.between(0.5, 20.0) : 0.0;
    goal.release = true;
    return goal;
  }

  void pullOnce(Client& client, const std::string& name)
  {
    Goal goal = client.sendGoal(somePull());
    if (dice_.oneIn(3))
    {
      world_.pause(Time(dice_.between(0.0, 0.2)));
      cancel(goal);
    }
    waitFor(goal, name);
  }

  void pullTwice(Client& client)
  {
    PullGoal goal = somePull();
    Grasp::Request request;
    request.header.frame_id = "world";
    request.point = goal.point;
    request.radius = goal.radius;
    goal.grasp_id = world_.ask<Grasp>("grasp", request).grasp_id;
    if (goal.grasp_id == 0)
    {
      return;
    }
    goal.release = false;
    Goal first = client.sendGoal(goal);
    world_.pause(Time(dice_.between(0.0, 0.05)));
    goal.direction.x = -goal.direction.x;
    goal.release = true;
    Goal second = client.sendGoal(goal);
    waitFor(first, "pull");
    waitFor(second, "pull");
  }

  void pullWrongly(Client& client, const std::string& name)
  {
    PullGoal wrong = somePull();
    wrong.linear_speed = badNumber();
    Goal goal = client.sendGoal(wrong);
    waitFor(goal, name);
    if (goal.getCommState() == actionlib::CommState::DONE &&
        goal.getTerminalState() != actionlib::TerminalState::REJECTED)
    {
      world_.fail(name, "accepted a speed that is none");
    }
  }

  /// If the server has told of it: else actionlib's client takes the goal for lost as soon as a
  /// status comes without it.
  static void cancel(Goal& goal)
  {
    if (goal.getCommState() != actionlib::CommState::WAITING_FOR_GOAL_ACK)
    {
      goal.cancel();
    }
  }

  /// Waits for its end and looks at it. While the simulation is paused it takes longer.
  void waitFor(Goal& goal, const std::string& name)
  {
    const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(LONGEST_PULL);
    while (goal.getCommState() != actionlib::CommState::DONE)
    {
      if (ros::WallTime::now() > deadline)
      {
        world_.fail(name, "has no end: " + goal.getCommState().toString());
        return;
      }
      if (!world_.pause(Time(0.002)))
      {
        cancel(goal);
        ros::WallDuration(0.01).sleep();
      }
    }
    const actionlib::TerminalState state = goal.getTerminalState();
    const auto result = goal.getResult();
    if (!result)
    {
      world_.fail(name, "ended without a result: " + state.toString() + " " + state.getText());
      return;
    }
    world_.check(name, *result);
    if (outcomesOf(state).count(result->outcome) == 0)
    {
      world_.fail(name, "is " + state.toString() + " with the outcome " +
                            std::to_string(result->outcome) + ": " + result->message);
    }
    static const std::vector<std::string> WORDS = { " arrived",          " stopped by force",
                                                    " stopped by tears", " lost",
                                                    " cancelled",        " refused" };
    world_.count(name + WORDS.at(result->outcome));
  }

  static std::set<int> outcomesOf(const actionlib::TerminalState& state)
  {
    switch (state.state_)
    {
      case actionlib::TerminalState::SUCCEEDED:
        return { PullResult::ARRIVED, PullResult::FORCE, PullResult::TEARS };
      case actionlib::TerminalState::ABORTED:
        return { PullResult::LOST };
      case actionlib::TerminalState::REJECTED:
        return { PullResult::REFUSED };
      case actionlib::TerminalState::PREEMPTED:
      case actionlib::TerminalState::RECALLED:
        return { PullResult::CANCELLED };
      default:
        return {};
    }
  }

  Client pull_;
  Client predict_pull_;
};

// -- balls ----------------------------------------------------------------------------------------

class BallStreamer : public User
{
public:
  BallStreamer(World& world, std::uint64_t seed)
      : User(world, seed)
      , topic_(ros::NodeHandle().advertise<CollisionSpheres>(world.node() + "/spheres", 10))
  {
    longest_pause_ = 0.02;
  }

private:
  void act() override
  {
    CollisionSpheres message;
    message.header.frame_id = "world";
    if (dice_.oneIn(10))
    {
      changeIds();
    }
    for (auto& [id, ball] : balls_)
    {
      ball.center.x += dice_.between(-0.02, 0.02);
      ball.center.y += dice_.between(-0.02, 0.02);
      ball.center.z += dice_.between(-0.02, 0.02);
      message.spheres.push_back(ball);
    }
    if (!message.spheres.empty() && dice_.oneIn(BAD))
    {
      spoil(message);
    }
    topic_.publish(message);
    world_.count("spheres sent");
  }

  void changeIds()
  {
    balls_.clear();
    for (int i = dice_.below(9); i > 0; --i)
    {
      CollisionSphere ball;
      ball.id = static_cast<std::uint64_t>(dice_.below(30));
      ball.center = somewhere();
      ball.radius = dice_.between(0.02, 0.12);
      ball.mass = dice_.oneIn(3) ? dice_.between(0.01, 1.0) : 0.0;
      if (dice_.oneIn(6))
      {
        ball.frame = HAND;
        ball.center = geometry_msgs::Point();
      }
      balls_[ball.id] = ball;
    }
  }

  void spoil(CollisionSpheres& message)
  {
    CollisionSphere& ball = message.spheres.front();
    switch (dice_.below(4))
    {
      case 0:
        ball.radius = badNumber();
        break;
      case 1:
        ball.center.z = badNumber();
        break;
      case 2:
        message.header.frame_id = "nowhere";
        break;
      default:
        message.spheres.push_back(ball);
    }
  }

  void leave() override { topic_.publish(CollisionSpheres()); }

  ros::Publisher topic_;
  std::map<std::uint64_t, CollisionSphere> balls_;
};

class Thrower : public User
{
public:
  using User::User;

private:
  void act() override
  {
    const geometry_msgs::Point aim = onTheCloth();
    ThrowSphere::Request request;
    request.header.frame_id = dice_.oneOf(FRAMES);
    request.center = aim;
    request.center.y -= 0.5;
    request.velocity.y = dice_.between(0.5, 20.0);
    request.velocity.x = dice_.between(-1.0, 1.0);
    request.radius = dice_.between(0.02, 0.1);
    request.mass = dice_.oneIn(2) ? dice_.between(0.01, 1.0) : 0.0;
    request.lifetime = dice_.between(0.2, 3.0);
    const bool wrong = dice_.oneIn(BAD);
    request.radius = wrong ? badNumber() : request.radius;
    world_.ask<ThrowSphere>("throw_sphere", request, wrong ? Expect::REFUSAL : Expect::EITHER);
  }
};

// -- pins and other parameters --------------------------------------------------------------------

class Pinner : public User
{
public:
  Pinner(World& world, std::uint64_t seed) : User(world, seed) { longest_pause_ = 0.2; }

private:
  void act() override
  {
    Pin::Request request;
    request.header.frame_id = "world";
    request.point = onTheCloth();
    request.radius = dice_.oneIn(3) ? 0.0 : dice_.between(0.01, 0.08);
    const int particles = static_cast<int>(world_.particles());
    for (int i = dice_.below(4); i > 0 && particles > 0; --i)
    {
      request.particles.push_back(static_cast<std::uint32_t>(dice_.below(particles)));
    }
    const bool wrong = dice_.oneIn(BAD);
    if (wrong)
    {
      request.particles.push_back(4000000000u);
    }
    world_.ask<Pin>(dice_.oneIn(2) ? "pin" : "unpin", request,
                    wrong ? Expect::REFUSAL : Expect::EITHER);
  }
};

class Tuner : public User
{
public:
  Tuner(World& world, std::uint64_t seed) : User(world, seed) { longest_pause_ = 0.3; }

private:
  struct Knob
  {
    std::string group;
    std::string name;
    double least;
    double most;
  };

  void act() override
  {
    static const std::vector<Knob> KNOBS = {
      { "/material", "stiffness", 60.0, 140.0 },
      { "/material", "bend_shear_stiffness", 5.0, 40.0 },
      { "/material", "damping", 0.0, 0.05 },
      { "/environment", "air_friction", 0.0, 2.0 },
      { "/environment", "wind_drag", 0.0, 2.0 },
      { "/environment/gravity", "z", -12.0, -5.0 },
      { "/environment/wind", "x", -4.0, 4.0 },
      { "/environment/wind", "y", -4.0, 4.0 },
      { "/tearing", "tear_strain", 0.25, 0.4 },
      { "/tearing", "weak_tear_strain", 0.15, 0.24 },
      { "/contact", "friction", 0.0, 1.0 },
      { "/contact", "floor_height", 0.0, 0.5 },
      { "/contact/bounds_min", "z", -50.0, -5.0 },
      { "/contact/bounds_max", "z", 5.0, 50.0 },
    };
    const Knob& knob = dice_.oneOf(KNOBS);
    double wish = dice_.between(knob.least, knob.most);
    std::string name = knob.name;
    if (dice_.oneIn(BAD))
    {
      wish = std::numeric_limits<double>::quiet_NaN();
    }
    else if (dice_.oneIn(BAD))
    {
      name = "unknown";
    }
    set(knob.group, name, wish);
  }

  void set(const std::string& group, const std::string& name, double wish)
  {
    using dynamic_reconfigure::ConfigTools;
    dynamic_reconfigure::Reconfigure call;
    ConfigTools::appendParameter(call.request.config, name, wish);
    if (!world_.callTwice(group.substr(1) + "/set_parameters", call))
    {
      world_.fail("set_parameters", group + " did not answer");
      return;
    }
    world_.check("set_parameters", call.response);
    double in_force = 0.0;
    const bool told = ConfigTools::getParameter(call.response.config, name, in_force);
    if (told != (name != "unknown"))
    {
      world_.fail("set_parameters", group + " answered another question");
    }
    world_.count(told && in_force == wish ? "set_parameters done" : "set_parameters refused");
  }
};

/// Moves a frame that grasps and balls follow; now and then it is missing for a while.
class FrameMover : public User
{
public:
  FrameMover(World& world, std::uint64_t seed) : User(world, seed) { longest_pause_ = 0.03; }

private:
  void act() override
  {
    if (dice_.oneIn(100))
    {
      world_.pause(Time(0.7));
    }
    geometry_msgs::TransformStamped frame;
    frame.header.frame_id = "world";
    frame.header.stamp = ros::Time::now();
    frame.child_frame_id = HAND;
    at_.x = 0.95 * at_.x + dice_.between(-0.03, 0.03);
    at_.y = 0.95 * at_.y + dice_.between(-0.03, 0.03);
    at_.z = 0.95 * at_.z + 0.05 + dice_.between(-0.03, 0.03);
    frame.transform.translation.x = at_.x;
    frame.transform.translation.y = at_.y;
    frame.transform.translation.z = at_.z;
    frame.transform.rotation.w = 1.0;
    frame.transform.translation.x = dice_.oneIn(50) ? badNumber() : at_.x;
    broadcaster_.sendTransform(frame);
    world_.count("tf sent");
  }

  tf2_ros::TransformBroadcaster broadcaster_;
  geometry_msgs::Point at_;
};

}  // namespace

// -- what they have in common ---------------------------------------------------------------------

void User::run()
{
  while (world_.pause(Time(dice_.between(0.0, longest_pause_))))
  {
    act();
  }
  leave();
}

geometry_msgs::Point User::somewhere()
{
  geometry_msgs::Point point;
  point.x = dice_.between(-0.7, 0.7);
  point.y = dice_.between(-0.6, 0.6);
  point.z = dice_.between(0.2, 1.8);
  return point;
}

geometry_msgs::Point User::onTheCloth()
{
  const int particles = static_cast<int>(world_.particles());
  return particles == 0 ? somewhere()
                        : world_.particle(static_cast<std::uint32_t>(dice_.below(particles)));
}

double User::badNumber()
{
  using Limits = std::numeric_limits<double>;
  static const std::vector<double> BAD_NUMBERS = { Limits::quiet_NaN(), Limits::infinity(),
                                                   -Limits::infinity(), 1e308, -1e308 };
  return dice_.oneOf(BAD_NUMBERS);
}

Crowd::Crowd(World& world, std::uint64_t seed, const std::string& states)
{
  for (const auto& make : { makeGripper, makeGripper, makeGripper, makePuller, makePuller,
                            makeBallStreamer, makeThrower, makePinner, makeTuner, makeFrameMover,
                            makeListener, makeListener, makeListener })
  {
    users_.push_back(make(world, seed + users_.size()));
  }
  users_.push_back(makeKeeper(world, seed + users_.size(), states));
  for (const auto& user : users_)
  {
    threads_.emplace_back([&user] { user->run(); });
  }
}

Crowd::~Crowd()
{
  for (std::thread& thread : threads_)
  {
    thread.join();
  }
}

std::unique_ptr<User> makeGripper(World& world, std::uint64_t seed)
{
  return std::make_unique<Gripper>(world, seed);
}
std::unique_ptr<User> makePuller(World& world, std::uint64_t seed)
{
  return std::make_unique<Puller>(world, seed);
}
std::unique_ptr<User> makeBallStreamer(World& world, std::uint64_t seed)
{
  return std::make_unique<BallStreamer>(world, seed);
}
std::unique_ptr<User> makeThrower(World& world, std::uint64_t seed)
{
  return std::make_unique<Thrower>(world, seed);
}
std::unique_ptr<User> makePinner(World& world, std::uint64_t seed)
{
  return std::make_unique<Pinner>(world, seed);
}
std::unique_ptr<User> makeTuner(World& world, std::uint64_t seed)
{
  return std::make_unique<Tuner>(world, seed);
}
std::unique_ptr<User> makeFrameMover(World& world, std::uint64_t seed)
{
  return std::make_unique<FrameMover>(world, seed);
}

}  // namespace soak
