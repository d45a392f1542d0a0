// Command replay_recording: does a recorded run again and says whether it is the same.
#include <cstdint>
#include <fstream>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "cloth_tearing/core/replay.h"

namespace
{

constexpr int SAME = 0;
constexpr int DIFFERS = 1;
constexpr int WRONG_USAGE = 2;

const char USAGE[] =
    "usage: replay_recording [--steps N] [--save STATE] FILE\n"
    "\n"
    "Does a run again that the node recorded (recording_folder), without ROS and as fast as it\n"
    "goes, and compares: every tear and fault, and the state hash every 500 steps, have to be\n"
    "the same, bit for bit.\n"
    "\n"
    "  --steps N      stop after so many steps, counted over all epochs (default: all)\n"
    "  --save STATE   save the state in the end to the new file STATE; put as NAME.cloth in a\n"
    "                 node's state_folder, ~restore_state goes on from there\n"
    "  --help         show this text\n"
    "\n"
    "Exit status: 0 the run is the same as far as it was written, 1 it differs, or FILE is\n"
    "damaged or no recording, 2 wrong usage.\n";

struct Arguments
{
  std::uint64_t steps = std::numeric_limits<std::uint64_t>::max();
  std::string save;
  std::string file;
  bool help = false;
};

std::uint64_t countFrom(const std::string& option, const std::string& text)
{
  if (text.empty() || text.size() > 18 || text.find_first_not_of("0123456789") != std::string::npos)
  {
    throw std::invalid_argument(option + " needs a number of steps, not \"" + text + "\"");
  }
  return std::stoull(text);
}

Arguments parse(const std::vector<std::string>& words)
{
  Arguments arguments;
  for (std::size_t i = 0; i < words.size(); ++i)
  {
    const std::string& word = words[i];
    if (word == "--help" || word == "-h")
    {
      arguments.help = true;
    }
    else if (word == "--steps" || word == "--save")
    {
      if (++i == words.size())
      {
        throw std::invalid_argument(word + " needs a value");
      }
      if (word == "--save")
      {
        arguments.save = words[i];
      }
      else
      {
        arguments.steps = countFrom(word, words[i]);
      }
    }
    else if (word.size() > 1 && word.front() == '-')
    {
      throw std::invalid_argument("unknown option " + word);
    }
    else if (!arguments.file.empty())
    {
      throw std::invalid_argument("one file at a time: " + arguments.file + " or " + word);
    }
    else
    {
      arguments.file = word;
    }
  }
  if (!arguments.help && arguments.file.empty())
  {
    throw std::invalid_argument("no file");
  }
  return arguments;
}

void save(const std::string& path, const std::string& state)
{
  if (std::ifstream(path).good())
  {
    throw std::runtime_error(path + " exists already");
  }
  std::ofstream file(path, std::ios::binary);
  file.write(state.data(), static_cast<std::streamsize>(state.size()));
  file.close();
  if (!file)
  {
    throw std::runtime_error("cannot write " + path);
  }
}

void replay(const Arguments& arguments)
{
  std::ifstream file(arguments.file, std::ios::binary);
  if (!file)
  {
    throw std::runtime_error("cannot read it");
  }
  cloth::Replay replay(file);
  bool more = true;
  while (replay.steps() < arguments.steps && (more = replay.step()))
  {
  }
  const cloth::Simulation& simulation = replay.simulation();
  std::cout << arguments.file << ": " << replay.steps() << " steps, " << replay.calls()
            << " calls, " << replay.tears() << " tears, " << replay.faults()
            << " faults: the same, bit for bit\n"
            << "epoch " << simulation.epoch() << ", step " << simulation.stepCount() << ", time "
            << simulation.time() << " s, state hash " << simulation.stateHash() << '\n';
  if (!more && replay.leftOver() > 0)
  {
    std::cout << "The last " << replay.leftOver()
              << " bytes are of a record that was not written to its end.\n";
  }
  if (!arguments.save.empty())
  {
    save(arguments.save, simulation.save());
  }
}

}  // namespace

int main(int argc, char** argv)
{
  Arguments arguments;
  try
  {
    arguments = parse({ argv + 1, argv + argc });
  }
  catch (const std::invalid_argument& error)
  {
    std::cerr << "replay_recording: " << error.what() << "\n\n" << USAGE;
    return WRONG_USAGE;
  }
  if (arguments.help)
  {
    std::cout << USAGE;
    return SAME;
  }
  try
  {
    replay(arguments);
    return SAME;
  }
  catch (const std::exception& error)
  {
    std::cerr << "replay_recording: " << arguments.file << ": " << error.what() << '\n';
    return DIFFERS;
  }
}
