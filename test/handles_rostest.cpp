// The promises of handles: clients of interactive markers hold, move, throw and pin by them.
#include <cloth_tearing/ClothSurface.h>
#include <cloth_tearing/CollisionSpheres.h>
#include <cloth_tearing/GraspStates.h>
#include <cloth_tearing/GraspTargets.h>
#include <cloth_tearing/SimulationStatus.h>
#include <cloth_tearing/client/cloth_client.h>
#include <visualization_msgs/InteractiveMarkerFeedback.h>
#include <visualization_msgs/InteractiveMarkerInit.h>
#include <visualization_msgs/InteractiveMarkerUpdate.h>

#include <cmath>
#include <limits>
#include <set>

#include "cloth_tearing/node/handle_markers.h"
#include "node_client.h"

using namespace cloth_tearing;  // NOLINT: the messages are what all of this is about
using Feedback = visualization_msgs::InteractiveMarkerFeedback;
using visualization_msgs::InteractiveMarker;
using visualization_msgs::InteractiveMarkerControl;
using visualization_msgs::InteractiveMarkerInit;

namespace
{

constexpr double TOP = 1.5;           // height of the upper edge [m]
constexpr double BOTTOM = TOP - 0.4;  // and of the lower one, before the cloth stretches
constexpr double REACH = 0.05;        // of the hand [m]
constexpr std::size_t EDGE = 11;      // pinned particles

geometry_msgs::Point at(double x, double y, double z)
{
  geometry_msgs::Point point;
  point.x = x;
  point.y = y;
  point.z = z;
  return point;
}

bool near(const geometry_msgs::Point& a, const geometry_msgs::Point& b, double distance = 1e-6)
{
  return std::hypot(std::hypot(a.x - b.x, a.y - b.y), a.z - b.z) <= distance;
}

bool finite(const geometry_msgs::Pose& pose)
{
  const auto& p = pose.position;
  const auto& q = pose.orientation;
  return std::isfinite(p.x + p.y + p.z + q.x + q.y + q.z + q.w);
}

/// A client of the markers of one node: what it sees, and what it does to them.
class HandleUser
{
public:
  explicit HandleUser(const std::string& node)
      : seen_(
            ros::NodeHandle().subscribe(node + "/handles/update_full", 1, &HandleUser::take, this))
      , feedback_(ros::NodeHandle().advertise<Feedback>(node + "/handles/feedback", 100))
  {
    EXPECT_TRUE(isSoon([this] { return feedback_.getNumSubscribers() > 0; }));
  }

  /// One that is there now, or an empty one.
  InteractiveMarker marker(const std::string& name)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const InteractiveMarker& marker : now_.markers)
    {
      if (marker.name == name)
      {
        return marker;
      }
    }
    return {};
  }

  bool has(const std::string& name) { return marker(name).name == name; }

  std::set<std::string> names()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::set<std::string> names;
    for (const InteractiveMarker& marker : now_.markers)
    {
      names.insert(marker.name);
    }
    return names;
  }

  /// Waits until these and no others are there.
  void expectOnly(const std::set<std::string>& wanted)
  {
    EXPECT_TRUE(isSoon([&] { return names() == wanted; })) << testing::PrintToString(names());
  }

  void expectAt(const std::string& name, const geometry_msgs::Point& place, double distance = 1e-6)
  {
    EXPECT_TRUE(isSoon([&] { return near(marker(name).pose.position, place, distance); }))
        << name << " is at\n"
        << marker(name).pose.position;
  }

  Feedback feedback(const std::string& name, std::uint8_t type)
  {
    Feedback message;
    message.header.frame_id = "world";
    message.client_id = "test";
    message.marker_name = name;
    message.event_type = type;
    message.pose = marker(name).pose;
    return message;
  }

  void send(const Feedback& message) { feedback_.publish(message); }

  void drag(const std::string& name, const geometry_msgs::Point& place)
  {
    Feedback message = feedback(name, Feedback::POSE_UPDATE);
    message.pose.position = place;
    send(message);
  }

  void choose(const std::string& name, HandleCommand command)
  {
    Feedback message = feedback(name, Feedback::MENU_SELECT);
    message.menu_entry_id = static_cast<std::uint32_t>(command);
    send(message);
  }

  /// The hand goes where it is dragged.
  void moveHand(const geometry_msgs::Point& place)
  {
    drag("hand", place);
    expectAt("hand", place);
    send(feedback("hand", Feedback::MOUSE_UP));
  }

private:
  void take(const InteractiveMarkerInit& message)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    now_ = message;
  }

  std::mutex mutex_;
  InteractiveMarkerInit now_;
  ros::Subscriber seen_;
  ros::Publisher feedback_;
};

/// A pressed button on a handle, which tells that it is there as rviz does, until it is let go.
class Pointer
{
public:
  Pointer(HandleUser& user, const std::string& name) : user_(user), name_(name)
  {
    user_.send(user_.feedback(name_, Feedback::MOUSE_DOWN));
    thread_ = std::thread(
        [this]
        {
          std::unique_lock<std::mutex> lock(mutex_);
          while (!released_.wait_for(lock, std::chrono::milliseconds(100), [this] { return up_; }))
          {
            user_.send(user_.feedback(name_, Feedback::KEEP_ALIVE));
          }
        });
  }

  ~Pointer()
  {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      up_ = true;
      released_.notify_all();
    }
    thread_.join();
    user_.send(user_.feedback(name_, Feedback::MOUSE_UP));
  }

  Pointer(const Pointer&) = delete;
  Pointer& operator=(const Pointer&) = delete;

private:
  HandleUser& user_;
  std::string name_;
  std::mutex mutex_;
  std::condition_variable released_;
  bool up_ = false;
  std::thread thread_;
};

/// A cloth as it was built, the hand at home.
class Handles : public testing::Test
{
protected:
  void SetUp() override
  {
    cloth_.reset();
    user_.expectOnly({ "hand" });
    user_.expectAt("hand", home_);
  }

  /// The hand is not at home, so that it is seen to go there.
  void TearDown() override { user_.moveHand(at(1.0, 1.0, 1.0)); }

  std::vector<GraspState> grasps()
  {
    const Step::Response now = cloth_.step(0);
    Collector<GraspStates> heard("/cloth/grasp_states");
    return heard
        .waitFor("the states of now", [&now](const GraspStates& s)
                 { return s.epoch == now.epoch && s.step == now.step; })
        .grasps;
  }

  /// Takes hold of the middle of the lower border. @return name of the handle
  std::string grasp(const std::string& gripper_frame = "")
  {
    id_ = cloth_.grasp(home_, REACH, 0.0, gripper_frame).grasp_id;
    const std::string name = "grasp_" + std::to_string(id_);
    EXPECT_TRUE(isSoon([&] { return user_.has(name); }));
    return name;
  }

  void setBall(const geometry_msgs::Point& center)
  {
    EXPECT_TRUE(isSoon([this] { return balls_.getNumSubscribers() > 0; }));
    CollisionSpheres message;
    message.header.frame_id = "world";
    message.spheres.resize(1);
    message.spheres[0].id = 4;
    message.spheres[0].center = center;
    message.spheres[0].radius = 0.05;
    balls_.publish(message);
    EXPECT_TRUE(isSoon([this] { return user_.has("sphere_4"); }));
  }

  /// Throws one upwards beside the cloth. @return name of its handle
  std::string throwBall(double mass)
  {
    geometry_msgs::Vector3 velocity;
    velocity.z = 1.0;
    const std::uint64_t id = cloth_.throwSphere(at(0.0, -1.0, 1.0), 0.05, velocity, mass);
    const std::string name = "thrown_" + std::to_string(id);
    EXPECT_TRUE(isSoon([&] { return user_.has(name); }));
    return name;
  }

  SimulationStatus statusWith(const std::string& refusal)
  {
    return Collector<SimulationStatus>("/cloth/status")
        .waitFor("a refusal: " + refusal, [&refusal](const SimulationStatus& s)
                 { return s.last_refusal.find(refusal) != std::string::npos; });
  }

  ClothClient cloth_{ "/cloth", "world", PATIENCE };
  HandleUser user_{ "/cloth" };
  ros::Publisher balls_ = ros::NodeHandle().advertise<CollisionSpheres>("/cloth/spheres", 1);
  geometry_msgs::Point home_ = at(0.0, 0.0, BOTTOM);
  std::uint64_t id_ = 0;  ///< of the grasp that was taken last
};

}  // namespace

// -- grasps --------------------------------------------------------------------------------------

TEST_F(Handles, AreThereAsLongAsTheirGrasps)
{
  const std::string name = grasp();
  user_.expectAt(name, home_);
  cloth_.drag(id_, at(0.1, -0.1, BOTTOM), 1.0);
  cloth_.step(1000);
  user_.expectAt(name, at(0.1, -0.1, BOTTOM));
  cloth_.release(id_);
  user_.expectOnly({ "hand" });
}

TEST_F(Handles, AreDrawnSmallWithAxesAndRingsAndAMenu)
{
  const InteractiveMarker marker = user_.marker(grasp());
  ASSERT_EQ(marker.controls.size(), 7u);
  EXPECT_EQ(marker.controls[0].interaction_mode, InteractiveMarkerControl::MOVE_3D);
  EXPECT_LT(marker.controls[0].markers.at(0).scale.x, 0.1) << "smaller than a quarter of the cloth";
  ASSERT_EQ(marker.menu_entries.size(), 2u);
  EXPECT_EQ(marker.menu_entries[0].title, "Release");
  EXPECT_EQ(marker.menu_entries[1].title, "Release and pin");
  EXPECT_EQ(marker.header.frame_id, "world");
  EXPECT_TRUE(marker.header.stamp.isZero()) << "clients answer in this frame";
}

TEST_F(Handles, DraggedMoveTheirGraspsAsStreamedTargetsDo)
{
  const geometry_msgs::Point target = at(0.1, -0.2, BOTTOM + 0.1);
  std::vector<geometry_msgs::Point> ways[2];
  const auto go = [this](std::vector<geometry_msgs::Point>& way)
  {
    for (int i = 0; i < 3; ++i)
    {
      cloth_.step(40);
      way.push_back(grasps().at(0).pose.position);
    }
  };
  const std::string name = grasp();
  {
    Pointer pointer(user_, name);
    user_.drag(name, target);
    user_.expectAt(name, target);
    go(ways[0]);
  }

  SetUp();
  grasp();
  ros::Publisher stream = ros::NodeHandle().advertise<GraspTargets>("/cloth/grasp_targets", 1);
  ASSERT_TRUE(isSoon([&] { return stream.getNumSubscribers() > 0; }));
  GraspTargets targets;
  targets.header.frame_id = "world";
  targets.targets.resize(1);
  targets.targets[0].grasp_id = id_;
  targets.targets[0].pose.position = target;
  stream.publish(targets);
  ASSERT_TRUE(isSoon([&] { return grasps().at(0).moving; }));
  go(ways[1]);

  EXPECT_FALSE(near(ways[0][0], target, 0.01)) << "it glides";
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_TRUE(near(ways[0][i], ways[1][i], 1e-9)) << i << ":\n" << ways[0][i] << ways[1][i];
  }
  EXPECT_TRUE(near(ways[0][2], target));
}

TEST_F(Handles, DraggedInAnotherFrameGoToThePlaceMeant)
{
  const std::string name = grasp();
  Feedback message = user_.feedback(name, Feedback::POSE_UPDATE);
  message.header.frame_id = "table";  // 1 m above the world, a quarter turn round z
  message.pose.position = at(-0.1, 0.05, 0.2);
  EXPECT_TRUE(isSoon(
      [&]  // once tf has heard of the table
      {
        user_.send(message);
        return near(user_.marker(name).pose.position, at(-0.05, -0.1, 1.2), 1e-6);
      }));
  cloth_.step(1000);
  EXPECT_TRUE(near(grasps().at(0).pose.position, at(-0.05, -0.1, 1.2), 1e-6));
}

TEST_F(Handles, StayUnderThePointerAndGoBackToTheirGraspsAfterIt)
{
  const std::string name = grasp();
  const geometry_msgs::Point target = at(0.0, -0.3, BOTTOM);
  {
    Pointer pointer(user_, name);
    user_.drag(name, target);
    user_.expectAt(name, target);
    cloth_.step(10);
    cloth_.grasp(at(-0.2, 0.0, BOTTOM), 0.01);
    user_.expectOnly({ "hand", name, "grasp_" + std::to_string(id_ + 1) });
    EXPECT_TRUE(near(user_.marker(name).pose.position, target)) << "though the grasp is far behind";
  }
  user_.expectAt(name, grasps().at(0).pose.position);
  EXPECT_FALSE(near(grasps().at(0).pose.position, target, 0.1));
}

TEST_F(Handles, GoBackToTheirGraspsWhenThePointerVanishes)
{
  const std::string name = grasp();
  user_.send(user_.feedback(name, Feedback::MOUSE_DOWN));
  user_.drag(name, at(0.0, -0.3, BOTTOM));
  user_.expectAt(name, at(0.0, -0.3, BOTTOM));
  user_.expectAt(name, home_);
}

TEST_F(Handles, ReleaseByTheirMenu)
{
  user_.choose(grasp(), HandleCommand::RELEASE);
  user_.expectOnly({ "hand" });
  EXPECT_TRUE(grasps().empty());
  cloth_.step(1);
  EXPECT_EQ(cloth_.unpin(home_, REACH), 0u);
}

TEST_F(Handles, ReleaseAndPinByTheirMenu)
{
  user_.choose(grasp(), HandleCommand::RELEASE_AND_PIN);
  user_.expectOnly({ "hand" });
  EXPECT_TRUE(grasps().empty());
  EXPECT_GT(cloth_.unpin(home_, REACH), 0u) << "what it held was pinned";
}

TEST_F(Handles, OfGraspsThatFollowAFrameHaveAMenuAlone)
{
  std::string name;
  ASSERT_TRUE(isSoon(
      [&]
      {
        try
        {
          name = grasp("table");
          return true;
        }
        catch (const ClothError&)  // until tf has heard of the table
        {
          return false;
        }
      }));
  const InteractiveMarker marker = user_.marker(name);
  ASSERT_EQ(marker.controls.size(), 1u);
  EXPECT_EQ(marker.controls[0].interaction_mode, InteractiveMarkerControl::MENU);
  EXPECT_EQ(marker.description, "grasp " + std::to_string(id_) + " follows table");

  user_.drag(name, at(0.0, 0.0, 2.0));
  statusWith("follows the frame table");
  user_.choose(name, HandleCommand::RELEASE);
  user_.expectOnly({ "hand" });
}

// -- the hand ------------------------------------------------------------------------------------

TEST_F(Handles, OfTheHandTakeHoldOfTheClothAndMakeWay)
{
  user_.moveHand(at(0.1, 0.01, 1.3));
  user_.choose("hand", HandleCommand::TAKE_HOLD);
  ASSERT_TRUE(isSoon([&] { return user_.names().size() == 2; }));
  const std::vector<GraspState> held = grasps();
  ASSERT_EQ(held.size(), 1u);
  EXPECT_TRUE(near(held[0].pose.position, at(0.1, 0.01, 1.3)));
  EXPECT_GT(held[0].held_particles, 1u) << "all within its radius";
  EXPECT_TRUE(isSoon(
      [&]
      {
        return !near(user_.marker("hand").pose.position,
                     user_.marker("grasp_" + std::to_string(held[0].grasp_id)).pose.position,
                     2.0 * REACH);
      }));
}

TEST_F(Handles, OfTheHandPinAndUnpin)
{
  Collector<ClothSurface> surfaces("/cloth/surface");
  user_.moveHand(at(0.1, 0.0, 1.3));
  user_.choose("hand", HandleCommand::PIN);
  surfaces.waitFor("more pins", [](const ClothSurface& s) { return s.held.size() > EDGE; });
  user_.choose("hand", HandleCommand::UNPIN);
  EXPECT_TRUE(isSoon([&] { return surfaces.all().back().held.size() == EDGE; }));
}

TEST_F(Handles, OfTheHandThrowBallsAlongTheirArrow)
{
  const geometry_msgs::Point place = at(0.0, -0.5, 1.3);
  user_.moveHand(place);
  user_.choose("hand", HandleCommand::THROW_BALL);
  ASSERT_TRUE(isSoon([&] { return user_.names().size() == 2; }));
  const std::string ball = *user_.names().rbegin();
  EXPECT_EQ(ball.substr(0, 7), "thrown_");
  user_.expectAt(ball, place);
  cloth_.step(100);
  user_.expectAt(ball, at(0.0, -0.3, 1.3), 1e-3);  // through the cloth, at throw_speed
}

TEST_F(Handles, OfTheHandComeHomeByAReset)
{
  user_.moveHand(at(0.5, -0.5, 1.0));
  cloth_.reset();
  user_.expectAt("hand", home_);
}

// -- spheres -------------------------------------------------------------------------------------

TEST_F(Handles, MoveStreamedSpheresSweptUntilTheStreamSaysOtherwise)
{
  setBall(at(0.0, -0.5, 1.3));
  {
    Pointer pointer(user_, "sphere_4");
    user_.drag("sphere_4", at(0.0, -0.46, 1.3));
    user_.expectAt("sphere_4", at(0.0, -0.46, 1.3));
    cloth_.step(200);
  }
  cloth_.step(100);
  user_.expectAt("sphere_4", at(0.0, -0.46, 1.3));
  setBall(at(0.2, -0.5, 1.3));
  EXPECT_TRUE(isSoon(
      [this]
      {
        cloth_.step(10);
        return near(user_.marker("sphere_4").pose.position, at(0.2, -0.5, 1.3));
      }));
}

TEST_F(Handles, HoldThrownSpheresUntilTheyAreLetGo)
{
  const std::string ball = throwBall(0.1);
  const geometry_msgs::Point place = at(0.01, -1.0, 1.01);
  {
    Pointer pointer(user_, ball);
    user_.drag(ball, place);
    user_.expectAt(ball, place);
    cloth_.step(2000);
  }
  user_.expectAt(ball, place);
  user_.moveHand(home_);  // feedback is obeyed in its order: the ball was let go before
  // It flies on upwards with the metre a second that it had, and falls.
  cloth_.step(100);
  user_.expectAt(ball, at(place.x, place.y, place.z + 0.051), 2e-3);
  cloth_.step(200);
  user_.expectAt(ball, at(place.x, place.y, place.z - 0.141), 2e-3);
}

TEST_F(Handles, LetGoOfSpheresWhosePointerVanishes)
{
  const std::string ball = throwBall(0.1);
  user_.send(user_.feedback(ball, Feedback::MOUSE_DOWN));
  user_.drag(ball, at(0.01, -1.0, 1.0));
  user_.expectAt(ball, at(0.01, -1.0, 1.0));
  EXPECT_TRUE(isSoon(
      [&]
      {
        cloth_.step(1);
        return user_.marker(ball).pose.position.z != 1.0;
      }));
}

TEST_F(Handles, ThrowSpheresAtTheCloth)
{
  const geometry_msgs::Point place = at(0.0, -1.0, 1.3);
  setBall(place);
  user_.choose("sphere_4", HandleCommand::THROW_AT_CLOTH);
  ASSERT_TRUE(isSoon([this] { return !user_.has("sphere_4") && user_.names().size() == 2; }));
  const std::string ball = *user_.names().rbegin();
  user_.expectAt(ball, place);
  cloth_.step(100);
  user_.expectAt(ball, at(0.0, -0.8, 1.3), 5e-3);
}

TEST_F(Handles, RemoveSpheres)
{
  setBall(at(0.0, -1.0, 1.3));
  const std::string ball = throwBall(0.0);
  user_.choose(ball, HandleCommand::REMOVE);
  user_.expectOnly({ "hand", "sphere_4" });
  user_.choose("sphere_4", HandleCommand::REMOVE);
  user_.expectOnly({ "hand" });
}

// -- what there is -------------------------------------------------------------------------------

TEST_F(Handles, FollowARestoredState)
{
  const std::string name = grasp();
  cloth_.saveState("held");
  cloth_.drag(id_, at(0.1, -0.1, BOTTOM), 1.0);
  cloth_.step(1000);
  user_.expectAt(name, at(0.1, -0.1, BOTTOM));
  cloth_.restoreState("held");
  user_.expectAt(name, home_);
  cloth_.reset();
  user_.expectOnly({ "hand" });
  cloth_.restoreState("held");
  user_.expectOnly({ "hand", name });
}

TEST_F(Handles, AreThereInANodeletManager)
{
  const ClothClient loaded("/loaded", "world", PATIENCE);
  HandleUser user("/loaded");
  loaded.reset();
  user.expectOnly({ "hand" });
  user.choose("hand", HandleCommand::TAKE_HOLD);
  EXPECT_TRUE(isSoon([&] { return user.names().size() == 2; }));
}

TEST_F(Handles, AreNotThereUnlessTheyAreWanted)
{
  ClothClient("/plain", "world", PATIENCE).step(1);
  ros::master::V_TopicInfo topics;
  ASSERT_TRUE(ros::master::getTopics(topics));
  bool plain = false;
  for (const ros::master::TopicInfo& topic : topics)
  {
    plain = plain || topic.name == "/plain/markers";
    EXPECT_EQ(topic.name.find("/plain/handles"), std::string::npos) << topic.name;
  }
  EXPECT_TRUE(plain) << "it runs";
}

// -- what is refused -----------------------------------------------------------------------------

TEST_F(Handles, ShowForAWhileWhyTheyWereRefused)
{
  user_.moveHand(at(0.0, -2.0, 1.3));
  user_.choose("hand", HandleCommand::TAKE_HOLD);
  const auto says = [this](const std::string& words)
  { return user_.marker("hand").description.find(words) != std::string::npos; };
  EXPECT_TRUE(isSoon([&] { return says("no particle within"); }));
  statusWith("handles/feedback: there is no particle within");
  EXPECT_TRUE(isSoon([&] { return user_.marker("hand").description == "hand"; }));
}

TEST_F(Handles, RefuseWhatMakesNoSenseAndChangeNothing)
{
  const std::string held = grasp();
  setBall(at(0.0, -1.0, 1.3));
  const std::uint64_t before = cloth_.step(0).state_hash;
  Collector<visualization_msgs::InteractiveMarkerUpdate> told("/cloth/handles/update");
  ASSERT_TRUE(isSoon([&] { return told.publishers() > 0; }));
  struct Case
  {
    std::function<void(Feedback&)> spoil;
    std::string words;
  };
  const auto position = [](double x) { return [x](Feedback& f) { f.pose.position.x = x; }; };
  const std::vector<Case> cases = {
    { position(std::nan("")), "pose.position.x is nan" },
    { position(std::numeric_limits<double>::infinity()), "pose.position.x is inf" },
    { position(-1e300), ".x is -1e+300" },
    { position(5000.0), ".x is 5000" },
    { [](Feedback& f) { f.pose.orientation.w = std::nan(""); }, "pose.orientation has length" },
    { [](Feedback& f) { f.pose.orientation.w = 3.0; }, "pose.orientation has length 3" },
    { [](Feedback& f) { f.header.frame_id = ""; }, "frame_id" },
    { [](Feedback& f) { f.header.frame_id = "nowhere"; }, "nowhere" },
    { [](Feedback& f) { f.event_type = 77; }, "there is no event_type 77" },
    { [](Feedback& f)
      {
        f.event_type = Feedback::MENU_SELECT;
        f.menu_entry_id = 4711;
      },
      "its menu has no entry 4711" },
  };
  for (const std::string& name : { held, std::string("hand"), std::string("sphere_4") })
  {
    for (const Case& wrong : cases)
    {
      Feedback message = user_.feedback(name, Feedback::POSE_UPDATE);
      wrong.spoil(message);
      user_.send(message);
      statusWith(wrong.words);
    }
  }
  Feedback unknown = user_.feedback("hand", Feedback::POSE_UPDATE);
  unknown.marker_name = "grasp_99";
  user_.send(unknown);
  user_.choose(held, HandleCommand::TAKE_HOLD);
  statusWith(held + ": its menu has no entry 5");

  EXPECT_EQ(cloth_.step(0).state_hash, before);
  user_.expectAt(held, home_);
  user_.expectAt("hand", home_);
  for (const auto& update : told.all())
  {
    for (const auto& pose : update.poses)
    {
      EXPECT_TRUE(finite(pose.pose)) << pose.name;
      EXPECT_LT(std::abs(pose.pose.position.x), 1000.0) << pose.name;
    }
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "handles_rostest");
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
