// Frames records, finds them again, and looks at each before it believes it.
#include "cloth_tearing/core/record.h"

#include <algorithm>

#include "cloth_tearing/core/archive.h"
#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/core/transfer.h"

namespace cloth
{

template <class Archive>
void transfer(Archive& archive, ModelTriangle& triangle)
{
  auto& [vertices, uv] = triangle;
  archive("vertices", vertices);
  archive("uv", uv);
}

template <class Archive>
void transfer(Archive& archive, ClothModel& model)
{
  auto& [positions, triangles] = model;
  archive("positions", positions);
  archive("triangles", triangles);
}

template <class Archive>
void transfer(Archive& archive, Limits& limits)
{
  auto& [particles, triangles, spheres, grasps] = limits;
  archive("particles", particles);
  archive("triangles", triangles);
  archive("spheres", spheres);
  archive("grasps", grasps);
}

/// Those that a step reads, and those that only requests and logs read.
template <class Archive>
void transferAll(Archive& archive, SimulationParams& params)
{
  archive("params", params);
  archive("max_grasp_distance", params.max_grasp_distance);
  archive("threads", params.threads);
  archive("tear_log_size", params.tear_log_size);
  archive("limits", params.limits);
  archive("life", params.life);
  archive("place", params.place);
}

template <class Archive>
void transfer(Archive& archive, RecordedStart& start)
{
  auto& [model, pinned, params] = start;
  archive("model", model);
  archive("pinned", pinned);
  transferAll(archive, params);
}

template <class Archive>
void transfer(Archive& archive, RecordedStep& step)
{
  auto& [hash, tears, fault] = step;
  archive("hash", hash);
  archive("tears", tears);
  archive("fault", fault);
}

namespace
{

constexpr std::uint32_t RECORDING_FORMAT = 1;
constexpr std::uint64_t CHECKSUM_SIZE = sizeof(std::uint64_t);
constexpr std::uint64_t HEAD_SIZE = sizeof(std::uint64_t) + sizeof(std::uint8_t) + CHECKSUM_SIZE;

std::string numberBytes(std::uint64_t number)
{
  ArchiveWriter writer;
  writer("number", number);
  return writer.take();
}

std::uint64_t numberFrom(const char* bytes)
{
  ArchiveReader reader(bytes, sizeof(std::uint64_t));
  std::uint64_t number = 0;
  reader("number", number);
  return number;
}

std::uint64_t chained(std::uint64_t before, const std::string& bytes)
{
  const std::string all = numberBytes(before) + bytes;
  return checksum(all.data(), all.size());
}

/// Size and kind with a checksum of their own, so that a damaged size is not taken for the end.
std::string headOf(std::uint64_t chain, RecordKind kind, std::uint64_t size)
{
  ArchiveWriter writer;
  writer("size", size);
  writer("kind", static_cast<std::uint8_t>(kind));
  return writer.bytes() + numberBytes(chained(chain, writer.bytes()));
}

}  // namespace

std::string bytesOf(const RecordedStart& start)
{
  ArchiveWriter writer;
  writer("format", RECORDING_FORMAT);
  writer("real_size", static_cast<std::uint32_t>(sizeof(Real)));
  writer("start", start);
  return writer.take();
}

RecordedStart startFrom(const std::string& bytes)
{
  ArchiveReader reader(bytes.data(), bytes.size());
  std::uint32_t format = 0;
  std::uint32_t real_size = 0;
  reader("format", format);
  reader("real_size", real_size);
  if (format != RECORDING_FORMAT || real_size != sizeof(Real))
  {
    throw Refusal("the recording has format " + std::to_string(format) + " with numbers of " +
                  std::to_string(real_size) + " bytes, must be " +
                  std::to_string(RECORDING_FORMAT) + " with " + std::to_string(sizeof(Real)) +
                  ": another version of this package made it");
  }
  RecordedStart start;
  reader("start", start);
  reader.expectEnd();
  return start;
}

std::string bytesOf(const RecordedStep& step)
{
  if (!step.hash && step.tears.empty() && step.fault.empty())
  {
    return {};
  }
  ArchiveWriter writer;
  writer("step", step);
  return writer.take();
}

RecordedStep stepFrom(const std::string& bytes)
{
  RecordedStep step;
  if (!bytes.empty())
  {
    ArchiveReader reader(bytes.data(), bytes.size());
    reader("step", step);
    reader.expectEnd();
  }
  return step;
}

std::string RecordWriter::framed(RecordKind kind, const std::string& bytes)
{
  const std::string head = headOf(chain_, kind, bytes.size());
  chain_ = chained(numberFrom(head.data() + HEAD_SIZE - CHECKSUM_SIZE), bytes);
  return head + bytes + numberBytes(chain_);
}

RecordReader::RecordReader(std::istream& stream) : stream_(stream)
{
  char magic[sizeof RECORDING_MAGIC] = {};
  stream_.seekg(0, std::ios::end);
  size_ = static_cast<std::uint64_t>(std::max<std::streamoff>(0, stream_.tellg()));
  stream_.seekg(0);
  stream_.read(magic, sizeof magic);
  if (!stream_ || !std::equal(std::begin(magic), std::end(magic), RECORDING_MAGIC))
  {
    throw Refusal("this is no recording of a cloth");
  }
  position_ = sizeof magic;
}

std::optional<Record> RecordReader::next()
{
  std::string head(HEAD_SIZE, '\0');
  if (leftOver() < HEAD_SIZE || !read(head))
  {
    return {};
  }
  const std::uint64_t size = numberFrom(head.data());
  const auto kind = static_cast<std::uint8_t>(head[sizeof size]);
  if (kind > static_cast<std::uint8_t>(RecordKind::STEP) ||
      head != headOf(chain_, static_cast<RecordKind>(kind), size))
  {
    refuseDamaged();
  }
  Record record{ static_cast<RecordKind>(kind), {} };
  std::string told(CHECKSUM_SIZE, '\0');
  if (leftOver() - HEAD_SIZE < CHECKSUM_SIZE || size > leftOver() - HEAD_SIZE - CHECKSUM_SIZE)
  {
    return {};
  }
  record.bytes.resize(size);
  if (!read(record.bytes) || !read(told))
  {
    return {};
  }
  chain_ = chained(numberFrom(head.data() + HEAD_SIZE - CHECKSUM_SIZE), record.bytes);
  if (chain_ != numberFrom(told.data()))
  {
    refuseDamaged();
  }
  ++count_;
  position_ += HEAD_SIZE + size + CHECKSUM_SIZE;
  return record;
}

/// @return whether all of `bytes` was there
bool RecordReader::read(std::string& bytes)
{
  stream_.read(&bytes[0], static_cast<std::streamsize>(bytes.size()));
  if (stream_.bad())
  {
    throw Refusal("cannot read on after byte " + std::to_string(position_));
  }
  return !stream_.fail();
}

void RecordReader::refuseDamaged() const
{
  throw Refusal("record " + std::to_string(count_ + 1) + ", at byte " + std::to_string(position_) +
                ", is damaged: its checksum does not match");
}

}  // namespace cloth
