// Plays the demo on a running cloth node, through the same services and topics as any other client.
#include <cloth_tearing/ClothSurface.h>
#include <cloth_tearing/Drag.h>
#include <cloth_tearing/Grasp.h>
#include <cloth_tearing/Release.h>
#include <cloth_tearing/SimulationStatus.h>
#include <cloth_tearing/TearEvents.h>
#include <cloth_tearing/ThrowSphere.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <Eigen/Geometry>
#include <array>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>

namespace cloth_tearing
{
namespace
{

/// How long the scene waits for the node, on the wall clock [s].
constexpr double PATIENCE = 120.0;

const std::array<const char*, 4> KIND_NAMES = { "basic", "weak_point", "one_point", "released" };
const std::array<const char*, 4> CAUSE_NAMES = { "nobody", "grasp", "sphere", "thrown sphere" };

geometry_msgs::Point toPoint(const Eigen::Vector3d& x)
{
  geometry_msgs::Point point;
  point.x = x.x();
  point.y = x.y();
  point.z = x.z();
  return point;
}

/// Grasps a cloth that hangs in x-z, drags it until it tears, and throws a ball through the rest.
/// Places are fractions of the cloth's own width and height, so that any model can hang there.
class DemoScene
{
public:
  explicit DemoScene(ros::NodeHandle nh) : nh_(std::move(nh))
  {
    events_ = nh_.subscribe("tear_events", 1000, &DemoScene::onTears, this);
    status_ = nh_.subscribe("status", 10, &DemoScene::onStatus, this);
    surface_ = nh_.subscribe("surface", 1, &DemoScene::onSurface, this);
  }

  void play()
  {
    waitUntil([this] { return time_ >= 0.0 && size_.x() > 0.0; }, "the node");
    surface_.shutdown();
    waitFor(ros::NodeHandle("~").param("settle_time", 1.5));

    say("the gripper takes hold and pulls");
    const std::uint64_t grasp = takeHold(at(0.82, 0.55, 0.0), 0.04 * size_.z());
    drag(grasp, at(0.95, 0.625, 0.75), 0.35);
    waitFor(2.7);
    drag(grasp, at(0.75, 0.8, 0.38), 0.35);
    waitFor(1.8);

    say("a ball goes through");
    throwBall(at(0.27, 0.32, 1.3), 12.0, 0.05 * size_.z());
    waitFor(1.7);
    std::printf("scene: ready for the picture\n");
    waitWall(ros::NodeHandle("~").param("picture_pause", 3.0));

    say("the gripper lets go");
    release(grasp);
    waitFor(2.0);
  }

  void summarise() const
  {
    std::printf("tears: %llu basic, %llu weak point, %llu one point\n", kinds_[0], kinds_[1],
                kinds_[2]);
  }

  bool torn() const { return kinds_[0] + kinds_[1] + kinds_[2] > 0; }

private:
  void onTears(const TearEvents& message)
  {
    for (const TearEvent& event : message.events)
    {
      ++kinds_.at(event.kind);
      std::printf(
          "tear %llu %s at (%.2f, %.2f, %.2f) m, strain %.2f over %.2f, %.2f N, by %s %llu,"
          " pieces %u\n",
          static_cast<unsigned long long>(event.sequence), KIND_NAMES.at(event.kind),
          event.position.x, event.position.y, event.position.z, event.strain, event.threshold,
          event.tension, CAUSE_NAMES.at(event.cause),
          static_cast<unsigned long long>(event.cause_id), event.pieces);
    }
  }

  void onStatus(const SimulationStatus& status) { time_ = status.time; }

  void onSurface(const ClothSurface& surface)
  {
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i + 2 < surface.positions.size(); i += 3)
    {
      box.extend(Eigen::Vector3d(surface.positions[i], surface.positions[i + 1],
                                 surface.positions[i + 2]));
    }
    frame_id_ = surface.header.frame_id;
    corner_ = Eigen::Vector3d(box.min().x(), box.center().y(), box.max().z());
    size_ = box.sizes();
  }

  /// A place from the upper left corner: right and down in fractions of the cloth's width and
  /// height, towards the viewer in fractions of its height.
  Eigen::Vector3d at(double right, double down, double forward) const
  {
    return corner_ + Eigen::Vector3d(right * size_.x(), -forward * size_.z(), -down * size_.z());
  }

  template <class Service>
  void call(const std::string& name, Service& service)
  {
    if (!ros::service::call(nh_.resolveName(name), service))
    {
      throw std::runtime_error(name + " gave no answer");
    }
    if (!service.response.success)
    {
      throw std::runtime_error(name + " was refused: " + service.response.message);
    }
  }

  std::uint64_t takeHold(const Eigen::Vector3d& point, double radius)
  {
    Grasp grasp;
    grasp.request.header.frame_id = frame_id_;
    grasp.request.point = toPoint(point);
    grasp.request.radius = radius;
    call("grasp", grasp);
    return grasp.response.grasp_id;
  }

  void drag(std::uint64_t grasp, const Eigen::Vector3d& target, double speed)
  {
    Drag drag;
    drag.request.header.frame_id = frame_id_;
    drag.request.grasp_id = grasp;
    drag.request.target.position = toPoint(target);
    drag.request.target.orientation.w = 1.0;
    drag.request.linear_speed = speed;
    drag.request.angular_speed = 1.0;
    call("drag", drag);
  }

  void release(std::uint64_t grasp)
  {
    Release release;
    release.request.grasp_id = grasp;
    call("release", release);
  }

  void throwBall(const Eigen::Vector3d& from, double speed, double radius)
  {
    ThrowSphere ball;
    ball.request.header.frame_id = frame_id_;
    ball.request.center = toPoint(from);
    ball.request.velocity.y = speed;
    ball.request.radius = radius;
    ball.request.lifetime = 1.5;
    call("throw_sphere", ball);
  }

  /// Handles messages until `done`.
  void waitUntil(const std::function<bool()>& done, const std::string& what)
  {
    const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(PATIENCE);
    while (!done())
    {
      if (!ros::ok() || ros::WallTime::now() > deadline)
      {
        throw std::runtime_error("waited in vain for " + what);
      }
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.05));
    }
  }

  /// Lets `seconds` of simulated time pass.
  void waitFor(double seconds)
  {
    const double until = time_ + seconds;
    waitUntil([&] { return time_ >= until; }, "the simulation to go on");
  }

  void waitWall(double seconds)
  {
    const ros::WallTime until = ros::WallTime::now() + ros::WallDuration(seconds);
    waitUntil([&] { return ros::WallTime::now() >= until; }, "the picture");
  }

  static void say(const char* what) { std::printf("scene: %s\n", what); }

  ros::NodeHandle nh_;
  ros::Subscriber events_;
  ros::Subscriber status_;
  ros::Subscriber surface_;
  std::array<unsigned long long, 4> kinds_{};
  double time_ = -1.0;  ///< simulated [s]; negative until the node was heard
  std::string frame_id_;
  Eigen::Vector3d corner_ = Eigen::Vector3d::Zero();  ///< upper left of the untorn cloth [m]
  Eigen::Vector3d size_ = Eigen::Vector3d::Zero();    ///< [m]
};

}  // namespace
}  // namespace cloth_tearing

int main(int argc, char** argv)
{
  ros::init(argc, argv, "demo_scene");
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  ros::NodeHandle pnh("~");
  cloth_tearing::DemoScene scene(ros::NodeHandle(pnh.param<std::string>("cloth", "cloth")));
  try
  {
    scene.play();
  }
  catch (const std::runtime_error& error)
  {
    std::fprintf(stderr, "scene: %s\n", error.what());
    scene.summarise();
    return 1;
  }
  scene.summarise();
  if (!pnh.param("exit_when_done", false))
  {
    ros::spin();  // the tears that come from now on are printed too
  }
  return scene.torn() ? 0 : 1;
}
