// Spring blocks as numbers, for saved states, and back.
#include <algorithm>
#include <string>

#include "cloth_tearing/core/number_reader.h"
#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/core/spring_blocks.h"
#include "cloth_tearing/core/spring_lanes.h"

namespace cloth
{

using kernels::LANES;

std::vector<int> SpringBlocks::toNumbers() const
{
  std::vector<int> numbers = { divided_ };
  const auto add = [&numbers](const Links& links)
  { numbers.insert(numbers.end(), links.begin(), links.end()); };
  for (const SpringGroup& group : groups_)
  {
    numbers.push_back(static_cast<int>(group.run_links.size()));
    for (std::size_t i = 0; i < group.run_links.size(); ++i)
    {
      numbers.push_back(group.run_ends[i].a);
      numbers.push_back(group.run_ends[i].b);
      add(group.run_links[i]);
    }
    numbers.push_back(static_cast<int>(group.loose_links.size()));
    for (const Links& links : group.loose_links)
    {
      add(links);
    }
  }
  for (int bit = 0; bit < 64; ++bit)
  {
    const bool used = (open_.used >> bit & 1) != 0;
    numbers.push_back(used ? open_.block[bit] : -1);
    numbers.push_back(used ? open_.filled[bit] : 0);
  }
  numbers.push_back(holes_);
  return numbers;
}

SpringBlocks::SpringBlocks(const SpringTable& springs, int particles,
                           const std::vector<int>& numbers, const SpringLines& lines)
{
  NumberReader reader(numbers, "solver/blocks");
  *this = SpringBlocks(springs, particles, reader.next(0, particles));
  const int last = static_cast<int>(groups_.size()) - 1;
  const auto readLinks = [&]
  {
    Links links;
    for (int& link : links)
    {
      link = reader.next(-1, static_cast<int>(places_.size()) - 1);
    }
    return links;
  };
  for (int g = 0; g <= last; ++g)
  {
    const int end = std::min(groups_[g].end, particles);
    for (int left = reader.count(LANES + 2); left > 0; --left)
    {
      const int a = reader.next(groups_[g].begin, end - LANES);
      const int b = reader.next(groups_[g].begin, end - LANES);
      readRun(g, { a, b }, readLinks(), springs);
    }
    for (int left = reader.count(LANES); left > 0; --left)
    {
      readLoose(g, readLinks(), springs);
    }
    if (g < last)
    {
      forgetRecords(g);
    }
  }
  for (int bit = 0; bit < 64; ++bit)
  {
    const int block = reader.next(-1, static_cast<int>(groups_[last].loose_links.size()) - 1);
    const int filled = reader.next(0, LANES - 1);
    if (block >= 0)
    {
      readOpen(bit, block, filled);
    }
  }
  holes_ = reader.next(0, LANES * static_cast<int>(groups_[last].loose_links.size()));
  reader.expectEnd();
  for (int link = 0; link < static_cast<int>(places_.size()); ++link)
  {
    const bool here = places_[link].group >= 0;
    if (lawOf(springs, link).active() && here == lines.has(link))
    {
      throw Refusal("solver/blocks: spring " + std::to_string(link / 2) +
                    (here ? " lies in a line as well" : " is missing"));
    }
  }
}

/// A block that was read: each of its springs carries something, lies within the group and nowhere
/// else yet, and shares no particle with another.
void SpringBlocks::refuseUnsound(int group, const Links& links, const SpringTable& springs) const
{
  std::vector<int> ends;
  for (int link : links)
  {
    if (link < 0)
    {
      continue;
    }
    const SpringLaw& law = lawOf(springs, link);
    const std::string name = "solver/blocks: spring " + std::to_string(link / 2);
    if (!law.active() || places_[link].group >= 0 ||
        std::count(links.begin(), links.end(), link) != 1)
    {
      throw Refusal(name + (law.active() ? " lies in two places" : " carries nothing"));
    }
    for (int end : sorted(law))
    {
      if (end < groups_[group].begin || end >= groups_[group].end)
      {
        throw Refusal(name + " lies in a group that it does not belong to");
      }
      ends.push_back(end);
    }
  }
  std::sort(ends.begin(), ends.end());
  if (std::adjacent_find(ends.begin(), ends.end()) != ends.end())
  {
    throw Refusal("solver/blocks: two springs of a block share a particle");
  }
}

/// A run as it was.
void SpringBlocks::readRun(int group, const kernels::RunEnds& ends, const Links& links,
                           const SpringTable& springs)
{
  refuseUnsound(group, links, springs);
  for (int lane = 0; lane < LANES; ++lane)
  {
    const std::array<int, 2> here = { ends.a + lane, ends.b + lane };
    if (links[lane] >= 0 && sorted(lawOf(springs, links[lane])) != here)
    {
      throw Refusal("solver/blocks: spring " + std::to_string(links[lane] / 2) +
                    " does not lie in its run");
    }
  }
  addRun(group, ends, links, springs);
}

/// A loose block as it was.
void SpringBlocks::readLoose(int group, const Links& links, const SpringTable& springs)
{
  refuseUnsound(group, links, springs);
  SpringGroup& target = groups_[group];
  const int block = static_cast<int>(target.loose_links.size());
  target.loose_ends.push_back({});
  target.loose_links.push_back(links);
  target.loose_lanes.push_back(noLanes());
  for (int lane = 0; lane < LANES; ++lane)
  {
    if (links[lane] >= 0)
    {
      const std::array<int, 2> ends = sorted(lawOf(springs, links[lane]));
      target.loose_ends[block].a[lane] = recordOf(target, ends[0]);
      target.loose_ends[block].b[lane] = recordOf(target, ends[1]);
      places_[links[lane]] = { group, block, lane, false };
      write(links[lane], springs);
    }
  }
}

/// A block of the last group that has lanes free, as it was.
void SpringBlocks::readOpen(int bit, int block, int filled)
{
  for (int other = 0; other < bit; ++other)
  {
    if ((open_.used >> other & 1) != 0 && open_.block[other] == block)
    {
      throw Refusal("solver/blocks: block " + std::to_string(block) + " is open twice");
    }
  }
  const SpringGroup& group = groups_.back();
  open_.used |= bitOf(bit);
  open_.block[bit] = block;
  open_.filled[bit] = filled;
  for (int lane = 0; lane < LANES; ++lane)
  {
    const int link = group.loose_links[block][lane];
    if (link >= 0 && lane >= filled)
    {
      throw Refusal("solver/blocks: lane " + std::to_string(lane) + " of block " +
                    std::to_string(block) + " is not free");
    }
    if (link >= 0)
    {
      for (int end : endsOf(link))
      {
        open_.touching[end] |= bitOf(bit);
      }
    }
  }
}

}  // namespace cloth
