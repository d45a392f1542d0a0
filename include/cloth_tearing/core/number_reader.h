// Numbers of a saved state, each checked when it is read.
#pragma once

#include <string>
#include <vector>

namespace cloth
{

/// Reads numbers that may come from anywhere.
class NumberReader
{
public:
  /// @param name of the numbers, for refusals
  NumberReader(const std::vector<int>& numbers, std::string name);

  /// @throws Refusal if it is not from `least` to `most`, or there is none
  int next(int least, int most);

  /// A count of things that take so many numbers each.
  int count(int size);

  /// @throws Refusal if there are more
  void expectEnd() const;

private:
  const std::vector<int>& numbers_;
  std::string name_;
  std::size_t at_ = 0;
};

}  // namespace cloth
