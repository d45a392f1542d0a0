// Turns a list of problems into one refusal.
#include "cloth_tearing/core/refusal.h"

namespace cloth
{

void refuseIf(const std::vector<std::string>& problems)
{
  if (problems.empty())
  {
    return;
  }
  std::string all = problems.front();
  for (std::size_t i = 1; i < problems.size(); ++i)
  {
    all += "\n" + problems[i];
  }
  throw Refusal(all);
}

}  // namespace cloth
