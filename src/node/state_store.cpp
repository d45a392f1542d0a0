// Keeps states in memory and writes them to files.
#include "cloth_tearing/node/state_store.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
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

[[noreturn]] void refuseErrno(const std::string& doing, const std::string& path)
{
  const int error = errno;
  throw cloth::Refusal("cannot " + doing + " " + path + ": " +
                       std::generic_category().message(error));
}

/// A file descriptor, closed in the end.
class File
{
public:
  File(const std::string& path, int flags) : number_(open(path.c_str(), flags | O_CLOEXEC)) {}
  ~File()
  {
    if (number_ >= 0)
    {
      ::close(number_);
    }
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  bool isOpen() const { return number_ >= 0; }
  int number() const { return number_; }

private:
  int number_;
};

/// @return whether all of `bytes` was there; errno says why not
bool readAll(int file, std::string& bytes)
{
  std::size_t taken = 0;
  while (taken < bytes.size())
  {
    const ssize_t more = ::read(file, &bytes[taken], bytes.size() - taken);
    if (more == 0)
    {
      errno = ENODATA;  // somebody has cut it off meanwhile
      return false;
    }
    if (more < 0 && errno != EINTR)
    {
      return false;
    }
    taken += static_cast<std::size_t>(std::max<ssize_t>(0, more));
  }
  return true;
}

}  // namespace

std::vector<std::string> problems(const StateStoreParams& params)
{
  std::vector<std::string> found;
  if (!params.folder.empty() && params.folder.front() != '/')
  {
    found.push_back("state_folder is \"" + params.folder + "\", must be an absolute path or empty");
  }
  check(found, "max_states", params.max_states, cloth::Range::between(1, 10000));
  check(found, "max_state_memory [MB]", params.max_state_memory,
        cloth::Range::between(1.0, 100000.0));
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
  const File file(path, O_RDONLY | O_NONBLOCK);  // of a pipe nobody knows when it is there
  struct stat status = {};
  if (!file.isOpen() || ::fstat(file.number(), &status) != 0)
  {
    refuseErrno("read", path);
  }
  if (!S_ISREG(status.st_mode))
  {
    throw cloth::Refusal("cannot read " + path + ": it is no file");
  }
  refuseLarge(static_cast<std::uint64_t>(status.st_size), mostBytes(), path);
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  if (!readAll(file.number(), bytes))
  {
    refuseErrno("read", path);
  }
  return std::make_shared<const std::string>(std::move(bytes));
}

}  // namespace cloth_tearing
