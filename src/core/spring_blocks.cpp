// Arranges springs in blocks.
#include "cloth_tearing/core/spring_blocks.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "cloth_tearing/core/spring_lanes.h"

namespace cloth
{
namespace
{

using kernels::LANES;

/// Particles of a group of the first phase: they fit into the memory that is a core's own.
constexpr int GROUP_SIZE = 2048;

/// A run with fewer springs than this takes longer than they do in loose blocks.
constexpr int SHORTEST_RUN = 6;

/// Loose blocks are filled anew when more than half of their lanes lost their springs, beyond this.
constexpr int FEW_HOLES = 256;

constexpr int NO_PARTICLE = -1;

/// A run that is being put together.
struct Run
{
  kernels::RunEnds ends;
  Links links = noLinks();
  int wave = 0;  ///< runs of the same wave touch no particle in common
};

/// Puts runs that need not wait for each other side by side, as far as none overtakes another that
/// touches the same particles: the results are those of the order before, bit for bit, but the
/// processor need not wait for one to begin the next.
void spread(std::vector<Run>& runs, int begin, int end)
{
  std::vector<int> latest(end - begin, 0);  // wave in which each particle was touched last
  for (Run& run : runs)
  {
    for (int lane = 0; lane < LANES; ++lane)
    {
      run.wave = std::max(
          { run.wave, latest[run.ends.a + lane - begin], latest[run.ends.b + lane - begin] });
    }
    ++run.wave;
    for (int lane = 0; lane < LANES; ++lane)
    {
      latest[run.ends.a + lane - begin] = run.wave;
      latest[run.ends.b + lane - begin] = run.wave;
    }
  }
  std::stable_sort(runs.begin(), runs.end(),
                   [](const Run& a, const Run& b) { return a.wave < b.wave; });
}

}  // namespace

/// Groups without blocks: stretches of particles, stretches across their borders, and all.
/// @param divided particles that are in stretches
SpringBlocks::SpringBlocks(const SpringTable& springs, int particles, int divided)
    : divided_(divided)
{
  const int count = std::max(1, divided / GROUP_SIZE);
  std::vector<int> borders;
  for (int i = 0; i <= count; ++i)
  {
    borders.push_back(static_cast<int>(static_cast<std::int64_t>(divided) * i / count));
  }
  const auto add = [this](int begin, int end)
  {
    groups_.emplace_back();
    groups_.back().begin = begin;
    groups_.back().end = end;
    groups_.back().particles.push_back(NO_PARTICLE);
  };
  for (int i = 0; i < count; ++i)
  {
    add(borders[i], borders[i + 1]);
  }
  for (int i = 0; i + 1 < count; ++i)
  {
    add((borders[i] + borders[i + 1]) / 2, (borders[i + 1] + borders[i + 2]) / 2);
  }
  add(0, std::numeric_limits<int>::max());
  phases_ = { 0, count, 2 * count - 1, 2 * count };
  places_.resize(2 * springs.structural.size());
  open_.touching.assign(particles, 0);
  records_.assign(particles, 0);
}

SpringBlocks::SpringBlocks(const SpringTable& springs, int particles, const SpringLines& lines)
    : SpringBlocks(springs, particles, particles)
{
  std::vector<std::vector<Link>> links(groups_.size());
  for (int i = 0; i < static_cast<int>(places_.size()); ++i)
  {
    const SpringLaw& law = lawOf(springs, i);
    if (law.active() && !lines.has(i))
    {
      const Link link{ i, std::min(law.a, law.b), std::max(law.a, law.b) };
      links[groupOf(link.a, link.b)].push_back(link);
    }
  }
  for (int g = 0; g < static_cast<int>(groups_.size()); ++g)
  {
    const bool last = g + 1 == static_cast<int>(groups_.size());
    for (const Link& link : makeRuns(g, std::move(links[g]), particles, springs))
    {
      addLoose(g, link, springs);
    }
    if (!last)
    {
      forgetRecords(g);
    }
  }
}

/// The first group that holds both ends.
int SpringBlocks::groupOf(int a, int b) const
{
  for (int phase = 0; phase < 3; ++phase)
  {
    const auto first = groups_.begin() + phases_[phase];
    const auto last = groups_.begin() + phases_[phase + 1];
    const auto after = std::upper_bound(first, last, a,
                                        [](int particle, const SpringGroup& group)
                                        { return particle < group.begin; });
    if (after != first && b < std::prev(after)->end && a < std::prev(after)->end)
    {
      return static_cast<int>(std::prev(after) - groups_.begin());
    }
  }
  return static_cast<int>(groups_.size()) - 1;
}

/// @return links that lie in no run, by particle
std::vector<SpringBlocks::Link> SpringBlocks::makeRuns(int group, std::vector<Link> links,
                                                       int particles, const SpringTable& springs)
{
  const auto by_reach = [](const Link& link)
  { return std::make_tuple(link.b - link.a, link.a, link.link); };
  std::sort(links.begin(), links.end(),
            [&](const Link& x, const Link& y) { return by_reach(x) < by_reach(y); });
  SpringGroup& target = groups_[group];
  const int end = std::min(target.end, particles);

  std::vector<Run> runs;
  std::vector<Link> loose;
  std::vector<char> taken(links.size(), 0);
  for (std::size_t i = 0; i < links.size(); ++i)
  {
    if (taken[i])
    {
      continue;
    }
    const int reach = links[i].b - links[i].a;
    const int first = std::min(links[i].a, end - LANES - reach);
    Run run;
    run.ends = { first, first + reach };
    std::vector<std::size_t> members;
    for (std::size_t k = i; first >= target.begin && k < links.size() &&
                            links[k].b - links[k].a == reach && links[k].a < first + LANES;
         ++k)
    {
      const int lane = links[k].a - first;
      const bool shared = lane >= reach && run.links[lane - reach] >= 0;
      if (!taken[k] && run.links[lane] < 0 && !shared)
      {
        run.links[lane] = links[k].link;
        members.push_back(k);
      }
    }
    if (static_cast<int>(members.size()) < SHORTEST_RUN)
    {
      loose.push_back(links[i]);
      continue;
    }
    for (std::size_t member : members)
    {
      taken[member] = 1;
    }
    runs.push_back(run);
  }
  spread(runs, target.begin, end);
  for (const Run& run : runs)
  {
    addRun(group, run.ends, run.links, springs);
  }
  std::sort(loose.begin(), loose.end(),
            [](const Link& x, const Link& y)
            { return std::tie(x.a, x.b, x.link) < std::tie(y.a, y.b, y.link); });
  return loose;
}

void SpringBlocks::addRun(int group, const kernels::RunEnds& ends, const Links& links,
                          const SpringTable& springs)
{
  SpringGroup& target = groups_[group];
  const int block = static_cast<int>(target.run_ends.size());
  target.run_ends.push_back(ends);
  target.run_links.push_back(links);
  target.run_lanes.push_back(noLanes());
  for (int lane = 0; lane < LANES; ++lane)
  {
    if (links[lane] >= 0)
    {
      places_[links[lane]] = { group, block, lane, true };
      write(links[lane], springs);
    }
  }
}

void SpringBlocks::addLoose(int group, const Link& link, const SpringTable& springs)
{
  SpringGroup& target = groups_[group];
  const std::uint64_t fitting = open_.used & ~(open_.touching[link.a] | open_.touching[link.b]);
  const int bit = fitting != 0 ? lowestBit(fitting) : openBlock(target);
  const int block = open_.block[bit];
  const int lane = open_.filled[bit]++;
  target.loose_ends[block].a[lane] = recordOf(target, link.a);
  target.loose_ends[block].b[lane] = recordOf(target, link.b);
  target.loose_links[block][lane] = link.link;
  open_.touching[link.a] |= bitOf(bit);
  open_.touching[link.b] |= bitOf(bit);
  places_[link.link] = { group, block, lane, false };
  write(link.link, springs);
  if (open_.filled[bit] == LANES)
  {
    closeBlock(target, bit);
  }
}

/// @return its bit
int SpringBlocks::openBlock(SpringGroup& group)
{
  if (~open_.used == 0)
  {
    closeBlock(group, static_cast<int>(std::max_element(open_.filled.begin(), open_.filled.end()) -
                                       open_.filled.begin()));
  }
  const int bit = lowestBit(~open_.used);
  open_.used |= bitOf(bit);
  open_.block[bit] = static_cast<int>(group.loose_ends.size());
  open_.filled[bit] = 0;
  group.loose_ends.push_back({});  // the record that is no particle's
  group.loose_links.push_back(noLinks());
  group.loose_lanes.push_back(noLanes());
  return bit;
}

void SpringBlocks::closeBlock(const SpringGroup& group, int bit)
{
  const kernels::RecordEnds& ends = group.loose_ends[open_.block[bit]];
  for (int lane = 0; lane < LANES; ++lane)
  {
    for (int record : { ends.a[lane], ends.b[lane] })
    {
      if (record > 0)
      {
        open_.touching[group.particles[record]] &= ~bitOf(bit);
      }
    }
  }
  open_.used &= ~bitOf(bit);
  open_.filled[bit] = 0;
}

int SpringBlocks::recordOf(SpringGroup& group, int particle)
{
  int& record = records_[particle];
  if (record == 0)
  {
    record = static_cast<int>(group.particles.size());
    group.particles.push_back(particle);
  }
  return record;
}

/// The next group has records and open blocks of its own.
void SpringBlocks::forgetRecords(int group)
{
  for (int particle : groups_[group].particles)
  {
    if (particle != NO_PARTICLE)
    {
      records_[particle] = 0;
      open_.touching[particle] = 0;
    }
  }
  open_.used = 0;
  open_.filled.fill(0);
}

void SpringBlocks::follow(const SpringTable& springs, int particles,
                          const std::vector<int>& changed, const SpringLines& lines)
{
  places_.resize(2 * springs.structural.size());
  open_.touching.resize(particles, 0);
  records_.resize(particles, 0);
  const int last = static_cast<int>(groups_.size()) - 1;
  for (int spring : changed)
  {
    for (int link : { linkOf(spring, false), linkOf(spring, true) })
    {
      const SpringLaw& law = lawOf(springs, link);
      const bool fits = places_[link].group >= 0 && law.active() && endsOf(link) == sorted(law);
      if (fits)
      {
        write(link, springs);
        continue;
      }
      remove(link);
      if (law.active() && !lines.has(link))
      {
        addLoose(last, { link, std::min(law.a, law.b), std::max(law.a, law.b) }, springs);
      }
    }
  }
  if (holes_ > FEW_HOLES && 2 * holes_ > LANES * static_cast<int>(groups_[last].loose_links.size()))
  {
    compact(springs);
  }
}

std::array<int, 2> SpringBlocks::sorted(const SpringLaw& law)
{
  return { std::min(law.a, law.b), std::max(law.a, law.b) };
}

/// The particles that a link joins where it lies, the lower first.
std::array<int, 2> SpringBlocks::endsOf(int link) const
{
  const Place& place = places_[link];
  const SpringGroup& group = groups_[place.group];
  if (place.run)
  {
    const kernels::RunEnds& ends = group.run_ends[place.block];
    return { ends.a + place.lane, ends.b + place.lane };
  }
  const kernels::RecordEnds& ends = group.loose_ends[place.block];
  return { group.particles[ends.a[place.lane]], group.particles[ends.b[place.lane]] };
}

void SpringBlocks::remove(int link)
{
  Place& place = places_[link];
  if (place.group < 0)
  {
    return;
  }
  SpringGroup& group = groups_[place.group];
  if (place.run)
  {
    group.run_links[place.block][place.lane] = -1;
    clearLane(group.run_lanes[place.block], place.lane);
  }
  else
  {
    if (place.group + 1 == static_cast<int>(groups_.size()))
    {
      leaveOpenBlock(place.block, endsOf(link));
      ++holes_;
    }
    group.loose_links[place.block][place.lane] = -1;
    clearLane(group.loose_lanes[place.block], place.lane);
    group.loose_ends[place.block].a[place.lane] = 0;
    group.loose_ends[place.block].b[place.lane] = 0;
  }
  place = {};
}

/// The particles of a block may be touched by others of it again, if it is open.
void SpringBlocks::leaveOpenBlock(int block, const std::array<int, 2>& ends)
{
  for (int bit = 0; bit < 64; ++bit)
  {
    if ((open_.used >> bit & 1) != 0 && open_.block[bit] == block)
    {
      open_.touching[ends[0]] &= ~bitOf(bit);
      open_.touching[ends[1]] &= ~bitOf(bit);
    }
  }
}

/// What a link is like, into its lane.
void SpringBlocks::write(int link, const SpringTable& springs)
{
  const Place& place = places_[link];
  SpringGroup& group = groups_[place.group];
  kernels::Lanes& lanes = place.run ? group.run_lanes[place.block] : group.loose_lanes[place.block];
  writeLane(lanes, place.lane, lawOf(springs, link),
            link % 2 == 0 ? watched_ : std::numeric_limits<Real>::infinity());
}

void SpringBlocks::watch(const SpringTable& springs, Real watched)
{
  watched_ = watched;
  for (int link = 0; link < static_cast<int>(places_.size()); link += 2)
  {
    if (places_[link].group >= 0)
    {
      write(link, springs);
    }
  }
}

/// Fills the loose blocks of the last group anew, in their order.
void SpringBlocks::compact(const SpringTable& springs)
{
  const int last = static_cast<int>(groups_.size()) - 1;
  SpringGroup& group = groups_[last];
  std::vector<Link> links;
  for (const Links& block : group.loose_links)
  {
    for (int link : block)
    {
      if (link >= 0)
      {
        const std::array<int, 2> ends = endsOf(link);
        links.push_back({ link, ends[0], ends[1] });
      }
    }
  }
  forgetRecords(last);
  group.loose_ends.clear();
  group.loose_lanes.clear();
  group.loose_links.clear();
  group.particles.assign(1, NO_PARTICLE);
  holes_ = 0;
  for (const Link& link : links)
  {
    addLoose(last, link, springs);
  }
}

}  // namespace cloth
