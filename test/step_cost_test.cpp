// Claims about the cost of a step that depend on no clock: counted instructions.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "child_process.h"

namespace
{

const char* const STORE = CLOTH_TEARING_SOURCE_DIR "/test/step_cost.txt";

/// How the figures are renewed.
const char* const RENEW = "CLOTH_TEARING_RENEW_STEP_COST=1 " CLOTH_TEARING_STEP_COST_TEST;

/// Of the least figure that fails over the one in store.
constexpr double MARGIN = 1.15;

/// Instructions differ from compiler to compiler.
const char* const COMPILER = CLOTH_TEARING_COMPILER;

/// The figures in store, by solver, and of which compiler they are.
struct Store
{
  std::string compiler;
  std::map<std::string, double> instructions;
};

/// Lines "compiler: TEXT" and "SOLVER: INSTRUCTIONS"; those with # are for readers.
Store readStore()
{
  Store store;
  std::ifstream file(STORE);
  for (std::string line; std::getline(file, line);)
  {
    const std::size_t colon = line.find(": ");
    if (line.empty() || line[0] == '#' || colon == std::string::npos)
    {
      continue;
    }
    const std::string name = line.substr(0, colon);
    const std::string value = line.substr(colon + 2);
    if (name == "compiler")
    {
      store.compiler = value;
    }
    else
    {
      store.instructions[name] = std::stod(value);
    }
  }
  return store;
}

void writeStore(const Store& store)
{
  std::ofstream file(STORE);
  file << "# Instructions of a step of 30 x 30 particles with the loops for AVX2, as callgrind "
          "counts "
          "them.\n# Written by step_cost_test with CLOTH_TEARING_RENEW_STEP_COST=1.\n"
       << "compiler: " << store.compiler << "\n";
  for (const auto& [solver, instructions] : store.instructions)
  {
    file << solver << ": " << static_cast<long long>(instructions) << "\n";
  }
  ASSERT_TRUE(file.flush()) << STORE;
}

/// What callgrind counted, and with which loops.
struct Count
{
  std::string loops;
  double instructions = 0.0;
};

Count countSteps(const std::string& solver, int steps)
{
  ChildProcess valgrind(
      { "env", "CLOTH_TEARING_SIMD=avx2", "valgrind", "--tool=callgrind",
        "--callgrind-out-file=/dev/null", CLOTH_TEARING_STEP_COST, solver, std::to_string(steps) },
      100);
  Count count;
  std::string said;
  for (std::string line; valgrind.readLine(line);)
  {
    said += line + "\n";
    const std::size_t at = line.find("Collected : ");
    if (at != std::string::npos)
    {
      count.instructions = std::stod(line.substr(at + 12));
    }
    if (line.rfind("loops: ", 0) == 0)
    {
      count.loops = line.substr(7);
    }
  }
  EXPECT_EQ(valgrind.exitStatus(), 0) << said;
  EXPECT_GT(count.instructions, 0.0) << said;
  return count;
}

class StepCost : public testing::TestWithParam<const char*>
{
};

TEST_P(StepCost, DoesNotGrow)
{
  const std::string solver = GetParam();
  const bool renew = std::getenv("CLOTH_TEARING_RENEW_STEP_COST") != nullptr;
  Store store = readStore();
  if (!renew && store.compiler != COMPILER)
  {
    GTEST_SKIP() << "instructions of a step are known for " << store.compiler << ", this is "
                 << COMPILER;
  }
  if (!ChildProcess({ "valgrind", "--version" }, 20).says("valgrind-"))
  {
    GTEST_SKIP() << "there is no valgrind: instructions of a step are not counted";
  }
  constexpr int STEPS = 100;
  const Count once = countSteps(solver, STEPS);
  if (once.loops != "avx2")
  {
    GTEST_SKIP() << "this processor has no AVX2: instructions of a step are not counted";
  }
  // The difference has nothing of the start.
  const double now = (countSteps(solver, 2 * STEPS).instructions - once.instructions) / STEPS;
  RecordProperty("instructions", std::to_string(now));
  if (renew)
  {
    store.compiler = COMPILER;
    store.instructions[solver] = now;
    writeStore(store);
    return;
  }
  ASSERT_EQ(store.instructions.count(solver), 1u)
      << "none in " << STORE << "; renew with " << RENEW;
  const double known = store.instructions[solver];
  EXPECT_LT(now, MARGIN * known) << "a step of " << solver << " took " << known
                                 << " instructions and now takes " << now << ": "
                                 << 100.0 * (now / known - 1.0)
                                 << " % more. If that is right, renew what is in store: " << RENEW;
  std::cout << solver << ": " << now << " instructions a step, in store " << known << "\n";
}

INSTANTIATE_TEST_SUITE_P(Of, StepCost, testing::Values("xpbd", "force_springs"),
                         [](const auto& solver) { return std::string(solver.param); });

}  // namespace
