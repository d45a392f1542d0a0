// Fuzzer of saved states: bytes damage a saved state, which has to be refused or to go on.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "cloth_tearing/core/archive.h"
#include "fuzz/bytes.h"
#include "fuzz/small_state.h"

namespace cloth
{
namespace
{

constexpr int STEPS = 3;
constexpr int MOST_DAMAGE = 4;  // places; more of them are only refused sooner
constexpr std::size_t CHECKSUM_SIZE = 8;

/// How the bytes at one place of a state change.
enum class Damage
{
  OTHER_BYTES,
  OTHER_DOUBLE,
  OTHER_FLOAT,
  OTHER_INDEX,
  LESS,
  MORE,
  KINDS
};

template <class T>
std::string bytesOf(T value)
{
  ArchiveWriter writer;
  writer("value", value);
  return writer.bytes();
}

/// Numbers that are trouble, which a fuzzer would take long to find in eight bytes.
template <class T>
std::string numberFrom(fuzz::Bytes& bytes)
{
  using Limits = std::numeric_limits<T>;
  const std::vector<T> numbers = {
    T(0),  T(1),  T(-1),  T(1e-6),       T(1e6),           Limits::max(), Limits::lowest(),
    T(50), T(-7), T(1e9), Limits::min(), Limits::epsilon()
  };
  return bytesOf(numbers[bytes.below(static_cast<int>(numbers.size()))]);
}

/// A place anywhere, among the parameters in the beginning, or in the end among what acts on the
/// cloth: its own arrays, the most of a state, shall not have the most of the damage.
std::size_t placeFrom(fuzz::Bytes& bytes, std::size_t size)
{
  constexpr std::size_t PART = 1024;
  const int part = bytes.below(3);
  const std::size_t length = part == 0 ? size : std::min(size, PART);
  const std::size_t at = bytes.below(static_cast<int>(length));
  return part == 2 ? size - length + at : at;
}

void damage(std::string& state, fuzz::Bytes& bytes)
{
  const auto kind = static_cast<Damage>(bytes.below(static_cast<int>(Damage::KINDS)));
  const std::size_t at = placeFrom(bytes, state.size() - CHECKSUM_SIZE);
  const std::size_t length = 1 + bytes.below(16);
  std::string replacement;
  switch (kind)
  {
    case Damage::OTHER_DOUBLE:
      replacement = numberFrom<double>(bytes);
      break;
    case Damage::OTHER_FLOAT:
      replacement = numberFrom<float>(bytes);
      break;
    case Damage::OTHER_INDEX:
      replacement = bytesOf(bytes.below(64) - 1);
      break;
    case Damage::LESS:
      state.erase(at, length);
      return;
    case Damage::MORE:
      state.insert(at, bytes.text(static_cast<int>(length)));
      return;
    default:
      replacement = bytes.text(static_cast<int>(length));
  }
  state.replace(at, replacement.size(), replacement);
}

/// `state` with the checksum that belongs to it, in place of its last bytes.
std::string sealed(std::string state)
{
  const std::size_t end = state.size() - CHECKSUM_SIZE;
  return state.replace(end, CHECKSUM_SIZE, bytesOf(checksum(state.data(), end)));
}

bool isSomewhere(const Cloth& cloth)
{
  const std::vector<Vec3> positions = cloth.state.position.toVectors();
  return std::all_of(positions.begin(), positions.end(),
                     [](const Vec3& position) { return position.allFinite(); });
}

void goOn(Simulation& simulation)
{
  for (int i = 0; i < STEPS; ++i)
  {
    simulation.step();
    fuzz::expect(isSomewhere(simulation.cloth()), "a restored cloth is nowhere");
    fuzz::expect(defects(simulation.cloth().mesh).empty(), "a restored cloth has defects");
  }
  simulation.summary();
  simulation.snapshot();
}

void restore(const std::string& state)
{
  static const Simulation present = fuzz::smallSimulation(SolverKind::XPBD);
  static const std::uint64_t hash = present.stateHash();
  try
  {
    Simulation next = present.restored(state);
    goOn(next);
    fuzz::expect(present.restored(next.save()).stateHash() == next.stateHash(),
                 "a state that was restored cannot be saved and restored again");
    next.reset();
    goOn(next);
  }
  catch (const Refusal& refusal)
  {
    fuzz::expect(!std::string(refusal.what()).empty(), "a refusal without a reason");
  }
  fuzz::expect(present.stateHash() == hash, "restoring changed what was there");
}

}  // namespace
}  // namespace cloth

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const std::vector<std::string> states = cloth::fuzz::smallStates();
  cloth::fuzz::Bytes bytes(data, size);
  std::string state = states[bytes.below(static_cast<int>(states.size()))];
  for (int i = 0; i < cloth::MOST_DAMAGE && !bytes.empty(); ++i)
  {
    cloth::damage(state, bytes);
  }
  cloth::restore(cloth::sealed(state));
  return 0;
}
