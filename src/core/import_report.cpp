// The words of a refusal.
#include "cloth_tearing/core/import_report.h"

#include <algorithm>

#include "cloth_tearing/core/checks.h"

namespace cloth
{
namespace
{

constexpr std::size_t MAX_PROBLEMS_SHOWN = 10;
constexpr double MOST_COORDINATE = 1e9;  // volumes of boxes stay far from overflow

}  // namespace

std::vector<std::string> problems(const ImportOptions& options)
{
  std::vector<std::string> found;
  check(found, "scale", options.scale, Range::above(0));
  check(found, "weld_distance", options.weld_distance, Range::atLeast(0));
  check(found, "max_bytes", static_cast<double>(options.max_bytes), Range::atLeast(1));
  check(found, "max_vertices", options.max_vertices, Range::atLeast(1));
  check(found, "max_triangles", options.max_triangles, Range::atLeast(1));
  check(found, "max_polygon_corners", options.max_polygon_corners, Range::atLeast(3));
  check(found, "max_coordinate", options.max_coordinate, Range::aboveUpTo(0, MOST_COORDINATE));
  check(found, "max_texture_coordinate", options.max_texture_coordinate,
        Range::aboveUpTo(0, MOST_COORDINATE));
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
