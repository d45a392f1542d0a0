// Measures the springs at pushed particles once more.
#include "cloth_tearing/core/pushed_springs.h"

#include <algorithm>

#include "cloth_tearing/core/sort_once.h"

namespace cloth
{
namespace
{

/// Springs that are measured in one go.
constexpr int STRETCH = 2048;

/// If more than one in so many particles was pushed, measuring all springs costs less.
constexpr std::size_t FEW = 4;

/// @param limit squared length over squared rest length
bool isStretched(const Cloth& cloth, int spring, Real limit)
{
  const SpringLaw& law = cloth.springs.structural[spring];
  const auto& x = cloth.state.position;
  return law.active() && !((x[law.b] - x[law.a]).squaredNorm() <= limit * (law.rest * law.rest));
}

}  // namespace

const std::vector<int>& PushedSprings::find(const Cloth& cloth, const std::vector<int>& noted,
                                            const std::vector<int>& pushed, double strain,
                                            WorkerPool* workers)
{
  const auto limit = static_cast<Real>((1.0 + strain) * (1.0 + strain));
  const auto room = static_cast<std::size_t>(cloth.mesh.springCount());
  if (springs_.capacity() < room)
  {
    springs_.reserve(2 * room);  // steady steps do not allocate
  }
  springs_ = noted;
  if (FEW * pushed.size() > static_cast<std::size_t>(cloth.mesh.particleCount()))
  {
    addOfAll(cloth, limit, workers);
  }
  else
  {
    addAt(cloth, pushed, limit);
  }
  sortOnce(springs_);
  return springs_;
}

void PushedSprings::addAt(const Cloth& cloth, const std::vector<int>& pushed, Real limit)
{
  const Mesh& mesh = cloth.mesh;
  const auto look = [&](SpringId s)
  {
    if (isStretched(cloth, s.index, limit))
    {
      springs_.push_back(s.index);
    }
  };
  for (int p : pushed)
  {
    mesh.forEachTriangleAt({ p },
                           [&](TriangleId t)
                           {
                             const Triangle& triangle = mesh.triangle(t);
                             const int k = triangle.cornerOf({ p });
                             look(triangle.springs[k]);
                             look(triangle.springs[(k + 2) % 3]);
                           });
  }
}

void PushedSprings::addOfAll(const Cloth& cloth, Real limit, WorkerPool* workers)
{
  const int count = cloth.mesh.springCount();
  found_.resize((count + STRETCH - 1) / STRETCH);
  share(workers, static_cast<int>(found_.size()),
        [&](int i)
        {
          std::vector<int>& found = found_[i];
          found.clear();
          found.reserve(STRETCH);
          for (int s = i * STRETCH; s < std::min(count, (i + 1) * STRETCH); ++s)
          {
            if (isStretched(cloth, s, limit))
            {
              found.push_back(s);
            }
          }
        });
  for (const std::vector<int>& found : found_)
  {
    springs_.insert(springs_.end(), found.begin(), found.end());
  }
}

}  // namespace cloth
