// A simulation's state as bytes: an envelope that tells what it is, and the state in it.
#include <string>
#include <utility>

#include "cloth_tearing/core/archive.h"
#include "cloth_tearing/core/recorded_calls.h"
#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/core/simulation.h"
#include "cloth_tearing/core/state_checks.h"
#include "cloth_tearing/core/transfer.h"

namespace cloth
{
namespace
{

constexpr char MAGIC[] = { 'C', 'L', 'O', 'T', 'H', '\r', '\n', '\x1a' };  // no text file
constexpr std::uint32_t STATE_FORMAT = 5;
constexpr std::size_t CHECKSUM_SIZE = sizeof(std::uint64_t);

/// What the state does not know of itself.
struct Origin
{
  std::uint64_t life = 0;
  std::string place;
  std::vector<TearEvent> tears;  ///< that made the cloth what it is, as far as the log goes back
};

template <class Archive>
void transfer(Archive& archive, Origin& origin)
{
  auto& [life, place, tears] = origin;
  archive("life", life);
  archive("place", place);
  archive("tears", tears);
}

std::uint64_t readNumber(const std::string& bytes, std::size_t at)
{
  ArchiveReader reader(bytes.data() + at, CHECKSUM_SIZE);
  std::uint64_t number = 0;
  reader("checksum", number);
  return number;
}

/// Refuses what is no state, of another kind, or damaged. @return its contents
ArchiveReader opened(const std::string& bytes)
{
  const std::size_t least = sizeof MAGIC + 2 * sizeof(std::uint32_t) + CHECKSUM_SIZE;
  if (bytes.size() < least || bytes.compare(0, sizeof MAGIC, MAGIC, sizeof MAGIC) != 0)
  {
    throw Refusal("this is no saved state of a cloth");
  }
  const std::size_t end = bytes.size() - CHECKSUM_SIZE;
  ArchiveReader reader(bytes.data() + sizeof MAGIC, end - sizeof MAGIC);
  std::uint32_t format = 0;
  std::uint32_t real_size = 0;
  reader("format", format);
  reader("real_size", real_size);
  if (format != STATE_FORMAT)
  {
    throw Refusal("the state has format " + std::to_string(format) + ", must be " +
                  std::to_string(STATE_FORMAT) + ": another version of this package saved it");
  }
  if (real_size != sizeof(Real))
  {
    throw Refusal("the state's numbers are " + std::to_string(real_size) + " bytes wide, must be " +
                  std::to_string(sizeof(Real)));
  }
  if (readNumber(bytes, end) != checksum(bytes.data(), end))
  {
    throw Refusal("the state is damaged: its checksum does not match");
  }
  return reader;
}

void refuseBeyond(const Limits& limits, const Mesh& untorn, std::size_t grasps, std::size_t spheres)
{
  const auto count = [](int number) { return static_cast<std::size_t>(number); };
  std::vector<std::string> found;
  checkCount(found, "particles", count(untorn.particleCount()), "limits/particles",
             limits.particles);
  checkCount(found, "triangles", count(untorn.triangleCount()), "limits/triangles",
             limits.triangles);
  checkCount(found, "grasps", grasps, "limits/grasps", limits.grasps);
  checkCount(found, "spheres", spheres, "limits/spheres", limits.spheres);
  refuseIf(found);
}

}  // namespace

std::string Simulation::save() const
{
  Origin origin{ params_.life, params_.place, {} };
  for (TearEvent& tear : log_.since(0, static_cast<std::size_t>(-1)))
  {
    if (history_.holds(tear.sequence))
    {
      origin.tears.push_back(std::move(tear));
    }
  }
  ArchiveWriter writer;
  for (char c : MAGIC)
  {
    writer("magic", static_cast<std::uint8_t>(c));
  }
  writer("format", STATE_FORMAT);
  writer("real_size", static_cast<std::uint32_t>(sizeof(Real)));
  writer("origin", origin);
  writer("", *this);
  writer("checksum", checksum(writer.bytes().data(), writer.bytes().size()));
  return writer.take();
}

Simulation Simulation::restored(const std::string& bytes) const
{
  ArchiveReader reader = opened(bytes);
  Origin origin;
  Simulation next = *this;
  next.grippers_.releaseAll(next.cloth_, "another state was restored");
  next.publish();
  reader("origin", origin);
  if (origin.place != params_.place)
  {
    throw Refusal("the state was saved in another place: its cloth frame is \"" + origin.place +
                  "\", here it is \"" + params_.place + "\"");
  }
  reader("state", next);
  reader.expectEnd();
  refuseIf(problems(next.params_));
  refuseBeyond(next.params_.limits, next.untorn_.mesh, next.grippers_.all().size(),
               next.spheres_.all().size());
  refuseUnsound(next.untorn_, "untorn");
  refuseUnsound(next.cloth_, "cloth");
  refuseUnsound(next.cloth_, next.solver_->memory(), next.params_.solver);
  refuseUnsound(next.cloth_, next.grippers_.all());
  refuseUnsound(next.spheres_.all());

  next.outer_.startOver();
  next.contact_.startOver();
  next.makeWorkers();
  next.tearing_ = Tearing(next.params_.tearing);
  next.watchSprings();
  next.start_time_ = time();
  next.start_step_ = next.step_;
  ++next.epoch_;
  next.balance_ = ForceBalance();
  next.balance_wanted_until_ = 0;
  next.adopt(origin.life, origin.tears);
  next.grippers_.resume(next.log_.range()[1] + 1);
  next.publish();
  return next;
}

void Simulation::become(Simulation other, const std::string& bytes)
{
  *this = std::move(other);
  note<&Simulation::restore>(bytes);
}

/// Takes the history of the state for its own, which needs events only where they are new here.
void Simulation::adopt(std::uint64_t life, std::vector<TearEvent>& tears)
{
  if (life == params_.life && history_.newest() <= log_.range()[1])
  {
    return;
  }
  for (const Adopted& known : adopted_)
  {
    if (known.life == life && known.theirs == history_)
    {
      history_ = known.ours;
      return;
    }
  }
  Adopted adopted{ life, std::exchange(history_, {}), {} };
  for (TearEvent& tear : tears)
  {
    tear.epoch = epoch_;
    tear.time = time();
    log_.add(tear);
    history_.add(tear.sequence);
  }
  adopted.ours = history_;
  adopted_.push_back(std::move(adopted));
}

}  // namespace cloth
