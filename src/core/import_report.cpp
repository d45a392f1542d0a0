// The words of a refusal.
#include "cloth_tearing/core/import_report.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

namespace cloth
{
namespace
{

constexpr std::size_t MAX_PROBLEMS_SHOWN = 10;

}  // namespace

std::string importText(double number)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << number;
  return out.str();
}

std::vector<std::string> problems(const ImportOptions& options)
{
  std::vector<std::string> found;
  const auto require =
      [&found](bool holds, const std::string& field, double value, const std::string& limit)
  {
    if (!holds)
    {
      found.push_back(field + " is " + importText(value) + ", must be " + limit);
    }
  };
  const auto isFinite = [](double value) { return std::isfinite(value); };
  require(options.scale > 0 && isFinite(options.scale), "scale", options.scale,
          "above 0 and finite");
  require(options.weld_distance >= 0 && isFinite(options.weld_distance), "weld_distance",
          options.weld_distance, "at least 0 and finite");
  require(options.max_bytes > 0, "max_bytes", static_cast<double>(options.max_bytes), "above 0");
  require(options.max_vertices > 0, "max_vertices", options.max_vertices, "above 0");
  require(options.max_triangles > 0, "max_triangles", options.max_triangles, "above 0");
  require(options.max_polygon_corners >= 3, "max_polygon_corners", options.max_polygon_corners,
          "at least 3");
  require(options.max_coordinate > 0 && options.max_coordinate <= 1e9, "max_coordinate",
          options.max_coordinate, "above 0 and at most 1e+09");
  return found;
}

void ImportProblems::add(int line, const std::string& reason)
{
  ++count_;
  if (first_.size() < MAX_PROBLEMS_SHOWN)
  {
    first_.push_back({ line, reason });
  }
}

void ImportProblems::refuseIfAny() const
{
  if (count_ > 0)
  {
    refuseNow();
  }
}

void ImportProblems::refuse(int line, const std::string& reason)
{
  if (first_.size() == MAX_PROBLEMS_SHOWN)
  {
    first_.pop_back();  // the one that ends it must be seen
  }
  add(line, reason);
  refuseNow();
}

void ImportProblems::refuseNow() const
{
  std::vector<ImportFinding> shown = first_;
  std::stable_sort(shown.begin(), shown.end(),
                   [](const ImportFinding& a, const ImportFinding& b) { return a.line < b.line; });
  std::string message = file_ + " cannot be imported, " + std::to_string(count_) +
                        (count_ == 1 ? " problem:" : " problems:");
  for (const ImportFinding& problem : shown)
  {
    message += "\n  " + file_;
    message += problem.line > 0 ? ", line " + std::to_string(problem.line) : "";
    message += ": " + problem.text;
  }
  if (count_ > shown.size())
  {
    message += "\n  and " + std::to_string(count_ - shown.size()) + " more";
  }
  throw ImportError(message);
}

}  // namespace cloth
