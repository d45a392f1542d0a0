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
    "usage: replay_recording [--steps N] [--save STATE] FILE...\n"
    "\n"
    "Does runs again that the node recorded (recording_folder), without ROS and as fast as it\n"
    "goes, and compares: every tear and fault, and the state hash after 1, 2, 4, ... 256 steps\n"
    "and then every 500, have to be the same, bit for bit.\n"
    "\n"
    "  --steps N      stop after so many steps, counted over all epochs (default: all)\n"
    "  --save STATE   save the state in the end to the new file STATE (with one FILE); put as\n"
    "                 NAME.cloth in a node's state_folder, ~restore_state goes on from there\n"
    "  --help         show this text\n"
    "\n"
    "Exit status: 0 all are the same as far as they were written, 1 one differs, or is damaged\n"
    "or no recording, 2 wrong usage.\n";

struct Arguments
{
  std::uint64_t steps = std::numeric_limits<std::uint64_t>::max();
  std::string save;
  std::vector<std::string> files;
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
    else
    {
      arguments.files.push_back(word);
    }
  }
  if (!arguments.help && arguments.files.empty())
  {
    throw std::invalid_argument("no file");
  }
  if (!arguments.save.empty() && arguments.files.size() > 1)
  {
    throw std::invalid_argument("--save needs one file, there are " +
                                std::to_string(arguments.files.size()));
  }
  return arguments;
}

void refuseExisting(const std::string& path)
{
  if (std::ifstream(path).good())
  {
    throw std::runtime_error("--save: " + path + " exists already");
  }
}

void save(const std::string& path, const std::string& state)
{
  std::ofstream file(path, std::ios::binary);
  file.write(state.data(), static_cast<std::streamsize>(state.size()));
  file.close();
  if (!file)
  {
    throw std::runtime_error("--save: cannot write " + path);
  }
}

void replay(const std::string& path, const Arguments& arguments)
{
  refuseExisting(arguments.save);
  std::ifstream file(path, std::ios::binary);
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
  std::cout << path << ": " << replay.steps() << " steps, " << replay.calls() << " calls, "
            << replay.tears() << " tears, " << replay.faults() << " faults, " << replay.hashes()
            << " state hashes, the last after " << replay.lastHash()
            << " steps: the same, bit for bit\n"
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
  int status = SAME;
  for (const std::string& path : arguments.files)
  {
    try
    {
      replay(path, arguments);
    }
    catch (const std::exception& error)
    {
      std::cerr << "replay_recording: " << path << ": " << error.what() << '\n';
      status = DIFFERS;
    }
  }
  return status;
}
