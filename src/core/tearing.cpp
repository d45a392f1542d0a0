// Thresholds, order and the edits of a tear.
#include "cloth_tearing/core/tearing.h"

#include <algorithm>
#include <cmath>

#include "cloth_tearing/core/held_sides.h"

namespace cloth
{
namespace
{

/// How far a one-point tear may shift its copy, as a fraction of the rest length (3.2.3).
constexpr double LARGEST_SHIFT = 0.25;

/// Lengths in Real are taken for a little longer than they are: rounding must not hide a spring.
constexpr double ROUNDING = 1.0 - 1e-5;

bool worseFirst(const TearReading& a, const TearReading& b)
{
  return a.utilisation() != b.utilisation() ? a.utilisation() > b.utilisation()
                                            : a.spring < b.spring;
}

double tension(const Cloth& cloth, SpringId s)
{
  const SpringLaw& law = cloth.springs.structural[s.index];
  return law.stiffness * cloth.strain(s) * cloth.rest.length[s.index];
}

/// The texture position of `p` in one of its triangles.
Vec2d textureAt(const Mesh& mesh, TriangleId t, ParticleId p)
{
  const Triangle& triangle = mesh.triangle(t);
  return triangle.uv[triangle.cornerOf(p)];
}

/// A NaN must not hide.
void keepLarger(double& most, double strain)
{
  most = strain > most || !(strain == strain) ? strain : most;
}

/// A tear ends at `p` now and may run on, unless it is pinned, or hangs by one point there.
void weaken(Cloth& cloth, ParticleId p)
{
  const bool can = !cloth.attachments[p.index].pinned() && !cloth.damage.hinge[p.index];
  cloth.damage.weak[p.index] = can ? 1 : 0;
}

/// Whether a triangle of the spring has a side that was released. A spring that began there would
/// be as long as that side has become.
bool isBesideReleased(const Cloth& cloth, SpringId s)
{
  for (TriangleId t : cloth.mesh.spring(s).triangles)
  {
    if (t.valid())
    {
      const auto& sides = cloth.mesh.triangle(t).springs;
      if (std::any_of(sides.begin(), sides.end(),
                      [&](SpringId side) { return cloth.damage.released[side.index] != 0; }))
      {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

double largestStrain(const Cloth& cloth)
{
  double most = 0.0;
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    if (cloth.springs.structural[i].active())
    {
      keepLarger(most, cloth.strain({ i }));
    }
  }
  return most;
}

/// What every threshold of the spring is multiplied by [-].
double Tearing::strength(const Cloth& cloth, SpringId s) const
{
  const auto& ends = cloth.mesh.spring(s).particles;
  const bool hem = cloth.damage.hem[ends[0].index] || cloth.damage.hem[ends[1].index];
  return cloth.damage.strength[s.index] * (hem ? rules_.hem_factor : 1.0);
}

double Tearing::crackBand(const Cloth& cloth, SpringId s) const
{
  return std::max(1.0, std::sqrt(rules_.crack_length / cloth.rest.length[s.index]));
}

std::vector<Tearing::Option> Tearing::options(const Cloth& cloth, SpringId s) const
{
  std::vector<Option> found;
  for (ParticleId p : cloth.mesh.spring(s).particles)
  {
    if (cloth.attachments[p.index].pinned())
    {
      continue;  // never doubled: the load moves on
    }
    const double factor = strength(cloth, s);
    if (cloth.damage.hinge[p.index])
    {
      found.push_back({ TearKind::ONE_POINT, p, factor * rules_.onePointThreshold(), 0.0 });
    }
    else if (cloth.damage.weak[p.index])
    {
      const double threshold = factor * crackBand(cloth, s) * rules_.weak_tear_strain;
      found.push_back({ TearKind::WEAK_POINT, p, threshold, 0.0 });
    }
  }
  if (found.size() == 2)
  {
    for (Option& option : found)
    {
      option.resistance = resistanceAt(cloth, option.at, s);
    }
    const auto preferred = [](const Option& a, const Option& b)
    {
      if (a.kind != b.kind)
      {
        return a.kind == TearKind::ONE_POINT;
      }
      return a.resistance != b.resistance ? a.resistance > b.resistance : a.at < b.at;
    };
    std::sort(found.begin(), found.end(), preferred);
  }
  return found;
}

/// How the spring would tear, and at what strain.
TearReading Tearing::unread(const Cloth& cloth, SpringId s) const
{
  TearReading reading{ s, TearKind::BASIC, 0.0, strength(cloth, s) * rules_.tear_strain };
  const auto& ends = cloth.mesh.spring(s).particles;
  const auto vulnerable = [&](ParticleId p)
  { return cloth.damage.hinge[p.index] || cloth.damage.weak[p.index]; };
  if (vulnerable(ends[0]) || vulnerable(ends[1]))
  {
    const std::vector<Option> ways = options(cloth, s);
    for (std::size_t i = 0; i < ways.size(); ++i)
    {
      if (i == 0 || ways[i].threshold < reading.threshold)
      {
        reading.kind = ways[i].kind;
        reading.threshold = ways[i].threshold;
      }
    }
  }
  return reading;
}

TearReading Tearing::read(const Cloth& cloth, SpringId s, double own) const
{
  TearReading reading = unread(cloth, s);
  const bool on_patch = reading.kind == TearKind::BASIC && own > reading.threshold;
  reading.strain = on_patch ? patch_.readStill(cloth, s, rules_.tear_radius) : own;
  return reading;
}

/// The least threshold of a spring of strength 1 [-].
double Tearing::leastRule() const
{
  return std::min({ rules_.tear_strain, rules_.weak_tear_strain, rules_.onePointThreshold() });
}

double Tearing::leastThreshold(const Cloth& cloth) const
{
  return cloth.damage.least_strength * leastRule();
}

void Tearing::look(const Cloth& cloth, SpringId s, double& most)
{
  const double own = cloth.strain(s);
  keepLarger(most, own);
  if (rules_.enabled && own > cloth.damage.strength[s.index] * leastRule())
  {
    const TearReading reading = read(cloth, s, own);
    if (reading.utilisation() > 1.0)
    {
      found_.push_back(reading);
    }
  }
}

double Tearing::scan(const Cloth& cloth)
{
  beginScan();
  const auto& x = cloth.state.position;
  double most = 0.0;
  const double least = leastThreshold(cloth);
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    const SpringLaw& law = cloth.springs.structural[i];
    const auto bound = static_cast<Real>(ROUNDING * (1.0 + std::min(most, least)));
    // Squares tell which springs are worth a closer look; a NaN is.
    if (law.active() &&
        !((x[law.b] - x[law.a]).squaredNorm() <= (bound * law.rest) * (bound * law.rest)))
    {
      look(cloth, { i }, most);
    }
  }
  concludeScan(cloth);
  return most;
}

double Tearing::scan(const Cloth& cloth, const std::vector<int>& springs)
{
  beginScan();
  double most = 0.0;
  for (int i : springs)
  {
    look(cloth, { i }, most);
  }
  concludeScan(cloth);
  return most;
}

void Tearing::beginScan()
{
  found_.clear();
  patch_.moved();
}

void Tearing::concludeScan(const Cloth& cloth)
{
  std::sort(found_.begin(), found_.end(), worseFirst);
  read_at_ = cloth.damage.tears;
}

std::vector<TearEvent> Tearing::tear(Cloth& cloth, std::vector<Grasp>& grasps,
                                     const Blocked& blocked, int& postponed)
{
  std::vector<TearEvent> events;
  postponed = 0;
  if (found_.empty())
  {
    return events;
  }
  ++pass_;
  touched_.resize(cloth.mesh.particleCount(), 0);
  for (const TearReading& reading : found_)
  {
    const bool full = static_cast<int>(events.size()) >= rules_.max_tears_per_step;
    if (full || touched(cloth, reading.spring))
    {
      ++postponed;
      continue;
    }
    TearEvent event;
    event.spring = reading.spring;
    event.tension = tension(cloth, reading.spring);
    if (tearSpring(cloth, grasps, reading, blocked, event))
    {
      events.push_back(std::move(event));
    }
  }
  found_.clear();
  return events;
}

bool Tearing::touched(const Cloth& cloth, SpringId s) const
{
  const auto& ends = cloth.mesh.spring(s).particles;
  return touched_[ends[0].index] == pass_ || touched_[ends[1].index] == pass_;
}

bool Tearing::tearSpring(Cloth& cloth, std::vector<Grasp>& grasps, const TearReading& reading,
                         const Blocked& blocked, TearEvent& event)
{
  const SpringId s = reading.spring;
  const double own = cloth.strain(s);
  const std::vector<Option> ways = options(cloth, s);
  bool held = ways.empty();  // a weak spring tears as sound cloth only where it has no way to go
  for (const Option& way : ways)
  {
    if (own <= way.threshold)
    {
      continue;
    }
    event.strain = own;
    event.threshold = way.threshold;
    if (way.kind == TearKind::ONE_POINT)
    {
      tearOnePoint(cloth, grasps, s, way.at, blocked, event);
      return true;
    }
    if (const auto path = findTearPath(cloth, way.at, s))
    {
      tearAlong(cloth, grasps, way.at, *path, event);
      return true;
    }
    // Cloth round a particle in a gripper may be slack: then it is the gripper that resists.
    held = held || cloth.attachments[way.at.index].held() || resistanceAt(cloth, way.at, s) > 0.0;
  }
  if (!held)
  {
    return false;
  }
  // The first tear of a step finds the cloth as it was read.
  const bool as_read = reading.kind == TearKind::BASIC && cloth.damage.tears == read_at_;
  const double patch = as_read ? reading.strain : patch_.read(cloth, s, rules_.tear_radius);
  return tearSound(cloth, grasps, s, patch, event);
}

bool Tearing::tearSound(Cloth& cloth, std::vector<Grasp>& grasps, SpringId s, double patch,
                        TearEvent& event)
{
  event.strain = patch;
  event.threshold = strength(cloth, s) * rules_.tear_strain;
  if (event.strain <= event.threshold)
  {
    return false;
  }
  if (!isBesideReleased(cloth, s) && canSplit(cloth, s))
  {
    tearAcross(cloth, s, event);
    return true;
  }
  // Too fine to split: part the cloth along its springs, at the end that resists more.
  std::optional<TearPath> best;
  ParticleId at;
  for (ParticleId p : cloth.mesh.spring(s).particles)
  {
    const auto path =
        cloth.attachments[p.index].pinned() ? std::nullopt : findTearPath(cloth, p, s);
    if (path && (!best || path->resistance > best->resistance))
    {
      best = path;
      at = p;
    }
  }
  if (best)
  {
    tearAlong(cloth, grasps, at, *best, event);
  }
  else
  {
    release(cloth, s, event);
  }
  return true;
}

bool Tearing::canSplit(const Cloth& cloth, SpringId s) const
{
  const double half = 0.5 * cloth.rest.length[s.index];
  for (TriangleId t : cloth.mesh.spring(s).triangles)
  {
    if (!t.valid())
    {
      continue;
    }
    const Triangle& triangle = cloth.mesh.triangle(t);
    const int side = triangle.sideOf(s);
    const double a = cloth.rest.length[triangle.springs[(side + 1) % 3].index];
    const double b = cloth.rest.length[triangle.springs[(side + 2) % 3].index];
    const double median = medianLength(a, b, 2.0 * half);
    const double altitude = cloth.rest.area[t.index] /
                            std::max({ half, a, b, median });  // of a half: 2 (area / 2) / side
    const double spacing = cloth.rest.spacing[t.index];
    if (half < rules_.min_length * spacing || median < rules_.min_length * spacing ||
        altitude < rules_.min_altitude * spacing)
    {
      return false;
    }
  }
  return true;
}

void Tearing::tearAcross(Cloth& cloth, SpringId s, TearEvent& event)
{
  const Spring torn = cloth.mesh.spring(s);
  const std::array<ParticleId, 2> corners = { cloth.mesh.opposite(s, 0),
                                              cloth.mesh.opposite(s, 1) };
  const int a = torn.particles[0].index;
  const int b = torn.particles[1].index;
  ParticleState& state = cloth.state;
  event.kind = TearKind::BASIC;
  event.position = 0.5 * (state.position[a] + state.position[b]).cast<double>();
  event.uv = 0.5 * (textureAt(cloth.mesh, torn.triangles[0], torn.particles[0]) +
                    textureAt(cloth.mesh, torn.triangles[0], torn.particles[1]));

  // Each split point goes to rest half-length from its own end (figure 3.9).
  const Vec3 along = state.position[b] - state.position[a];
  const double length = along.cast<double>().norm();
  const auto fraction = static_cast<Real>(0.5 * cloth.rest.length[s.index] / length);
  const Vec3 slip = state.velocity[b] - state.velocity[a];

  const Edit edit = cloth.mesh.splitSpring(s);
  cloth.follow(edit);
  const int near = edit.particles[0].id.index;
  const int far = edit.particles[1].id.index;
  state.position[near] = state.position[a] + fraction * along;
  state.position[far] = state.position[b] - fraction * along;
  state.velocity[near] = state.velocity[a] + fraction * slip;
  state.velocity[far] = state.velocity[b] - fraction * slip;
  for (ParticleId corner : corners)
  {
    if (corner.valid())
    {
      weaken(cloth, corner);
    }
  }
  conclude(cloth, edit, event);
}

void Tearing::tearAlong(Cloth& cloth, std::vector<Grasp>& grasps, ParticleId p,
                        const TearPath& path, TearEvent& event)
{
  std::vector<ParticleId> far_ends;
  for (SpringId s : path.springs)
  {
    far_ends.push_back(cloth.mesh.spring(s).other(p));
  }
  const bool sound = path.springs.size() == 2;
  event.kind = sound ? TearKind::BASIC : TearKind::WEAK_POINT;
  event.path = sound ? SpringId{} : path.springs.front();
  event.position = cloth.state.position[p.index].cast<double>();
  event.uv = textureAt(cloth.mesh, cloth.mesh.spring(event.spring).triangles[0], p);

  const Edit edit = sound ? cloth.mesh.openAlong(p, path.springs[0], path.springs[1])
                          : cloth.mesh.detachAlong(p, path.springs[0]);
  cloth.follow(edit);
  cloth.damage.weak[p.index] = 0;  // figure 3.17: the tear has moved on
  for (ParticleId end : far_ends)
  {
    weaken(cloth, end);
  }
  keepHeld(cloth, grasps, edit, event.spring);
  conclude(cloth, edit, event);
}

void Tearing::tearOnePoint(Cloth& cloth, std::vector<Grasp>& grasps, SpringId s, ParticleId p,
                           const Blocked& blocked, TearEvent& event)
{
  const TriangleId pulled = cloth.mesh.spring(s).triangles[0];
  event.kind = TearKind::ONE_POINT;
  event.position = cloth.state.position[p.index].cast<double>();
  event.uv = textureAt(cloth.mesh, pulled, p);

  const Edit edit = cloth.mesh.detachFan(p, pulled);
  cloth.follow(edit);
  cloth.damage.weak[p.index] = 0;
  keepHeld(cloth, grasps, edit, s);
  const ParticleId copy = edit.particles.front().id;
  relieve(cloth, s, copy, blocked);
  if (const auto loose = pieces_.parted(cloth.mesh, p, copy))
  {
    ++cloth.damage.pieces;
    for (ParticleId q : *loose)
    {
      event.loose_mass += cloth.rest.mass[q.index];
    }
    event.loose_area = event.loose_mass / cloth.rest.areal_density;
  }
  conclude(cloth, edit, event);
}

void Tearing::release(Cloth& cloth, SpringId s, TearEvent& event)
{
  const auto& ends = cloth.mesh.spring(s).particles;
  const TriangleId t = cloth.mesh.spring(s).triangles[0];
  event.kind = TearKind::RELEASED;
  event.position =
      0.5 *
      (cloth.state.position[ends[0].index] + cloth.state.position[ends[1].index]).cast<double>();
  event.uv = 0.5 * (textureAt(cloth.mesh, t, ends[0]) + textureAt(cloth.mesh, t, ends[1]));
  cloth.release(s);
  ++cloth.damage.tears;
  patch_.follow(cloth, {});
  event.pieces = cloth.damage.pieces;
}

/// Draws the copy of a one-point tear along the pull if its spring would tear again at once
/// (3.2.3), a little and never into an obstacle.
void Tearing::relieve(Cloth& cloth, SpringId s, ParticleId copy, const Blocked& blocked) const
{
  const double threshold = cloth.damage.strength[s.index] * rules_.weak_tear_strain;
  const double excess = cloth.strain(s) - threshold;
  if (excess <= 0.0 || cloth.attachments[copy.index].held())
  {
    return;
  }
  const double shift = std::min(excess, LARGEST_SHIFT) * cloth.rest.length[s.index];
  const Vec3 pull = cloth.direction(s, copy);
  const Vec3 place =
      cloth.state.position[copy.index] + static_cast<Real>(shift) / pull.norm() * pull;
  if (!blocked(place))
  {
    cloth.state.position[copy.index] = place;
  }
}

void Tearing::conclude(Cloth& cloth, const Edit& edit, TearEvent& event)
{
  for (const auto& added : edit.particles)
  {
    event.particles.push_back({ added.id, added.parents });
  }
  event.triangles = edit.touched;
  event.pieces = cloth.damage.pieces;
  patch_.follow(cloth, edit.touched);

  touched_.resize(cloth.mesh.particleCount(), 0);
  for (ParticleId p : edit.near_particles)
  {
    touched_[p.index] = pass_;
  }
}

TearReading Tearing::worst(const Cloth& cloth) const
{
  std::vector<SpringId> all(cloth.mesh.springCount());
  for (int i = 0; i < cloth.mesh.springCount(); ++i)
  {
    all[i] = { i };
  }
  return worst(cloth, all);
}

TearReading Tearing::worst(const Cloth& cloth, const std::vector<SpringId>& springs) const
{
  // A reading is at most the spring's own strain over its threshold: look in that order.
  patch_.moved();
  std::vector<TearReading> bounds;
  for (SpringId s : springs)
  {
    const double own = cloth.springs.structural[s.index].active() ? cloth.strain(s) : 0.0;
    if (own > 0.0)
    {
      bounds.push_back(unread(cloth, s));
      bounds.back().strain = own;
    }
  }
  const auto lower = [](const TearReading& a, const TearReading& b) { return worseFirst(b, a); };
  std::make_heap(bounds.begin(), bounds.end(), lower);
  TearReading best;
  best.threshold = 1.0;
  while (!bounds.empty() && bounds.front().utilisation() > best.utilisation())
  {
    TearReading candidate = bounds.front();
    std::pop_heap(bounds.begin(), bounds.end(), lower);
    bounds.pop_back();
    if (candidate.kind == TearKind::BASIC)
    {
      candidate.strain = patch_.readStill(cloth, candidate.spring, rules_.tear_radius);
    }
    if (candidate.utilisation() > best.utilisation())
    {
      best = candidate;
    }
  }
  return best;
}

}  // namespace cloth
