// Reads the command line of thesis_experiments.
#include "experiment_options.h"

#include <cstdlib>

#include "cloth_tearing/core/checks.h"

namespace cloth
{
namespace
{

constexpr double LEAST_TIME_STEP = 1e-5;  ///< [s]
constexpr double MOST_TIME_STEP = 0.1;    ///< [s]

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

/// The parts between commas.
std::vector<std::string> parts(const std::string& text)
{
  std::vector<std::string> parts(1);
  for (const char c : text)
  {
    if (c == ',')
    {
      parts.emplace_back();
    }
    else
    {
      parts.back() += c;
    }
  }
  return parts;
}

void readSolver(const std::string& name, Options& options)
{
  for (const auto& [kind, lines] :
       { std::pair{ SolverKind::XPBD, false }, std::pair{ SolverKind::XPBD, true },
         std::pair{ SolverKind::FORCE_SPRINGS, false } })
  {
    if (name == solverName(kind, lines))
    {
      options.solver = kind;
      options.lines = lines;
      return;
    }
  }
  throw UsageError("--solver is \"" + name + "\", must be xpbd, xpbd_lines or force_springs");
}

double within(const std::string& option, const std::string& text, double low, double high)
{
  const double value = number(option, text);
  if (!(value >= low && value <= high))
  {
    throw UsageError(option + " is " + text + ", must be a number from " + cloth::text(low) +
                     " to " + cloth::text(high));
  }
  return value;
}

RectanglePattern mesh(const std::string& name)
{
  for (const RectanglePattern mesh : ALL_MESHES)
  {
    if (name == nameOf(mesh))
    {
      return mesh;
    }
  }
  throw UsageError("--mesh is \"" + name +
                   "\", must be one_diagonal, alternating, irregular or all");
}

void apply(Options& options, const std::string& option, const std::string& value)
{
  if (option == "--resolution")
  {
    options.resolutions.clear();
    for (const std::string& part : parts(value))
    {
      options.resolutions.push_back(wholeNumber(option, part, 4, 500));
    }
  }
  else if (option == "--mesh")
  {
    options.meshes = value == "all" ? ALL_MESHES : std::vector<RectanglePattern>{};
    for (const std::string& part : value == "all" ? std::vector<std::string>{} : parts(value))
    {
      options.meshes.push_back(mesh(part));
    }
  }
  else if (option == "--seed")
  {
    options.seeds.clear();
    for (const std::string& part : parts(value))
    {
      options.seeds.push_back(wholeNumber(option, part, 0, 1000000000));
    }
  }
  else if (option == "--time-step")
  {
    options.time_steps.clear();
    for (const std::string& part : parts(value))
    {
      options.time_steps.push_back(within(option, part, LEAST_TIME_STEP, MOST_TIME_STEP));
    }
  }
  else if (option == "--grading")
  {
    options.grading = within(option, value, 0.2, 5.0);
  }
  else if (option == "--solver")
  {
    readSolver(value, options);
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

}  // namespace

const std::vector<RectanglePattern> ALL_MESHES = { RectanglePattern::ONE_DIAGONAL,
                                                   RectanglePattern::ALTERNATING,
                                                   RectanglePattern::IRREGULAR };

const char* nameOf(RectanglePattern pattern)
{
  static const char* const NAMES[] = { "one_diagonal", "alternating", "irregular" };
  return NAMES[static_cast<int>(pattern)];
}

const char* solverName(SolverKind solver, bool lines)
{
  if (solver == SolverKind::FORCE_SPRINGS)
  {
    return "force_springs";
  }
  return lines ? "xpbd_lines" : "xpbd";
}

std::string clothName(const Setting& setting)
{
  std::string name = nameOf(setting.pattern);
  name += "_" + std::to_string(setting.resolution);
  return setting.pattern == RectanglePattern::IRREGULAR ? name + "_" + std::to_string(setting.seed)
                                                        : name;
}

std::string fileName(const Setting& setting)
{
  const Setting usual;
  std::string name = nameOf(setting.pattern);
  name += "_" + std::to_string(setting.resolution) + "_" + std::to_string(setting.seed);
  const bool usual_solver = setting.solver == usual.solver && setting.lines == usual.lines;
  name += usual_solver ? "" : std::string("_") + solverName(setting.solver, setting.lines);
  name += setting.grading == usual.grading ? "" : "_grading_" + text(setting.grading);
  name += setting.time_step == usual.time_step ? "" : "_dt_" + text(setting.time_step);
  return name;
}

std::vector<Setting> Options::settings(const std::vector<int>& default_resolutions,
                                       const std::vector<RectanglePattern>& default_meshes,
                                       const std::vector<int>& default_seeds) const
{
  std::vector<Setting> settings;
  Setting setting;
  setting.grading = grading.value_or(1.0);
  setting.solver = solver;
  setting.lines = lines;
  for (const int resolution : resolutions.empty() ? default_resolutions : resolutions)
  {
    setting.resolution = resolution;
    for (const RectanglePattern mesh : meshes.empty() ? default_meshes : meshes)
    {
      setting.pattern = mesh;
      const std::vector<int>& wanted = seeds.empty() ? default_seeds : seeds;
      const bool random = mesh == RectanglePattern::IRREGULAR;
      for (const int seed : random ? wanted : std::vector<int>{ 1 })
      {
        setting.seed = static_cast<std::uint64_t>(seed);
        for (const double time_step :
             time_steps.empty() ? std::vector<double>{ 0.001 } : time_steps)
        {
          setting.time_step = time_step;
          settings.push_back(setting);
        }
      }
    }
  }
  return settings;
}

Options parseOptions(const std::vector<std::string>& arguments)
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

}  // namespace cloth
