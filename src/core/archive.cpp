// The sentences of a reader that refuses, and checksums.
#include "cloth_tearing/core/archive.h"

#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/core/word_hash.h"

namespace cloth
{

void ArchiveReader::refuse(const std::string& why) const
{
  std::string place;
  for (const char* name : place_)
  {
    place += (place.empty() ? "" : "/") + std::string(name);
  }
  throw Refusal(place + " " + why);
}

void ArchiveReader::refuseShort(std::uint64_t count, std::size_t size) const
{
  refuse("asks for " + std::to_string(count) + " x " + std::to_string(size) + " bytes, " +
         std::to_string(left()) + " are left");
}

void ArchiveReader::expectEnd() const
{
  if (left() > 0)
  {
    throw Refusal(std::to_string(left()) + " bytes are left over");
  }
}

std::uint64_t checksum(const char* bytes, std::size_t size)
{
  WordHash hash;
  for (std::size_t at = 0; at < size; at += 8)
  {
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < 8 && at + i < size; ++i)
    {
      word |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + i])) << 8 * i;
    }
    hash.add(word);
  }
  hash.add(size);
  return hash.value();
}

}  // namespace cloth
