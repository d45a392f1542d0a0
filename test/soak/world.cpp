// What all users of a soaked node share: what they know of the cloth, and what came of their calls.
#include "world.h"

namespace soak
{

namespace
{

constexpr int MOST_FAILURES = 5;  // of a kind that are told

}  // namespace

bool World::isOver() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return over_;
}

void World::end()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  over_ = true;
  ended_.notify_all();
}

bool World::pause(std::chrono::duration<double> time) const
{
  std::unique_lock<std::mutex> lock(mutex_);
  return !ended_.wait_for(lock, time, [this] { return over_; });
}

void World::fail(const std::string& kind, const std::string& what)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (++failures_[kind] <= MOST_FAILURES)
  {
    ADD_FAILURE() << kind << ": " << what;
  }
  ++counts_[kind + " FAILED"];
}

void World::count(const std::string& what, std::uint64_t times)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  counts_[what] += times;
}

std::map<std::string, std::uint64_t> World::counts() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return counts_;
}

void World::showCloth(const cloth_tearing::ClothSurface& surface)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  surface_ = surface;
}

geometry_msgs::Point World::particle(std::uint32_t id) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  geometry_msgs::Point point = surface_.origin;
  if (3 * std::size_t{ id } + 2 < surface_.positions.size())
  {
    point.x += surface_.positions[3 * id];
    point.y += surface_.positions[3 * id + 1];
    point.z += surface_.positions[3 * id + 2];
  }
  return point;
}

std::uint32_t World::particles() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return static_cast<std::uint32_t>(surface_.positions.size() / 3);
}

void World::showGrasps(const cloth_tearing::GraspStates& states)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  grasps_.clear();
  for (const cloth_tearing::GraspState& grasp : states.grasps)
  {
    grasps_.push_back(grasp.grasp_id);
  }
}

std::vector<std::uint64_t> World::grasps() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return grasps_;
}

}  // namespace soak
