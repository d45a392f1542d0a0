// Tables and snapshots that --output asks for.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "experiment_options.h"

namespace cloth
{

/// One run's row: names of columns with what stands in them.
using Row = std::vector<std::pair<std::string, std::string>>;

/// @param values one at least
double median(std::vector<double> values);

/// The columns that say which cloth a run was made with.
Row settingColumns(const Setting& setting);

/// A folder with a CSV file and OBJ snapshots; does nothing if its name is empty.
class Output
{
public:
  /// @param table name of the CSV file; an old one is replaced
  /// @throws UsageError if `folder` cannot be made or written to
  Output(const std::string& folder, const std::string& table);

  /// Adds a run; the first row's names become the heading.
  /// @throws std::runtime_error if it cannot be written
  void row(const Row& row);

  /// Writes the cloth as it is, with texture coordinates, into `name`.
  /// @throws std::runtime_error if it cannot be written
  void snapshot(const std::string& name, const Simulation& simulation) const;

private:
  void line(const Row& row, bool heading);

  std::filesystem::path folder_;
  std::ofstream table_;
  bool headed_ = false;
};

}  // namespace cloth
