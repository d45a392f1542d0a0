// Runs the experiments of the thesis' chapter 4 and says whether their claims hold.
#include <cstdlib>
#include <iostream>

#include "cloth_tearing/core/refusal.h"
#include "experiment_commands.h"

namespace cloth
{
namespace
{

constexpr int CLAIM_FAILED = 1;
constexpr int WRONG_USAGE = 2;

const char* const USAGE = R"(usage: thesis_experiments EXPERIMENT [OPTION ...]

Runs an experiment of the thesis' chapter 4, prints a table, and ends with 0 only if what the
experiment claims holds: 1 if it does not, 2 for wrong usage.

experiments:
)";

const char* const OPTIONS = R"(
options; LIST is one value or several with commas between, and every combination is run:
  --resolution LIST  particles along either side of the cloth, 4 to 500
  --mesh LIST        one_diagonal, alternating, irregular, or all
  --seed LIST        of irregular meshes; direction and trouser: also of where cloth is held
  --grading G        spacing at the border over spacing in the middle, 0.2 to 5 (default 1; nonuniform: 2)
  --solver NAME      xpbd (default), xpbd_lines or force_springs
  --time-step LIST   [s], 0.00001 to 0.1 (default 0.001)
  --output DIR       one CSV row per run in DIR/EXPERIMENT.csv, cloths as OBJ files
  --help             this text
)";

struct Command
{
  const char* name;
  bool (*run)(const Options&);
  const char* help;
};

const Command COMMANDS[] = {
  { "balls", balls, "4.1: five balls, three tear the cloth, two slide off; and three small ones" },
  { "peaks", peaks, "4.1: the strains that balls cause, and the window for a threshold" },
  { "map", map, "4.1: which radius tears the cloth from which speed on" },
  { "variations", variations, "4.1: the balls with ten parameters 10 and 20 percent up and down" },
  { "nonuniform", nonuniform, "4.3: half the particles, fine in the middle, and the time saved" },
  { "direction", direction, "4.2: the crack opens across the pull and goes on in its direction" },
  { "trouser", trouser, "4.2: legs pulled apart; the tear runs on along the cut; the force" },
  { "profile", profile, "4.3: what tearing costs while the cloth is torn all the time" },
  { "texture", texture, "3.3: torn cloth that is put back shows the texture it had" },
};

void printHelp()
{
  std::cout << USAGE;
  for (const Command& command : COMMANDS)
  {
    std::cout << "  " << command.name << std::string(19 - std::string(command.name).size(), ' ')
              << command.help << '\n';
  }
  std::cout << OPTIONS;
}

int run(const std::vector<std::string>& arguments)
{
  const Options options = parseOptions(arguments);
  for (const Command& command : COMMANDS)
  {
    if (options.experiment == command.name)
    {
      return command.run(options) ? EXIT_SUCCESS : CLAIM_FAILED;
    }
  }
  throw UsageError(options.experiment.empty() ? "name an experiment"
                                              : "there is no experiment " + options.experiment);
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
      cloth::printHelp();
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
