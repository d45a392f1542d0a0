// A tear in words.
#include "cloth_tearing/node/tear_words.h"

#include <array>
#include <cstdio>

namespace cloth_tearing
{
namespace
{

const std::array<const char*, 4> KIND_NAMES = { "basic", "weak_point", "one_point", "released" };
const std::array<const char*, 4> CAUSE_NAMES = { "", "grasp", "sphere", "thrown sphere" };

std::string causeOf(const TearEvent& event)
{
  return event.cause == TearEvent::NO_CAUSE ? "by itself"
                                            : std::string("by ") + CAUSE_NAMES.at(event.cause) +
                                                  " " + std::to_string(event.cause_id);
}

}  // namespace

std::string inWords(const TearEvent& event)
{
  std::array<char, 256> line;
  std::snprintf(
      line.data(), line.size(),
      "tear %llu %s at (%.2f, %.2f, %.2f) m, strain %.2f over %.2f, %.2f N, %s, pieces %u",
      static_cast<unsigned long long>(event.sequence), KIND_NAMES.at(event.kind), event.position.x,
      event.position.y, event.position.z, event.strain, event.threshold, event.tension,
      causeOf(event).c_str(), event.pieces);
  return line.data();
}

}  // namespace cloth_tearing
