// Plays the demo on a running cloth node, through the same services and topics as any other client.
#include <cloth_tearing/ClothSurface.h>
#include <cloth_tearing/Drag.h>
#include <cloth_tearing/Grasp.h>
#include <cloth_tearing/Release.h>
#include <cloth_tearing/SimulationStatus.h>
#include <cloth_tearing/Step.h>
#include <cloth_tearing/TearEvents.h>
#include <cloth_tearing/ThrowSphere.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cloth_tearing/node/tear_words.h"

namespace cloth_tearing
{
namespace
{

/// How long the scene waits for the node, on the wall clock [s].
constexpr double PATIENCE = 120.0;
/// The cloth is stepped this far at a time [s]; what the scene does falls between two of these.
constexpr double BEAT = 1.0 / 30.0;
/// Radius of the gripper in mean spacings of the particles [-].
constexpr double GRIPPER_SPACINGS = 1.5;

geometry_msgs::Point toPoint(const Eigen::Vector3d& x)
{
  geometry_msgs::Point point;
  point.x = x.x();
  point.y = x.y();
  point.z = x.z();
  return point;
}

Eigen::Vector3d particleOf(const ClothSurface& surface, std::size_t i)
{
  return Eigen::Vector3d(surface.origin.x + surface.positions[3 * i],
                         surface.origin.y + surface.positions[3 * i + 1],
                         surface.origin.z + surface.positions[3 * i + 2]);
}

/// Mean length of the triangles' sides [m].
double meanSpacing(const ClothSurface& surface)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
  {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    sum +=
        (particleOf(surface, surface.triangles[i]) - particleOf(surface, surface.triangles[next]))
            .norm();
  }
  return sum / static_cast<double>(surface.triangles.size());
}

/// Grasps a cloth that hangs in x-z, drags it until it tears, and throws a ball through the rest.
/// Places are fractions of the cloth's own width and height, so that any model can hang there.
/// The node is paused and the scene steps it, at the pace of the wall clock: so each action comes
/// at its own step, and it tears alike every time, however fast the machine is.
class DemoScene
{
public:
  explicit DemoScene(ros::NodeHandle nh) : nh_(std::move(nh))
  {
    events_subscriber_ = nh_.subscribe("tear_events", 1000, &DemoScene::onTears, this);
    status_subscriber_ = nh_.subscribe("status", 10, &DemoScene::onStatus, this);
    surface_subscriber_ = nh_.subscribe("surface", 1, &DemoScene::onSurface, this);
  }

  void play()
  {
    waitUntil([this] { return time_step_ > 0.0 && surface_; }, "the node");
    measure();
    waitWall(ros::NodeHandle("~").param("start_pause", 0.0), "the start");
    advance(1.5);

    say("the gripper takes hold and pulls");
    const std::uint64_t grasp = takeHold(at(0.82, 0.55, 0.0), 0.04 * size_.z());
    drag(grasp, at(0.95, 0.625, 0.75), 0.35);
    advance(2.7);
    drag(grasp, at(0.75, 0.8, 0.38), 0.35);
    advance(1.8);

    say("a ball goes through");
    throwBall(at(0.27, 0.32, 1.3), 12.0, 0.05 * size_.z());
    advance(1.7);
    std::printf("scene: ready for the picture\n");
    waitWall(ros::NodeHandle("~").param("picture_pause", 3.0), "the picture");

    say("the gripper lets go");
    release(grasp);
    advance(2.0);
    waitUntil([this] { return tearsHeard() >= tears_; }, "word of each tear");
  }

  /// Lets the cloth go on by itself.
  void resume()
  {
    std_srvs::Trigger trigger;
    call("resume", trigger);
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
      std::printf("%s\n", inWords(event).c_str());
    }
  }

  void onStatus(const SimulationStatus& status) { time_step_ = status.time_step; }

  void onSurface(const ClothSurfaceConstPtr& surface) { surface_ = surface; }

  /// Reads the frame, the corner and the size off the untorn cloth.
  void measure()
  {
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < surface_->positions.size() / 3; ++i)
    {
      box.extend(particleOf(*surface_, i));
    }
    frame_id_ = surface_->header.frame_id;
    corner_ = Eigen::Vector3d(box.min().x(), box.center().y(), box.max().z());
    size_ = box.sizes();
  }

  unsigned long long tearsHeard() const { return kinds_[0] + kinds_[1] + kinds_[2] + kinds_[3]; }

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

  /// Takes hold of the particle that is nearest to `place` in x and z, on the viewer's side, and of
  /// those within `radius` [m] or a little more if the mesh is coarse.
  std::uint64_t takeHold(const Eigen::Vector3d& place, double radius)
  {
    waitUntil([this] { return surface_->step == step_; }, "the surface");
    const double spacing = meanSpacing(*surface_);
    Grasp grasp;
    grasp.request.header.frame_id = frame_id_;
    grasp.request.point = toPoint(graspablePoint(place, spacing));
    grasp.request.radius = std::max(radius, GRIPPER_SPACINGS * spacing);
    call("grasp", grasp);
    return grasp.response.grasp_id;
  }

  /// The free particle nearest to `place` as the viewer sees it: of those that lie `spacing` [m]
  /// further or less, the one in front.
  Eigen::Vector3d graspablePoint(const Eigen::Vector3d& place, double spacing) const
  {
    std::set<std::uint32_t> held;
    for (const HeldParticle& particle : surface_->held)
    {
      held.insert(particle.particle);
    }
    std::vector<std::pair<double, Eigen::Vector3d>> free;  // with their distance in x-z
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < surface_->positions.size() / 3; ++i)
    {
      if (held.count(i) == 0)
      {
        const Eigen::Vector3d x = particleOf(*surface_, i);
        const double distance = std::hypot(x.x() - place.x(), x.z() - place.z());
        nearest = std::min(nearest, distance);
        free.emplace_back(distance, x);
      }
    }
    if (free.empty())
    {
      throw std::runtime_error("every particle is pinned, there is nothing to grasp");
    }
    Eigen::Vector3d front = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
    for (const auto& [distance, x] : free)
    {
      front = distance <= nearest + spacing && x.y() < front.y() ? x : front;
    }
    return front;
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
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.005));
    }
  }

  /// Steps the cloth, beat by beat, for `seconds` of simulated time or a fraction of a beat more.
  void advance(double seconds)
  {
    const int beats = static_cast<int>(std::ceil(seconds / BEAT - 1e-9));
    for (int i = 0; i < beats; ++i)
    {
      const ros::WallTime until = ros::WallTime::now() + ros::WallDuration(BEAT);
      Step step;
      step.request.steps = static_cast<std::uint32_t>(std::lround(BEAT / time_step_));
      call("step", step);
      step_ = step.response.step;
      tears_ += step.response.tears;
      waitUntil([&] { return ros::WallTime::now() >= until; }, "the next beat");
    }
  }

  void waitWall(double seconds, const std::string& what)
  {
    const ros::WallTime until = ros::WallTime::now() + ros::WallDuration(seconds);
    waitUntil([&] { return ros::WallTime::now() >= until; }, what);
  }

  static void say(const char* what) { std::printf("scene: %s\n", what); }

  ros::NodeHandle nh_;
  ros::Subscriber events_subscriber_;
  ros::Subscriber status_subscriber_;
  ros::Subscriber surface_subscriber_;
  ClothSurfaceConstPtr surface_;               ///< the newest; null until the node was heard
  std::array<unsigned long long, 4> kinds_{};  ///< tears heard of, by kind
  unsigned long long tears_ = 0;               ///< that the steps made
  std::uint64_t step_ = 0;                     ///< the last one done
  double time_step_ = 0.0;                     ///< [s]; 0 until the node was heard
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
    scene.resume();
    ros::spin();  // the tears that come from now on are printed too
  }
  return scene.torn() ? 0 : 1;
}
