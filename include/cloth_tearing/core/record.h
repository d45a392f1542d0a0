// The records of a recording as bytes: how they are framed, and how they are found again.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "cloth_tearing/core/cloth_model.h"
#include "cloth_tearing/core/simulation.h"
#include "cloth_tearing/core/tear_event.h"

namespace cloth
{

/// With which every recording begins.
constexpr char RECORDING_MAGIC[] = { 'C', 'L', 'O', 'T', 'H', 'R', '\n', '\x1a' };

enum class RecordKind : std::uint8_t
{
  START,  ///< what the simulation was built from: a RecordedStart
  CALL,   ///< a change from outside: its number in Simulation::Calls and its arguments
  STEP,   ///< a step: a RecordedStep, or nothing if that has nothing to tell
};

/// What a simulation is built from.
struct RecordedStart
{
  ClothModel model;
  std::vector<int> pinned;
  SimulationParams params;
};

/// What became of a step.
struct RecordedStep
{
  std::optional<std::uint64_t> hash;  ///< of the state after it; noted now and then
  std::vector<TearEvent> tears;
  std::string fault;
};

/// They begin with the format and the width of numbers.
std::string bytesOf(const RecordedStart& start);

/// @throws Refusal saying what is wrong with `bytes`
RecordedStart startFrom(const std::string& bytes);

/// Nothing if `step` has nothing to tell.
std::string bytesOf(const RecordedStep& step);

/// @throws Refusal saying what is wrong with `bytes`
RecordedStep stepFrom(const std::string& bytes);

struct Record
{
  RecordKind kind = RecordKind::START;
  std::string bytes;
};

/// Makes a record of a kind and its bytes: size, kind, checksum of these, bytes, checksum of all.
/// Checksums cover that of the record before: none can be lost, doubled or put elsewhere unseen.
class RecordWriter
{
public:
  std::string framed(RecordKind kind, const std::string& bytes);

private:
  std::uint64_t chain_ = 0;  ///< checksum of the record before
};

/// Reads records one after the other.
class RecordReader
{
public:
  /// @param stream of bytes, whose end can be found; outlives the reader
  /// @throws Refusal if that is no recording
  explicit RecordReader(std::istream& stream);

  /// @return none at the end: where there is no whole record any more
  /// @throws Refusal if a record is there and damaged: nothing from it on can be relied on
  std::optional<Record> next();

  /// Bytes that have been read, in whole records.
  std::uint64_t position() const { return position_; }

  /// Bytes after them: of a record that was being written when the writer was ended, if next() has
  /// found no other.
  std::uint64_t leftOver() const { return size_ - position_; }

private:
  bool read(std::string& bytes);
  [[noreturn]] void refuseDamaged() const;

  std::istream& stream_;
  std::uint64_t size_ = 0;      ///< of the whole
  std::uint64_t position_ = 0;  ///< of the next record
  std::uint64_t count_ = 0;
  std::uint64_t chain_ = 0;  ///< checksum of the record before
};

}  // namespace cloth
