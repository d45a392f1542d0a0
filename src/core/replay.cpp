// Reads records and does what they tell.
#include "cloth_tearing/core/replay.h"

#include <utility>

#include "cloth_tearing/core/recorded_calls.h"
#include "cloth_tearing/core/refusal.h"

namespace cloth
{
namespace
{

std::unique_ptr<Simulation> begun(RecordReader& reader)
{
  const std::optional<Record> record = reader.next();
  if (!record || record->kind != RecordKind::START)
  {
    throw Refusal("the recording ends before its beginning is whole");
  }
  const RecordedStart start = startFrom(record->bytes);
  return std::make_unique<Simulation>(start.model, start.pinned, start.params);
}

/// What differs, the first thing first; empty if nothing does.
std::string difference(const RecordedStep& recorded, const RecordedStep& now)
{
  if (recorded.fault != now.fault)
  {
    return "the fault \"" + recorded.fault + "\" was recorded, now it is \"" + now.fault + "\"";
  }
  if (recorded.tears.size() != now.tears.size())
  {
    return std::to_string(recorded.tears.size()) + " tears were recorded, now there are " +
           std::to_string(now.tears.size());
  }
  if (recorded.hash != now.hash)
  {
    return "the state hash " + std::to_string(*recorded.hash) + " was recorded, now it is " +
           std::to_string(*now.hash);
  }
  return bytesOf(recorded) == bytesOf(now) ? "" : "the tears are others";
}

}  // namespace

void Simulation::Calls::repeat(const std::string& bytes, Simulation& simulation)
{
  ArchiveReader reader(bytes.data(), bytes.size());
  std::uint8_t number = 0;
  reader("call", number);
  if (!repeatIn(All(), number, reader, simulation))
  {
    throw Refusal("there is no call " + std::to_string(number));
  }
}

Replay::Replay(std::istream& stream) : reader_(stream), simulation_(begun(reader_))
{
}

bool Replay::step()
{
  while (const std::optional<Record> record = next())
  {
    if (record->kind == RecordKind::STEP)
    {
      repeatStep(record->bytes);
      return true;
    }
    repeatCall(record->bytes);
  }
  return false;
}

std::optional<Record> Replay::next()
{
  try
  {
    return reader_.next();
  }
  catch (const Refusal& refusal)
  {
    throw Refusal(where() + refusal.what());
  }
}

std::string Replay::where() const
{
  return "after " + std::to_string(steps_) + " steps and " + std::to_string(calls_) + " calls: ";
}

void Replay::repeatCall(const std::string& bytes)
{
  try
  {
    Simulation::Calls::repeat(bytes, *simulation_);
  }
  catch (const Refusal& refusal)
  {
    throw Refusal(where() + "a call that was recorded is refused now: " + refusal.what());
  }
  ++calls_;
}

void Replay::repeatStep(const std::string& bytes)
{
  const RecordedStep recorded = stepFrom(bytes);
  const StepReport report = simulation_->step();
  RecordedStep now{ {}, report.tears, report.fault };
  if (recorded.hash)
  {
    now.hash = simulation_->stateHash();
  }
  const std::string differs = difference(recorded, now);
  if (!differs.empty())
  {
    throw Refusal(where() + "the next step differs: " + differs);
  }
  ++steps_;
  if (recorded.hash)
  {
    ++hashes_;
    last_hash_ = steps_;
  }
  tears_ += report.tears.size();
  faults_ += report.fault.empty() ? 0 : 1;
}

}  // namespace cloth
