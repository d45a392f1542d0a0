// Claims of the command check_mesh: what it prints and with which status it ends.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <string>

namespace
{

struct Answer
{
  std::string output;  // what it printed, errors too
  int status = -1;     // what it exited with
};

Answer checkMesh(const std::string& arguments)
{
  Answer answer;
  FILE* const pipe =
      popen((std::string("'") + CHECK_MESH + "' " + arguments + " 2>&1").c_str(), "r");
  if (pipe == nullptr)
  {
    return answer;
  }
  std::array<char, 256> part;
  while (fgets(part.data(), static_cast<int>(part.size()), pipe) != nullptr)
  {
    answer.output += part.data();
  }
  const int status = pclose(pipe);
  answer.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return answer;
}

// A file that lives as long as the test that looks at it.
class File
{
public:
  explicit File(const std::string& text) : path_(testing::TempDir() + "check_mesh_test.obj")
  {
    std::ofstream(path_) << text;
  }
  ~File() { std::remove(path_.c_str()); }

  const std::string& path() const { return path_; }

private:
  std::string path_;
};

bool holds(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

const char SQUARE_IN_TWO[] =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 1 1 0\nv 0 1 0\nv 0 0 0\n"
    "f 1 2 3\nf 4 5 6\n";

TEST(CheckMesh, CountsWhatBecomesOfAFile)
{
  const File file("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\nf 1 4 3\n");

  const Answer answer = checkMesh(file.path());

  EXPECT_EQ(answer.status, 0);
  for (const char* line :
       { ": accepted\n", "5 vertices, 0 texture vertices, 2 faces",
         "4 particles, 5 springs, 2 triangles, 1 piece\n", "borders:  1, of 4 springs",
         "size:     2 x 1 x 0 m, area 2 m^2", "edges:    1 to 2.23607 m",
         "0 faces dropped, 1 face turned over, 1 vertex left out",
         "line 7: the face is wound against its neighbours, turned over",
         "line 5: vertex 5 is in no face, left out" })
  {
    EXPECT_TRUE(holds(answer.output, line)) << line << "\n" << answer.output;
  }
}

TEST(CheckMesh, EndsWithOneIfAnyFileIsRefusedAndStillChecksTheOthers)
{
  const File good(SQUARE_IN_TWO);

  const Answer answer = checkMesh("/no/such/file.obj " + good.path());

  EXPECT_EQ(answer.status, 1);
  EXPECT_TRUE(holds(answer.output, "/no/such/file.obj: it cannot be opened")) << answer.output;
  EXPECT_TRUE(holds(answer.output, good.path() + ": accepted")) << answer.output;
}

TEST(CheckMesh, TakesScaleAndWeldDistance)
{
  const File file(SQUARE_IN_TWO);

  const Answer apart = checkMesh(file.path());
  const Answer welded = checkMesh("--weld-distance 0.001 --scale 0.01 " + file.path());

  EXPECT_TRUE(holds(apart.output, "2 pieces")) << apart.output;
  EXPECT_TRUE(holds(welded.output, "1 piece\n")) << welded.output;
  EXPECT_TRUE(holds(welded.output, "2 vertices welded")) << welded.output;
  EXPECT_TRUE(holds(welded.output, "size:     0.01 x 0.01 x 0 m")) << welded.output;
}

TEST(CheckMesh, JoinsFindingsThatSayTheSame)
{
  const File file(
      "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 3 0 0\nv 3 1 0\n"
      "f 1 2 5\nf 1 5 4\nf 2 3 6\nf 6 5 2\nf 7 3 8\nf 6 8 3\n");

  EXPECT_TRUE(holds(checkMesh(file.path()).output,
                    "lines 13-14: the face is wound against its neighbours, turned over (2 times)"))
      << checkMesh(file.path()).output;
}

TEST(CheckMesh, ListsFindingsOfOneKindOnceWithTheFirstPlaces)
{
  std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  for (int i = 0; i < 8; ++i)
  {
    text += "v 0 0 1\nvn 0 0 1\n";  // on every other line, so each place stands alone
  }
  const File file(text + "f 1 2 3\n");

  const std::string output = checkMesh(file.path()).output;

  EXPECT_TRUE(holds(output,
                    "lines 4, 6, 8, 10, 12, ...: vertex 4 is in no face, left out "
                    "(8 like this)\n"))
      << output;
  EXPECT_FALSE(holds(output, "vertex 5 is in no face")) << output;
}

TEST(CheckMesh, RefusesAFileInMillimetresAsTheNodeDoes)
{
  const File file("v 0 0 0\nv 1500 0 0\nv 0 1500 0\nf 1 2 3\n");

  const Answer as_it_is = checkMesh(file.path());
  const Answer scaled = checkMesh("--scale 0.001 " + file.path());

  EXPECT_EQ(as_it_is.status, 1);
  EXPECT_TRUE(holds(as_it_is.output,
                    "line 2: a coordinate of 1500 m, must be at most 1000 m: "
                    "scale it down (--scale, import/scale)"))
      << as_it_is.output;
  EXPECT_EQ(scaled.status, 0) << scaled.output;
}

TEST(CheckMesh, EndsWithTwoAndItsUsageIfItIsCalledWrongly)
{
  struct Case
  {
    const char* arguments;
    const char* words;
  };
  const Case cases[] = {
    { "", "no file is given" },
    { "--scale 2", "no file is given" },
    { "--scale", "--scale needs a number" },
    { "--scale x a.obj", "--scale needs a number, not \"x\"" },
    { "--scale 1m a.obj", "--scale needs a number, not \"1m\"" },
    { "--scale '' a.obj", "--scale needs a number, not \"\"" },
    { "--scale 0 a.obj", "scale is 0" },
    { "--scale nan a.obj", "scale is nan" },
    { "--weld-distance -1 a.obj", "weld_distance is -1" },
    { "--colour a.obj", "unknown option --colour" },
  };
  for (const Case& c : cases)
  {
    const Answer answer = checkMesh(c.arguments);
    EXPECT_EQ(answer.status, 2) << c.arguments;
    EXPECT_TRUE(holds(answer.output, c.words)) << answer.output;
    EXPECT_TRUE(holds(answer.output, "usage: check_mesh")) << answer.output;
  }
}

TEST(CheckMesh, ShowsItsUsageOnRequest)
{
  const Answer answer = checkMesh("--help");

  EXPECT_EQ(answer.status, 0);
  EXPECT_TRUE(holds(answer.output, "usage: check_mesh"));
}

}  // namespace
