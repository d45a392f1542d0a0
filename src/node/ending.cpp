// Takes the signals that end a process, and sees to it that it does end.
#include "cloth_tearing/node/ending.h"

#include <unistd.h>

#include <cstdio>
#include <ctime>

namespace cloth_tearing
{

namespace
{

constexpr timespec MOMENT = { 0, 50000000 };

}  // namespace

Ending::Ending(std::chrono::milliseconds patience) : patience_(patience)
{
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  thread_ = std::thread([this] { run(); });
}

Ending::~Ending()
{
  over_ = true;
  thread_.join();
}

void Ending::begin()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  begun_ = true;
  wake_.notify_all();
}

bool Ending::waitFor(std::chrono::milliseconds while_)
{
  std::unique_lock<std::mutex> lock(mutex_);
  return wake_.wait_for(lock, while_, [this] { return begun_.load(); });
}

void Ending::run()
{
  while (!over_ && !begun_)
  {
    if (sigtimedwait(&signals_, nullptr, &MOMENT) > 0)
    {
      begin();
    }
  }
  const Clock::time_point end = Clock::now() + patience_;
  while (!over_ && Clock::now() < end)
  {
    nanosleep(&MOMENT, nullptr);
  }
  if (!over_)
  {
    std::fputs(
        "The end takes too long, probably for a master that does not answer: ended without "
        "taking leave of it\n",
        stderr);
    _exit(0);
  }
}

}  // namespace cloth_tearing
