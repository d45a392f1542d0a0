// Many clients that call the node's services at the same time.
#include "service_storm.h"

#include <cloth_tearing/GetTearEvents.h>
#include <cloth_tearing/Grasp.h>
#include <cloth_tearing/Release.h>
#include <cloth_tearing/Step.h>
#include <ros/node_handle.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <thread>

namespace
{

using cloth_tearing::GetTearEvents;
using cloth_tearing::Grasp;
using cloth_tearing::Release;
using cloth_tearing::Step;

/// One of the clients, on a thread of its own.
class Client
{
public:
  Client(const std::string& node, int number)
      : number_(number)
      , grasp_(handle_.serviceClient<Grasp>(node + "/grasp", true))
      , release_(handle_.serviceClient<Release>(node + "/release", true))
      , events_(handle_.serviceClient<GetTearEvents>(node + "/get_tear_events", true))
      , step_(handle_.serviceClient<Step>(node + "/step", true))
  {
  }

  void call(int calls)
  {
    for (int i = 0; i < calls; ++i)
    {
      switch (i % 4)
      {
        case 0:
          grasp();
          break;
        case 1:
          release();
          break;
        case 2:
          measure(events_, newestEvents());
          break;
        default:
          measure(step_, Step());
          break;
      }
    }
  }

  const StormReport& report() const { return report_; }

private:
  template <class Service>
  Service measure(ros::ServiceClient& client, Service service)
  {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    const bool answered = client.call(service);
    ++report_.calls;
    if (answered)
    {
      ++report_.answered;
      report_.served += service.response.success ? 1 : 0;
      report_.milliseconds.push_back(
          std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
    }
    return service;
  }

  void grasp()
  {
    Grasp wish;
    wish.request.header.frame_id = "world";
    wish.request.point.x = -0.45 + 0.1 * (number_ % 10);
    wish.request.point.z = 0.65 + 0.07 * (number_ / 10 % 10);
    wish.request.radius = 0.04;
    held_ = measure(grasp_, wish).response.grasp_id;
  }

  /// Of its own grasp; that of a grasp that there is not is refused, since 0 would mean all.
  void release()
  {
    Release wish;
    wish.request.grasp_id = held_ != 0 ? held_ : ~std::uint64_t{ 0 };
    measure(release_, wish);
  }

  static GetTearEvents newestEvents()
  {
    GetTearEvents wish;
    wish.request.max_count = 100;
    return wish;
  }

  int number_;
  std::uint64_t held_ = 0;
  StormReport report_;
  ros::NodeHandle handle_;
  ros::ServiceClient grasp_;
  ros::ServiceClient release_;
  ros::ServiceClient events_;
  ros::ServiceClient step_;
};

}  // namespace

StormReport serviceStorm(const std::string& node, int clients, int calls)
{
  std::vector<std::unique_ptr<Client>> all;
  for (int i = 0; i < clients; ++i)
  {
    all.push_back(std::make_unique<Client>(node, i));
  }
  std::vector<std::thread> threads;
  for (const auto& client : all)
  {
    threads.emplace_back([&client, calls] { client->call(calls); });
  }
  StormReport sum;
  for (int i = 0; i < clients; ++i)
  {
    threads[static_cast<std::size_t>(i)].join();
    const StormReport& one = all[static_cast<std::size_t>(i)]->report();
    sum.calls += one.calls;
    sum.answered += one.answered;
    sum.served += one.served;
    sum.milliseconds.insert(sum.milliseconds.end(), one.milliseconds.begin(),
                            one.milliseconds.end());
  }
  std::sort(sum.milliseconds.begin(), sum.milliseconds.end());
  return sum;
}
