// Writes down what happens to a simulation, so that it can be done again: see Replay.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace cloth
{

class RecordWriter;
class Simulation;
struct RecordedStart;
struct StepReport;

/// Where a recording goes.
class RecordSink
{
public:
  virtual ~RecordSink() = default;

  /// Puts all of `bytes` after what is there; if it cannot, only what was there remains.
  /// @throws std::exception saying why it cannot
  virtual void append(const std::string& bytes) = 0;
};

/// Gives each change and each step to its sink before it returns. A sink that fails ends the
/// recording, not the simulation: up to there it can be replayed.
///
/// Of the thread that steps the simulation.
class Recorder
{
public:
  /// @param on_problem called once, with the reason, when nothing can be recorded any more
  /// @throws what the sink throws if it does not even take the beginning
  Recorder(std::unique_ptr<RecordSink> sink, const RecordedStart& start,
           std::function<void(const std::string&)> on_problem);
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  ~Recorder();

  /// @param call its number and its arguments
  void called(const std::string& call);

  /// @param simulation after the step
  void stepped(const Simulation& simulation, const StepReport& report);

private:
  template <class Bytes>
  void append(Bytes bytes);

  std::unique_ptr<RecordSink> sink_;  ///< none: nothing is recorded any more
  std::unique_ptr<RecordWriter> writer_;
  std::function<void(const std::string&)> on_problem_;
  std::uint64_t steps_ = 0;
};

/// The recorder of one simulation: copies of that are not recorded, and whatever is assigned to it
/// is recorded on.
class OwnRecorder
{
public:
  OwnRecorder() = default;
  OwnRecorder(const OwnRecorder& /*other*/) {}
  OwnRecorder& operator=(const OwnRecorder& /*other*/) { return *this; }  // NOLINT: keeps its own
  ~OwnRecorder() = default;

  void set(std::shared_ptr<Recorder> recorder) { recorder_ = std::move(recorder); }
  Recorder* get() const { return recorder_.get(); }

private:
  std::shared_ptr<Recorder> recorder_;
};

}  // namespace cloth
