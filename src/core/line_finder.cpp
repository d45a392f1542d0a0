// Joins springs into lines, and lines into shares without common particles.
#include "cloth_tearing/core/line_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "cloth_tearing/core/spring_lanes.h"

namespace cloth
{
namespace
{

/// Lines of fewer springs gain nothing: these are solved one by one.
constexpr std::size_t SHORTEST_LINE = 3;

/// Cosine of the greatest turn of a line.
constexpr double STRAIGHT = 0.3;

/// Lines go into at most so many shares.
constexpr int MOST_SHARES = 64;

/// Cosine of the turn from one way to the next; NaN if one has no length.
double cosine(const Vec3Array& places, int from, int at, int to)
{
  double product = 0.0;
  double squared[2] = {};
  for (int k = 0; k < 3; ++k)
  {
    const double here = places.axis(k)[at];
    const double in = here - places.axis(k)[from];
    const double out = places.axis(k)[to] - here;
    product += in * out;
    squared[0] += in * in;
    squared[1] += out * out;
  }
  return product / std::sqrt(squared[0] * squared[1]);
}

/// A spring on the way along a line.
struct Step
{
  int spring;
  int to;  ///< particle at its far end
};

class Finder
{
public:
  Finder(const std::vector<SpringLaw>& springs, const Vec3Array& places)
      : springs_(springs)
      , places_(places)
      , at_(places.size())
      , next_(springs.size(), { -1, -1 })
      , taken_(springs.size(), 0)
      , line_at_(places.size(), -1)
  {
    for (int i = 0; i < static_cast<int>(springs.size()); ++i)
    {
      if (springs[i].active())
      {
        at_[springs[i].a].push_back(i);
        at_[springs[i].b].push_back(i);
      }
    }
    for (int p = 0; p < static_cast<int>(at_.size()); ++p)
    {
      pairUp(p);
    }
  }

  std::vector<SpringLine> lines()
  {
    std::vector<SpringLine> lines;
    for (int i = 0; i < static_cast<int>(springs_.size()); ++i)
    {
      if (springs_[i].active() && !taken_[i])
      {
        lines.push_back(lineFrom(beginOf(i), static_cast<int>(lines.size())));
      }
    }
    return lines;
  }

private:
  int otherEnd(int spring, int particle) const
  {
    return springs_[spring].a == particle ? springs_[spring].b : springs_[spring].a;
  }

  /// The spring that goes on from `particle`, the end of `spring`; -1: none.
  int& next(int spring, int particle)
  {
    return next_[spring][springs_[spring].a == particle ? 0 : 1];
  }

  void pairUp(int particle)
  {
    struct Pair
    {
      double cosine;
      int one;
      int other;
    };
    std::vector<Pair> pairs;
    const std::vector<int>& springs = at_[particle];
    for (std::size_t i = 0; i < springs.size(); ++i)
    {
      for (std::size_t k = i + 1; k < springs.size(); ++k)
      {
        const double straight = cosine(places_, otherEnd(springs[i], particle), particle,
                                       otherEnd(springs[k], particle));
        if (straight > STRAIGHT)
        {
          pairs.push_back({ straight, springs[i], springs[k] });
        }
      }
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.cosine > b.cosine; });
    for (const Pair& pair : pairs)
    {
      int& after_one = next(pair.one, particle);
      int& after_other = next(pair.other, particle);
      if (after_one < 0 && after_other < 0)
      {
        after_one = pair.other;
        after_other = pair.one;
      }
    }
  }

  /// Where the line through a spring begins, or any of its springs if it is a ring.
  Step beginOf(int spring)
  {
    Step step{ spring, springs_[spring].b };
    while (true)
    {
      const int from = otherEnd(step.spring, step.to);
      const int before = next(step.spring, from);
      if (before < 0 || before == spring || taken_[before])
      {
        return step;
      }
      step = { before, from };
    }
  }

  SpringLine lineFrom(Step step, int line)
  {
    SpringLine found;
    const int begin = otherEnd(step.spring, step.to);
    found.particles.push_back(begin);
    line_at_[begin] = line;
    while (step.spring >= 0 && !taken_[step.spring] && line_at_[step.to] != line)
    {
      taken_[step.spring] = 1;
      found.springs.push_back(step.spring);
      found.particles.push_back(step.to);
      line_at_[step.to] = line;
      const int after = next(step.spring, step.to);
      step = { after, after < 0 ? -1 : otherEnd(after, step.to) };
    }
    return found;
  }

  const std::vector<SpringLaw>& springs_;
  const Vec3Array& places_;
  std::vector<std::vector<int>> at_;      ///< springs by particle
  std::vector<std::array<int, 2>> next_;  ///< by spring: what goes on from either end
  std::vector<char> taken_;               ///< by spring
  std::vector<int> line_at_;              ///< by particle: the last line there
};

int lowestFree(std::uint64_t used)
{
  int bit = 0;
  while (bit < MOST_SHARES && (used >> bit & 1) != 0)
  {
    ++bit;
  }
  return bit;
}

}  // namespace

std::vector<SpringLine> findLines(const SpringTable& springs, const Vec3Array& places)
{
  std::vector<SpringLine> lines = Finder(springs.structural, places).lines();
  lines.erase(
      std::remove_if(lines.begin(), lines.end(),
                     [](const SpringLine& line) { return line.springs.size() < SHORTEST_LINE; }),
      lines.end());
  std::stable_sort(lines.begin(), lines.end(),
                   [](const SpringLine& a, const SpringLine& b)
                   { return a.springs.size() > b.springs.size(); });
  return lines;
}

double unbraced(const std::vector<SpringLine>& lines, const SpringTable& springs,
                const Vec3Array& places)
{
  int ends = 0;
  std::vector<char> border(places.size(), 0);
  for (std::size_t i = 0; i < springs.structural.size(); ++i)
  {
    const SpringLaw& law = springs.structural[i];
    ends += law.active() ? 2 : 0;
    if (law.active() && !springs.bend_shear[i].active())
    {
      border[law.a] = 1;
      border[law.b] = 1;
    }
  }
  double braced = 0.0;
  for (const SpringLine& line : lines)
  {
    const std::vector<int>& p = line.particles;
    braced += border[p.front()] + border[p.back()];
    for (std::size_t i = 1; i + 1 < p.size(); ++i)
    {
      const double straight = cosine(places, p[i - 1], p[i], p[i + 1]);
      braced += 2.0 * straight * straight;
    }
  }
  return ends == 0 ? 0.0 : 1.0 - braced / ends;
}

std::vector<std::vector<SpringLine>> apart(const std::vector<SpringLine>& lines, int particles)
{
  std::vector<std::vector<SpringLine>> shares;
  std::vector<std::uint64_t> touched(particles, 0);  // by which shares
  for (const SpringLine& line : lines)
  {
    std::uint64_t used = 0;
    for (int p : line.particles)
    {
      used |= touched[p];
    }
    const int share = lowestFree(used);
    if (share == MOST_SHARES)
    {
      continue;
    }
    shares.resize(std::max(shares.size(), static_cast<std::size_t>(share) + 1));
    shares[share].push_back(line);
    for (int p : line.particles)
    {
      touched[p] |= bitOf(share);
    }
  }
  return shares;
}

}  // namespace cloth
