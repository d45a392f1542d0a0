// Appends to a file, all or nothing.
#include "cloth_tearing/core/recording_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "cloth_tearing/core/refusal.h"

namespace cloth
{
namespace
{

/// @return whether all is written; errno says why not
bool writeAll(int file, const std::string& bytes)
{
  std::size_t written = 0;
  while (written < bytes.size())
  {
    const ssize_t more = ::write(file, bytes.data() + written, bytes.size() - written);
    if (more < 0 && errno != EINTR)
    {
      return false;
    }
    written += static_cast<std::size_t>(std::max<ssize_t>(0, more));
  }
  return true;
}

}  // namespace

RecordingFile::RecordingFile(const std::string& path, std::uint64_t limit)
    : path_(path)
    , limit_(limit)
    , file_(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666))
{
  if (file_ < 0)
  {
    refuseErrno("make");
  }
}

RecordingFile::~RecordingFile()
{
  close(file_);
}

void RecordingFile::append(const std::string& bytes)
{
  if (bytes.size() > limit_ - size_)
  {
    throw Refusal("the recording " + path_ + " has " + std::to_string(size_) +
                  " bytes, must not have more than " + std::to_string(limit_));
  }
  if (!writeAll(file_, bytes))
  {
    const int error = errno;
    // (Nothing can be done if this fails, too: the reader finds the last whole record.)
    static_cast<void>(!ftruncate(file_, static_cast<off_t>(size_)));
    errno = error;
    refuseErrno("write");
  }
  size_ += bytes.size();
}

void RecordingFile::refuseErrno(const std::string& doing) const
{
  const int error = errno;
  throw Refusal("cannot " + doing + " the recording " + path_ + ": " +
                std::generic_category().message(error));
}

}  // namespace cloth
