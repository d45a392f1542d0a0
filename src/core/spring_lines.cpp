// Lays lines side by side, and follows tears.
#include "cloth_tearing/core/spring_lines.h"

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <tuple>
#include <utility>

namespace cloth
{
namespace
{

using kernels::LANES;

/// Lines whose particles are neighbours in memory lie side by side where so much of their rungs
/// have springs; where less, copies of the particles are faster.
constexpr double DENSE = 0.6;

constexpr int NO_PARTICLE = -1;

SpringLine ascending(SpringLine line)
{
  if (line.particles.front() > line.particles.back())
  {
    std::reverse(line.particles.begin(), line.particles.end());
    std::reverse(line.springs.begin(), line.springs.end());
  }
  return line;
}

/// From each particle of an ascending line to the next; 0 if that differs.
int stepOf(const SpringLine& line)
{
  const int step = line.particles[1] - line.particles[0];
  for (std::size_t i = 2; i < line.particles.size(); ++i)
  {
    if (line.particles[i] - line.particles[i - 1] != step)
    {
      return 0;
    }
  }
  return step;
}

/// LANES neighbours of which each node of some lines has one: particle t * step + o lies at node t,
/// where o, the remainder, is in the window.
struct Window
{
  int step;
  int begin;  ///< remainder in lane 0
  int lanes;  ///< the others belong to another window

  bool operator<(const Window& other) const
  {
    return std::tie(step, begin) < std::tie(other.step, other.begin);
  }
};

/// The window of an ascending line. The last one of a step begins early, so that it ends in time.
Window windowOf(const SpringLine& line)
{
  const int step = stepOf(line);
  if (step < LANES)
  {
    return {};
  }
  const int begin = line.particles.front() % step / LANES * LANES;
  return { step, std::min(begin, step - LANES), std::min(LANES, step - begin) };
}

/// The lines of a window.
struct Neighbours
{
  std::vector<std::size_t> lines;
  int springs = 0;
  int first_node = 0;  ///< particle over step
  int last_node = 0;

  void add(std::size_t index, const SpringLine& line, int step)
  {
    const int first = line.particles.front() / step;
    const int last = line.particles.back() / step;
    first_node = lines.empty() ? first : std::min(first_node, first);
    last_node = lines.empty() ? last : std::max(last_node, last);
    lines.push_back(index);
    springs += static_cast<int>(line.springs.size());
  }

  int rungs() const { return last_node - first_node; }
};

/// Whether four nodes have particles in all lanes in use but the last three or less, and those of a
/// lane follow one another.
bool inRows(const SpringLadder& ladder, int node)
{
  if (node + 4 > ladder.nodes())
  {
    return false;
  }
  for (int lane = 0; lane < ladder.used / 4 * 4; ++lane)
  {
    const int first = ladder.particle(node, lane);
    for (int k = 0; k < 4; ++k)
    {
      if (first < 0 || ladder.particle(node + k, lane) != first + k)
      {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

SpringLines::SpringLines(const SpringTable& springs, const Vec3Array& places)
    : places_(springs.structural.size())
{
  const int particles = static_cast<int>(places.size());
  for (std::vector<SpringLine>& share : apart(findLines(springs, places), particles))
  {
    for (SpringLine& line : share)
    {
      line = ascending(std::move(line));
    }
    layLoose(laySideBySide(std::move(share), particles, springs), springs);
  }
}

/// @return the other lines
std::vector<SpringLine> SpringLines::laySideBySide(std::vector<SpringLine> lines, int particles,
                                                   const SpringTable& springs)
{
  std::map<Window, Neighbours> windows;
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    const Window window = windowOf(lines[i]);
    const int last = lines[i].particles.back();
    if (window.step > 0 && last - last % window.step + window.begin + LANES <= particles)
    {
      windows[window].add(i, lines[i], window.step);
    }
  }
  int step = 0;
  for (const auto& [window, found] : windows)
  {
    if (found.springs < DENSE * found.rungs() * window.lanes)
    {
      continue;
    }
    if (window.step != step || window.lanes < LANES)
    {
      endPhase();  // whole windows of one step have no particle in common, others may
    }
    step = window.step;
    SpringLadder empty;
    empty.first = found.first_node * step + window.begin;
    empty.step = step;
    const int ladder = addLadder(std::move(empty), found.rungs());
    for (std::size_t i : found.lines)
    {
      const int lane = lines[i].particles.front() % step - window.begin;
      int rung = lines[i].particles.front() / step - found.first_node;
      for (int spring : lines[i].springs)
      {
        put(ladder, rung++, lane, spring, springs);
      }
      lines[i].springs.clear();
    }
  }
  endPhase();
  lines.erase(std::remove_if(lines.begin(), lines.end(),
                             [](const SpringLine& line) { return line.springs.empty(); }),
              lines.end());
  return lines;
}

/// Fills lanes one line after the other, the longest first, always the shortest lane.
void SpringLines::layLoose(const std::vector<SpringLine>& lines, const SpringTable& springs)
{
  if (lines.empty())
  {
    return;
  }
  std::size_t nodes = 0;
  for (const SpringLine& line : lines)
  {
    nodes += line.particles.size();
  }
  const std::size_t full = LANES * lines.front().particles.size();
  const auto lanes = static_cast<int>((nodes + full - 1) / full * LANES);
  std::vector<std::vector<const SpringLine*>> filled(lanes);
  using Lane = std::pair<int, int>;  // nodes in it, and which it is
  std::priority_queue<Lane, std::vector<Lane>, std::greater<>> shortest;
  for (int lane = 0; lane < lanes; ++lane)
  {
    shortest.push({ 0, lane });
  }
  std::vector<int> lengths(lanes / LANES, 0);  // of the ladders, nodes
  for (const SpringLine& line : lines)
  {
    auto [length, lane] = shortest.top();
    shortest.pop();
    filled[lane].push_back(&line);
    length += static_cast<int>(line.particles.size());
    lengths[lane / LANES] = std::max(lengths[lane / LANES], length);
    shortest.push({ length, lane });
  }
  for (int first = 0; first < lanes; first += LANES)
  {
    if (lengths[first / LANES] == 0)
    {
      continue;
    }
    SpringLadder empty;
    empty.particles.assign(lengths[first / LANES] * LANES, NO_PARTICLE);
    const int ladder = addLadder(std::move(empty), lengths[first / LANES] - 1);
    for (int lane = 0; lane < LANES; ++lane)
    {
      layInLane(ladder, lane, filled[first + lane], springs);
    }
    notePattern(ladders_[ladder]);
  }
  endPhase();
}

void SpringLines::layInLane(int ladder, int lane, const std::vector<const SpringLine*>& lines,
                            const SpringTable& springs)
{
  int node = 0;
  for (const SpringLine* line : lines)
  {
    for (std::size_t i = 0; i < line->springs.size(); ++i)
    {
      put(ladder, node + static_cast<int>(i), lane, line->springs[i], springs);
    }
    for (int particle : line->particles)
    {
      ladders_[ladder].particles[node++ * LANES + lane] = particle;
    }
  }
}

/// What copying the ladder's particles can make use of.
void SpringLines::notePattern(SpringLadder& ladder)
{
  ladder.used = 0;
  for (std::size_t i = 0; i < ladder.particles.size(); ++i)
  {
    if (ladder.particles[i] != NO_PARTICLE)
    {
      ladder.used = std::max(ladder.used, static_cast<int>(i) % LANES + 1);
    }
  }
  for (int node = 0; node < ladder.nodes(); node += 4)
  {
    ladder.in_rows.push_back(inRows(ladder, node) ? 1 : 0);
  }
}

void SpringLines::endPhase()
{
  if (phases_.back() != static_cast<int>(ladders_.size()))
  {
    phases_.push_back(static_cast<int>(ladders_.size()));
  }
}

/// @return its index
int SpringLines::addLadder(SpringLadder ladder, int rungs)
{
  ladder.lanes.assign(rungs, noLanes());
  ladder.links.assign(rungs, noLinks());
  longest_ = std::max(longest_, rungs + 1);
  longest_copied_ = ladder.sideBySide() ? longest_copied_ : std::max(longest_copied_, rungs + 1);
  ladders_.push_back(std::move(ladder));
  return static_cast<int>(ladders_.size()) - 1;
}

void SpringLines::put(int ladder, int rung, int lane, int spring, const SpringTable& springs)
{
  ladders_[ladder].links[rung][lane] = linkOf(spring, false);
  places_[spring] = { ladder, rung, lane };
  write(spring, springs);
}

bool SpringLines::fits(const Place& place, const SpringLaw& law) const
{
  const SpringLadder& ladder = ladders_[place.ladder];
  const int from = ladder.particle(place.rung, place.lane);
  const int to = ladder.particle(place.rung + 1, place.lane);
  return law.active() && std::minmax(from, to) == std::minmax(law.a, law.b);
}

void SpringLines::follow(const SpringTable& springs, const std::vector<int>& changed)
{
  for (int spring : changed)
  {
    if (!has(linkOf(spring, false)))
    {
      continue;
    }
    Place& place = places_[spring];
    if (fits(place, springs.structural[spring]))
    {
      write(spring, springs);
      continue;
    }
    ladders_[place.ladder].links[place.rung][place.lane] = -1;
    clearLane(ladders_[place.ladder].lanes[place.rung], place.lane);
    place = {};
  }
}

/// What a spring is like, into its lane.
void SpringLines::write(int spring, const SpringTable& springs)
{
  const Place& place = places_[spring];
  writeLane(ladders_[place.ladder].lanes[place.rung], place.lane, springs.structural[spring],
            watched_);
}

void SpringLines::watch(const SpringTable& springs, Real watched)
{
  watched_ = watched;
  for (int spring = 0; spring < static_cast<int>(places_.size()); ++spring)
  {
    if (places_[spring].ladder >= 0)
    {
      write(spring, springs);
    }
  }
}

}  // namespace cloth
