// Writes tables and snapshots.
#include "experiment_output.h"

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/obj_writer.h"

namespace cloth
{

double median(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

Row settingColumns(const Setting& setting)
{
  return { { "mesh", nameOf(setting.pattern) },
           { "resolution", std::to_string(setting.resolution) },
           { "seed", std::to_string(setting.seed) },
           { "grading", text(setting.grading) },
           { "solver", solverName(setting.solver, setting.lines) },
           { "time_step", text(setting.time_step) } };
}

Output::Output(const std::string& folder, const std::string& table) : folder_(folder)
{
  if (!folder_.empty())
  {
    std::error_code failure;
    std::filesystem::create_directories(folder_, failure);
    table_.open(folder_ / table);
    if (failure || !table_)
    {
      throw UsageError("--output is " + folder + ", must be a folder that can be written to" +
                       (failure ? ": " + failure.message() : ""));
    }
  }
}

void Output::row(const Row& row)
{
  if (folder_.empty())
  {
    return;
  }
  if (!headed_)
  {
    headed_ = true;
    line(row, true);
  }
  line(row, false);
}

void Output::line(const Row& row, bool heading)
{
  const char* separator = "";
  for (const auto& [name, value] : row)
  {
    table_ << separator << (heading ? name : value);
    separator = ",";
  }
  table_ << '\n';
  if (!table_.flush())
  {
    throw std::runtime_error("cannot write to " + folder_.string());
  }
}

void Output::snapshot(const std::string& name, const Simulation& simulation) const
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

}  // namespace cloth
