// Keeps states in memory and writes them to files.
#include "cloth_tearing/node/state_store.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/node/file_names.h"
#include "cloth_tearing/node/whole_file.h"

namespace cloth_tearing
{

namespace
{

constexpr const char* EXTENSION = ".cloth";
constexpr double MEGABYTE = 1e6;

void refuseLarge(std::uint64_t bytes, std::uint64_t most, const std::string& what)
{
  if (bytes > most)
  {
    throw cloth::Refusal(what + " would take " + cloth::text(double(bytes) / MEGABYTE) +
                         " MB, max_state_memory is " + cloth::text(double(most) / MEGABYTE) +
                         " MB");
  }
}

}  // namespace

std::vector<std::string> problems(const StateStoreParams& params)
{
  std::vector<std::string> found;
  if (!params.folder.empty() && params.folder.front() != '/')
  {
    found.push_back("state_folder is \"" + params.folder + "\", must be an absolute path or empty");
  }
  check(found, "max_states", params.max_states, cloth::Range::between(1, cloth::MAX_STATES));
  check(found, "max_state_memory [MB]", params.max_state_memory,
        cloth::Range::between(1.0, cloth::MAX_STATE_FILE));
  return found;
}

std::uint64_t StateStore::mostBytes() const
{
  return static_cast<std::uint64_t>(MEGABYTE * params_.max_state_memory);
}

void StateStore::keep(const std::string& name, std::string bytes)
{
  cloth::refuseIf(nameProblems(name));
  const auto state = std::make_shared<const std::string>(std::move(bytes));
  const std::lock_guard<std::mutex> lock(mutex_);
  std::uint64_t all = state->size();
  std::size_t count = 1;
  for (const auto& other : kept_)
  {
    if (other.first != name)
    {
      all += other.second->size();
      ++count;
    }
  }
  if (count > static_cast<std::size_t>(params_.max_states))
  {
    throw cloth::Refusal("there are " + std::to_string(count - 1) + " states, max_states is " +
                         std::to_string(params_.max_states));
  }
  refuseLarge(all, mostBytes(), "all states together");
  kept_[name] = state;
}

StateStore::Bytes StateStore::kept(const std::string& name) const
{
  cloth::refuseIf(nameProblems(name));
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = kept_.find(name);
  if (found == kept_.end())
  {
    throw cloth::Refusal("there is no state \"" + name + "\" in memory");
  }
  return found->second;
}

std::string StateStore::pathOf(const std::string& name) const
{
  cloth::refuseIf(nameProblems(name));
  if (params_.folder.empty())
  {
    throw cloth::Refusal("there are no files of states: state_folder is empty");
  }
  return params_.folder + "/" + name + EXTENSION;
}

void StateStore::write(const std::string& name, const std::string& bytes) const
{
  const std::string path = pathOf(name);
  refuseLarge(bytes.size(), mostBytes(), path);
  std::error_code error;
  std::filesystem::create_directories(params_.folder, error);
  if (error)
  {
    throw cloth::Refusal("cannot make the folder " + params_.folder + ": " + error.message());
  }
  writeWholeFile(path, Existing::REPLACE, bytes);
}

StateStore::Bytes StateStore::read(const std::string& name) const
{
  const std::string path = pathOf(name);
  return std::make_shared<const std::string>(
      readWholeFile(path, [&](std::uint64_t size) { refuseLarge(size, mostBytes(), path); }));
}

}  // namespace cloth_tearing
