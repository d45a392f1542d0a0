// Claims of the OBJ reader: what it understands, mends, reports and refuses, and that it never
// crashes.
#include "cloth_tearing/core/obj_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cstdint>
#include <fstream>
#include <locale>
#include <random>
#include <sstream>
#include <stdexcept>

#include "cloth_tearing/core/mesh.h"
#include "cloth_tearing/core/mesh_builder.h"

namespace cloth
{
namespace
{

ObjImport import(const std::string& text, const ImportOptions& options = ImportOptions())
{
  std::istringstream stream(text);
  return readObj(stream, "cloth.obj", options);
}

std::string refusal(const std::string& text, const ImportOptions& options = ImportOptions())
{
  try
  {
    import(text, options);
  }
  catch (const ImportError& error)
  {
    return error.what();
  }
  return "accepted";
}

// What every accepted model must be, whatever was in the file.
testing::AssertionResult isClean(const ObjImport& imported)
{
  const ClothModel& model = imported.model;
  const Mesh mesh(static_cast<int>(model.positions.size()), model.triangles);
  for (const std::string& defect : defects(mesh))
  {
    return testing::AssertionFailure() << defect;
  }
  for (const ModelTriangle& t : model.triangles)
  {
    const Vec3d& a = model.positions[t.vertices[0]];
    const Vec3d u = model.positions[t.vertices[1]] - a;
    const Vec3d v = model.positions[t.vertices[2]] - a;
    if (!(u.norm() > 0 && v.norm() > 0 && (u - v).norm() > 0 && u.cross(v).norm() > 0))
    {
      return testing::AssertionFailure() << "a triangle has no area";
    }
  }
  return testing::AssertionSuccess();
}

bool reports(const ObjImport& imported, int line, const std::string& words)
{
  return std::any_of(imported.report.findings.begin(), imported.report.findings.end(),
                     [&](const ImportFinding& finding) {
                       return finding.line == line && finding.text.find(words) != std::string::npos;
                     });
}

bool holds(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

//  4 --- 3
//  |   / |
//  | /   |
//  1 --- 2
const char SQUARE[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const char SQUARE_UV[] = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
const char TWO_TRIANGLES[] = "f 1 2 3\nf 1 3 4\n";

std::string square(const std::string& rest = TWO_TRIANGLES)
{
  return SQUARE + rest;
}

TEST(ObjReader, ReadsVerticesTextureAndFaces)
{
  const ObjImport cloth =
      import(std::string(SQUARE) + SQUARE_UV + "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");

  ASSERT_EQ(cloth.model.positions.size(), 4u);
  EXPECT_EQ(cloth.model.positions[2], Vec3d(1, 1, 0));
  ASSERT_EQ(cloth.model.triangles.size(), 2u);
  EXPECT_EQ(cloth.model.triangles[1].vertices, (std::array<int, 3>{ 0, 2, 3 }));
  EXPECT_EQ(cloth.model.triangles[1].uv[2], Vec2d(0, 1));
  EXPECT_EQ(cloth.report.pieces, 1);
  EXPECT_EQ(cloth.report.borders, 1);
  EXPECT_EQ(cloth.report.springs, 5);
  EXPECT_EQ(cloth.report.border_springs, 4);
  EXPECT_TRUE(cloth.report.findings.empty());
  EXPECT_TRUE(isClean(cloth));
}

TEST(ObjReader, UnderstandsEveryWayOfWritingTheSameSquare)
{
  const std::string vertices = SQUARE;
  const std::string uvs = SQUARE_UV;
  const std::string good[] = {
    vertices + TWO_TRIANGLES,
    vertices + "f 1 2 3 4\n",
    vertices + "f 1 2 3 4",
    vertices + uvs + "f 1/1 2/2 3/3 4/4\n",
    vertices + uvs + "vn 0 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\n",
    vertices + "vn 0 0 1\nf 1//1 2//1 3//1 4//1\n",
    vertices + "vn 0 nan x\nf 1//-1 2//-1 3//-1 4//-1\n",
    vertices + "f -4 -3 -2 -1\n",
    vertices + uvs + "f -4/-4 -3/-3 -2/-2 -1/-1\n",
    vertices + "f 1/ 2/ 3/ 4/\n",
    vertices + "f 1 2 3 \\\n4\n",
    vertices + "f 1 2 \\\r\n 3 \\\r\n4\r\n",
    vertices + "  f\t1  2\t3 4   \n",
    vertices + "f 1 2 3 4 # the whole of it\n",
    vertices + "# a path C:\\cloths\\\nf 1 2 3 4\n",
    "f 1 2 3 4\n" + vertices,
    "\xEF\xBB\xBF" + vertices + "f 1 2 3 4\n",
    "# made by hand\n\n\n" + vertices + "\n\ng front\no cloth\ns 1\nf 1 2 3 4\n",
    "v 0 0 0 1\nv 1 0 0 1.0\nv 1 1 0 1\nv 0 1 0 1\nf 1 2 3 4\n",
    "v 0 0 0 1 0.5 0\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\nv 0 1 0 1 0 nan\nf 1 2 3 4\n",
    "v 0.0 -0 +0\nv 1e0 0. .0\nv 10E-1 1.000000000000000000000 0\nv 0 0.1e+1 0e5\nf 1 2 3 4\n",
    "v 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0\rf 1 2 3 4\r",
    vertices + "vt 0\nvt 1 0\nvt 1 1 0\nvt 0 1\nf 1/1 2/2 3/3 4/4\n",
  };
  for (const std::string& text : good)
  {
    ASSERT_NO_THROW(import(text)) << text << refusal(text);
    const ObjImport cloth = import(text);
    EXPECT_EQ(cloth.model.positions, import(square()).model.positions) << text;
    EXPECT_EQ(cloth.model.triangles.size(), 2u) << text;
    EXPECT_EQ(cloth.model.triangles[0].uv[0], Vec2d(0, 0)) << text;
    EXPECT_NEAR(cloth.report.area, 1, 1e-15) << text;
    EXPECT_TRUE(isClean(cloth)) << text;
  }
}

TEST(ObjReader, RefusesWithFileLineAndReason)
{
  struct Case
  {
    std::string text;
    const char* words;
  };
  const std::string vertices = SQUARE;
  const Case bad[] = {
    { "", "cloth.obj: there is no face in it" },
    { "\n\n# nothing\n", "there is no face in it" },
    { vertices, "there is no face in it" },
    { std::string(1000, '\0'), "there is no face in it" },
    { "\x7f"
      "ELF\x02\x01\n\xff\xfe\n",
      "there is no face in it" },
    { "v 0 0\n" + square(), "line 1: v has 2 numbers, must have 3 to 8" },
    { "v 0 0 0 0 0 0 0 0 0\n" + square(), "line 1: v has 9 numbers" },
    { "v\n" + square(), "line 1: v has 0 numbers" },
    { "v 0 0 x\n" + square(), "line 1: \"x\" is not a number" },
    { "v 0 0 1,5\n" + square(), "line 1: \"1,5\" is not a number" },
    { "v 0 0 1e\n" + square(), "line 1: \"1e\" is not a number" },
    { "v 0 0 0x10\n" + square(), "line 1: \"0x10\" is not a number" },
    { "v 0 0 --1\n" + square(), "line 1: \"--1\" is not a number" },
    { "v 0 0 .\n" + square(), "line 1: \".\" is not a number" },
    { "v 0 nan 0\n" + square(), "line 1: \"nan\" is not a finite number" },
    { "v 0 -NaN(ind) 0\n" + square(), "line 1: \"-NaN(ind)\" is not a finite number" },
    { "v 0 0 -inf\n" + square(), "line 1: \"-inf\" is not a finite number" },
    { "v 0 1.#INF 0\n" + square(), "line 1: \"1.#INF\" is not a finite number" },
    { "v 1e400 0 0\n" + square(), "line 1: \"1e400\" is not a finite number" },
    { "v 1e999999999999999999 0 0\n" + square(), "is not a finite number" },
    { "v 1e300 0 0\n" + square(),
      "line 1: a coordinate of 1e+300 m, must be at most 1000 m: scale it down" },
    { "vt 1e7 0\n" + square(), "line 1: a texture coordinate of 1e+07, must be at most 1e+06" },
    { "vt 0 -1e7\n" + square(), "line 1: a texture coordinate of 1e+07, must be at most 1e+06" },
    { "vt\n" + square(), "line 1: vt has 0 numbers, must have 1 to 3" },
    { "vt 0 inf\n" + square(), "line 1: \"inf\" is not a finite number" },
    { square("f 1 2\n"), "line 5: the face has 2 corners, must have 3 or more" },
    { square("f\n"), "line 5: the face has 0 corners" },
    { square("f 1 2 5\n"), "line 5: vertex index 5 is out of range, there are 4" },
    { square("f 1 2 0\n"), "line 5: index 0 in \"0\", they count from 1" },
    { square("f 1 2 -5\n"), "line 5: vertex index -5 is out of range, there are 4 before" },
    { square("f 1 2 99999999999999999999\n"), "line 5: vertex index" },
    { square("f 1 2 2147483648\n"), "line 5: vertex index" },
    { square("f 1 2 -99999999999999999999\n"), "line 5: vertex index" },
    { square("f 1/1 2/1 3/1\n"), "line 5: texture index 1 is out of range, there are 0" },
    { square("f 1/0 2/1 3/1\n"), "line 5: index 0 in \"1/0\"" },
    { square("f 1//1 2//1 3//1\n"), "line 5: normal index 1 is out of range, there are 0" },
    { square("f 1 2 3.0\n"), "line 5: \"3.0\" is not a corner" },
    { square("f 1 2 three\n"), "line 5: \"three\" is not a corner" },
    { square("f 1/1/1/1 2 3\n"), "line 5: \"1/1/1/1\" is not a corner" },
    { square("f /1 2 3\n"), "line 5: \"/1\" is not a corner" },
    { square("vt 0 0\nf 1/1 2 3/1\n"), "line 6: some corners of the face have a texture index" },
    { square("f 1 2 2\n"), "line 5: the face names vertex 2 twice" },
    { square("f 1 2 3 1\n"), "line 5: the face names vertex 1 twice" },
    { square("f 1 2 3\nf 2 3 1\n"), "line 6: the same face as in line 5 again" },
    { square("f 1 2 3\nf 1 3 4\nf 1 2 3\n"),
      "1 problem:\n  cloth.obj, line 7: the same face as in line 5 again" },
    { square("f 1 2 3\nf 3 2 1\n"), "line 6: the same face as in line 5 again" },
    { square("f 1 2 3 4\nf 4 3 2 1\n"), "line 6: the same face as in line 5 again" },
    { square("f 1 2 3\nf 1 3 4\nv .5 .5 1\nf 1 3 5\n"),
      "line 8: the edge between vertices 1 and 3 has 3 faces (lines 5, 6, 8)" },
    { square("f 1 3 2 4\n"), "line 5: the polygon crosses or touches itself" },
    { square("v 0.5 0 0\nf 1 2 3 5 4\n"), "line 6: the polygon crosses or touches itself" },
    { square("v 2 0 0\nf 1 5 2 3 4\n"), "line 6: the polygon crosses or touches itself" },
    { "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n", "the model is 0 m across" },
    { "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "no face is left that has an area" },
    // A Moebius band of five quads.
    { "v 0 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 2 0 1\nv 2 1 1\nv 1 0 2\nv 1 1 2\nv 0 0 2\nv 0 1 2\n"
      "f 1 3 4 2\nf 3 5 6 4\nf 5 7 8 6\nf 7 9 10 8\nf 9 2 1\nf 9 1 10\n",
      "the surface has only one side, like a Moebius band" },
  };
  for (const Case& c : bad)
  {
    const std::string message = refusal(c.text);
    EXPECT_TRUE(holds(message, c.words)) << c.words << "\n" << c.text << "\n" << message;
    EXPECT_TRUE(holds(message, "cloth.obj")) << message;
  }
}

TEST(ObjReader, NamesTheLineWhereAOneSidedSurfaceMeetsItself)
{
  const std::string message = refusal(
      "v 0 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 2 0 1\nv 2 1 1\nv 1 0 2\nv 1 1 2\nv 0 0 2\nv 0 1 2\n"
      "f 1 3 4 2\nf 3 5 6 4\nf 5 7 8 6\nf 7 9 10 8\nf 9 2 1\nf 9 1 10\n");

  EXPECT_TRUE(holds(message, "1 problem:")) << message;
  EXPECT_TRUE(holds(message, "cloth.obj, line 1")) << message;
  EXPECT_TRUE(holds(message, "at the edge between vertices ")) << message;
}

TEST(ObjReader, ListsTenProblemsAndCountsTheRest)
{
  std::string text = SQUARE;
  for (int i = 0; i < 25; ++i)
  {
    text += "f 1 2 " + std::to_string(100 + i) + "\n";
  }
  const std::string message = refusal(text);

  EXPECT_TRUE(holds(message, "cloth.obj cannot be imported, 25 problems:"));
  EXPECT_TRUE(holds(message, "line 5: vertex index 100"));
  EXPECT_TRUE(holds(message, "line 14: vertex index 109"));
  EXPECT_FALSE(holds(message, "line 15:"));
  EXPECT_TRUE(holds(message, "and 15 more"));
}

TEST(ObjReader, CountsLinesInFilesOfEveryOrigin)
{
  for (const std::string end : { "\n", "\r\n", "\r" })
  {
    const std::string text = "# one" + end + end + "v 0 0 \\" + end + "0" + end + "v 1 x 0" + end;
    EXPECT_TRUE(holds(refusal(text), "line 5: \"x\"")) << refusal(text);
  }
}

TEST(ObjReader, HoldsToItsLimits)
{
  struct Case
  {
    void (*limit)(ImportOptions&);
    const char* words;
  };
  const Case cases[] = {
    { [](ImportOptions& o) { o.max_bytes = 40; },
      "cloth.obj: it has more than 40 bytes (max_bytes)" },
    { [](ImportOptions& o) { o.max_vertices = 3; }, "line 4: there are more than 3 vertices" },
    { [](ImportOptions& o) { o.max_triangles = 1; }, "line 5: there are more than 1 triangles" },
    { [](ImportOptions& o) { o.max_polygon_corners = 3; },
      "line 5: the face has more than 3 corners" },
    { [](ImportOptions& o) { o.max_coordinate = 0.5; }, "line 2: a coordinate of 1 m" },
    { [](ImportOptions& o) { o.scale = 1e7; }, "line 2: a coordinate of 1e+07 m" },
    { [](ImportOptions& o) { o.scale = 1e-200; }, "the model is 1.41421e-200 m across" },
  };
  for (const Case& c : cases)
  {
    ImportOptions options;
    c.limit(options);
    const std::string message = refusal(square("f 1 2 3 4\n"), options);
    EXPECT_TRUE(holds(message, c.words)) << message;
  }
}

TEST(ObjReader, RefusesOptionsThatMakeNoSense)
{
  ImportOptions options;
  options.scale = 0;
  EXPECT_THROW(import(square(), options), std::invalid_argument);
  options.scale = 1;
  options.weld_distance = -1;
  EXPECT_THROW(import(square(), options), std::invalid_argument);
}

TEST(ObjReader, ScalesToMetres)
{
  ImportOptions millimetres;
  millimetres.scale = 0.001;

  EXPECT_EQ(import(square(), millimetres).model.positions[2], Vec3d(0.001, 0.001, 0));
}

TEST(ObjReader, SaysWhatItIgnored)
{
  const ObjImport cloth =
      import("mtllib a.mtl\nusemtl red\nl 1 2\nl 2 3\np 1\nvp 0 0\ncurv 0 1 1 2\n" + square());

  EXPECT_TRUE(reports(cloth, 1, "\"mtllib\" is ignored"));
  EXPECT_TRUE(reports(cloth, 2, "\"usemtl\" is ignored"));
  EXPECT_TRUE(reports(cloth, 3, "\"l\" is ignored, like 1 more"));
  EXPECT_TRUE(reports(cloth, 5, "\"p\" is ignored"));
  EXPECT_TRUE(reports(cloth, 6, "\"vp\" is ignored"));
  EXPECT_TRUE(reports(cloth, 7, "\"curv\" is ignored"));
}

TEST(ObjReader, ReadsNumbersToTheNearestDouble)
{
  const char* const numbers[] = { "0.1",
                                  "-123.456789",
                                  "3.141592653589793115997963468544185161590576171875",
                                  "9007199254740993e-16",
                                  "123456789012345678e-17",
                                  "0.000000000000000000000000000000123",
                                  "4.9e-324",
                                  "1e-400",
                                  "2.2250738585072011e-308",
                                  "00000000000000000000000000001.5" };
  for (const char* number : numbers)
  {
    const ObjImport cloth =
        import("v 0 0 " + std::string(number) + "\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(cloth.model.positions[0].z(), std::strtod(number, nullptr)) << number;
  }
}

class CommaPoint : public std::numpunct<char>
{
protected:
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(ObjReader, DoesNotCareForTheLocale)
{
  const std::string text = "v 0.5 0 0.1234567890123456789\nv 1.25 0 0\nv 0 1.5e1 0\nf 1 2 3\n";
  const ObjImport here = import(text);
  const std::string refused = refusal("v 1234567.5 0 0\n" + square());

  const std::locale before = std::locale::global(std::locale(std::locale(), new CommaPoint));
  const std::string c_locale = std::setlocale(LC_ALL, nullptr);
  for (const char* german : { "de_DE.UTF-8", "de_DE.utf8", "de_DE" })
  {
    std::setlocale(LC_ALL, german);  // where it is installed
  }
  const ObjImport there = import(text);
  const std::string refused_there = refusal("v 1234567.5 0 0\n" + square());
  std::setlocale(LC_ALL, c_locale.c_str());
  std::locale::global(before);

  EXPECT_EQ(there.model.positions, here.model.positions);
  EXPECT_EQ(here.model.positions[1].x(), 1.25);
  EXPECT_EQ(refused_there, refused);
}

TEST(ObjReader, JoinsVerticesByIndexAloneAcrossATextureSeam)
{
  // The square's halves have islands of their own in the texture.
  const ObjImport cloth =
      import(std::string(SQUARE) +
             "vt 0 0\nvt 1 0\nvt 1 1\nvt 2 0\nvt 3 1\nvt 2 1\nf 1/1 2/2 3/3\nf 1/4 3/5 4/6\n");

  EXPECT_EQ(cloth.report.particles, 4);
  EXPECT_EQ(cloth.report.springs, 5);
  EXPECT_EQ(cloth.report.seam_edges, 1);
  EXPECT_EQ(cloth.model.triangles[0].uv[2], Vec2d(1, 1));
  EXPECT_EQ(cloth.model.triangles[1].uv[1], Vec2d(3, 1));
}

TEST(ObjReader, KeepsCoincidentVerticesApartUnlessAskedToWeldThem)
{
  const std::string two_sheets =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 1e-9\nv 0 1 0\nf 1 2 3\nf 4 5 6\n";
  const ObjImport apart = import(two_sheets);
  ImportOptions options;
  options.weld_distance = 1e-6;
  const ObjImport welded = import(two_sheets, options);

  EXPECT_EQ(apart.report.particles, 6);
  EXPECT_EQ(apart.report.pieces, 2);
  EXPECT_EQ(welded.report.particles, 4);
  EXPECT_EQ(welded.report.pieces, 1);
  EXPECT_EQ(welded.report.welded_vertices, 2);
  EXPECT_TRUE(reports(welded, 5, "vertex 5 is joined to vertex 3, 1e-09 m away"));
  EXPECT_TRUE(isClean(welded));
}

TEST(ObjReader, WeldsToTheNearestKeptVertexWithinTheDistance)
{
  // In a row 0.9 mm apart: each third one is kept, none creeps along the row.
  std::string text = "v 0 1 0\nv 1 1 0\n";
  for (int i = 0; i < 7; ++i)
  {
    text += "v " + std::to_string(0.0009 * i) + " 0 0\n";
  }
  ImportOptions options;
  options.weld_distance = 0.001;
  const ObjImport cloth = import(text + "f 1 3 2\nf 1 9 2\nf 1 4 5\nf 1 6 7\n", options);

  EXPECT_EQ(cloth.report.welded_vertices, 3);  // 4 to 3, 6 to 5, 8 to 7
}

TEST(ObjReader, CollapsesEdgesWithoutLengthAndSaysWhere)
{
  // A square of two quads whose shared side is doubled by a quad without width.
  const ObjImport cloth = import(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\n"
      "f 1 2 3 4\nf 2 5 8 3\nf 5 6 7 8\n");

  EXPECT_EQ(cloth.report.collapsed_edges, 2);
  EXPECT_EQ(cloth.report.dropped_faces, 1);
  EXPECT_EQ(cloth.report.particles, 6);
  EXPECT_EQ(cloth.report.triangles, 4);
  EXPECT_EQ(cloth.report.pieces, 1);
  EXPECT_TRUE(reports(cloth, 10, "the edge between vertices 2 and 5 has no length"));
  EXPECT_TRUE(reports(cloth, 10, "the edge between vertices 3 and 8 has no length"));
  EXPECT_TRUE(reports(cloth, 10, "the face has no area, vertices of it are joined; dropped"));
  EXPECT_EQ(cloth.report.unused_vertices, 0);
  EXPECT_TRUE(isClean(cloth));
}

TEST(ObjReader, CollapsesEdgesThatOnlyACollapseHasMadeTooShort)
{
  // 2 and 3 are too far apart to be joined, until 2 is joined to 1 between them.
  const ObjImport cloth = import(
      "v 0 0 0\nv 1.8e-6 0 0\nv -1.2e-6 0 0\nv 0 1 0\nv 1 0 0\nv -1 0 0\n"
      "f 2 3 4\nf 3 2 5\nf 1 2 5\nf 3 6 4\n");

  EXPECT_EQ(cloth.report.collapsed_edges, 2);
  EXPECT_EQ(cloth.report.particles, 3);
  EXPECT_TRUE(isClean(cloth));
}

TEST(ObjReader, JudgesFacesAgainAfterACollapse)
{
  // Two flaps stand on the edges 1-2 and 1-3, which become one when 2 and 3 are joined.
  const std::string message = refusal(
      "v 0 0 0\nv 1 0 0\nv 1 0 0\nv 0 1 0\nv 0 1 1\nv 0 0 1\n"
      "f 1 2 4\nf 2 1 5\nf 1 3 6\nf 2 3 5\n");

  EXPECT_TRUE(holds(message, "line 9: the edge between vertices 1 and 2 has 3 faces")) << message;
}

TEST(ObjReader, CutsTheFaceBeyondAVertexThatLiesOnItsEdge)
{
  //      4
  //    /   \        the face 1 3 2 has no area: 2 lies on the edge 1-3 of the face 1 3 4
  //  1 - 2 - 3
  //    \ | /
  //      5
  const ObjImport cloth = import(
      "v -1 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\n"
      "vt 0 .5\nvt .5 .5\nvt 1 .5\nvt .5 1\nvt .5 0\n"
      "f 1/1 3/3 4/4\nf 1/1 2/2 3/3\nf 1/1 5/5 2/2\nf 5/5 3/3 2/2\n");

  EXPECT_EQ(cloth.report.triangles, 4);
  EXPECT_EQ(cloth.report.dropped_faces, 1);
  EXPECT_EQ(cloth.report.borders, 1);
  EXPECT_EQ(cloth.report.border_springs, 4);
  EXPECT_NEAR(cloth.report.area, 2, 1e-12);
  EXPECT_EQ(cloth.report.seam_edges, 0);
  EXPECT_TRUE(reports(cloth, 12, "its vertex 2 lies on the edge between vertices 1 and 3"));
  EXPECT_TRUE(reports(cloth, 12, "the face beyond (line 11) is cut in two there"));
  EXPECT_TRUE(isClean(cloth));
}

// Splits the line from a to b at the points between them, in any order, by faces without area.
void addFlatFaces(int a, int b, const std::vector<int>& between, std::mt19937_64& random,
                  std::vector<std::string>& faces)
{
  if (between.empty())
  {
    return;
  }
  const auto middle = between.begin() + static_cast<std::ptrdiff_t>(random() % between.size());
  faces.push_back("f " + std::to_string(b) + " " + std::to_string(a) + " " +
                  std::to_string(*middle) + "\n");
  addFlatFaces(a, *middle, std::vector<int>(between.begin(), middle), random, faces);
  addFlatFaces(*middle, b, std::vector<int>(middle + 1, between.end()), random, faces);
}

TEST(ObjReader, TakesOutAnyNumberOfFlatFacesInAnyOrder)
{
  // Six points lie on each edge of the triangle 1 2 3; faces without area join them to it, and
  // beyond each edge they are the feet of a fan.
  constexpr int BETWEEN = 6;
  std::mt19937_64 random(17);
  const Vec2d corners[3] = { Vec2d(0, 0), Vec2d(7, 0), Vec2d(0, 7) };
  const Vec2d tips[3] = { Vec2d(3, -3), Vec2d(7, 7), Vec2d(-3, 3) };
  for (int i = 0; i < 300; ++i)
  {
    std::string text = "v 0 0 0\nv 7 0 0\nv 0 7 0\n";
    std::vector<std::string> faces = { "f 1 2 3\n" };
    int last = 3;
    for (int k = 0; k < 3; ++k)
    {
      const int a = k + 1;
      const int b = (k + 1) % 3 + 1;
      const Vec2d step = (corners[b - 1] - corners[k]) / (BETWEEN + 1);
      std::vector<int> between;
      for (int n = 1; n <= BETWEEN; ++n)
      {
        const Vec2d place = corners[k] + n * step;
        text += "v " + std::to_string(place.x()) + " " + std::to_string(place.y()) + " 0\n";
        between.push_back(++last);
      }
      addFlatFaces(a, b, between, random, faces);
      text += "v " + std::to_string(tips[k].x()) + " " + std::to_string(tips[k].y()) + " 0\n";
      const int tip = ++last;
      for (int n = 0; n <= BETWEEN; ++n)
      {
        const int from = n == 0 ? a : between[n - 1];
        const int to = n == BETWEEN ? b : between[n];
        faces.push_back("f " + std::to_string(to) + " " + std::to_string(from) + " " +
                        std::to_string(tip) + "\n");
      }
    }
    for (std::size_t n = faces.size() - 1; n > 0; --n)
    {
      std::swap(faces[n], faces[random() % (n + 1)]);
    }
    for (const std::string& face : faces)
    {
      text += face;
    }
    const ObjImport cloth = import(text);

    ASSERT_EQ(cloth.report.dropped_faces, 3 * BETWEEN) << text;
    ASSERT_EQ(cloth.report.border_springs, 6) << text;
    ASSERT_EQ(cloth.report.triangles, 1 + 3 * BETWEEN + 3 * (BETWEEN + 1)) << text;
    ASSERT_NEAR(cloth.report.area, 24.5 + 10.5 + 24.5 + 10.5, 1e-4) << text;
    ASSERT_TRUE(isClean(cloth)) << text;
  }
}

TEST(ObjReader, CutsTheTextureBeyondASeamAtTheSamePlace)
{
  // The face beyond has an island of its own: the cut at a quarter of its edge is at u = 5.25.
  const ObjImport cloth = import(
      "v 0 0 0\nv 1 0 0\nv 4 0 0\nv 0 1 0\nv 1 -1 0\n"
      "vt 0 0\nvt .1 0\nvt .4 0\nvt .1 -1\nvt 5 0\nvt 6 0\nvt 5 1\n"
      "f 1/5 3/6 4/7\nf 1/1 2/2 3/3\nf 1/1 5/4 2/2\nf 5/4 3/3 2/2\n");

  int found = 0;
  for (const ModelTriangle& t : cloth.model.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const bool beyond = std::count(t.vertices.begin(), t.vertices.end(), 3) > 0;
      if (beyond && t.vertices[k] == 1)
      {
        EXPECT_EQ(t.uv[k], Vec2d(5.25, 0));
        ++found;
      }
    }
  }
  EXPECT_EQ(found, 2);
  EXPECT_EQ(cloth.report.seam_edges, 2);
}

TEST(ObjReader, DropsAFlatFaceAtTheBorder)
{
  const ObjImport cloth = import(
      "v -1 0 0\nv 0 0 0\nv 1 0 0\nv 0 -1 0\n"
      "f 1 2 3\nf 1 4 2\nf 4 3 2\n");

  EXPECT_EQ(cloth.report.triangles, 2);
  EXPECT_EQ(cloth.report.borders, 1);
  EXPECT_TRUE(reports(cloth, 5, "no face lies beyond it; dropped"));
  EXPECT_TRUE(isClean(cloth));
}

TEST(ObjReader, CutsAFaceWithAVertexOnEachOfItsEdges)
{
  // 1 2 3 are the corners, 4 5 6 lie on its edges, 7 8 9 outside.
  const ObjImport cloth = import(
      "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 -1 0\nv 2 2 0\nv -1 1 0\n"
      "f 1 2 3\nf 2 1 4\nf 3 2 5\nf 1 3 6\n"
      "f 4 1 7\nf 2 4 7\nf 5 2 8\nf 3 5 8\nf 6 3 9\nf 1 6 9\n");

  EXPECT_EQ(cloth.report.triangles, 10);
  EXPECT_EQ(cloth.report.dropped_faces, 3);
  EXPECT_EQ(cloth.report.borders, 1);
  EXPECT_EQ(cloth.report.border_springs, 6);
  EXPECT_NEAR(cloth.report.area, 6, 1e-12);
  EXPECT_TRUE(isClean(cloth));
}

TEST(ObjReader, DropsAFlatFaceThatIsOneTooManyAtAnEdge)
{
  const ObjImport cloth = import(
      "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 1 1 0\nv 1 -1 0\n"
      "f 1 2 4\nf 2 3 4\nf 1 5 2\nf 2 5 3\nf 1 2 3\n");

  EXPECT_EQ(cloth.report.triangles, 4);
  EXPECT_EQ(cloth.report.borders, 1);
  EXPECT_TRUE(reports(cloth, 10, "too many at the edge between vertices 1 and 2; dropped"));
  EXPECT_TRUE(isClean(cloth));
}

TEST(ObjReader, TakesFlatFacesOutOneAfterTheOther)
{
  // A fan of flat faces under the edge 1-6: 2 to 5 lie on it.
  const ObjImport cloth = import(
      "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\nv 5 0 0\nv 2 1 0\nv 2 -1 0\n"
      "f 1 6 7\nf 1 2 3\nf 1 3 4\nf 1 4 5\nf 1 5 6\n"
      "f 1 8 2\nf 2 8 3\nf 3 8 4\nf 4 8 5\nf 5 8 6\n");

  EXPECT_EQ(cloth.report.triangles, 10);
  EXPECT_EQ(cloth.report.dropped_faces, 4);
  EXPECT_EQ(cloth.report.borders, 1);
  EXPECT_EQ(cloth.report.border_springs, 4);
  EXPECT_NEAR(cloth.report.area, 5, 1e-12);
  EXPECT_TRUE(isClean(cloth));
}

TEST(ObjReader, WindsFacesAlikeAndReportsEachItTurned)
{
  const ObjImport cloth = import(
      "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n"
      "f 1 2 5 4\nf 2 6 3\nf 2 6 5\n");

  EXPECT_EQ(cloth.report.turned_faces, 1);
  EXPECT_TRUE(reports(cloth, 8, "the face is wound against its neighbours, turned over"))
      << cloth.report.findings.front().line;
  for (const ModelTriangle& t : cloth.model.triangles)
  {
    const Vec3d& a = cloth.model.positions[t.vertices[0]];
    EXPECT_GT((cloth.model.positions[t.vertices[1]] - a)
                  .cross(cloth.model.positions[t.vertices[2]] - a)
                  .z(),
              0);
  }
  EXPECT_TRUE(isClean(cloth));
}

TEST(ObjReader, WindsFacesTheWayOfTheMajorityAndTurnsTheirTextureToo)
{
  const ObjImport cloth =
      import(std::string(SQUARE) + "v 2 0 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 2 0\n" +
             "f 1/1 3/3 2/2\nf 1/1 3/3 4/4\nf 2/2 5/5 3/3\n");

  EXPECT_EQ(cloth.report.turned_faces, 1);
  EXPECT_TRUE(reports(cloth, 11, "turned over"));
  for (const ModelTriangle& t : cloth.model.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_EQ(t.uv[k], Vec2d(cloth.model.positions[t.vertices[k]].head<2>()));
    }
  }
}

TEST(ObjReader, AcceptsBowTiesSeveralObjectsAndClosedSurfaces)
{
  const ObjImport bow_tie =
      import("v -1 -1 0\nv 0 0 0\nv -1 1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\nf 2 4 5\n");
  const ObjImport objects = import(
      "o left\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
      "o right\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf -3 -2 -1\n");
  const ObjImport pyramid = import(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
      "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");

  EXPECT_EQ(bow_tie.report.pieces, 1);
  EXPECT_EQ(bow_tie.report.borders, 2);
  EXPECT_EQ(objects.report.pieces, 2);
  EXPECT_EQ(pyramid.report.borders, 0);
  for (const ObjImport* cloth : { &bow_tie, &objects, &pyramid })
  {
    EXPECT_TRUE(isClean(*cloth));
  }
}

TEST(ObjReader, LeavesOutVerticesInNoFace)
{
  const ObjImport cloth = import("v 900 0 0\n" + square("f 2 3 4\nf 2 4 5\n"));

  EXPECT_EQ(cloth.report.particles, 4);
  EXPECT_EQ(cloth.report.unused_vertices, 1);
  EXPECT_EQ(cloth.report.highest, Vec3d(1, 1, 0));
  EXPECT_TRUE(reports(cloth, 1, "vertex 1 is in no face, left out"));
}

TEST(ObjReader, MakesUpTextureFromTheBroadSideOfTheModel)
{
  struct Case
  {
    const char* name;
    const char* vertices;
    int u, v;  // axes of the model
  };
  const Case cases[] = {
    { "thin in x", "v 0 0 0\nv 0.1 2 0\nv 0.1 2 4\nv 0 0 4\n", 2, 1 },
    { "thin in y", "v 0 0 0\nv 4 0.1 0\nv 4 0.1 2\nv 0 0 2\n", 0, 2 },
    { "thin in z", "v 0 0 0\nv 4 0 0.1\nv 4 2 0.1\nv 0 2 0\n", 0, 1 },
  };
  for (const Case& c : cases)
  {
    const ObjImport cloth = import(std::string(c.vertices) + "f 1 2 3 4\n");

    EXPECT_EQ(cloth.report.untextured_faces, 1) << c.name;
    EXPECT_TRUE(reports(cloth, 5, "has no texture coordinates; they are made up by projection"));
    for (const ModelTriangle& t : cloth.model.triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        const Vec3d& place = cloth.model.positions[t.vertices[k]];
        EXPECT_EQ(t.uv[k], Vec2d(place[c.u] / 4, place[c.v] / 4)) << c.name;
      }
    }
  }
}

TEST(ObjReader, MakesUpTextureWhereThatOfTheFileSpansNoArea)
{
  const ObjImport cloth = import(square("vt 0 0\nf 1/1 2/1 3/1 4/1\n"));

  EXPECT_TRUE(reports(cloth, 6, "texture coordinates that span no area; others are made up"));
  EXPECT_EQ(cloth.report.untextured_faces, 1);
  EXPECT_EQ(cloth.report.flat_texture, 0);
  EXPECT_EQ(cloth.model.triangles[0].uv[2], Vec2d(1, 1));
}

double shoelace(const std::vector<Vec2d>& corners)
{
  double twice_area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const Vec2d& a = corners[i];
    const Vec2d& b = corners[(i + 1) % corners.size()];
    twice_area += a.x() * b.y() - a.y() * b.x();
  }
  return twice_area / 2;
}

TEST(ObjPolygons, AreCutIntoTrianglesOfTheSameArea)
{
  struct Case
  {
    const char* name;
    std::vector<Vec2d> corners;
  };
  const Case cases[] = {
    { "arrow", { { 0, 0 }, { 2, 1 }, { 0, 2 }, { 0.5, 1 } } },
    { "L", { { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } } },
    { "corners on straight sides",
      { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 }, { 3, 3 }, { 2, 3 }, { 0, 3 }, { 0, 1 } } },
    { "triangle with a row on one side", { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 }, { 0, 3 } } },
    { "comb",
      { { 0, 0 },
        { 5, 0 },
        { 5, 3 },
        { 4, 3 },
        { 4, 1 },
        { 3, 1 },
        { 3, 3 },
        { 2, 3 },
        { 2, 1 },
        { 1, 1 },
        { 1, 3 },
        { 0, 3 } } },
    { "spiral",
      { { 0, 0 },
        { 5, 0 },
        { 5, 5 },
        { 1, 5 },
        { 1, 2 },
        { 3, 2 },
        { 3, 3 },
        { 2, 3 },
        { 2, 4 },
        { 4, 4 },
        { 4, 1 },
        { 0, 1 } } },
  };
  for (const Case& c : cases)
  {
    for (const bool tilted : { false, true })
    {
      for (const bool backwards : { false, true })
      {
        std::ostringstream text;
        std::string face = "f";
        for (std::size_t i = 0; i < c.corners.size(); ++i)
        {
          const Vec2d& p = c.corners[backwards ? c.corners.size() - 1 - i : i];
          text << "v " << p.x() * (tilted ? 0.6 : 1) << " " << p.y() << " "
               << p.x() * (tilted ? 0.8 : 0) << "\n";
          face += " " + std::to_string(i + 1);
        }
        const std::string file = text.str() + face + "\n";
        ASSERT_EQ(refusal(file), "accepted") << c.name;
        const ObjImport cloth = import(file);
        EXPECT_EQ(cloth.model.triangles.size(), c.corners.size() - 2) << c.name;
        EXPECT_NEAR(cloth.report.area, shoelace(c.corners), 1e-9) << c.name;
        EXPECT_EQ(cloth.report.turned_faces, 0) << c.name;
        EXPECT_TRUE(isClean(cloth)) << c.name;
        for (const ModelTriangle& t : cloth.model.triangles)
        {
          const Vec3d& a = cloth.model.positions[t.vertices[0]];
          const Vec3d normal = (cloth.model.positions[t.vertices[1]] - a)
                                   .cross(cloth.model.positions[t.vertices[2]] - a);
          EXPECT_EQ(normal.z() > 0, !backwards) << c.name;
        }
      }
    }
  }
}

TEST(ObjPolygons, AreCutWithoutSliversThatNeedNotBe)
{
  std::ostringstream text;
  std::string face = "f";
  for (int i = 0; i < 40; ++i)
  {
    text << "v " << std::cos(2 * M_PI * i / 40) << " " << std::sin(2 * M_PI * i / 40) << " 0\n";
    face += " " + std::to_string(i + 1);
  }
  // A quad of 1 x 0.1 corners has one good diagonal when it leans.
  const ObjImport leaning = import("v 0 0 0\nv 1 0 0\nv 1.9 1 0\nv .9 1 0\nf 1 2 3 4\n");
  const ObjImport disc = import(text.str() + face + "\n");

  EXPECT_GT(leaning.report.least_altitude, 0.65);
  EXPECT_GT(disc.report.least_altitude, 0.012);  // what the short sides of the circle allow
}

TEST(ObjPolygons, AvoidADiagonalThatIsTakenByAnotherFace)
{
  // A quad with a flap along its shorter diagonal.
  const ObjImport cloth = import(
      "v 0 0 0\nv 1 0 0\nv 1.1 1.1 0\nv 0 1 0\nv .5 .5 1\n"
      "f 1 2 3 4\nf 2 4 5\n");

  EXPECT_EQ(cloth.report.triangles, 3);
  EXPECT_TRUE(isClean(cloth));
}

TEST(ObjPolygons, OfAThousandCornersAreCutInNoTime)
{
  std::ostringstream text;
  std::string face = "f";
  for (int i = 0; i < 1000; ++i)
  {
    const double radius = i % 2 == 0 ? 1 : 0.5;
    text << "v " << radius * std::cos(2 * M_PI * i / 1000) << " "
         << radius * std::sin(2 * M_PI * i / 1000) << " 0\n";
    face += " " + std::to_string(i + 1);
  }
  EXPECT_EQ(import(text.str() + face).report.triangles, 998);
}

// A strip of quads and triangles with everything the format offers.
std::string richFile()
{
  return "# cloth\nmtllib m.mtl\no a\nv 0 0 0\nv 1 0 0 1 1 1\nv 2 0 0.5\nv 0 1 0\nv 1 1 0\nv 2 1 "
         "0\n"
         "v 0 2 0\nv 1 2 -0.25\nv 2 2 1e-1\nvt 0 0\nvt 1 0 0\nvt 0.5\nvn 0 0 1\n"
         "f 1/1/1 2/2/1 5/3/1 4/1/1\nf 2//1 3//1 6//1 \\\n5//1\nf -6 -5 -2\nf 4 8 7\nf 5 6 9 8\n"
         "l 1 2 3\ng b\nv 5 5 5\nv 5 5 5\nv 6 5 5\nv 5 6 5\nf 10 11 12\nf 11 12 13\n";
}

class Mutator
{
public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  std::string mutate(std::string text)
  {
    static const char* const PIECES[] = { "nan",         "1e400",    "-1", "0",         "/",
                                          "//",          "\\\n",     "\r", "f ",        "v ",
                                          "vt ",         "9",        ".",  "e",         "-",
                                          "#",           " ",        "\n", "f 1 2 3\n", "f 3 2 1\n",
                                          "f 4 5 6 7\n", "v 1 1 0\n" };
    for (std::size_t count = 1 + below(6); count > 0 && !text.empty(); --count)
    {
      const std::size_t at = below(text.size());
      switch (below(5))
      {
        case 0:
          text[at] = static_cast<char>(below(256));
          break;
        case 1:
          text.erase(at, 1 + below(12));
          break;
        case 2:
          text.insert(at, PIECES[below(sizeof(PIECES) / sizeof(*PIECES))]);
          break;
        case 3:
          text.insert(below(text.size()), text.substr(at, 1 + below(40)));
          break;
        default:
          text[at] = static_cast<char>('0' + below(10));
      }
    }
    return text;
  }

private:
  std::size_t below(std::size_t limit) { return random_() % limit; }

  std::mt19937_64 random_;
};

TEST(ObjReader, AcceptsCleanlyOrRefusesWithAReasonWhateverIsInTheFile)
{
  Mutator mutator(7);
  const std::string seed = richFile();
  int accepted = 0;
  int refused = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const std::string text = mutator.mutate(seed);
    ImportOptions options;
    options.weld_distance = i % 3 == 0 ? 0.3 : 0;
    try
    {
      ASSERT_TRUE(isClean(import(text, options))) << text;
      ++accepted;
    }
    catch (const ImportError& error)
    {
      ASSERT_TRUE(holds(error.what(), "cloth.obj: ") || holds(error.what(), "cloth.obj, line "));
      ++refused;
    }
  }
  EXPECT_GT(accepted, 1000);
  EXPECT_GT(refused, 1000);
}

// Random triangles over points on a coarse lattice: collapses, flat faces, overlaps, one-sidedness.
TEST(ObjReader, AcceptsCleanlyOrRefusesWithAReasonWhateverTheTopology)
{
  std::mt19937_64 random(11);
  const auto below = [&random](std::size_t limit) { return static_cast<int>(random() % limit); };
  int accepted = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const int vertices = 4 + below(8);
    std::string text;
    for (int v = 0; v < vertices; ++v)
    {
      text += "v " + std::to_string(below(4)) + " " + std::to_string(below(4)) + " " +
              std::to_string(below(2)) + "\n";
    }
    for (int f = 1 + below(6); f > 0; --f)
    {
      text += "f";
      const int first = below(vertices);
      const int step = 1 + below(2);
      for (int k = 0; k < 3 + below(2); ++k)
      {
        text += " " + std::to_string((first + k * step) % vertices + 1);
      }
      text += "\n";
    }
    try
    {
      ASSERT_TRUE(isClean(import(text))) << text;
      ++accepted;
    }
    catch (const ImportError&)
    {
    }
  }
  EXPECT_GT(accepted, 1000);
}

// A disc of cloth crumpled onto a few points and lines: edges without length and flat faces by the
// dozen, side by side.
TEST(ObjReader, AcceptsCleanlyOrRefusesWithAReasonHoweverCrumpledTheCloth)
{
  std::mt19937_64 random(13);
  RectangleParams params;
  params.columns = params.rows = 5;
  int accepted = 0;
  int mended = 0;
  for (int i = 0; i < 5000; ++i)
  {
    params.pattern = i % 2 == 0 ? RectanglePattern::ALTERNATING : RectanglePattern::ONE_DIAGONAL;
    const ClothModel disc = rectangle(params);
    std::string text;
    for (std::size_t v = 0; v < disc.positions.size(); ++v)
    {
      const bool moved = random() % 3 == 0;
      const int x = static_cast<int>(moved ? random() % 5 : v % 5);
      const int y = static_cast<int>(moved ? random() % 5 : v / 5);
      text += "v " + std::to_string(x) + " " + std::to_string(y) + " 0\n";
    }
    for (const ModelTriangle& t : disc.triangles)
    {
      text += "f " + std::to_string(t.vertices[0] + 1) + " " + std::to_string(t.vertices[1] + 1) +
              " " + std::to_string(t.vertices[2] + 1) + "\n";
    }
    try
    {
      const ObjImport cloth = import(text);
      ASSERT_TRUE(isClean(cloth)) << text;
      ++accepted;
      mended += cloth.report.dropped_faces;
    }
    catch (const ImportError& error)
    {
      ASSERT_TRUE(holds(error.what(), "cloth.obj, line ")) << error.what();
    }
  }
  EXPECT_GT(accepted, 1000);
  EXPECT_GT(mended, 5000);
}

TEST(ObjReader, SaysThatAFileCannotBeOpenedOrRead)
{
  for (const char* path : { "/no/such/file.obj", "/", "" })
  {
    EXPECT_THROW(readObjFile(path), ImportError);
  }
}

TEST(ShippedModels, ImportWithoutAFinding)
{
  struct Case
  {
    const char* name;
    int borders;
    bool has_seams;
  };
  for (const Case& c : { Case{ "towel", 1, false }, Case{ "tunic", 4, true } })
  {
    const ObjImport cloth =
        readObjFile(std::string(CLOTH_TEARING_SOURCE_DIR) + "/models/" + c.name + ".obj");

    EXPECT_TRUE(cloth.report.findings.empty()) << c.name;
    EXPECT_EQ(cloth.report.pieces, 1) << c.name;
    EXPECT_EQ(cloth.report.borders, c.borders) << c.name;
    EXPECT_EQ(cloth.report.seam_edges > 0, c.has_seams) << c.name;
    EXPECT_GE(cloth.report.triangles, 1000) << c.name;
    EXPECT_LE(cloth.report.triangles, 2000) << c.name;
    EXPECT_EQ(cloth.report.highest.y(), 0) << c.name;
    EXPECT_TRUE(isClean(cloth)) << c.name;
  }
}

class StrangersGarments : public testing::Test
{
protected:
  void SetUp() override
  {
    if (!std::ifstream(path("tshirt_0")))
    {
      GTEST_SKIP() << "the garments of others are not beside this package";
    }
  }

  static std::string path(const std::string& name)
  {
    return std::string(CLOTH_TEARING_SOURCE_DIR) + "/../shared/meshes/dedo/" + name + ".obj";
  }
};

TEST_F(StrangersGarments, ImportCleanly)
{
  struct Case
  {
    const char* name;
    int particles, triangles, borders, collapsed, dropped;
  };
  const Case cases[] = {
    { "tshirt_0", 544, 1018, 4, 44, 88 },     { "mask_0", 401, 628, 3, 0, 0 },
    { "button_cloth", 392, 686, 3, 0, 0 },    { "vest_00", 423, 728, 3, 0, 0 },
    { "generated_cloth", 385, 674, 2, 0, 0 },
  };
  for (const Case& c : cases)
  {
    const ObjImport cloth = readObjFile(path(c.name));

    EXPECT_EQ(cloth.report.particles, c.particles) << c.name;
    EXPECT_EQ(cloth.report.triangles, c.triangles) << c.name;
    EXPECT_EQ(cloth.report.pieces, 1) << c.name;
    EXPECT_EQ(cloth.report.borders, c.borders) << c.name;
    EXPECT_EQ(cloth.report.collapsed_edges, c.collapsed) << c.name;
    EXPECT_EQ(cloth.report.dropped_faces, c.dropped) << c.name;
    EXPECT_TRUE(isClean(cloth)) << c.name;
  }
}

TEST_F(StrangersGarments, AreRefusedNamingTheirNonManifoldEdges)
{
  try
  {
    readObjFile(path("apron_0"));
    FAIL() << "the apron was accepted";
  }
  catch (const ImportError& error)
  {
    const std::string message = error.what();
    EXPECT_TRUE(holds(message,
                      "apron_0.obj, line 1405: the edge between vertices 170 and 173 has 3 "
                      "faces (lines 1188, 1190, 1405)"))
        << message;
    EXPECT_TRUE(holds(message, "the edge between vertices 17 and 22 has 3 faces")) << message;
  }
}

}  // namespace
}  // namespace cloth
