// A recording as a file that only grows.
#pragma once

#include <cstdint>
#include <string>

#include "cloth_tearing/core/recorder.h"

namespace cloth
{

/// What append() has returned from is in the file whatever becomes of the process; of the machine,
/// that is the file system's matter.
class RecordingFile : public RecordSink
{
public:
  /// @param path of a file that is not there yet
  /// @param limit the file never gets longer [byte]
  /// @throws Refusal with the path and why it cannot be made
  RecordingFile(const std::string& path, std::uint64_t limit);
  RecordingFile(const RecordingFile&) = delete;
  RecordingFile& operator=(const RecordingFile&) = delete;
  ~RecordingFile() override;

  /// @throws Refusal with the path and why there is no room; the file is as before then
  void append(const std::string& bytes) override;

private:
  [[noreturn]] void refuseErrno(const std::string& doing) const;

  std::string path_;
  std::uint64_t limit_;
  std::uint64_t size_ = 0;
  int file_;
};

}  // namespace cloth
