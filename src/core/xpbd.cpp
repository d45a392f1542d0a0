// One Gauss-Seidel sweep of compliant distance constraints.
#include "cloth_tearing/core/xpbd.h"

#include <algorithm>

namespace cloth
{

using kernels::Particles;

namespace
{

/// Of a group's particles, into w of their records.
void packMasses(const float* inverse_mass, const std::vector<int>& particles,
                std::vector<kernels::Record>& records)
{
  for (std::size_t r = 1; r < particles.size(); ++r)
  {
    records[r].w = inverse_mass[particles[r]];
  }
}

/// What the share of stiffness that is not braced makes of the number of springs without lines:
/// hung irregular sheets of 30 to 80 particles a side, where that share is 0.22, are half as soft.
constexpr double SLACK = 2.0;

/// (1/m_a + 1/m_b) k dt^2 that nine of ten structural springs do not exceed.
double numberOfMost(const ParticleState& state, const SpringTable& springs, double dt)
{
  std::vector<double> numbers;
  for (const SpringLaw& spring : springs.structural)
  {
    if (spring.active())
    {
      const double w = state.inverse_mass[spring.a] + state.inverse_mass[spring.b];
      numbers.push_back(w * spring.stiffness * dt * dt);
    }
  }
  if (numbers.empty())
  {
    return 0.0;
  }
  const auto nine_tenths =
      numbers.begin() + static_cast<std::ptrdiff_t>(9 * (numbers.size() - 1) / 10);
  std::nth_element(numbers.begin(), nine_tenths, numbers.end());
  return *nine_tenths;
}

/// What solving a ladder takes beside the particles. Each thread has its own: it is worth most
/// while it is in the memory that is a core's own.
struct LineScratch
{
  std::vector<kernels::Rung> rungs;
  std::vector<kernels::Node> nodes;  ///< where particles do not lie side by side
};

/// Makes room for all ladders at once: a thread meets the longest at any time.
LineScratch& lineScratch(const SpringLines& lines)
{
  thread_local LineScratch scratch;
  const auto rungs = static_cast<std::size_t>(lines.longest());
  const auto nodes = static_cast<std::size_t>(lines.longestCopied());
  scratch.rungs.resize(std::max(scratch.rungs.size(), rungs));
  scratch.nodes.resize(std::max(scratch.nodes.size(), nodes));
  return scratch;
}

/// The particles that were copied to nodes, `first` and those after it.
Particles copies(kernels::Node& first, const Particles& particles)
{
  Particles copied = particles;  // the pulls on those that are held go where they belong
  for (int k = 0; k < 3; ++k)
  {
    copied.way[k] = first.way[k];
    copied.start[k] = first.start[k];
  }
  copied.inverse_mass = first.inverse_mass;
  return copied;
}

}  // namespace

std::unique_ptr<Solver> XpbdSolver::clone() const
{
  return std::make_unique<XpbdSolver>(*this);
}

void XpbdSolver::advance(ParticleState& state, const SpringTable& springs,
                         const Vec3Array& acceleration, double dt)
{
  const auto h = static_cast<Real>(dt);
  const int count = state.size();
  arrange(springs, state);
  way_.resize(count);
  held_.resize(count);
  held_.setZero();
  held_scale_ = 1.0 / (dt * dt);

  Particles particles{};
  particles.inverse_mass = state.inverse_mass.data();
  for (int k = 0; k < 3; ++k)
  {
    particles.way[k] = way_.axis(k);
    particles.start[k] = state.previous.axis(k);
    particles.held[k] = held_.axis(k);
  }
  forGroups(
      [&](int g, Scratch& scratch)
      {
        if (g < stretches())
        {
          predict(state, acceleration, stretch(g, count), h);
        }
        solve(groups()[g], scratch, particles, h);
      });
  forLadders([&](const SpringLadder& ladder, Notes& notes) { solve(ladder, notes, particles, h); });
  forStretches(count, [&](Range range) { finish(state, range, h); });
  collectNotes(springs.structural.size());
}

void XpbdSolver::predict(const ParticleState& state, const Vec3Array& acceleration, Range range,
                         float dt)
{
  const int first = range.begin;
  for (int k = 0; k < 3; ++k)
  {
    kernels::best().predict(way_.axis(k) + first, state.velocity.axis(k) + first,
                            acceleration.axis(k) + first, state.inverse_mass.data() + first,
                            state.previous.axis(k) + first, state.position.axis(k) + first, dt,
                            range.end - first);
  }
}

void XpbdSolver::finish(ParticleState& state, Range range, float dt) const
{
  const int first = range.begin;
  for (int k = 0; k < 3; ++k)
  {
    kernels::best().finish(way_.axis(k) + first, state.previous.axis(k) + first,
                           state.inverse_mass.data() + first, dt, state.position.axis(k) + first,
                           state.velocity.axis(k) + first, range.end - first);
  }
}

void XpbdSolver::solve(const SpringGroup& group, Scratch& scratch, const Particles& particles,
                       float dt)
{
  const kernels::Set& loops = kernels::best();
  const auto runs = group.run_ends.size();
  const auto loose = group.loose_ends.size();
  scratch.run_notes.count =
      loops.sweep_runs(particles, group.run_ends.data(), group.run_lanes.data(),
                       static_cast<int>(runs), dt, scratch.run_notes.roomFor(runs));
  scratch.loose_notes.count = 0;
  if (loose == 0)
  {
    return;
  }
  auto& way = scratch.records[0];
  auto& start = scratch.records[1];
  pack(particles.way, group.particles, way);
  packMasses(particles.inverse_mass, group.particles, way);
  pack(particles.start, group.particles, start);
  scratch.loose_notes.count = loops.sweep_records(
      { way.data(), start.data(), group.particles.data() }, particles.held, group.loose_ends.data(),
      group.loose_lanes.data(), static_cast<int>(loose), dt, scratch.loose_notes.roomFor(loose));
  unpack(way, group.particles, particles.way);
}

void XpbdSolver::solve(const SpringLadder& ladder, Notes& notes, const Particles& particles,
                       float dt) const
{
  const kernels::Set& loops = kernels::best();
  const auto rungs = static_cast<std::size_t>(ladder.rungs());
  LineScratch& scratch = lineScratch(lines());
  if (ladder.sideBySide())
  {
    notes.count = loops.sweep_ladder(
        { ladder.first, ladder.step, ladder.rungs(), ladder.lanes.data(), nullptr }, particles, dt,
        scratch.rungs.data(), notes.roomFor(rungs));
    return;
  }
  const kernels::NodeList list = ladder.nodeList();
  loops.pack_nodes(particles, list, scratch.nodes.data());
  notes.count = loops.sweep_ladder({ 0, sizeof(kernels::Node) / sizeof(float), list.count - 1,
                                     ladder.lanes.data(), list.particle },
                                   copies(scratch.nodes.front(), particles), dt,
                                   scratch.rungs.data(), notes.roomFor(rungs));
  loops.unpack_nodes(particles, list, scratch.nodes.data());
}

/// Cloth whose lines turn and end everywhere is about half as soft as without lines; where they are
/// straight it is not soft at all.
double XpbdSolver::stiffnessNumber(const ParticleState& state, const SpringTable& springs,
                                   double dt) const
{
  const double number = numberOfMost(state, springs, dt);
  if (!inLines())
  {
    return number;
  }
  const std::vector<SpringLine> lines = findLines(springs, state.position);
  return number * std::min(1.0, SLACK * unbraced(lines, springs, state.position));
}

double XpbdSolver::lineNumber(const ParticleState& state, const SpringTable& springs,
                              double dt) const
{
  return inLines() ? numberOfMost(state, springs, dt) : 0.0;
}

}  // namespace cloth
