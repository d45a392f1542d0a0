// Calls services for a window, which must not wait for them.
#include "cloth_tearing/rviz/service_caller.h"

#include <QMetaObject>

namespace cloth_tearing
{

namespace
{

constexpr double PATIENCE = 2.0;  // with an answer, before it is told [s]

}  // namespace

ServiceCaller::ServiceCaller() : thread_([this] { work(); })
{
}

ServiceCaller::~ServiceCaller()
{
  {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_until(lock, end_.value_or(Clock::now() + LAST_PATIENCE),
                        [this] { return waiting_.empty() && !busy_; });
    ending_ = true;
    cutAll();
    changed_.notify_all();
  }
  thread_.join();
}

void ServiceCaller::cut()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  cutAll();
}

/// With mutex_ locked.
void ServiceCaller::cutAll()
{
  ++cuts_;
  waiting_.clear();
  if (calling_)
  {
    under_way_.shutdown();
  }
}

double ServiceCaller::waiting() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return busy_ ? std::chrono::duration<double>(Clock::now() - since_).count() : 0.0;
}

std::string ServiceCaller::waitingFor(const std::string& node) const
{
  const double seconds = waiting();
  return seconds > PATIENCE
             ? node + " has not answered for " + std::to_string(static_cast<int>(seconds)) + " s"
             : std::string();
}

void ServiceCaller::enqueue(Task task)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_.push_back(std::move(task));
  changed_.notify_all();
}

void ServiceCaller::work()
{
  std::unique_lock<std::mutex> lock(mutex_);
  while (true)
  {
    changed_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    if (ending_)
    {
      return;
    }
    Task task = std::move(waiting_.front());
    const Turn turn = cuts_;
    waiting_.pop_front();
    busy_ = true;
    since_ = Clock::now();
    lock.unlock();
    task(turn);
    task = nullptr;  // what it holds may take long to let go
    lock.lock();
    busy_ = false;
    changed_.notify_all();
  }
}

/// @return false: it is too late to call
bool ServiceCaller::begin(Turn turn, const ros::ServiceClient& client)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  under_way_ = client;
  calling_ = turn == cuts_;
  return calling_;
}

void ServiceCaller::end()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  calling_ = false;
  under_way_ = ros::ServiceClient();
}

void ServiceCaller::deliver(Turn turn, std::function<void()> tell)
{
  const auto unless_cut = [this, turn, tell = std::move(tell)]
  {
    if (isOf(turn))
    {
      tell();
    }
  };
  QMetaObject::invokeMethod(this, unless_cut, Qt::QueuedConnection);
}

/// Whether there was no cut since.
bool ServiceCaller::isOf(Turn turn) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return turn == cuts_;
}

}  // namespace cloth_tearing
