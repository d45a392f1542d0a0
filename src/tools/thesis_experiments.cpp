// Runs the experiments of the thesis' chapter 4 and says whether their claims hold.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/obj_writer.h"
#include "cloth_tearing/experiments/ball_experiment.h"
#include "cloth_tearing/experiments/thesis_world.h"

namespace cloth
{
namespace
{

constexpr int CLAIM_FAILED = 1;
constexpr int WRONG_USAGE = 2;

constexpr double SETTLING = 6.0;  ///< [s]

const char* const USAGE = R"(usage: thesis_experiments EXPERIMENT [OPTION ...]

Runs an experiment of the thesis' chapter 4, prints a table, and ends with 0 only if what the
experiment claims holds: 1 if it does not, 2 for wrong usage.

experiments:
  balls            4.1: five balls; three tear the cloth, two slide off it

options:
  --resolution N   particles along either side of the cloth, 4 to 500 (default 30)
  --mesh NAME      one_diagonal, alternating, irregular, or all (default all)
  --seed N         of irregular meshes (default 1)
  --solver NAME    xpbd or force_springs (default xpbd)
  --time-step S    [s] (default 0.001)
  --output DIR     writes a row a run to DIR/balls.csv, and the cloth after each as an OBJ file
  --help           this text
)";

class UsageError : public std::runtime_error
{
  using std::runtime_error::runtime_error;
};

struct Options
{
  std::string experiment;
  int resolution = 30;
  std::vector<std::string> meshes = { "one_diagonal", "alternating", "irregular" };
  std::uint64_t seed = 1;
  SolverKind solver = SolverKind::XPBD;
  double time_step = 0.001;
  std::string output;
};

double number(const std::string& option, const std::string& text)
{
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0')
  {
    throw UsageError(option + " is \"" + text + "\", must be a number");
  }
  return value;
}

int wholeNumber(const std::string& option, const std::string& text, int low, int high)
{
  const double value = number(option, text);
  if (!(value >= low && value <= high) || value != static_cast<int>(value))
  {
    throw UsageError(option + " is " + text + ", must be a whole number from " +
                     std::to_string(low) + " to " + std::to_string(high));
  }
  return static_cast<int>(value);
}

void apply(Options& options, const std::string& option, const std::string& value)
{
  if (option == "--resolution")
  {
    options.resolution = wholeNumber(option, value, 4, 500);
  }
  else if (option == "--mesh")
  {
    if (value != "all")
    {
      rectanglePattern(value);  // throws for a wrong name
      options.meshes = { value };
    }
  }
  else if (option == "--seed")
  {
    options.seed = static_cast<std::uint64_t>(wholeNumber(option, value, 0, 1000000000));
  }
  else if (option == "--solver")
  {
    if (value != "xpbd" && value != "force_springs")
    {
      throw UsageError("--solver is \"" + value + "\", must be xpbd or force_springs");
    }
    options.solver = value == "xpbd" ? SolverKind::XPBD : SolverKind::FORCE_SPRINGS;
  }
  else if (option == "--time-step")
  {
    options.time_step = number(option, value);
  }
  else if (option == "--output")
  {
    options.output = value;
  }
  else
  {
    throw UsageError("there is no option " + option);
  }
}

Options parse(const std::vector<std::string>& arguments)
{
  Options options;
  for (std::size_t i = 0; i < arguments.size(); ++i)
  {
    const std::string& word = arguments[i];
    if (word.compare(0, 2, "--") != 0)
    {
      if (!options.experiment.empty())
      {
        throw UsageError("one experiment at a time: " + options.experiment + " or " + word);
      }
      options.experiment = word;
    }
    else if (i + 1 == arguments.size())
    {
      throw UsageError(word + " needs a value");
    }
    else
    {
      apply(options, word, arguments[++i]);
    }
  }
  return options;
}

/// The folder and the table that --output asks for; does nothing without it.
class Output
{
public:
  Output(const std::string& folder, const std::string& table, const std::string& header)
      : folder_(folder)
  {
    if (folder_.empty())
    {
      return;
    }
    std::filesystem::create_directories(folder_);
    table_.open(folder_ / table);
    row(header);
  }

  void row(const std::string& text)
  {
    if (folder_.empty())
    {
      return;
    }
    table_ << text << '\n';
    if (!table_.flush())
    {
      throw std::runtime_error("cannot write to " + folder_.string());
    }
  }

  void snapshot(const std::string& name, const Simulation& simulation)
  {
    if (folder_.empty())
    {
      return;
    }
    std::ofstream file(folder_ / name);
    writeObj(file, simulation.snapshot().surface);
    if (!file.flush())
    {
      throw std::runtime_error("cannot write " + (folder_ / name).string());
    }
  }

private:
  std::filesystem::path folder_;
  std::ofstream table_;
};

std::string csv(const std::vector<std::string>& fields)
{
  std::string row = fields.front();
  for (std::size_t i = 1; i < fields.size(); ++i)
  {
    row += ',' + fields[i];
  }
  return row;
}

/// @return whether all five end as in the thesis
bool ballsOn(const std::string& mesh, const Options& options, Output& output)
{
  SimulationParams params = thesisParams(options.solver);
  params.solver.time_step = options.time_step;
  const Simulation hung = hungCloth(
      thesisSheet(options.resolution, rectanglePattern(mesh), options.seed), params, SETTLING);
  bool all = true;
  for (std::size_t i = 0; i < THESIS_THROWS.size(); ++i)
  {
    const BallThrow& thrown = THESIS_THROWS[i];
    Simulation simulation = hung;
    const BallOutcome outcome = throwBall(simulation, thrown);
    const bool agrees = outcome.agrees(thrown);
    all = all && agrees;
    const char* const what = outcome.toreThrough()  ? "torn through"
                             : outcome.total() == 0 ? "not torn"
                                                    : "torn, not through";
    std::printf("%-13s %-17s %-18s basic %3d  weak %3d  one %3d  released %d  pieces %d  %s\n",
                mesh.c_str(), thrown.name, what, outcome.tears[0], outcome.tears[1],
                outcome.tears[2], outcome.tears[3], outcome.pieces,
                agrees ? "ok" : "NOT AS IN THE THESIS");
    std::fflush(stdout);
    output.row(csv({ mesh, std::to_string(options.resolution), std::to_string(options.seed),
                     options.solver == SolverKind::XPBD ? "xpbd" : "force_springs",
                     text(options.time_step), std::to_string(i + 1), text(thrown.radius),
                     text(thrown.speed), text(thrown.height), std::to_string(outcome.tears[0]),
                     std::to_string(outcome.tears[1]), std::to_string(outcome.tears[2]),
                     std::to_string(outcome.tears[3]), outcome.slid ? "1" : "0",
                     std::to_string(outcome.pieces), text(outcome.torn_length),
                     text(outcome.peak_strain), agrees ? "1" : "0" }));
    output.snapshot("balls_" + mesh + "_" + std::to_string(i + 1) + ".obj", simulation);
  }
  return all;
}

bool balls(const Options& options)
{
  Output output(options.output, "balls.csv",
                "mesh,resolution,seed,solver,time_step,experiment,radius,speed,height,basic,weak,"
                "one_point,released,slid,pieces,torn_length,peak_strain,as_in_thesis");
  bool all = true;
  for (const std::string& mesh : options.meshes)
  {
    all = ballsOn(mesh, options, output) && all;
  }
  std::printf(all ? "all as in the thesis\n" : "not all as in the thesis\n");
  return all;
}

int run(const std::vector<std::string>& arguments)
{
  static const std::map<std::string, bool (*)(const Options&)> EXPERIMENTS = { { "balls", balls } };
  const Options options = parse(arguments);
  const auto experiment = EXPERIMENTS.find(options.experiment);
  if (experiment == EXPERIMENTS.end())
  {
    throw UsageError(options.experiment.empty() ? "name an experiment"
                                                : "there is no experiment " + options.experiment);
  }
  return experiment->second(options) ? EXIT_SUCCESS : CLAIM_FAILED;
}

}  // namespace
}  // namespace cloth

int main(int argc, char** argv)
{
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  for (const std::string& word : arguments)
  {
    if (word == "--help" || word == "-h")
    {
      std::cout << cloth::USAGE;
      return EXIT_SUCCESS;
    }
  }
  try
  {
    return cloth::run(arguments);
  }
  catch (const cloth::Refusal& refusal)
  {
    std::cerr << "thesis_experiments: " << refusal.what() << '\n';
  }
  catch (const std::invalid_argument& wrong)
  {
    std::cerr << "thesis_experiments: " << wrong.what() << '\n';
  }
  catch (const cloth::UsageError& wrong)
  {
    std::cerr << "thesis_experiments: " << wrong.what() << "; see --help\n";
  }
  catch (const std::exception& failure)
  {
    std::cerr << "thesis_experiments: " << failure.what() << '\n';
    return cloth::CLAIM_FAILED;
  }
  return cloth::WRONG_USAGE;
}
