// Fuzzer of mesh edits: bytes choose a small mesh, then edits and the elements they are made on.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cloth_tearing/core/mesh.h"
#include "fuzz/bytes.h"
#include "small_meshes.h"

namespace cloth
{
namespace
{

constexpr int MOST_EDITS = 64;  // the check costs as much as the mesh is large

enum EditKind
{
  SPLIT,
  DETACH,
  OPEN,
  DETACH_FAN,
  SEPARATE,
  EDIT_KINDS
};

/// Where the next edit is to be made. Most combinations of arbitrary elements are refused: half of
/// the time they are chosen near one another.
struct Place
{
  ParticleId p;
  SpringId from;
  SpringId to;
  TriangleId t;
};

Place placeFrom(fuzz::Bytes& bytes, const Mesh& mesh)
{
  Place place;
  place.from.index = bytes.below(mesh.springCount());
  if (bytes.below(2) == 0)
  {
    place.p.index = bytes.below(mesh.particleCount());
    place.to.index = bytes.below(mesh.springCount());
    place.t.index = bytes.below(mesh.triangleCount());
    return place;
  }
  const Spring& spring = mesh.spring(place.from);
  place.p = spring.particles[bytes.below(2)];
  place.t = spring.triangles[spring.border() ? 0 : bytes.below(2)];
  const Fan fan = mesh.fanAt(place.p, place.t);
  place.to = fan.springs[bytes.below(static_cast<int>(fan.springs.size()))];
  return place;
}

Edit make(Mesh& mesh, EditKind kind, const Place& place)
{
  switch (kind)
  {
    case SPLIT:
      return mesh.splitSpring(place.from);
    case DETACH:
      return mesh.detachAlong(place.p, place.from);
    case OPEN:
      return mesh.openAlong(place.p, place.from, place.to);
    case DETACH_FAN:
      return mesh.detachFan(place.p, place.t);
    default:
      return mesh.separateFans(place.p);
  }
}

void play(fuzz::Bytes& bytes)
{
  static const std::vector<NamedModel> models = everyConfiguration();
  Mesh mesh = meshOf(models[bytes.below(static_cast<int>(models.size()))].model);
  for (int edits = 0; edits < MOST_EDITS && !bytes.empty(); ++edits)
  {
    const Mesh before = mesh;
    const auto kind = static_cast<EditKind>(bytes.below(EDIT_KINDS));
    const Place place = placeFrom(bytes, mesh);
    try
    {
      const Edit edit = make(mesh, kind, place);
      const std::vector<std::string> found = defects(mesh);
      fuzz::expect(found.empty(), found.empty() ? "" : found.front());
      fuzz::expect(touchesAllThatChanged(before, mesh, edit.touched), "an edit hides what changed");
    }
    catch (const TopologyError&)
    {
      fuzz::expect(isSame(mesh, before), "a refused edit changed the mesh");
    }
  }
}

}  // namespace
}  // namespace cloth

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  cloth::fuzz::Bytes bytes(data, size);
  cloth::play(bytes);
  return 0;
}
