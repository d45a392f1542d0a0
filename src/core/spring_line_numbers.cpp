// Spring lines as numbers, for saved states, and back.
#include <algorithm>
#include <string>

#include "cloth_tearing/core/number_reader.h"
#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/core/spring_lines.h"

namespace cloth
{

using kernels::LANES;

std::vector<int> SpringLines::toNumbers() const
{
  std::vector<int> numbers = { static_cast<int>(phases_.size()) - 1 };
  for (std::size_t phase = 0; phase + 1 < phases_.size(); ++phase)
  {
    numbers.push_back(phases_[phase + 1] - phases_[phase]);
    for (int i = phases_[phase]; i < phases_[phase + 1]; ++i)
    {
      const SpringLadder& ladder = ladders_[i];
      numbers.push_back(ladder.rungs());
      numbers.push_back(ladder.first);
      numbers.push_back(ladder.step);
      numbers.insert(numbers.end(), ladder.particles.begin(), ladder.particles.end());
      for (const Links& links : ladder.links)
      {
        numbers.insert(numbers.end(), links.begin(), links.end());
      }
    }
  }
  return numbers;
}

SpringLines::SpringLines(const SpringTable& springs, int particles, const std::vector<int>& numbers)
    : places_(springs.structural.size())
{
  NumberReader reader(numbers, "solver/lines");
  std::vector<int> touched(particles, 0);
  for (int phases = reader.count(1); phases > 0; --phases)
  {
    for (int left = reader.count(3 + LANES); left > 0; --left)
    {
      readLadder(reader, springs, touched);
    }
    endPhase();
  }
  reader.expectEnd();
}

/// A ladder as it was: its springs join the particles of their nodes and lie nowhere else.
/// @param touched by particle: how many phases there were when a ladder had it last
void SpringLines::readLadder(NumberReader& reader, const SpringTable& springs,
                             std::vector<int>& touched)
{
  const auto particles = static_cast<int>(touched.size());
  SpringLadder read;
  const int rungs = reader.count(LANES);
  read.first = reader.next(-1, std::max(-1, particles - LANES));
  const int most = read.sideBySide() && rungs > 0 ? (particles - LANES - read.first) / rungs : 0;
  read.step = reader.next(0, most);
  for (int i = 0; !read.sideBySide() && i < (rungs + 1) * LANES; ++i)
  {
    read.particles.push_back(reader.next(-1, particles - 1));
  }
  const int ladder = addLadder(std::move(read), rungs);
  refuseSharedParticles(ladders_[ladder], touched);
  for (int rung = 0; rung < rungs; ++rung)
  {
    for (int lane = 0; lane < LANES; ++lane)
    {
      const int link = reader.next(-1, 2 * static_cast<int>(places_.size()) - 1);
      if (link >= 0)
      {
        readSpring(ladder, rung, lane, link, springs);
      }
    }
  }
  if (!ladders_[ladder].sideBySide())
  {
    notePattern(ladders_[ladder]);
  }
}

void SpringLines::refuseSharedParticles(const SpringLadder& ladder, std::vector<int>& touched) const
{
  const auto phase = static_cast<int>(phases_.size());
  for (int node = 0; node < ladder.nodes(); ++node)
  {
    for (int lane = 0; lane < LANES; ++lane)
    {
      const int particle = ladder.particle(node, lane);
      if (particle >= 0 && touched[particle] == phase)
      {
        throw Refusal("solver/lines: particle " + std::to_string(particle) +
                      " lies in two places of a phase");
      }
      if (particle >= 0)
      {
        touched[particle] = phase;
      }
    }
  }
}

void SpringLines::readSpring(int ladder, int rung, int lane, int link, const SpringTable& springs)
{
  const std::string name = "solver/lines: spring " + std::to_string(link / 2);
  if (link % 2 != 0 || has(link))
  {
    throw Refusal(name + (link % 2 != 0 ? " is no structural spring" : " lies in two places"));
  }
  if (!fits({ ladder, rung, lane }, springs.structural[link / 2]))
  {
    throw Refusal(name + " does not lie in its line");
  }
  put(ladder, rung, lane, link / 2, springs);
}

}  // namespace cloth
