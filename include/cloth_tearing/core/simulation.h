// The whole cloth world: what one thread owns, steps, asks and commands.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/cloth_model.h"
#include "cloth_tearing/core/event_history.h"
#include "cloth_tearing/core/event_log.h"
#include "cloth_tearing/core/force_balance.h"
#include "cloth_tearing/core/forces.h"
#include "cloth_tearing/core/grippers.h"
#include "cloth_tearing/core/limits.h"
#include "cloth_tearing/core/loose_pieces.h"
#include "cloth_tearing/core/material.h"
#include "cloth_tearing/core/pin_commands.h"
#include "cloth_tearing/core/pushed_springs.h"
#include "cloth_tearing/core/recorder.h"
#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/core/rest_shape.h"
#include "cloth_tearing/core/solver.h"
#include "cloth_tearing/core/sphere_contact.h"
#include "cloth_tearing/core/sphere_set.h"
#include "cloth_tearing/core/step_observer.h"
#include "cloth_tearing/core/strength.h"
#include "cloth_tearing/core/surface.h"
#include "cloth_tearing/core/tear_rules.h"
#include "cloth_tearing/core/tearing.h"
#include "cloth_tearing/core/worker_pool.h"

namespace cloth
{

struct SimulationParams
{
  Material material;
  Environment environment;
  SolverParams solver;
  TearRules tearing;
  StrengthParams strength;  ///< in the coordinates of the model that it is built from
  ContactParams contact;
  RestShapeSource rest_shape = RestShapeSource::IMPORTED;
  double max_grasp_distance = 0.05;  ///< a grasp by nearest particle reaches so far [m], > 0
  double grasp_force_filter = 0.01;  ///< time constant of a grasp's smoothed wrench [s]; 0 = none
  double max_gripper_speed = 5.0;    ///< of grasps that follow a frame or a stream [m/s], > 0
  double max_gripper_turn = 20.0;    ///< of the same [rad/s], > 0
  double max_speed = 200.0;          ///< of a particle; beyond is a runaway [m/s], > 0
  double runaway_strain = 50.0;  ///< of a spring that carries load; beyond is a runaway [-], > 0
  int threads = 0;             ///< that share a step; 0 = as many as pay off. The bits are the same
  int tear_log_size = 100000;  ///< tears kept for those who ask later, and events of grasps, >= 1
  Limits limits;
  std::uint64_t life = 0;  ///< names the simulation and its copies among all others: see restored()
  std::string place;       ///< where the cloth frame is, in words: see restored()

  /// How fast air brakes cloth [1/s].
  double airRate() const
  {
    return environment.air_friction + environment.wind_drag / material.areal_density;
  }
};

/// Everything wrong with `params`, one sentence each, naming the field; empty if they can be used.
std::vector<std::string> problems(const SimulationParams& params);

/// What may change while the cloth lives; the rest of SimulationParams is for its life.
struct Tuning
{
  Material material;
  Environment environment;
  TearRules tearing;
  ContactParams contact;
  double max_strain = 0.0;  ///< see SolverParams
  int max_substeps = 0;
};

Tuning tuningOf(const SimulationParams& params);

struct StepReport
{
  std::vector<TearEvent> tears;
  int postponed = 0;        ///< springs that must wait for the next step to tear
  double max_strain = 0.0;  ///< of springs that carry load, after contact; 0 if tearing is on and
                            ///< none was near a threshold when the step began [-]
  std::vector<std::string> notes;  ///< what its users should know: a piece put to rest, substeps
  std::string fault;  ///< why the step was undone and the run must pause; empty if all is well
};

/// The state in numbers.
struct Summary
{
  double time = 0.0;  ///< [s]
  std::uint64_t step = 0;
  std::uint32_t epoch = 0;
  std::uint64_t revision = 0;
  std::array<std::uint64_t, TEAR_KINDS> tears{};  ///< by kind, since the last reset
  int particles = 0;
  int springs = 0;
  int bend_shear_springs = 0;
  int triangles = 0;
  int pieces = 0;
  int pieces_at_rest = 0;
  int substeps = 1;          ///< that the solver cuts a step into
  double rest_area = 0.0;    ///< [m^2]
  double mass = 0.0;         ///< [kg]
  double max_strain = 0.0;   ///< [-]
  double utilisation = 0.0;  ///< the strain that tearing reads over its threshold; 1 = tears
  Vec3d utilisation_at = Vec3d::Zero();  ///< where [m], cloth frame
  std::uint64_t state_hash = 0;          ///< of positions, velocities, topology, grasps and spheres
};

/// Owned by one thread. Copyable: a copy goes on by itself.
class Simulation
{
public:
  struct Calls;  ///< the members that change it from outside, for recordings: recorded_calls.h

  /// @param model in the cloth frame: its axes are those of the world it hangs in
  /// @param pinned particles that stand still
  /// @throws Refusal naming everything wrong with `params`, or that cloth so soft at this time_step
  /// would tear by its own weight; TopologyError for a model that is no mesh
  Simulation(const ClothModel& model, const std::vector<int>& pinned,
             const SimulationParams& params);

  /// One tick of params().solver.time_step (design: carry, advance, limit, contact, tear).
  /// @param observer told where the tick is; may be null
  StepReport step(StepObserver* observer = nullptr);

  /// Back to the beginning: the cloth as built, no grasps, no spheres. The epoch rises by one;
  /// time, tear numbers and the log go on.
  void reset();

  /// Everything that decides what comes next, as bytes: cloth, untorn cloth, motion, damage,
  /// grasps, spheres, and the parameters that a step reads. With the tears that made the cloth what
  /// it is.
  std::string save() const;

  /// This simulation in the state that `bytes` hold: it goes on, bit for bit, as the one that was
  /// saved would have gone on. The epoch is one higher than here; time, all logs and their numbers,
  /// and the numbers of grasps, pulls and thrown spheres go on from here. Tears of another life are
  /// added to the log, each once, under new numbers, with this time and epoch. Present grasps end,
  /// and those of the state are taken; their pulls go on under new numbers.
  /// @throws Refusal saying why `bytes` are no such state, or that it was saved in another place
  Simulation restored(const std::string& bytes) const;

  /// Goes on as restored() says. @throws Refusal as that; nothing has changed then
  void restore(const std::string& bytes) { become(restored(bytes), bytes); }

  /// The same in two parts, for who has to do something between them.
  /// @param other what restored(bytes) has made of this
  void become(Simulation other, const std::string& bytes);

  /// From now on `recorder` is told of every step, and of every call that changes this simulation
  /// before it returns. To be set before anything has changed.
  void recordTo(std::shared_ptr<Recorder> recorder) { recorder_.set(std::move(recorder)); }

  /// Takes hold of the cloth. Pinned particles are passed over.
  /// @throws Refusal if nothing is within reach, or a particle is held by another grasp
  GraspTaken grasp(const GraspRequest& request);

  /// Sends a grasp on its way; a second drag replaces the first, and ends a pull.
  /// @throws Refusal if there is no such grasp, it follows a frame, or the target is not usable
  void drag(std::uint64_t grasp, const DragTarget& target);

  /// Lets a grasp glide to `pose` in `time` [s], but no faster than max_gripper_speed and
  /// max_gripper_turn, and stand there; replaces a drag, and ends a pull. For streamed targets.
  /// @throws Refusal if there is no such grasp, it follows a frame, or pose or time are not usable
  void steer(std::uint64_t grasp, const Pose& pose, double time);

  /// The same for a grasp that follows a frame, to where the frame is now.
  /// @throws Refusal if there is no such grasp, it follows none, or pose or time are not usable
  void follow(std::uint64_t grasp, const Pose& pose, double time);

  /// Notes that the frame of a grasp is missing; whether it lets go then is the caller's matter.
  /// @throws Refusal if there is no such grasp or it follows none
  void frameLost(std::uint64_t grasp, const std::string& reason);

  /// Notes that it is back. @throws Refusal if there is no such grasp or it follows none
  void frameFound(std::uint64_t grasp);

  /// Commands move it from now on. @throws Refusal if there is no such grasp or it follows none
  void stopFollowing(std::uint64_t grasp);

  /// Begins a pull; the one before on the same grasp is cancelled. It is looked at in the end of
  /// each step, so that it ends in the very step in which its condition holds: see pullEndsSince().
  /// @return its id
  /// @throws Refusal if there is no such grasp, it follows a frame, or the request is not usable
  std::uint64_t pull(const PullRequest& request);

  /// Its grasp stands still where it is. @return whether there was such a pull
  bool cancelPull(std::uint64_t pull);

  /// Lets go. @throws Refusal if there is no such grasp
  void release(std::uint64_t grasp, const std::string& reason = "released on request",
               AfterGrasp after = AfterGrasp::FREE);

  /// Lets go of everything. @return how many grasps there were
  int releaseAll(AfterGrasp after = AfterGrasp::FREE);

  /// Particles stand still from now on, until unpin() or reset(). See cloth::pin.
  int pin(const PinRequest& request);

  /// Particles are free again, until reset(). See cloth::unpin.
  int unpin(const PinRequest& request);

  /// The full set of streamed spheres: known ids move on from where they are, others are new,
  /// missing ones vanish.
  /// @throws Refusal naming everything wrong with them, twice the same id among it
  void setSpheres(const std::vector<Sphere>& spheres);

  /// Sends a streamed sphere to `center` [m] in `time` [s], without a jump: for one that follows a
  /// frame, between sets. Faster than max_sphere_speed it is placed there anew.
  /// @throws Refusal if there is no such sphere, or center or time are not usable
  void moveSphere(std::uint64_t id, const Vec3d& center, double time);

  /// @return the id of the thrown sphere
  /// @throws Refusal naming everything wrong with it, or that there are too many spheres
  std::uint64_t throwSphere(const ThrowRequest& request);

  /// Catches a sphere and sends it to `center` [m]. It stands still there until it is let go.
  /// @throws Refusal if there is no such sphere, it follows a frame, or center is not usable
  void holdSphere(SphereSource source, std::uint64_t id, const Vec3d& center);

  /// It goes on as before it was caught. @throws Refusal if there is no such sphere
  void letGoOfSphere(SphereSource source, std::uint64_t id);

  /// Throws a sphere from where it is at the centre of mass of the cloth, at `speed` [m/s].
  /// @return its new id, among the thrown ones
  /// @throws Refusal if there is no such sphere, speed is not usable, or there is nothing to aim at
  std::uint64_t throwAtCloth(SphereSource source, std::uint64_t id, double speed);

  /// @throws Refusal if there is no such sphere
  const Sphere& findSphere(SphereSource source, std::uint64_t id) const
  {
    return spheres_.find(source, id);
  }

  /// @throws Refusal if there is no such sphere
  void removeSphere(SphereSource source, std::uint64_t id);

  /// Changes parameters from the next step on, of the torn cloth and of the one that reset() goes
  /// back to. Before the first step, it is then as if it had been built with them.
  /// @return what users should know, as startNotes()
  /// @throws Refusal as the constructor; nothing has changed then
  std::vector<std::string> tune(const Tuning& tuning);

  /// Tunes the rules alone, to switch tearing on and off.
  void setTearRules(const TearRules& rules);

  /// Puts the cloth of `other` in place of this one, with its parameters, which have this
  /// time_step; as reset() otherwise.
  void takeCloth(Simulation other);

  /// The same with a cloth that save() has saved. @throws Refusal as restored()
  void takeSaved(const std::string& bytes) { takeCloth(restored(bytes)); }

  /// Puts every particle where `positions` [m] says, at rest: to show where cloth belongs.
  /// @throws Refusal if there are not as many positions as particles, or one is out of range
  void place(const Vec3Array& positions);

  const SimulationParams& params() const { return params_; }
  const Cloth& cloth() const { return cloth_; }
  const std::vector<Grasp>& grasps() const { return grippers_.all(); }

  bool hasGrasp(std::uint64_t id) const { return grippers_.has(id); }

  /// @throws Refusal if there is no such grasp
  const Grasp& findGrasp(std::uint64_t id) const { return grippers_.find(id); }

  const std::vector<Sphere>& spheres() const { return spheres_.all(); }
  double time() const
  {
    return start_time_ + static_cast<double>(step_ - start_step_) * params_.solver.time_step;
  }
  std::uint64_t stepCount() const { return step_; }
  std::uint32_t epoch() const { return epoch_; }
  std::uint64_t revision() const { return cloth_.damage.tears; }

  /// What users should know of the cloth as built: one too soft for its time_step, substeps.
  std::vector<std::string> startNotes() const;

  /// Logged tears from sequence number `first` on, at most `most`.
  std::vector<TearEvent> tearsSince(std::uint64_t first, std::size_t most) const
  {
    return log_.since(first, most);
  }

  /// The oldest and newest tear number in the log; {1, 0} if there was none.
  std::array<std::uint64_t, 2> loggedTears() const { return log_.range(); }

  /// Events of grasps from sequence number `first` on, at most `most`: those of steps and those of
  /// commands.
  std::vector<GraspEvent> graspEventsSince(std::uint64_t first, std::size_t most) const
  {
    return grasp_log_.since(first, most);
  }

  /// The oldest and newest number of them in the log; {1, 0} if there was none.
  std::array<std::uint64_t, 2> loggedGraspEvents() const { return grasp_log_.range(); }

  /// How pulls ended, from sequence number `first` on, at most `most`. The last 1000 are kept.
  std::vector<PullEnd> pullEndsSince(std::uint64_t first, std::size_t most) const
  {
    return pull_log_.since(first, most);
  }

  /// The oldest and newest number of an ended pull in the log; {1, 0} if there was none.
  std::array<std::uint64_t, 2> loggedPullEnds() const { return pull_log_.range(); }

  /// Pulls that are under way, by ascending grasp.
  std::vector<PullProgress> pulls() const;

  /// Forces on the whole cloth in the last step; zero before the first, and after one that was
  /// undone. Summed up when asked for: if the last step tore, and nobody had asked in the thousand
  /// steps before, from the parts of the torn cloth.
  ForceBalance forceBalance() const;

  /// How many springs the limiter of the force springs drew together in the last step: what hangs
  /// on them pulls less on grasps and pins than it weighs.
  int limitedSprings() const { return solver_->limited(); }

  /// Threads that share a step, the caller's included.
  int threads() const { return workers_ ? workers_->threads() : 1; }

  /// Strain over threshold where the cloth at a grasp, and one ring round it, is nearest to tearing
  /// [-]; 1 = tears. @throws Refusal if there is no such grasp
  double utilisationNear(std::uint64_t grasp) const;

  Snapshot snapshot() const;
  Summary summary() const;
  std::uint64_t stateHash() const;

private:
  template <class Archive>
  friend void transfer(Archive& archive, Simulation& simulation);

  /// What a step may change before it tears, to go back to if the step goes wrong.
  struct Undo
  {
    Vec3Array velocity;
    std::vector<Grasp> grasps;
    std::vector<Sphere> spheres;
  };

  /// Tears of another life that have come into the log.
  struct Adopted
  {
    std::uint64_t life = 0;
    EventHistory theirs;
    EventHistory ours;
  };

  template <auto METHOD, class... Arguments>
  void note(const Arguments&... arguments);

  StepReport tick(StepObserver* observer);
  void makeWorkers();
  void makeSolver();
  void watchSprings();
  double watchedStrain() const;
  double scan();
  void remember();
  void undo();
  bool isCalm(Real limit) const;
  std::string findFault(double max_strain) const;
  Stability findStability();
  void checkStability(std::vector<std::string>& notes);
  void startOver(const std::string& why);
  static void refuseUnfit(const SimulationParams& params, const Cloth& untorn,
                          const SolverHandle& solver, const Stability& stability);
  void record(StepReport& report);
  TearCause causeOf(const Vec3d& position) const;
  StepForces forces() const;
  void keepBalance();
  void concludeGrasps(const std::vector<TearEvent>& tears);
  void publish();
  void adopt(std::uint64_t life, std::vector<TearEvent>& tears);

  SimulationParams params_;
  Cloth untorn_;  ///< as built, for reset()
  Cloth cloth_;
  SolverHandle solver_;
  SphereContact contact_;
  Tearing tearing_;
  LoosePieces loose_pieces_;
  Grippers grippers_;
  SphereSet spheres_;
  Vec3Array acceleration_;  ///< scratch of a step [m/s^2]
  OuterForces outer_;
  PushedSprings suspects_;  ///< scratch of scan()
  Undo undo_;
  Stability stability_;
  EventLog<TearEvent> log_;
  EventLog<GraspEvent> grasp_log_;
  EventLog<PullEnd> pull_log_;
  std::optional<ForceBalance> balance_ = ForceBalance();  ///< of the last step, once summed up
  mutable std::uint64_t balance_wanted_until_ = 0;        ///< step
  EventHistory history_;                                  ///< tears of the present cloth
  std::vector<Adopted> adopted_;  ///< one for each history that came with a restored state
  std::array<std::uint64_t, TEAR_KINDS> tears_{};  ///< by kind, since the last reset
  Stability start_stability_;                      ///< of the cloth as built
  double start_time_ = 0.0;                        ///< of the epoch [s]
  std::uint64_t start_step_ = 0;                   ///< with which the epoch began
  std::uint64_t step_ = 0;
  std::uint32_t epoch_ = 0;
  std::shared_ptr<WorkerPool> workers_;  ///< share the work of a step; none: it is done alone
  OwnRecorder recorder_;
};

}  // namespace cloth
