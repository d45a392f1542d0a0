// Fuzzer of OBJ files: bytes are a file, which has to be refused or become cloth.
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/obj_reader.h"
#include "fuzz/bytes.h"

namespace cloth
{
namespace
{

ImportOptions smallOptions(bool weld)
{
  ImportOptions options;
  options.weld_distance = weld ? 0.01 : 0.0;
  options.max_vertices = 1000;
  options.max_triangles = 1000;
  return options;
}

void load(const std::string& file, bool weld)
{
  std::istringstream stream(file);
  try
  {
    const ObjImport import = readObj(stream, "fuzz.obj", smallOptions(weld));
    const Cloth cloth = makeCloth(import.model, {}, Material{}, RestShapeSource::IMPORTED, 0.0);
    fuzz::expect(defects(cloth.mesh).empty(), "a file became cloth with defects");
    fuzz::expect(cloth.mesh.triangleCount() == import.report.triangles &&
                     cloth.mesh.particleCount() == import.report.particles &&
                     cloth.mesh.springCount() == import.report.springs,
                 "the report counts something else");
  }
  catch (const ImportError& refusal)
  {
    fuzz::expect(std::string(refusal.what()).find("fuzz.obj") != std::string::npos,
                 "a refusal does not name the file");
  }
}

}  // namespace
}  // namespace cloth

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string file(reinterpret_cast<const char*>(data), size);
  cloth::load(file, false);
  cloth::load(file, true);
  return 0;
}
