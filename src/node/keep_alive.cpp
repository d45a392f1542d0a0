// Knows who holds the cloth only as long as somebody speaks for it, and of whom nothing was heard.
#include "cloth_tearing/node/keep_alive.h"

#include <algorithm>

namespace cloth_tearing
{

void KeepAlive::watch(const Watched& grasp, Time now)
{
  if (empty())
  {
    looked_ = now;
  }
  watched_[grasp.grasp] = { grasp, now };
}

void KeepAlive::hear(std::uint64_t grasp, Time now)
{
  const auto found = watched_.find(grasp);
  if (found != watched_.end())
  {
    found->second.heard = std::max(found->second.heard, now);
  }
}

bool KeepAlive::look(Time now)
{
  const bool lapsed = now - looked_ > LAPSE;
  looked_ = now;
  bool any = false;
  for (auto& [id, entry] : watched_)
  {
    entry.heard = lapsed ? now : entry.heard;
    any = any || silent(entry, now);
  }
  return any;
}

std::vector<KeepAlive::Watched> KeepAlive::takeSilent(Time now)
{
  std::vector<Watched> found;
  for (auto next = watched_.begin(); next != watched_.end();)
  {
    const Entry& entry = next->second;
    const bool is_silent = silent(entry, now);
    if (is_silent)
    {
      found.push_back(entry.grasp);
    }
    next = is_silent ? watched_.erase(next) : std::next(next);
  }
  return found;
}

bool KeepAlive::silent(const Entry& entry, Time now)
{
  return std::chrono::duration<double>(now - entry.heard).count() > entry.grasp.patience;
}

}  // namespace cloth_tearing
