// One tick after the other, and commands between them.
#include "cloth_tearing/core/simulation.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/flush_subnormals.h"
#include "cloth_tearing/core/forces.h"
#include "cloth_tearing/core/kernels.h"
#include "cloth_tearing/core/recorded_calls.h"
#include "cloth_tearing/core/snapshot_taker.h"
#include "cloth_tearing/core/sort_once.h"
#include "cloth_tearing/core/state_hash.h"

namespace cloth
{
namespace
{

/// How often a loose piece is looked for beyond the bounds [steps].
constexpr std::uint64_t BOUNDS_INTERVAL = 100;

/// Who has asked for the balance of forces may ask again for so long [steps]: till then it is
/// summed up before each tear, which changes what it is summed up from.
constexpr std::uint64_t BALANCE_INTEREST = 1000;

/// Ends of pulls that are kept for those who ask later.
constexpr int ENDED_PULLS = 1000;

/// Springs that begin a step above this part of the least threshold are looked at in its end [-].
/// One that makes the rest of the way within a step is found in the end of the next.
constexpr double NEAR = 0.7;

void append(std::vector<std::string>& found, const std::vector<std::string>& more)
{
  found.insert(found.end(), more.begin(), more.end());
}

/// Air acts on the speed at the start of a step: braking by more than this speed would turn it
/// round, and at twice that let it grow without end.
void checkAir(std::vector<std::string>& found, const SimulationParams& params)
{
  const double rate = params.airRate();
  const double dt = params.solver.time_step;
  if (params.material.areal_density > 0.0 && rate * dt > 1.0)
  {
    found.push_back("air_friction + wind_drag / areal_density is " + text(rate) +
                    " [1/s], must be at most 1 / time_step = " + text(1.0 / dt));
  }
}

/// Tells the observer, if there is one; in the end that the step is over.
class PhaseMarker
{
public:
  explicit PhaseMarker(StepObserver* observer) : observer_(observer) {}
  ~PhaseMarker() { (*this)(StepPhase::END); }
  PhaseMarker(const PhaseMarker&) = delete;
  PhaseMarker& operator=(const PhaseMarker&) = delete;

  void operator()(StepPhase phase) const
  {
    if (observer_ != nullptr)
    {
      observer_->enter(phase);
    }
  }

private:
  StepObserver* observer_;
};

/// Springs of the triangles round held particles and their neighbours, each once.
std::vector<SpringId> springsNear(const Mesh& mesh, const Grasp& grasp)
{
  std::vector<ParticleId> particles;
  for (const Grasp::Held& held : grasp.held)
  {
    mesh.forEachTriangleAt(held.particle,
                           [&](TriangleId t)
                           {
                             const auto& corners = mesh.triangle(t).particles;
                             particles.insert(particles.end(), corners.begin(), corners.end());
                           });
  }
  sortOnce(particles);
  std::vector<SpringId> springs;
  for (ParticleId p : particles)
  {
    mesh.forEachTriangleAt(p,
                           [&](TriangleId t)
                           {
                             const auto& sides = mesh.triangle(t).springs;
                             springs.insert(springs.end(), sides.begin(), sides.end());
                           });
  }
  sortOnce(springs);
  return springs;
}

const SimulationParams& checked(const SimulationParams& params)
{
  refuseIf(problems(params));
  return params;
}

const ClothModel& fitting(const ClothModel& model, const Limits& limits)
{
  std::vector<std::string> found;
  checkCount(found, "particles of the model", model.positions.size(), "limits/particles",
             limits.particles);
  checkCount(found, "triangles of the model", model.triangles.size(), "limits/triangles",
             limits.triangles);
  refuseIf(found);
  return model;
}

}  // namespace

std::vector<std::string> problems(const SimulationParams& params)
{
  std::vector<std::string> found = problems(params.material);
  append(found, problems(params.environment));
  append(found, problems(params.solver));
  append(found, problems(params.tearing));
  append(found, problems(params.strength));
  append(found, problems(params.contact));
  checkAir(found, params);
  check(found, "max_grasp_distance [m]", params.max_grasp_distance,
        Range::aboveUpTo(0.0, MAX_COORDINATE));
  check(found, "grasp_force_filter [s]", params.grasp_force_filter, Range::between(0.0, 10.0));
  check(found, "max_gripper_speed [m/s]", params.max_gripper_speed,
        Range::aboveUpTo(0.0, MAX_GRIPPER_SPEED));
  check(found, "max_gripper_turn [rad/s]", params.max_gripper_turn,
        Range::aboveUpTo(0.0, MAX_GRIPPER_TURN));
  check(found, "max_speed [m/s]", params.max_speed, Range::aboveUpTo(0.0, MAX_PARTICLE_SPEED));
  check(found, "runaway_strain [-]", params.runaway_strain, Range::aboveUpTo(0.0, 1e4));
  check(found, "threads", params.threads, Range::between(0, 256));
  check(found, "tear_log_size", params.tear_log_size, Range::between(1, MAX_EVENTS_LOGGED));
  append(found, problems(params.limits));
  return found;
}

Simulation::Simulation(const ClothModel& model, const std::vector<int>& pinned,
                       const SimulationParams& params)
    : params_(checked(params))
    , untorn_(makeCloth(fitting(model, params.limits), pinned, params.material, params.rest_shape,
                        params.tearing.hem_width, params.strength))
    , cloth_(untorn_)
    , solver_(params.solver)
    , tearing_(params.tearing)
    , log_(params.tear_log_size)
    , grasp_log_(params.tear_log_size)
    , pull_log_(ENDED_PULLS)
{
  makeWorkers();
  watchSprings();
  stability_ = findStability();
  start_stability_ = stability_;
  refuseUnfit(params_, untorn_, solver_, start_stability_);
}

StepReport Simulation::step(StepObserver* observer)
{
  StepReport report = tick(observer);
  if (recorder_.get() != nullptr)
  {
    recorder_.get()->stepped(*this, report);
  }
  return report;
}

StepReport Simulation::tick(StepObserver* observer)
{
  const FlushSubnormals fast;
  const PhaseMarker enter{ observer };
  const double dt = params_.solver.time_step;
  StepReport report;
  enter(StepPhase::CARRY);
  remember();
  // Held particles follow their grippers.
  grippers_.carry(cloth_.state, dt, { params_.max_gripper_speed, params_.max_gripper_turn });
  enter(StepPhase::ADVANCE);
  outer_.accelerate(cloth_, untorn_.mesh, params_.environment, acceleration_,
                    workers_.get());  // gravity, air, wind (2.1.1)
  solver_->advance(cloth_.state, cloth_.springs, acceleration_, dt);
  enter(StepPhase::LIMIT);
  solver_->limitStrain(cloth_.state, cloth_.springs);  // woven cloth hardly stretches (2.1.1)
  enter(StepPhase::CONTACT);
  moveSpheres(spheres_.all(), params_.contact, params_.environment, dt);
  contact_.resolve(cloth_, spheres_.all(), params_.contact, dt,
                   workers_.get());  // spheres push the cloth (4.1)

  enter(StepPhase::DETECT);
  report.max_strain = scan();
  balance_.reset();
  enter(StepPhase::CHECK);
  report.fault = findFault(report.max_strain);
  if (!report.fault.empty())
  {
    undo();
    return report;
  }
  grippers_.feel(forces(), params_.grasp_force_filter);
  enter(StepPhase::EDIT);
  ++step_;
  if (tearing_.found())
  {
    if (step_ < balance_wanted_until_)
    {
      keepBalance();  // edits change what it is summed up from
    }
    undo_.grasps = grippers_.all();
  }
  report.tears = tearing_.tear(
      cloth_, grippers_.all(),
      [this](const Vec3& x) { return isInsideObstacle(x, spheres_.all(), params_.contact); },
      report.postponed);
  record(report);
  concludeGrasps(report.tears);
  if (!report.tears.empty())
  {
    checkStability(report.notes);
  }
  if (step_ % BOUNDS_INTERVAL == 0)
  {
    append(report.notes, loose_pieces_.rest(cloth_, params_.contact));
  }
  solver_->follow(cloth_.springs, cloth_.state.size());
  outer_.follow(cloth_);
  contact_.follow(cloth_);
  cloth_.springs.changes.forget();
  return report;
}

double Simulation::scan()
{
  if (!params_.tearing.enabled)
  {
    return tearing_.scan(cloth_);
  }
  const std::vector<int>& pushed = contact_.pushed();
  if (pushed.empty())
  {
    return tearing_.scan(cloth_, solver_->stretched());
  }
  // A push may overstretch a slack spring in one step.
  return tearing_.scan(cloth_, suspects_.find(cloth_, solver_->stretched(), pushed, watchedStrain(),
                                              workers_.get()));
}

/// As many threads as pay off for this cloth.
void Simulation::makeWorkers()
{
  const int wanted = threadsFor(params_.threads, untorn_.state.size());
  if (wanted != threads())
  {
    workers_ = wanted > 1 ? std::make_shared<WorkerPool>(wanted) : nullptr;
  }
  solver_->shareWork(workers_);
}

void Simulation::makeSolver()
{
  solver_ = SolverHandle(params_.solver);
  solver_->shareWork(workers_);
}

void Simulation::watchSprings()
{
  solver_->watch(watchedStrain());
}

/// A spring that is stretched by more is looked at in the end of the step [-].
double Simulation::watchedStrain() const
{
  return NEAR * std::min(tearing_.leastThreshold(cloth_), params_.runaway_strain);
}

void Simulation::remember()
{
  ParticleState& state = cloth_.state;
  state.previous.resize(state.size());
  undo_.velocity.resize(state.size());
  shareStretches(workers_.get(), state.size(),
                 [&](int begin, int end)
                 {
                   state.previous.copy(state.position, begin, end);
                   undo_.velocity.copy(state.velocity, begin, end);
                 });
  undo_.grasps = grippers_.all();
  undo_.spheres = spheres_.all();
}

void Simulation::undo()
{
  cloth_.state.position = cloth_.state.previous;
  cloth_.state.velocity = undo_.velocity;
  grippers_.all() = undo_.grasps;
  spheres_.all() = undo_.spheres;
  balance_ = ForceBalance();
}

/// Whether all particles have places that are numbers and squared speeds up to `limit`.
bool Simulation::isCalm(Real limit) const
{
  const ParticleState& state = cloth_.state;
  std::atomic<bool> calm{ true };
  shareStretches(workers_.get(), state.size(),
                 [&](int begin, int end)
                 {
                   const float* position[3];
                   const float* velocity[3];
                   for (int k = 0; k < 3; ++k)
                   {
                     position[k] = state.position.axis(k) + begin;
                     velocity[k] = state.velocity.axis(k) + begin;
                   }
                   if (!kernels::best().calm(position, velocity, limit, end - begin))
                   {
                     calm = false;
                   }
                 });
  return calm;
}

std::string Simulation::findFault(double max_strain) const
{
  if (!(max_strain <= params_.runaway_strain))
  {
    return "a strain of " + text(max_strain) +
           " exceeds runaway_strain = " + text(params_.runaway_strain) + ": the step was undone";
  }
  const auto limit = static_cast<Real>(params_.max_speed * params_.max_speed);
  if (isCalm(limit))
  {
    return {};
  }
  for (int i = 0; i < cloth_.state.size(); ++i)
  {
    const Real squared = cloth_.state.velocity[i].squaredNorm();
    if (!(squared <= limit) || !cloth_.state.position[i].allFinite())
    {
      return "particle " + std::to_string(i) + " moves at " + text(std::sqrt(double(squared))) +
             " m/s, beyond max_speed = " + text(params_.max_speed) + ": the step was undone";
    }
  }
  return {};
}

Stability Simulation::findStability()
{
  return solver_->checkStability(cloth_.state, cloth_.springs, params_.solver.time_step,
                                 params_.airRate());
}

void Simulation::checkStability(std::vector<std::string>& notes)
{
  const Stability stability = findStability();
  if (stability.substeps != stability_.substeps || stability.floored > stability_.floored)
  {
    std::string note =
        "the force springs take " + std::to_string(stability.substeps) + " substeps a step";
    if (stability.floored > 0)
    {
      note += ", " + std::to_string(stability.floored) + " light particles at the mass floor";
    }
    notes.push_back(note);
  }
  stability_ = stability;
}

void Simulation::record(StepReport& report)
{
  for (TearEvent& event : report.tears)
  {
    event.epoch = epoch_;
    event.step = step_;
    event.time = time();
    event.cause = causeOf(event.position);
    ++tears_[static_cast<int>(event.kind)];
    log_.add(event);
    history_.add(event.sequence);
  }
}

TearCause Simulation::causeOf(const Vec3d& position) const
{
  TearCause nearest;
  nearest.distance = std::numeric_limits<double>::infinity();
  const auto consider = [&](CauseKind kind, std::uint64_t id, double distance)
  {
    if (distance < nearest.distance)
    {
      nearest = { kind, id, distance };
    }
  };
  for (const Grasp& grasp : grippers_.all())
  {
    for (const Grasp::Held& held : grasp.held)
    {
      const Vec3d at = cloth_.state.position[held.particle.index].cast<double>();
      consider(CauseKind::GRASP, grasp.id, (at - position).norm());
    }
  }
  for (const Sphere& sphere : spheres_.all())
  {
    const double distance = (sphere.center - position).norm() - sphere.radius;
    const bool thrown = sphere.source == SphereSource::THROWN;
    consider(thrown ? CauseKind::THROWN_SPHERE : CauseKind::SPHERE, sphere.id,
             std::max(0.0, distance));
  }
  return nearest.kind == CauseKind::NONE ? TearCause{} : nearest;
}

StepForces Simulation::forces() const
{
  return { cloth_,
           *solver_,
           acceleration_,
           undo_.velocity,
           params_.environment.gravity,
           contact_.impulse(),
           params_.solver.time_step };
}

ForceBalance Simulation::forceBalance() const
{
  balance_wanted_until_ = step_ + BALANCE_INTEREST;
  return balance_ ? *balance_ : forces().balance();
}

/// Sums up the last step before the cloth changes.
void Simulation::keepBalance()
{
  if (!balance_)
  {
    balance_ = forces().balance();
  }
}

void Simulation::concludeGrasps(const std::vector<TearEvent>& tears)
{
  if (!grippers_.all().empty())
  {
    if (grippers_.mayLetGo())
    {
      keepBalance();
    }
    grippers_.conclude(cloth_, undo_.grasps, tears, params_.solver.time_step);
    publish();
  }
}

/// Numbers and logs what has happened to grasps and pulls.
void Simulation::publish()
{
  Grippers::News news = grippers_.takeNews();
  for (GraspEvent& event : news.events)
  {
    event.epoch = epoch_;
    event.step = step_;
    event.time = time();
    grasp_log_.add(event);
  }
  for (PullEnd& end : news.ends)
  {
    end.last_tear = log_.range()[1];
    end.pieces = cloth_.damage.pieces;
    pull_log_.add(end);
  }
}

void Simulation::reset()
{
  startOver("the cloth was reset");
  note<&Simulation::reset>();
}

void Simulation::startOver(const std::string& why)
{
  grippers_.releaseAll(cloth_, why);
  publish();
  cloth_ = untorn_;
  tearing_ = Tearing(params_.tearing);  // counts of tears come again
  outer_.startOver();
  contact_.startOver();
  makeSolver();
  watchSprings();
  stability_ = findStability();
  spheres_.clear();
  balance_ = ForceBalance();
  balance_wanted_until_ = 0;
  tears_ = {};
  history_ = {};
  start_time_ = time();
  start_step_ = 0;
  step_ = 0;
  ++epoch_;
}

GraspTaken Simulation::grasp(const GraspRequest& request)
{
  std::vector<std::string> found;
  checkCount(found, "grasps", grippers_.all().size() + 1, "limits/grasps", params_.limits.grasps);
  refuseIf(found);
  keepBalance();
  const GraspTaken taken = grippers_.take(cloth_, request, params_.max_grasp_distance);
  publish();
  note<&Simulation::grasp>(request);
  return taken;
}

void Simulation::drag(std::uint64_t grasp, const DragTarget& target)
{
  grippers_.drag(grasp, target);
  publish();
  note<&Simulation::drag>(grasp, target);
}

void Simulation::steer(std::uint64_t grasp, const Pose& pose, double time)
{
  grippers_.steer(grasp, pose, time);
  publish();
  note<&Simulation::steer>(grasp, pose, time);
}

void Simulation::follow(std::uint64_t grasp, const Pose& pose, double time)
{
  grippers_.follow(grasp, pose, time);
  publish();
  note<&Simulation::follow>(grasp, pose, time);
}

void Simulation::frameLost(std::uint64_t grasp, const std::string& reason)
{
  grippers_.frameLost(grasp, reason);
  publish();
  note<&Simulation::frameLost>(grasp, reason);
}

void Simulation::frameFound(std::uint64_t grasp)
{
  grippers_.frameFound(grasp);
  publish();
  note<&Simulation::frameFound>(grasp);
}

void Simulation::stopFollowing(std::uint64_t grasp)
{
  grippers_.stopFollowing(grasp);
  note<&Simulation::stopFollowing>(grasp);
}

std::uint64_t Simulation::pull(const PullRequest& request)
{
  const std::uint64_t id = grippers_.pull(request, log_.range()[1] + 1);
  publish();
  note<&Simulation::pull>(request);
  return id;
}

bool Simulation::cancelPull(std::uint64_t pull)
{
  keepBalance();
  const bool was_there = grippers_.cancelPull(cloth_, pull);
  publish();
  note<&Simulation::cancelPull>(pull);
  return was_there;
}

std::vector<PullProgress> Simulation::pulls() const
{
  std::vector<PullProgress> under_way;
  for (const Grasp& grasp : grippers_.all())
  {
    if (grasp.pull)
    {
      under_way.push_back(progressOf(grasp));
    }
  }
  return under_way;
}

void Simulation::release(std::uint64_t grasp, const std::string& reason, AfterGrasp after)
{
  keepBalance();
  grippers_.release(cloth_, grasp, reason, after);
  publish();
  note<&Simulation::release>(grasp, reason, after);
}

int Simulation::releaseAll(AfterGrasp after)
{
  keepBalance();
  const int released = grippers_.releaseAll(cloth_, "released on request, with all others", after);
  publish();
  note<&Simulation::releaseAll>(after);
  return released;
}

int Simulation::pin(const PinRequest& request)
{
  keepBalance();
  const int changed = cloth::pin(cloth_, request);
  grippers_.findLoosePieces(cloth_, "");
  publish();
  note<&Simulation::pin>(request);
  return changed;
}

int Simulation::unpin(const PinRequest& request)
{
  keepBalance();
  const int changed = cloth::unpin(cloth_, request);
  grippers_.findLoosePieces(cloth_, "no pin holds it any more");
  publish();
  note<&Simulation::unpin>(request);
  return changed;
}

double Simulation::utilisationNear(std::uint64_t grasp) const
{
  return tearing_.worst(cloth_, springsNear(cloth_.mesh, grippers_.find(grasp))).utilisation();
}

void Simulation::moveSphere(std::uint64_t id, const Vec3d& center, double time)
{
  spheres_.moveTo(id, center, time, params_.contact, params_.solver.time_step);
  note<&Simulation::moveSphere>(id, center, time);
}

void Simulation::setSpheres(const std::vector<Sphere>& spheres)
{
  std::vector<std::string> found;
  checkCount(found, "spheres", spheres.size() + spheres_.count(SphereSource::THROWN),
             "limits/spheres", params_.limits.spheres);
  refuseIf(found);
  spheres_.set(spheres, params_.contact, params_.solver.time_step);
  note<&Simulation::setSpheres>(spheres);
}

void Simulation::removeSphere(SphereSource source, std::uint64_t id)
{
  spheres_.remove(source, id);
  note<&Simulation::removeSphere>(source, id);
}

std::uint64_t Simulation::throwSphere(const ThrowRequest& request)
{
  std::vector<std::string> found;
  checkCount(found, "spheres", spheres_.all().size() + 1, "limits/spheres", params_.limits.spheres);
  refuseIf(found);
  const std::uint64_t id = spheres_.throwOne(request);
  note<&Simulation::throwSphere>(request);
  return id;
}

void Simulation::holdSphere(SphereSource source, std::uint64_t id, const Vec3d& center)
{
  spheres_.hold(source, id, center, params_.contact, params_.solver.time_step);
  note<&Simulation::holdSphere>(source, id, center);
}

void Simulation::letGoOfSphere(SphereSource source, std::uint64_t id)
{
  spheres_.letGo(source, id, params_.contact);
  note<&Simulation::letGoOfSphere>(source, id);
}

std::uint64_t Simulation::throwAtCloth(SphereSource source, std::uint64_t id, double speed)
{
  std::vector<std::string> found;
  check(found, "speed [m/s]", speed, Range::aboveUpTo(0.0, MAX_SPHERE_SPEED));
  refuseIf(found);
  const Vec3d way = cloth_.center() - spheres_.find(source, id).center;
  if (way.isZero(0.0))
  {
    throw Refusal("the sphere is in the centre of the cloth: there is nothing to aim at");
  }
  const std::uint64_t thrown = spheres_.throwAgain(source, id, speed * way.normalized());
  note<&Simulation::throwAtCloth>(source, id, speed);
  return thrown;
}

void Simulation::place(const Vec3Array& positions)
{
  std::vector<std::string> found;
  if (positions.size() != cloth_.state.position.size())
  {
    found.push_back("there are " + std::to_string(positions.size()) +
                    " positions, must be one for "
                    "each of " +
                    std::to_string(cloth_.state.size()) + " particles");
  }
  for (std::size_t i = 0; i < positions.size() && found.empty(); ++i)
  {
    check(found, "position [m] of particle " + std::to_string(i), positions[i].cast<double>(),
          MAX_COORDINATE);
  }
  refuseIf(found);
  keepBalance();
  cloth_.state.position = positions;
  cloth_.state.velocity.setZero();
  note<&Simulation::place>(positions);
}

Snapshot Simulation::snapshot() const
{
  Snapshot snapshot;
  SnapshotTaker().take(*this, snapshot);
  return snapshot;
}

Summary Simulation::summary() const
{
  Summary summary;
  summary.time = time();
  summary.step = step_;
  summary.epoch = epoch_;
  summary.revision = revision();
  summary.tears = tears_;
  summary.particles = cloth_.mesh.particleCount();
  summary.springs = cloth_.mesh.springCount();
  summary.triangles = cloth_.mesh.triangleCount();
  summary.bend_shear_springs =
      static_cast<int>(std::count_if(cloth_.rest.bend_length.begin(), cloth_.rest.bend_length.end(),
                                     [](double length) { return length > 0.0; }));
  summary.pieces = cloth_.damage.pieces;
  summary.pieces_at_rest = cloth_.damage.pieces_at_rest;
  summary.substeps = stability_.substeps;
  for (double area : cloth_.rest.area)
  {
    summary.rest_area += area;
  }
  for (double mass : cloth_.rest.mass)
  {
    summary.mass += mass;
  }
  summary.max_strain = largestStrain(cloth_);
  const TearReading worst = tearing_.worst(cloth_);
  summary.utilisation = worst.utilisation();
  if (worst.spring.valid())
  {
    const auto& ends = cloth_.mesh.spring(worst.spring).particles;
    summary.utilisation_at =
        0.5 * (cloth_.state.position[ends[0].index] + cloth_.state.position[ends[1].index])
                  .cast<double>();
  }
  summary.state_hash = stateHash();
  return summary;
}

std::uint64_t Simulation::stateHash() const
{
  return cloth::stateHash(cloth_, grippers_.all(), spheres_.all());
}

}  // namespace cloth
