// Writes a temporary file, then gives it its name.
#include "cloth_tearing/node/whole_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "cloth_tearing/core/refusal.h"

namespace cloth_tearing
{

namespace
{

[[noreturn]] void refuseErrno(const std::string& doing, const std::string& path)
{
  const int error = errno;
  throw cloth::Refusal("cannot " + doing + " " + path + ": " +
                       std::generic_category().message(error));
}

[[noreturn]] void refuseExisting(const std::string& path)
{
  throw cloth::Refusal(path + " exists already, and is not to be replaced");
}

/// A file that is there as long as this is.
class TemporaryFile
{
public:
  explicit TemporaryFile(const std::string& target)
      : path_(besides(target))
      , number_(open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666))
  {
    if (number_ < 0)
    {
      refuseErrno("write", target);
    }
  }
  ~TemporaryFile()
  {
    close();
    unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }

  /// @return whether all is on the disk; errno says why not
  bool write(const std::string& bytes)
  {
    std::size_t written = 0;
    while (written < bytes.size())
    {
      const ssize_t more = ::write(number_, bytes.data() + written, bytes.size() - written);
      if (more < 0 && errno != EINTR)
      {
        return false;
      }
      written += static_cast<std::size_t>(std::max<ssize_t>(0, more));
    }
    return fsync(number_) == 0 && close();
  }

private:
  static std::string besides(const std::string& target)
  {
    static std::atomic<unsigned> count{ 0 };
    const std::filesystem::path path(target);
    const std::string name = "." + path.filename().string() + "." + std::to_string(getpid()) + "." +
                             std::to_string(++count);
    return (path.parent_path() / name).string();
  }

  /// @return whether all went well, which some file systems tell only now
  bool close()
  {
    const int number = std::exchange(number_, -1);
    return number < 0 || ::close(number) == 0;
  }

  std::string path_;
  int number_;
};

/// Makes sure that the folder of `path` knows it, whatever happens to the machine.
void settleFolder(const std::string& path)
{
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const int number = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool settled = number >= 0 && fsync(number) == 0;
  const int error = errno;
  if (number >= 0)
  {
    close(number);
  }
  if (!settled)
  {
    errno = error;
    refuseErrno("be sure of", path);
  }
}

}  // namespace

void writeWholeFile(const std::string& path, Existing existing, const std::string& bytes)
{
  std::error_code unreadable;
  if (existing == Existing::KEEP && std::filesystem::exists(path, unreadable))
  {
    refuseExisting(path);
  }
  TemporaryFile file(path);
  if (!file.write(bytes))
  {
    refuseErrno("write", path);
  }
  const bool replace = existing == Existing::REPLACE;
  if ((replace ? rename(file.path().c_str(), path.c_str())
               : link(file.path().c_str(), path.c_str())) != 0)
  {
    if (errno == EEXIST && !replace)  // somebody was faster
    {
      refuseExisting(path);
    }
    refuseErrno("write", path);
  }
  settleFolder(path);
}

}  // namespace cloth_tearing
