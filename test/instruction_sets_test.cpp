// Claims about the built library: on an old processor nothing runs that it does not know.
#include <gtest/gtest.h>

#include <cctype>
#include <set>
#include <sstream>
#include <string>

#include "child_process.h"

namespace
{

/// What objdump says of a function: its name, and whether it has instructions of AVX, whose names
/// all begin with a v, or registers wider than SSE's.
struct Function
{
  std::string name;
  bool avx = false;
  bool wide = false;
};

/// @return the name in a line like "0000000000001234 <name>:", else nothing
std::string nameIn(const std::string& line)
{
  const std::size_t from = line.find(" <");
  const bool begins = !line.empty() && std::isxdigit(static_cast<unsigned char>(line[0])) != 0;
  return begins && from != std::string::npos && line.back() == ':'
             ? line.substr(from + 2, line.size() - from - 4)
             : std::string();
}

/// @return the instruction in a line like "  1234:<tab>instruction", else nothing
std::string instructionIn(const std::string& line)
{
  const std::size_t tab = line.find(":\t");
  return tab == std::string::npos ? std::string() : line.substr(tab + 2);
}

/// Instructions for virtual machines and segments have such names, too.
bool isAvx(const std::string& instruction)
{
  static const std::set<std::string> others = { "verr", "verw", "vmcall", "vmlaunch", "vmresume" };
  return !instruction.empty() && instruction[0] == 'v' &&
         others.count(instruction.substr(0, instruction.find(' '))) == 0;
}

std::vector<Function> functionsOf(const std::string& library)
{
  ChildProcess objdump({ "objdump", "--disassemble", "--demangle", "--no-show-raw-insn", library },
                       120);
  std::vector<Function> functions;
  for (std::string line; objdump.readLine(line);)
  {
    const std::string name = nameIn(line);
    if (!name.empty())
    {
      functions.push_back({ name });
    }
    const std::string instruction = instructionIn(line);
    if (functions.empty() || instruction.empty())
    {
      continue;
    }
    functions.back().avx |= isAvx(instruction);
    functions.back().wide |= instruction.find("%zmm") != std::string::npos ||
                             instruction.find("%ymm") != std::string::npos;
  }
  EXPECT_EQ(objdump.exitStatus(), 0) << "objdump " << library;
  return functions;
}

bool isOf(const std::string& name_space, const Function& function)
{
  return function.name.find("cloth::kernels::" + name_space + "::") != std::string::npos;
}

bool mayHaveAvx(const Function& function)
{
  return isOf("avx2", function) || isOf("avx512", function);
}

/// @return why instructions cannot be looked at, or need not be; empty if they can
std::string hindrance()
{
  const std::string flags = CLOTH_TEARING_OWN_FLAGS;
  if (flags.find("-march=") != std::string::npos || flags.find("-mavx") != std::string::npos)
  {
    return "built for certain processors (" + flags + "): its instructions are as wanted";
  }
  return ChildProcess({ "objdump", "--version" }, 20).says("GNU objdump")
             ? ""
             : "there is no objdump: instructions are not looked at";
}

}  // namespace

TEST(CoreLibrary, HasAvxInstructionsOnlyInTheLoopsMadeForThem)
{
  const std::string why_not = hindrance();
  if (!why_not.empty())
  {
    GTEST_SKIP() << why_not;
  }
  const std::vector<Function> functions = functionsOf(CLOTH_TEARING_CORE_LIBRARY);
  int plain = 0;
  int wide = 0;
  for (const Function& function : functions)
  {
    EXPECT_TRUE(mayHaveAvx(function) || !(function.avx || function.wide)) << function.name;
    wide += mayHaveAvx(function) && function.wide ? 1 : 0;
    plain += isOf("plain", function) ? 1 : 0;
  }
  EXPECT_GT(plain, 0) << "of " << functions.size() << " functions";
  EXPECT_GT(wide, 0) << "of " << functions.size() << " functions";
}

TEST(ObjectsMadeForAvx, HaveNothingThatTheLinkerMayTakeForOthers)
{
  const std::string why_not = hindrance();
  if (!why_not.empty())
  {
    GTEST_SKIP() << why_not;
  }
  int objects = 0;
  std::istringstream names(CLOTH_TEARING_AVX_OBJECTS);
  for (std::string object; std::getline(names, object, ':'); ++objects)
  {
    for (const Function& function : functionsOf(object))
    {
      EXPECT_TRUE(mayHaveAvx(function)) << function.name << " in " << object;
    }
  }
  EXPECT_EQ(objects, 2);
}
