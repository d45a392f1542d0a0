// Does again what was recorded, and compares every step.
#pragma once

#include <cstdint>
#include <istream>
#include <memory>
#include <string>

#include "cloth_tearing/core/record.h"
#include "cloth_tearing/core/simulation.h"

namespace cloth
{

/// A recorded run, played once more: the same calls between the same steps. Tears, faults and the
/// hashes that were noted have to be the same, bit for bit.
class Replay
{
public:
  /// @param stream of bytes, whose end can be found; outlives the replay
  /// @throws Refusal if that is no recording, or it ends before its beginning is whole
  explicit Replay(std::istream& stream);

  /// Does all calls up to the next step, and that.
  /// @return whether there was one; after the last, all that is whole has been done
  /// @throws Refusal naming the step and what differs, or the record that is damaged
  bool step();

  const Simulation& simulation() const { return *simulation_; }
  std::uint64_t steps() const { return steps_; }  ///< done, over all epochs
  std::uint64_t calls() const { return calls_; }  ///< done
  std::uint64_t tears() const { return tears_; }  ///< that came again
  std::uint64_t faults() const { return faults_; }
  std::uint64_t hashes() const { return hashes_; }       ///< that came again
  std::uint64_t lastHash() const { return last_hash_; }  ///< after so many steps

  /// Bytes of a record that was not written to its end, once all others have been done.
  std::uint64_t leftOver() const { return reader_.leftOver(); }

private:
  std::optional<Record> next();
  void repeatCall(const std::string& bytes);
  void repeatStep(const std::string& bytes);
  std::string where() const;

  RecordReader reader_;
  std::unique_ptr<Simulation> simulation_;
  std::uint64_t steps_ = 0;
  std::uint64_t calls_ = 0;
  std::uint64_t tears_ = 0;
  std::uint64_t faults_ = 0;
  std::uint64_t hashes_ = 0;
  std::uint64_t last_hash_ = 0;
};

}  // namespace cloth
