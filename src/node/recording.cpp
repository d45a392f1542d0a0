// Finds a name for a recording and opens it.
#include "cloth_tearing/node/recording.h"

#include <unistd.h>

#include <ctime>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/limits.h"
#include "cloth_tearing/core/recording_file.h"
#include "cloth_tearing/core/refusal.h"

namespace cloth_tearing
{

namespace
{

constexpr const char* EXTENSION = ".clothrec";
constexpr double MEGABYTE = 1e6;

/// Local time and the process tell runs apart, a number those of one process within a second.
std::string freePath(const std::string& folder)
{
  const std::time_t now = std::time(nullptr);
  std::tm local = {};
  localtime_r(&now, &local);
  char time[32];
  std::strftime(time, sizeof time, "%Y-%m-%d-%H-%M-%S", &local);
  const std::string begin = folder + "/cloth_" + time + "_" + std::to_string(getpid());
  std::string path = begin + EXTENSION;
  for (int i = 2; std::filesystem::exists(path); ++i)
  {
    path = begin + "_" + std::to_string(i) + EXTENSION;
  }
  return path;
}

}  // namespace

std::vector<std::string> problems(const RecordingParams& params)
{
  std::vector<std::string> found;
  if (!params.folder.empty() && params.folder.front() != '/')
  {
    found.push_back("recording_folder is \"" + params.folder +
                    "\", must be an absolute path or empty");
  }
  check(found, "recording_limit [MB]", params.limit,
        cloth::Range::between(1.0, cloth::MAX_RECORDING));
  return found;
}

std::string beginRecording(cloth::Simulation& simulation, const cloth::RecordedStart& start,
                           const RecordingParams& params,
                           const std::function<void(const std::string&)>& on_problem)
{
  std::error_code error;
  std::filesystem::create_directories(params.folder, error);
  if (error)
  {
    throw cloth::Refusal("cannot make the recording_folder " + params.folder + ": " +
                         error.message());
  }
  const std::string path = freePath(params.folder);
  const auto limit = static_cast<std::uint64_t>(MEGABYTE * params.limit);
  auto file = std::make_unique<cloth::RecordingFile>(path, limit);
  try
  {
    simulation.recordTo(std::make_shared<cloth::Recorder>(std::move(file), start, on_problem));
  }
  catch (const std::exception&)  // it says why; an empty file would help nobody
  {
    std::filesystem::remove(path, error);
    throw;
  }
  return path;
}

}  // namespace cloth_tearing
