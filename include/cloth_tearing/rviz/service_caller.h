// Calls services for a window, which must not wait for them.
#pragma once

#ifndef Q_MOC_RUN
#include <ros/node_handle.h>
#include <ros/service_client.h>

#include <QObject>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#endif

namespace cloth_tearing
{

/// Makes calls one after the other on a thread of its own and hands their answers to the thread
/// that it was made in, between the events of that thread. All members are for that thread.
class ServiceCaller : public QObject
{
public:
  /// What came of a call.
  template <class Response>
  struct Answer
  {
    std::string problem;  ///< why it was not done, in words; empty = done
    Response response;    ///< as far as there is one

    bool done() const { return problem.empty(); }
  };

  template <class Service>
  using Callback = std::function<void(const Answer<typename Service::Response>&)>;

  /// With calls that are left at the end.
  static constexpr std::chrono::seconds LAST_PATIENCE{ 1 };

  ServiceCaller();

  /// Lets calls that are left be done for LAST_PATIENCE, or as finishBy() says; cuts the rest
  /// short. Nobody is told any more.
  ~ServiceCaller() override;

  /// Until when the destructor waits for what is left. Several that are told the same time before
  /// the first of them is destroyed take no longer than one.
  void finishBy(std::chrono::steady_clock::time_point end) { end_ = end; }

  ServiceCaller(const ServiceCaller&) = delete;
  ServiceCaller& operator=(const ServiceCaller&) = delete;

  /// Calls `name` when its turn has come, and then `callback`, which outlives nobody: it is not
  /// called once this object is gone. Answers with `success` false count as not done, with their
  /// `message` for the reason.
  template <class Service>
  void call(const std::string& name, const typename Service::Request& request,
            Callback<Service> callback)
  {
    enqueue(
        [this, name, request, callback](Turn turn)
        {
          Answer<typename Service::Response> answer;
          answer.problem = transact<Service>(turn, name, request, answer.response);
          deliver(turn, [callback, answer] { callback(answer); });
        });
  }

  /// Does `work()` when its turn has come, and then `callback` with what it returned: for what else
  /// would make a window wait. It cannot be cut short.
  template <class Work, class Callback>
  void run(Work work, Callback callback)
  {
    enqueue([this, work, callback](Turn turn)
            { deliver(turn, [callback, result = work()] { callback(result); }); });
  }

  /// Gives up what waits and cuts short the call that is under way; nobody is told any more.
  void cut();

  /// For how long the call under way has been waiting for its answer [s]; 0 = none is under way.
  double waiting() const;

  /// "/cloth has not answered for 3 s"; empty as long as that is not worth telling.
  std::string waitingFor(const std::string& node) const;

private:
  using Clock = std::chrono::steady_clock;
  using Turn = std::uint64_t;  ///< how often there had been a cut when it came
  using Task = std::function<void(Turn)>;

  template <class Service>
  std::string transact(Turn turn, const std::string& name, const typename Service::Request& request,
                       typename Service::Response& response)
  {
    ros::NodeHandle node;
    // Only a lasting connection can be cut while somebody waits for the answer.
    ros::ServiceClient client = node.serviceClient<Service>(name, true);
    if (!client.isValid())
    {
      return "there is no service " + node.resolveName(name) + ": its node is not running";
    }
    if (!begin(turn, client))
    {
      return "ended";
    }
    typename Service::Request sent = request;
    const bool answered = client.call(sent, response);
    end();
    return answered ? refusalIn(response, 0) : node.resolveName(name) + " was not answered";
  }

  template <class Response>
  static auto refusalIn(const Response& response, int) -> decltype(response.success, std::string())
  {
    return response.success ? std::string() : std::string(response.message);
  }

  /// Of answers that cannot say no.
  template <class Response>
  static std::string refusalIn(const Response& /*response*/, long)
  {
    return {};
  }

  void enqueue(Task task);
  void work();
  bool begin(Turn turn, const ros::ServiceClient& client);
  void end();
  void deliver(Turn turn, std::function<void()> tell);
  void cutAll();
  bool isOf(Turn turn) const;

  std::optional<Clock::time_point> end_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Task> waiting_;  ///< guarded by mutex_, as is what follows
  Turn cuts_ = 0;
  ros::ServiceClient under_way_;
  bool calling_ = false;
  bool busy_ = false;  ///< with one that was taken off the queue
  Clock::time_point since_;
  bool ending_ = false;

  std::thread thread_;  ///< last: it starts when everything else is there
};

}  // namespace cloth_tearing
