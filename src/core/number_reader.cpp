// Refuses numbers that cannot be.
#include "cloth_tearing/core/number_reader.h"

#include <utility>

#include "cloth_tearing/core/refusal.h"

namespace cloth
{

NumberReader::NumberReader(const std::vector<int>& numbers, std::string name)
    : numbers_(numbers), name_(std::move(name))
{
}

int NumberReader::next(int least, int most)
{
  if (at_ >= numbers_.size())
  {
    throw Refusal(name_ + " end too early");
  }
  const int number = numbers_[at_];
  if (number < least || number > most)
  {
    throw Refusal(name_ + " " + std::to_string(at_) + " is " + std::to_string(number) +
                  ", must be " + std::to_string(least) + " to " + std::to_string(most));
  }
  ++at_;
  return number;
}

int NumberReader::count(int size)
{
  return next(0, static_cast<int>((numbers_.size() - at_) / static_cast<std::size_t>(size)));
}

void NumberReader::expectEnd() const
{
  if (at_ != numbers_.size())
  {
    throw Refusal(name_ + " go on after their end");
  }
}

}  // namespace cloth
