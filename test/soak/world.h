// What all users of a soaked node share: what they know of the cloth, and what came of their calls.
#pragma once

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "message_checks.h"

namespace soak
{

constexpr double PATIENCE = 20.0;  ///< with an answer or an end, on a busy machine [s]

/// What a request has to be answered with.
enum class Expect
{
  SUCCESS,
  REFUSAL,
  EITHER,  ///< it depends on what the others do
};

/// All members may be called from any thread.
class World
{
public:
  /// @param node the cloth's name
  explicit World(const std::string& node) : node_(node) {}

  const std::string& node() const { return node_; }

  bool isOver() const;
  void end();

  /// Waits until the end or for so long. @return whether it is not the end
  bool pause(std::chrono::duration<double> time) const;

  /// Adds a failure of the test, of each kind the first few times only.
  void fail(const std::string& kind, const std::string& what);

  /// Counts something that went as it should.
  void count(const std::string& what, std::uint64_t times = 1);
  std::map<std::string, std::uint64_t> counts() const;

  /// Fails with everything that is wrong with `message` by itself.
  template <class Message>
  void check(const std::string& name, const Message& message)
  {
    for (const std::string& problem : problems(message))
    {
      fail(name, problem);
    }
  }

  /// Calls a service that has `success` and `message`, on a connection of its own, and looks at the
  /// answer.
  template <class Service>
  typename Service::Response ask(const std::string& name,
                                 const typename Service::Request& request = {},
                                 Expect expected = Expect::EITHER)
  {
    Service call;
    call.request = request;
    if (!callTwice(name, call))
    {
      fail(name, "was not answered");
      return {};
    }
    const bool success = call.response.success != 0;
    const std::string& words = call.response.message;
    if (!success && words.empty())
    {
      fail(name, "is refused without a reason");
    }
    const bool busy = words.compare(0, 5, "busy:") == 0;  // so may the machine be
    if (!success && !busy && expected == Expect::SUCCESS)
    {
      fail(name, "is refused: " + words);
    }
    if (success && expected == Expect::REFUSAL)
    {
      fail(name, "is accepted though it is wrong");
    }
    check(name, call.response);
    count(name + (success ? " done" : busy ? " refused as busy" : " refused"));
    return call.response;
  }

  /// Where particles are, by the newest ~surface.
  void showCloth(const cloth_tearing::ClothSurface& surface);
  geometry_msgs::Point particle(std::uint32_t id) const;
  std::uint32_t particles() const;

  /// Grasps that there are, by the newest ~grasp_states.
  void showGrasps(const cloth_tearing::GraspStates& states);
  std::vector<std::uint64_t> grasps() const;

  /// Calls again if there is no answer: asking the master and connecting may fail without the node
  /// having heard of it.
  template <class Service>
  bool callTwice(const std::string& name, Service& call)
  {
    if (ros::service::call(node_ + "/" + name, call))
    {
      return true;
    }
    count("calls made again");
    return ros::service::call(node_ + "/" + name, call);
  }

private:
  std::string node_;
  mutable std::mutex mutex_;  // guards what follows
  mutable std::condition_variable ended_;
  bool over_ = false;
  std::map<std::string, int> failures_;
  std::map<std::string, std::uint64_t> counts_;
  cloth_tearing::ClothSurface surface_;
  std::vector<std::uint64_t> grasps_;
};

}  // namespace soak
