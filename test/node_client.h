// What tests of a running node share: calls that must be answered, and messages waited for.
#pragma once

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

/// No wait takes longer; a busy machine may need some of it.
constexpr double PATIENCE = 20.0;  // [s]

/// Calls a service that has to be answered, whatever the answer.
template <class Service>
typename Service::Response ask(const std::string& name,
                               const typename Service::Request& request = {})
{
  Service call;
  call.request = request;
  EXPECT_TRUE(ros::service::waitForService(name, ros::Duration(PATIENCE))) << name;
  EXPECT_TRUE(ros::service::call(name, call)) << name << ": a refusal is an answer, too";
  return call.response;
}

/// Asks until `ready()` says yes. @return whether it did in time
template <class Ready>
bool isSoon(Ready ready)
{
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(PATIENCE);
  while (!ready())
  {
    if (ros::WallTime::now() > deadline)
    {
      return false;
    }
    std::this_thread::yield();
  }
  return true;
}

/// Keeps all messages of a topic. Needs a spinner.
template <class Message>
class Collector
{
public:
  using Condition = std::function<bool(const Message&)>;

  explicit Collector(const std::string& topic)
      : subscriber_(ros::NodeHandle().subscribe(topic, 1000, &Collector::take, this))
  {
  }

  /// Waits for a message, old or new, that fulfils `condition`, and returns it.
  /// Adds a failure that names `what` if there is none in time.
  Message waitFor(const std::string& what, const Condition& condition)
  {
    std::unique_lock<std::mutex> lock(mutex_);
    std::size_t seen = 0;
    Message found;
    const auto fulfilled = [&]
    {
      for (; seen < messages_.size(); ++seen)
      {
        if (condition(messages_[seen]))
        {
          found = messages_[seen];
          return true;
        }
      }
      return false;
    };
    EXPECT_TRUE(changed_.wait_for(lock, std::chrono::duration<double>(PATIENCE), fulfilled))
        << "no message in time: " << what;
    return found;
  }

  /// The first message there was.
  Message first()
  {
    return waitFor("any", [](const Message&) { return true; });
  }

  std::uint32_t publishers() const { return subscriber_.getNumPublishers(); }

  std::vector<Message> all()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_;
  }

private:
  void take(const Message& message)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    messages_.push_back(message);
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Message> messages_;
  ros::Subscriber subscriber_;  // last: it calls take()
};
