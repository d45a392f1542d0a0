// The heuristic of thesis 3.2.2.
#include "cloth_tearing/core/tear_path.h"

#include <algorithm>
#include <cmath>

namespace cloth
{
namespace
{

/// One spring of the fan as `p` feels it.
struct Pull
{
  int place;       ///< in the fan
  double against;  ///< tension against the stretched spring's pull [N]
  double cosine;   ///< of its angle to the pull
};

std::vector<Pull> pulls(const Cloth& cloth, ParticleId p, const Fan& fan, SpringId stretched)
{
  const Vec3d pull = cloth.direction(stretched, p).cast<double>();
  const double pull_length = pull.norm();
  std::vector<Pull> all;
  for (std::size_t i = 0; i < fan.springs.size(); ++i)
  {
    const Vec3d d = cloth.direction(fan.springs[i], p).cast<double>();
    const double length = d.norm();
    const double denominator = length * pull_length;
    const double cosine = denominator > 0.0 ? d.dot(pull) / denominator : 0.0;
    const SpringLaw& law = cloth.springs.structural[fan.springs[i].index];
    const double tension = law.active() ? std::max(0.0, law.stiffness * (length - law.rest)) : 0.0;
    all.push_back({ static_cast<int>(i), -tension * cosine, cosine });
  }
  return all;
}

/// The spring nearest the perpendicular among the places strictly between `from` and `to`, going
/// up and round a closed fan; none if there are none.
SpringId mostPerpendicular(const Fan& fan, const std::vector<Pull>& pulls, int from, int to)
{
  const int count = static_cast<int>(fan.springs.size());
  SpringId best;
  double least = 0.0;
  for (int i = (from + 1) % count; i != to; i = (i + 1) % count)
  {
    const double cosine = std::abs(pulls[i].cosine);
    const SpringId s = fan.springs[i];
    if (!best.valid() || cosine < least || (cosine == least && s < best))
    {
      best = s;
      least = cosine;
    }
  }
  return best;
}

Fan fanOf(const Cloth& cloth, ParticleId p, SpringId s)
{
  return cloth.mesh.fanAt(p, cloth.mesh.spring(s).triangles[0]);
}

/// Those that resist, most first, ties by id.
std::vector<Pull> resisting(const Fan& fan, std::vector<Pull> pulls)
{
  pulls.erase(
      std::remove_if(pulls.begin(), pulls.end(), [](const Pull& f) { return !(f.against > 0.0); }),
      pulls.end());
  std::sort(pulls.begin(), pulls.end(),
            [&](const Pull& a, const Pull& b)
            {
              return a.against != b.against ? a.against > b.against
                                            : fan.springs[a.place] < fan.springs[b.place];
            });
  return pulls;
}

}  // namespace

std::optional<TearPath> findTearPath(const Cloth& cloth, ParticleId p, SpringId stretched)
{
  const Fan fan = fanOf(cloth, p, stretched);
  const std::vector<Pull> all = pulls(cloth, p, fan, stretched);
  const int pulled = fan.indexOf(stretched);
  for (const Pull& held : resisting(fan, all))
  {
    TearPath path;
    path.resistance = held.against;
    const SpringId between =
        mostPerpendicular(fan, all, std::min(pulled, held.place), std::max(pulled, held.place));
    if (!between.valid())
    {
      continue;
    }
    path.springs.push_back(between);
    if (fan.closed)
    {
      const SpringId other_side =
          mostPerpendicular(fan, all, std::max(pulled, held.place), std::min(pulled, held.place));
      if (!other_side.valid())
      {
        continue;
      }
      path.springs.push_back(other_side);
    }
    return path;
  }
  return std::nullopt;
}

double resistanceAt(const Cloth& cloth, ParticleId p, SpringId stretched)
{
  const Fan fan = fanOf(cloth, p, stretched);
  double most = 0.0;
  for (const Pull& pull : pulls(cloth, p, fan, stretched))
  {
    most = std::max(most, pull.against);
  }
  return most;
}

}  // namespace cloth
