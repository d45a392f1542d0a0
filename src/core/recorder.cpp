// Frames what happens and hands it on, until the sink takes no more.
#include "cloth_tearing/core/recorder.h"

#include <exception>
#include <utility>

#include "cloth_tearing/core/record.h"

namespace cloth
{
namespace
{

/// The hash of the state, which costs as much as some steps do, is noted after so many [steps].
constexpr std::uint64_t HASH_INTERVAL = 500;

/// And after 1, 2, 4, ... of the first ones, so that short runs have some, too.
bool wantsHash(std::uint64_t steps)
{
  const bool power_of_two = (steps & (steps - 1)) == 0;
  return steps % HASH_INTERVAL == 0 || (steps < HASH_INTERVAL && power_of_two);
}

}  // namespace

Recorder::Recorder(std::unique_ptr<RecordSink> sink, const RecordedStart& start,
                   std::function<void(const std::string&)> on_problem)
    : sink_(std::move(sink))
    , writer_(std::make_unique<RecordWriter>())
    , on_problem_(std::move(on_problem))
{
  sink_->append(std::string(RECORDING_MAGIC, sizeof RECORDING_MAGIC) +
                writer_->framed(RecordKind::START, bytesOf(start)));
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
        if (wantsHash(++steps_) || !report.fault.empty())
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
