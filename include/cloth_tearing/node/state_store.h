// Saved states under names: in memory, or as files of one folder.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace cloth_tearing
{

struct StateStoreParams
{
  std::string folder;               ///< of the files, an absolute path; empty = there are no files
  int max_states = 100;             ///< in memory, 1 to 10000
  double max_state_memory = 500.0;  ///< for all of them, and the most for a file [MB], 1 to 100000
};

/// Everything wrong with `params`, one sentence each, naming the parameter.
std::vector<std::string> problems(const StateStoreParams& params);

/// Knows nothing of what it keeps. All members may be called from any thread; all refuse names
/// other than of letters, digits, '_', '-' and '.', at most 64, not beginning with '.', which are
/// names of files in one folder on any system.
class StateStore
{
public:
  using Bytes = std::shared_ptr<const std::string>;

  explicit StateStore(const StateStoreParams& params) : params_(params) {}

  /// Keeps `bytes` in memory, in place of what had the name before.
  /// @throws Refusal naming the limit that does not allow it
  void keep(const std::string& name, std::string bytes);

  /// @throws Refusal if nothing has the name
  Bytes kept(const std::string& name) const;

  /// Whether there is a folder of files.
  bool hasFiles() const { return !params_.folder.empty(); }

  /// Writes `bytes` to the file of the name, in place of the one before: whoever reads it, and
  /// whatever happens meanwhile, finds one or the other, never a part. The folder is made if it is
  /// missing.
  /// @throws Refusal with the path and what is wrong
  void write(const std::string& name, const std::string& bytes) const;

  /// @throws Refusal with the path and what is wrong
  Bytes read(const std::string& name) const;

private:
  std::string pathOf(const std::string& name) const;
  std::uint64_t mostBytes() const;

  StateStoreParams params_;
  mutable std::mutex mutex_;           // guards what follows
  std::map<std::string, Bytes> kept_;  ///< by name
};

}  // namespace cloth_tearing
