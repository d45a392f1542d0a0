// Turns a list of problems into one refusal.
#include "cloth_tearing/core/refusal.h"

namespace cloth
{
namespace
{

constexpr std::size_t MOST_SHOWN = 20;

}  // namespace

void refuseIf(const std::vector<std::string>& problems)
{
  if (problems.empty())
  {
    return;
  }
  std::string all = problems.front();
  for (std::size_t i = 1; i < problems.size() && i < MOST_SHOWN; ++i)
  {
    all += "\n" + problems[i];
  }
  if (problems.size() > MOST_SHOWN)
  {
    all += "\nand " + std::to_string(problems.size() - MOST_SHOWN) + " more";
  }
  throw Refusal(all);
}

}  // namespace cloth
