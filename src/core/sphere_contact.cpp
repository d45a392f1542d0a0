// Swept contact of triangles with spheres, and the floor.
#include "cloth_tearing/core/sphere_contact.h"

#include <algorithm>
#include <cmath>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/kernels.h"

namespace cloth
{
namespace
{

/// Neighbouring triangles push shared particles in turn, each a little against the other. After a
/// push deeper than this fraction of the reach they are looked at again, so that a small fast ball
/// does not work its way through.
constexpr Real DEEP_PUSH = Real(0.1);
constexpr int MAX_PASSES = 8;

/// Cloth nearer to the centre of a new sphere than this fraction of its reach was not struck by it:
/// the sphere was placed into the cloth.
constexpr Real INSIDE = Real(0.9);

/// Beside a held corner a push makes a free one part from the sphere by no more than this fraction
/// of the speed with which they met.
constexpr Real LEAD = Real(0.5);

/// Tiles that are put onto the floor in one go.
constexpr int TILES = 64;

/// Weights of the corners at the point of triangle (a, b, c) nearest to the origin
/// (Ericson, Real-Time Collision Detection, 5.1.5).
Vec3 nearestWeights(const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Real d1 = -ab.dot(a);
  const Real d2 = -ac.dot(a);
  if (d1 <= 0 && d2 <= 0)
  {
    return { 1, 0, 0 };
  }
  const Real d3 = -ab.dot(b);
  const Real d4 = -ac.dot(b);
  if (d3 >= 0 && d4 <= d3)
  {
    return { 0, 1, 0 };
  }
  const Real vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0)
  {
    const Real t = d1 / (d1 - d3);
    return { 1 - t, t, 0 };
  }
  const Real d5 = -ab.dot(c);
  const Real d6 = -ac.dot(c);
  if (d6 >= 0 && d5 <= d6)
  {
    return { 0, 0, 1 };
  }
  const Real vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0)
  {
    const Real t = d2 / (d2 - d6);
    return { 1 - t, 0, t };
  }
  const Real va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6)
  {
    const Real t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return { 0, 1 - t, t };
  }
  const Real sum = va + vb + vc;
  return sum > 0 ? Vec3(va / sum, vb / sum, vc / sum) : Vec3(1, 0, 0);
}

/// Where a triangle meets a sphere in one step.
struct Contact
{
  Vec3 weights;  ///< of the corners at the point that touches
  Vec3 normal;   ///< from the sphere's centre to it
};

struct Corners
{
  std::array<Vec3, 3> start;  ///< relative to the sphere's centre at the start of the step
  std::array<Vec3, 3> end;    ///< relative to its centre at the end

  Vec3 at(int corner, Real fraction) const
  {
    return start[corner] + fraction * (end[corner] - start[corner]);
  }
};

/// The first touch within the step, sampled so finely that the sphere's centre cannot pass
/// through the triangle between two samples.
/// @return whether they come closer than `reach`
bool firstTouch(const Corners& corners, Real reach, Contact& contact)
{
  Real travel = 0;
  for (int k = 0; k < 3; ++k)
  {
    travel = std::max(travel, (corners.end[k] - corners.start[k]).squaredNorm());
  }
  const int samples =
      1 + static_cast<int>(std::min(Real(1000), std::sqrt(travel) / (Real(0.5) * reach)));
  for (int i = samples == 1 ? 1 : 0; i <= samples; ++i)
  {
    const Real fraction = Real(i) / Real(samples);
    const std::array<Vec3, 3> x = { corners.at(0, fraction), corners.at(1, fraction),
                                    corners.at(2, fraction) };
    contact.weights = nearestWeights(x[0], x[1], x[2]);
    const Vec3 nearest =
        contact.weights[0] * x[0] + contact.weights[1] * x[1] + contact.weights[2] * x[2];
    const Real squared = nearest.squaredNorm();
    if (squared >= reach * reach)
    {
      continue;
    }
    const Real distance = std::sqrt(squared);
    // A centre in the plane of the triangle leaves no side to choose: take its front.
    const Vec3 front = (x[1] - x[0]).cross(x[2] - x[0]);
    const Vec3 away = distance > Real(1e-3) * reach ? nearest : front;
    const Real length = std::sqrt(away.squaredNorm());
    contact.normal = length > 0 ? Vec3(away / length) : Vec3(0, 0, 1);
    return true;
  }
  return false;
}

/// Velocity change that keeps two things from approaching along `normal`, and rubs.
Vec3 velocityChange(const Vec3& relative, const Vec3& normal, Real friction)
{
  const Real approach = -relative.dot(normal);
  if (!(approach > 0))
  {
    return Vec3::Zero();
  }
  const Vec3 slip = relative + approach * normal;
  const Real slip_speed = std::sqrt(slip.squaredNorm());
  const Real rubbed = std::min(slip_speed, friction * approach);
  return approach * normal - (slip_speed > 0 ? Vec3(rubbed / slip_speed * slip) : Vec3::Zero());
}

/// The largest inverse mass of a corner; 0 if all are held.
Real lightestCorner(const ParticleState& state, const Triangle& triangle)
{
  Real most = 0;
  for (ParticleId p : triangle.particles)
  {
    most = std::max(most, state.inverse_mass[p.index]);
  }
  return most;
}

Corners cornersOf(const ParticleState& state, const Triangle& triangle, const Sphere& sphere)
{
  const Vec3 start = sphere.previous.cast<Real>();
  const Vec3 end = sphere.center.cast<Real>();
  Corners corners;
  for (int k = 0; k < 3; ++k)
  {
    corners.start[k] = state.previous[triangle.particles[k].index] - start;
    corners.end[k] = state.position[triangle.particles[k].index] - end;
  }
  return corners;
}

/// Pushes the touching point of a triangle along the normal, with what that does to velocities.
/// @return how far it was pushed [m]
Real pushApart(ParticleState& state, const Triangle& triangle, Sphere& sphere,
               const Contact& contact, Real push, const ContactParams& params, Real dt)
{
  const Real lightest = lightestCorner(state, triangle);
  if (!(lightest > 0) && !sphere.yields())
  {
    return 0;  // neither of them gives way
  }
  const auto& p = triangle.particles;
  const Real sphere_inverse_mass = sphere.yields() ? static_cast<Real>(1.0 / sphere.mass) : Real(0);
  // One that cannot be pushed has the velocity of its way, whoever moves it.
  const Vec3 way =
      (sphere.yields() ? sphere.velocity : Vec3d((sphere.center - sphere.previous) / double(dt)))
          .cast<Real>();
  // Inverse mass that feels a push at the contact. A held corner counts as if it were free, and its
  // share is lost: left to a free one near by, it would throw that away.
  Real yielding = sphere_inverse_mass;
  Vec3 velocity = -way;
  bool held = false;           // whether a corner is
  std::array<Real, 3> before;  // how fast each corner parts from the sphere [m/s]
  for (int k = 0; k < 3; ++k)
  {
    const Real w = contact.weights[k];
    const Real inverse_mass = state.inverse_mass[p[k].index];
    held = held || !(inverse_mass > 0);
    yielding += w * w * (inverse_mass > 0 ? inverse_mass : lightest);
    velocity += w * state.velocity[p[k].index];
    before[k] = contact.normal.dot(state.velocity[p[k].index] - way);
  }
  const Vec3 change = velocityChange(velocity, contact.normal, static_cast<Real>(params.friction));
  const Real approach_speed = std::max(Real(0), -contact.normal.dot(velocity));
  // What rubs off the speed rubs off the way too.
  const Vec3 rubbed = change - change.dot(contact.normal) * contact.normal;
  const Vec3 shift = push * contact.normal + dt * rubbed;
  for (int k = 0; k < 3; ++k)
  {
    const Real share = contact.weights[k] * state.inverse_mass[p[k].index] / yielding;
    auto corner_velocity = state.velocity[p[k].index];
    const Vec3 velocity_before = corner_velocity;
    state.position[p[k].index] += share * shift;
    corner_velocity += share * change;
    // Beside a held corner the contact asks again each step: none is to run ahead of the ball.
    const Real ahead = contact.normal.dot(corner_velocity - way);
    const Real most_ahead = std::max(before[k], LEAD * approach_speed);
    if (held && ahead > most_ahead)
    {
      corner_velocity -= (ahead - most_ahead) * contact.normal;
    }
    if (share > 0)
    {
      const Vec3 gained = corner_velocity - velocity_before;
      sphere.force -= gained.cast<double>() / (dt * state.inverse_mass[p[k].index]);
    }
  }
  if (sphere.yields())
  {
    sphere.center -= (sphere_inverse_mass / yielding * shift).cast<double>();
    sphere.velocity -= (sphere_inverse_mass / yielding * change).cast<double>();
  }
  return push;
}

/// What parting a triangle from a sphere came to.
struct Parting
{
  bool pushed = false;
  Real push = 0;        ///< [m]
  bool inside = false;  ///< it was well inside
};

/// Parts a triangle from a sphere.
Parting resolveTriangle(ParticleState& state, const Triangle& triangle, Sphere& sphere,
                        const ContactParams& params, Real dt)
{
  const auto reach = static_cast<Real>(sphere.radius + params.thickness);
  const Corners corners = cornersOf(state, triangle, sphere);
  Contact contact;
  if (!firstTouch(corners, reach, contact))
  {
    return {};
  }
  Real gap = -reach;
  Real approach = 0;
  for (int k = 0; k < 3; ++k)
  {
    gap += contact.weights[k] * contact.normal.dot(corners.end[k]);
    approach += contact.weights[k] * contact.normal.dot(corners.start[k] - corners.end[k]);
  }
  if (gap >= 0)
  {
    return {};
  }
  // Out, but where it was inside from the start only as far as push_speed allows.
  const Real most = static_cast<Real>(params.push_speed) * dt + approach;
  return { true, pushApart(state, triangle, sphere, contact,
                           std::max(Real(0), std::min(-gap, most)), params, dt) };
}

/// The side to which cloth goes that a sphere was placed into: that of the nearest triangle, or
/// its front where the centre lies in it. Zero if no cloth is well inside.
Vec3 sideOut(const ParticleState& state, const Mesh& mesh, const std::vector<TriangleId>& near,
             const Sphere& sphere, Real reach)
{
  Real least = (INSIDE * reach) * (INSIDE * reach);
  Vec3 out = Vec3::Zero();
  for (TriangleId id : near)
  {
    const std::array<Vec3, 3> x = cornersOf(state, mesh.triangle(id), sphere).start;
    const Vec3 weights = nearestWeights(x[0], x[1], x[2]);
    const Vec3 nearest = weights[0] * x[0] + weights[1] * x[1] + weights[2] * x[2];
    const Vec3 front = (x[1] - x[0]).cross(x[2] - x[0]);
    if (nearest.squaredNorm() < least && front.squaredNorm() > 0)
    {
      least = nearest.squaredNorm();
      out = nearest.dot(front) < 0 ? Vec3(-front) : front;
    }
  }
  return out.squaredNorm() > 0 ? Vec3(out / std::sqrt(out.squaredNorm())) : out;
}

/// Lifts a triangle out of a sphere that was placed into it, along sphere.out and at push_speed:
/// pushed away from the centre it would be torn open in its plane.
Parting liftTriangle(ParticleState& state, const Triangle& triangle, Sphere& sphere,
                     const ContactParams& params, Real dt)
{
  const auto reach = static_cast<Real>(sphere.radius + params.thickness);
  const Corners corners = cornersOf(state, triangle, sphere);
  Contact contact;
  contact.weights = nearestWeights(corners.end[0], corners.end[1], corners.end[2]);
  contact.normal = sphere.out.cast<Real>();
  Vec3 nearest = Vec3::Zero();
  Vec3 moved = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
  {
    nearest += contact.weights[k] * corners.end[k];
    moved += contact.weights[k] * (corners.end[k] - corners.start[k]);
  }
  const Real squared = nearest.squaredNorm();
  if (squared >= reach * reach)
  {
    return {};
  }
  const Real height = nearest.dot(contact.normal);
  const Real lift = std::sqrt(reach * reach - squared + height * height) - height;
  const Real most = static_cast<Real>(params.push_speed) * dt - contact.normal.dot(moved);
  const Real push = pushApart(state, triangle, sphere, contact,
                              std::max(Real(0), std::min(lift, most)), params, dt);
  return { true, push, squared < INSIDE * INSIDE * reach * reach };
}

/// Goes its share of the way to where a stream has placed it.
void glide(Sphere& sphere, double dt)
{
  const double share = sphere.jump_time > dt ? dt / sphere.jump_time : 1.0;
  sphere.center += share * sphere.jump;
  sphere.jump *= 1.0 - share;
  sphere.jump_time -= dt;
}

void rollOnFloor(Sphere& sphere, const ContactParams& params)
{
  const double height = params.floor_height + sphere.radius;
  if (params.floor && sphere.center.z() < height)
  {
    sphere.center.z() = height;
    sphere.velocity.z() = std::max(0.0, sphere.velocity.z());
  }
}

bool within(const Vec3d& x, const Vec3d& low, const Vec3d& high)
{
  return (x.array() >= low.array()).all() && (x.array() <= high.array()).all();
}

}  // namespace

std::vector<std::string> problems(const ContactParams& params)
{
  std::vector<std::string> found;
  check(found, "friction [-]", params.friction, Range::between(0.0, 10.0));
  check(found, "thickness [m]", params.thickness, Range::aboveUpTo(0.0, 1.0));
  check(found, "push_speed [m/s]", params.push_speed, Range::aboveUpTo(0.0, 100.0));
  check(found, "floor_height [m]", params.floor_height,
        Range::between(-MAX_COORDINATE, MAX_COORDINATE));
  check(found, "floor_friction [-]", params.floor_friction, Range::between(0.0, 10.0));
  check(found, "bounds_min [m]", params.bounds_min, MAX_COORDINATE);
  check(found, "bounds_max [m]", params.bounds_max, MAX_COORDINATE);
  for (int i = 0; i < 3; ++i)
  {
    if (!(params.bounds_min[i] < params.bounds_max[i]))
    {
      const std::string axis = { "xyz"[i] };
      found.push_back("bounds_min [m]." + axis + " is " + text(params.bounds_min[i]) +
                      ", must be less than bounds_max." + axis + " = " +
                      text(params.bounds_max[i]));
    }
  }
  check(found, "max_sphere_speed [m/s]", params.max_sphere_speed,
        Range::aboveUpTo(0.0, MAX_SPHERE_SPEED));
  check(found, "sphere_timeout [s]", params.sphere_timeout, Range::between(0.0, 1e6));
  return found;
}

std::vector<std::string> problems(const Sphere& sphere)
{
  std::vector<std::string> found;
  const std::string name = "sphere " + std::to_string(sphere.id) + ": ";
  check(found, name + "center [m]", sphere.center, MAX_COORDINATE);
  check(found, name + "velocity [m/s]", sphere.velocity, MAX_SPHERE_SPEED);
  check(found, name + "radius [m]", sphere.radius, Range::between(1e-4, 100.0));
  check(found, name + "mass [kg]", sphere.mass, Range::between(0.0, 1e6));
  return found;
}

void moveSpheres(std::vector<Sphere>& spheres, const ContactParams& params,
                 const Environment& environment, double dt)
{
  for (Sphere& sphere : spheres)
  {
    sphere.previous = sphere.center;
    glide(sphere, dt);
    sphere.age += dt;
    if (sphere.caught)
    {
      continue;
    }
    const bool moves = sphere.source == SphereSource::THROWN || sphere.time_left > 0.0;
    if (moves && sphere.mass > 0.0)
    {
      sphere.velocity += dt * environment.gravity;
    }
    if (moves)
    {
      sphere.center += dt * sphere.velocity;
    }
    else
    {
      sphere.velocity.setZero();
    }
    if (sphere.mass > 0.0)
    {
      rollOnFloor(sphere, params);
    }
    sphere.time_left -= dt;
  }
  const auto gone = [&](const Sphere& s)
  {
    return s.source == SphereSource::THROWN &&
           (s.time_left <= 0.0 || !within(s.center, params.bounds_min, params.bounds_max));
  };
  spheres.erase(std::remove_if(spheres.begin(), spheres.end(), gone), spheres.end());
}

void SphereContact::resolve(Cloth& cloth, std::vector<Sphere>& spheres, const ContactParams& params,
                            double dt, WorkerPool* workers)
{
  impulse_.setZero();
  for (int p : pushed_)
  {
    is_pushed_[p] = 0;
  }
  pushed_.clear();
  if (spheres.empty() && !params.floor)
  {
    return;
  }
  is_pushed_.resize(cloth.state.size(), 0);
  pushed_.reserve(cloth.state.size());
  for (Sphere& sphere : spheres)
  {
    sphere.force.setZero();
    resolveSphere(cloth, sphere, params, dt, workers);
    impulse_ -= dt * sphere.force;
  }
  if (params.floor)
  {
    impulse_ += resolveFloor(cloth, params, dt, workers);
  }
}

/// @return what it does to the momentum of the cloth [N s]
Vec3d SphereContact::resolveFloor(Cloth& cloth, const ContactParams& params, double dt,
                                  WorkerPool* workers)
{
  const auto h = static_cast<Real>(dt);
  kernels::Floor floor{};
  floor.height = static_cast<Real>(params.floor_height + params.thickness);
  floor.friction = static_cast<Real>(params.floor_friction);
  floor.push = static_cast<Real>(params.push_speed) * h;  // for cloth that was below it
  floor.dt = h;
  ParticleState& state = cloth.state;
  change_.resize(state.size());
  landed_.resize(TriangleTiles::tilesFor(state.size()));
  const auto land = [&](int begin, int end, const Real* inverse_mass)
  { landTiles(state, floor, begin, end, inverse_mass); };
  const int whole = state.size() / kernels::TILE;
  shareStretches(
      workers, whole,
      [&](int begin, int end)
      { land(begin, end, state.inverse_mass.data() + begin * kernels::TILE); },
      TILES);
  std::array<Real, kernels::TILE> rest{};
  std::copy(state.inverse_mass.begin() + whole * kernels::TILE, state.inverse_mass.end(),
            rest.begin());
  land(whole, static_cast<int>(landed_.size()), rest.data());
  return impulseOfFloor(state);
}

void SphereContact::landTiles(ParticleState& state, const kernels::Floor& floor, int begin, int end,
                              const Real* inverse_mass)
{
  float* position[3];
  float* velocity[3];
  float* change[3];
  const float* start[3];
  for (int k = 0; k < 3; ++k)
  {
    position[k] = state.position.axis(k) + begin * kernels::TILE;
    velocity[k] = state.velocity.axis(k) + begin * kernels::TILE;
    change[k] = change_.axis(k) + begin * kernels::TILE;
    start[k] = state.previous.axis(k) + begin * kernels::TILE;
  }
  kernels::best().land(position, velocity, start, inverse_mass, floor, change,
                       landed_.data() + begin, end - begin);
}

Vec3d SphereContact::impulseOfFloor(const ParticleState& state)
{
  Vec3d impulse = Vec3d::Zero();
  for (std::size_t tile = 0; tile < landed_.size(); ++tile)
  {
    for (int lane = 0; lane < kernels::TILE && landed_[tile] >> lane != 0; ++lane)
    {
      if ((landed_[tile] >> lane & 1U) != 0)
      {
        const int i = static_cast<int>(tile) * kernels::TILE + lane;
        notePushed(i);
        impulse += change_[i].cast<double>() / state.inverse_mass[i];
      }
    }
  }
  return impulse;
}

void SphereContact::notePushed(int particle)
{
  if (!is_pushed_[particle])
  {
    is_pushed_[particle] = 1;
    pushed_.push_back(particle);
  }
}

/// Calls part(triangle) for those that the sphere may touch.
/// @return the largest push, and whether any of them was well inside
template <class Part>
auto SphereContact::partAll(const Mesh& mesh, const Sphere& sphere, const Part& part)
{
  Parting all;
  for (TriangleId id : near_.all())
  {
    const Triangle& triangle = mesh.triangle(id);
    if (!near_.mayTouch(triangle))
    {
      continue;
    }
    const Parting one = part(triangle);
    all.push = std::max(all.push, one.push);
    all.inside = all.inside || one.inside;
    if (one.pushed)
    {
      for (ParticleId p : triangle.particles)
      {
        notePushed(p.index);
        near_.forget(p.index);
      }
      near_.moved(sphere.center.cast<Real>());
    }
  }
  return all;
}

void SphereContact::resolveSphere(Cloth& cloth, Sphere& sphere, const ContactParams& params,
                                  double dt, WorkerPool* workers)
{
  const auto h = static_cast<Real>(dt);
  const auto reach = static_cast<Real>(sphere.radius + params.thickness);
  near_.find(cloth, sphere.previous.cast<Real>(), sphere.center.cast<Real>(), reach, workers);

  if (sphere.fresh)
  {
    sphere.out = sideOut(cloth.state, cloth.mesh, near_.all(), sphere, reach).cast<double>();
    sphere.fresh = false;
  }
  if (!sphere.out.isZero(0.0))
  {
    const auto lift = [&](const Triangle& triangle)
    { return liftTriangle(cloth.state, triangle, sphere, params, h); };
    if (partAll(cloth.mesh, sphere, lift).inside)
    {
      return;
    }
    sphere.out.setZero();  // the cloth is outside now
  }

  const auto part = [&](const Triangle& triangle)
  { return resolveTriangle(cloth.state, triangle, sphere, params, h); };
  Real push = reach;
  for (int pass = 0; pass < MAX_PASSES && push > DEEP_PUSH * reach; ++pass)
  {
    push = partAll(cloth.mesh, sphere, part).push;
  }
}

bool isInsideObstacle(const Vec3& point, const std::vector<Sphere>& spheres,
                      const ContactParams& params)
{
  const Vec3d x = point.cast<double>();
  const auto holds = [&](const Sphere& s)
  { return (x - s.center).squaredNorm() < s.radius * s.radius; };
  return (params.floor && x.z() < params.floor_height) ||
         std::any_of(spheres.begin(), spheres.end(), holds);
}

}  // namespace cloth
