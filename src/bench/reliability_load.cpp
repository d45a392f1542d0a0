// Puts load on a running node and measures it; scripts/reliability starts both.
#include <cloth_tearing/ClothSurface.h>
#include <cloth_tearing/CollisionSpheres.h>
#include <cloth_tearing/SimulationStatus.h>
#include <cloth_tearing/TearEvents.h>
#include <ros/init.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "service_storm.h"

namespace
{

using Clock = std::chrono::steady_clock;

constexpr int CLIENTS = 100;
constexpr int CALLS = 20;             // of each
constexpr double SPHERE_RATE = 10e3;  // [Hz]
constexpr int ROUNDS = 9;
constexpr std::chrono::seconds WINDOW(2);

const char* const USAGE =
    "usage: reliability_load load NODE | spheres NODE PROCESS | listen NODE\n"
    "\n"
    "Puts load on the node of that name and prints what came of it.\n"
    "\n"
    "  load     100 clients make 20 calls each, all at once\n"
    "  spheres  what ~spheres at 10 kHz costs of the step rate, and of the processor time of\n"
    "           the thread that steps, the busiest of that process\n"
    "  listen   listens to ~markers, ~surface and ~tear_events until it is ended\n";

double quantile(const std::vector<double>& ascending, double part)
{
  const double last = static_cast<double>(ascending.size()) - 1.0;
  return ascending.empty() ? 0.0 : ascending[static_cast<std::size_t>(part * last + 0.5)];
}

/// @return exit status: 0 if every call was answered
int load(const std::string& node)
{
  const StormReport report = serviceStorm(node, CLIENTS, CALLS);
  const std::vector<double>& ms = report.milliseconds;
  std::printf("calls %d, answered %d, with success %d, p50 %.1f ms, p99 %.1f ms, max %.1f ms\n",
              report.calls, report.answered, report.served, quantile(ms, 0.5), quantile(ms, 0.99),
              quantile(ms, 1.0));
  return report.answered == report.calls ? 0 : 1;
}

/// Processor time of each thread of a process so far [s].
std::map<std::string, double> threadTimes(const std::string& process)
{
  std::map<std::string, double> times;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/" + process + "/task"))
  {
    std::ifstream file(thread.path() / "schedstat");  // nanoseconds on a processor come first
    double nanoseconds = 0.0;
    if (file >> nanoseconds)
    {
      times[thread.path().filename()] = 1e-9 * nanoseconds;
    }
  }
  return times;
}

/// What the busiest thread used meanwhile [s].
double busiest(const std::map<std::string, double>& before,
               const std::map<std::string, double>& after)
{
  double most = 0.0;
  for (const auto& [thread, time] : after)
  {
    const auto found = before.find(thread);
    most = std::max(most, time - (found != before.end() ? found->second : 0.0));
  }
  return most;
}

struct Rates
{
  double steps = 0.0;     ///< in a second [1/s]
  double per_time = 0.0;  ///< in a second of processor time of the thread that steps [1/s]
};

/// How many steps the node makes, by its ~status.
class StepRate
{
public:
  StepRate(const std::string& node, const std::string& process)
      : process_(process)
      , subscriber_(ros::NodeHandle().subscribe(node + "/status", 100, &StepRate::take, this))
  {
  }

  /// Over a while from now.
  Rates measure(std::chrono::seconds window)
  {
    const Look begin = next();
    const auto before = threadTimes(process_);
    std::this_thread::sleep_for(window);
    const Look end = next();
    const auto after = threadTimes(process_);
    const auto steps = static_cast<double>(end.step - begin.step);
    return { steps / std::chrono::duration<double>(end.at - begin.at).count(),
             steps / busiest(before, after) };
  }

private:
  struct Look
  {
    std::uint64_t step = 0;
    Clock::time_point at;
    int number = 0;
  };

  void take(const cloth_tearing::SimulationStatus& status)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    newest_ = { status.step, Clock::now(), newest_.number + 1 };
  }

  Look newest()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return newest_;
  }

  Look next()
  {
    const int before = newest().number;
    while (ros::ok() && newest().number == before)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return newest();
  }

  std::string process_;
  std::mutex mutex_;
  Look newest_;
  ros::Subscriber subscriber_;  // last: it calls take()
};

/// Publishes a moving sphere off the cloth at SPHERE_RATE while it lives.
class SphereStream
{
public:
  explicit SphereStream(const ros::Publisher& topic) : topic_(topic), thread_([this] { run(); }) {}

  ~SphereStream() { stop(); }

  /// @return how many were published in a second [1/s]
  double stop()
  {
    over_ = true;
    if (thread_.joinable())
    {
      thread_.join();
    }
    return rate_;
  }

private:
  void run()
  {
    const Clock::time_point begin = Clock::now();
    cloth_tearing::CollisionSpheres message;
    message.header.frame_id = "world";
    message.spheres.resize(1);
    message.spheres[0].radius = 0.05;
    std::uint64_t sent = 0;
    for (; !over_; ++sent)
    {
      message.spheres[0].center.y = 1.0 + 1e-6 * static_cast<double>(sent % 1000);
      topic_.publish(message);
      std::this_thread::sleep_until(
          begin + std::chrono::duration_cast<Clock::duration>(
                      std::chrono::duration<double>(static_cast<double>(sent + 1) / SPHERE_RATE)));
    }
    rate_ = static_cast<double>(sent) / std::chrono::duration<double>(Clock::now() - begin).count();
  }

  ros::Publisher topic_;
  std::atomic<bool> over_{ false };
  double rate_ = 0.0;
  std::thread thread_;
};

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return quantile(values, 0.5);
}

void tell(const char* what, double Rates::*rate, const std::vector<Rates>& without,
          const std::vector<Rates>& with)
{
  std::vector<double> values[2];
  for (std::size_t i = 0; i < without.size(); ++i)
  {
    values[0].push_back(without[i].*rate);
    values[1].push_back(with[i].*rate);
  }
  std::printf("%s %.0f without, %.0f with: %.1f %% less; ", what, median(values[0]),
              median(values[1]), 100.0 * (1.0 - median(values[1]) / median(values[0])));
}

int spheres(const std::string& node, const std::string& process)
{
  StepRate rate(node, process);
  const ros::Publisher topic =
      ros::NodeHandle().advertise<cloth_tearing::CollisionSpheres>(node + "/spheres", 1);
  std::vector<Rates> without;
  std::vector<Rates> with;
  std::vector<double> sent;
  for (int round = 0; round < ROUNDS; ++round)
  {
    without.push_back(rate.measure(WINDOW));
    SphereStream stream(topic);
    with.push_back(rate.measure(WINDOW));
    sent.push_back(stream.stop());
  }
  tell("steps in a second", &Rates::steps, without, with);
  tell("in a second of its thread", &Rates::per_time, without, with);
  std::printf("%.0f messages/s\n", median(sent));
  return 0;
}

template <class Message>
void ignore(const Message& /*message*/)
{
}

int listen(const std::string& node)
{
  ros::NodeHandle handle;
  const std::vector<ros::Subscriber> heard = {
    handle.subscribe(node + "/markers", 1, ignore<visualization_msgs::MarkerArray>),
    handle.subscribe(node + "/surface", 1, ignore<cloth_tearing::ClothSurface>),
    handle.subscribe(node + "/tear_events", 1, ignore<cloth_tearing::TearEvents>)
  };
  ros::waitForShutdown();
  return 0;
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc == 2 && std::strcmp(argv[1], "--help") == 0)
  {
    std::fputs(USAGE, stdout);
    return 0;
  }
  ros::init(argc, argv, "reliability_load", ros::init_options::AnonymousName);
  const std::vector<std::string> words(argv + 1, argv + argc);
  const std::string what = words.empty() ? "" : words[0];
  if (words.size() != (what == "spheres" ? 3u : 2u) ||
      (what != "load" && what != "spheres" && what != "listen"))
  {
    std::fputs(USAGE, stderr);
    return 2;
  }
  ros::NodeHandle handle;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return what == "load"      ? load(words[1])
         : what == "spheres" ? spheres(words[1], words[2])
                             : listen(words[1]);
}
