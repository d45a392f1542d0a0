// Frames what happens and hands it on, until the sink takes no more.
#include "cloth_tearing/core/recorder.h"

#include <exception>
#include <utility>

#include "cloth_tearing/core/record.h"

namespace cloth
{
namespace
{

/// How often the hash of the state is noted, which costs as much as some steps do [steps].
constexpr std::uint64_t HASH_INTERVAL = 500;

}  // namespace

Recorder::Recorder(std::unique_ptr<RecordSink> sink, const RecordedStart& start,
                   std::function<void(const std::string&)> on_problem)
    : sink_(std::move(sink))
    , writer_(std::make_unique<RecordWriter>())
    , on_problem_(std::move(on_problem))
{
  append(
      [&]
      {
        return std::string(RECORDING_MAGIC, sizeof RECORDING_MAGIC) +
               writer_->framed(RecordKind::START, bytesOf(start));
      });
}

Recorder::~Recorder() = default;

void Recorder::called(const std::string& call)
{
  append([&] { return writer_->framed(RecordKind::CALL, call); });
}

void Recorder::stepped(const Simulation& simulation, const StepReport& report)
{
  append(
      [&]
      {
        RecordedStep step{ {}, report.tears, report.fault };
        if (++steps_ % HASH_INTERVAL == 0)
        {
          step.hash = simulation.stateHash();
        }
        return writer_->framed(RecordKind::STEP, bytesOf(step));
      });
}

template <class Bytes>
void Recorder::append(Bytes bytes)
{
  if (!sink_)
  {
    return;
  }
  try
  {
    sink_->append(bytes());
  }
  catch (const std::exception& error)
  {
    sink_.reset();
    if (on_problem_)
    {
      on_problem_(error.what());
    }
  }
}

}  // namespace cloth
