// Claims of the OBJ writer: what it writes is the cloth, torn as it is.
#include "cloth_tearing/core/obj_writer.h"

#include <gtest/gtest.h>

#include <sstream>

#include "cloth_tearing/core/obj_reader.h"
#include "scenes.h"

namespace cloth
{
namespace
{

TEST(ObjWriter, WritesWhatTheReaderReadsBackAsTheSameTornCloth)
{
  Cloth cloth = makeCloth(sheet(1.0, 1.0, 6, 6), {}, cotton(), RestShapeSource::IMPORTED, 0.0);
  for (int s : { 3, 20, 41 })
  {
    cloth.follow(cloth.mesh.splitSpring({ s }));
  }
  for (int i = 0; i < cloth.state.size(); ++i)
  {
    cloth.state.position[i] += Vec3(0, 0, 0.001f * i);
  }
  const Surface surface = makeSurface(cloth);
  std::stringstream file;

  writeObj(file, surface);

  const ClothModel model = readObj(file, "torn.obj", ImportOptions()).model;
  ASSERT_EQ(model.positions.size(), surface.position.size());
  for (std::size_t i = 0; i < model.positions.size(); ++i)
  {
    EXPECT_EQ(model.positions[i].cast<Real>(), surface.position[i]);
  }
  ASSERT_EQ(model.triangles.size(), surface.topology->triangles.size());
  for (std::size_t i = 0; i < model.triangles.size(); ++i)
  {
    EXPECT_EQ(model.triangles[i].vertices, surface.topology->triangles[i].particles);
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_EQ(model.triangles[i].uv[k], surface.topology->triangles[i].uv[k]);
    }
  }
}

}  // namespace
}  // namespace cloth
