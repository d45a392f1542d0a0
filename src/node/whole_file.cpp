// Writes a temporary file, then gives it its name; reads a regular file to its end.
#include "cloth_tearing/node/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
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
  const File file(folder, O_RDONLY | O_DIRECTORY);
  if (!file.isOpen() || fsync(file.number()) != 0)
  {
    refuseErrno("be sure of", path);
  }
}

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

std::string readWholeFile(const std::string& path, const std::function<void(std::uint64_t)>& judge)
{
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
  judge(static_cast<std::uint64_t>(status.st_size));
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  if (!readAll(file.number(), bytes))
  {
    refuseErrno("read", path);
  }
  return bytes;
}

}  // namespace cloth_tearing
