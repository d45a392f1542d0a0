// Calls services for a window, which must not wait for them.
#include "cloth_tearing/rviz/service_caller.h"

#include <QMetaObject>

namespace cloth_tearing
{

namespace
{

constexpr std::chrono::seconds LAST_CALLS{ 1 };  // for what is to be said before the end

}  // namespace

ServiceCaller::ServiceCaller() : thread_([this] { run(); })
{
}

ServiceCaller::~ServiceCaller()
{
  {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, LAST_CALLS, [this] { return waiting_.empty() && !busy_; });
    ending_ = true;
    waiting_.clear();
    if (calling_)
    {
      under_way_.shutdown();
    }
    changed_.notify_all();
  }
  thread_.join();
}

double ServiceCaller::waiting() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return busy_ ? std::chrono::duration<double>(Clock::now() - since_).count() : 0.0;
}

void ServiceCaller::enqueue(Work work)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_.push_back(std::move(work));
  changed_.notify_all();
}

void ServiceCaller::run()
{
  std::unique_lock<std::mutex> lock(mutex_);
  while (true)
  {
    changed_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    if (ending_)
    {
      return;
    }
    const Work work = std::move(waiting_.front());
    waiting_.pop_front();
    busy_ = true;
    since_ = Clock::now();
    lock.unlock();
    work();
    lock.lock();
    busy_ = false;
    changed_.notify_all();
  }
}

/// @return false: it is too late to call
bool ServiceCaller::begin(const ros::ServiceClient& client)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  under_way_ = client;
  calling_ = !ending_;
  return calling_;
}

void ServiceCaller::end()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  calling_ = false;
  under_way_ = ros::ServiceClient();
}

void ServiceCaller::deliver(Work tell)
{
  QMetaObject::invokeMethod(this, std::move(tell), Qt::QueuedConnection);
}

}  // namespace cloth_tearing
