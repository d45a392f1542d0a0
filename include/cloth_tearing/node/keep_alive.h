// Knows who holds the cloth only as long as somebody speaks for it, and of whom nothing was heard.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <vector>

namespace cloth_tearing
{

/// Watches grasps by times that it is given, of a clock that never goes back. Knows no threads.
class KeepAlive
{
public:
  using Time = std::chrono::steady_clock::time_point;

  struct Watched
  {
    std::uint64_t grasp = 0;
    std::uint32_t epoch = 0;  ///< in which it was taken: in another one it is none of these
    double patience = 0.0;    ///< with its silence [s]
  };

  /// Without a look for so long nobody was listened to either: all silence begins anew.
  static constexpr std::chrono::milliseconds LAPSE{ 500 };

  bool empty() const { return watched_.empty(); }

  /// From now on, as if it were heard of now.
  void watch(const Watched& grasp, Time now);

  /// Somebody speaks for a grasp, watched or not.
  void hear(std::uint64_t grasp, Time now);

  void forget(std::uint64_t grasp) { watched_.erase(grasp); }
  void forgetAll() { watched_.clear(); }

  /// To be called again and again. @return whether anybody was silent for too long
  bool look(Time now);

  /// Nobody could look until now, but all were listened to.
  void skip(Time now) { looked_ = now; }

  /// Forgets all who were silent for too long. @return who they were, by their numbers
  std::vector<Watched> takeSilent(Time now);

private:
  struct Entry
  {
    Watched grasp;
    Time heard;
  };

  static bool silent(const Entry& entry, Time now);

  std::map<std::uint64_t, Entry> watched_;  ///< by the grasp
  Time looked_;
};

}  // namespace cloth_tearing
