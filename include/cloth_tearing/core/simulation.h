// The whole cloth world: what one thread owns, steps, asks and commands.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/cloth_model.h"
#include "cloth_tearing/core/grippers.h"
#include "cloth_tearing/core/loose_pieces.h"
#include "cloth_tearing/core/material.h"
#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/core/rest_shape.h"
#include "cloth_tearing/core/solver.h"
#include "cloth_tearing/core/sphere_contact.h"
#include "cloth_tearing/core/sphere_set.h"
#include "cloth_tearing/core/step_observer.h"
#include "cloth_tearing/core/strength.h"
#include "cloth_tearing/core/surface.h"
#include "cloth_tearing/core/tear_log.h"
#include "cloth_tearing/core/tear_rules.h"
#include "cloth_tearing/core/tearing.h"

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
  double max_speed = 200.0;          ///< of a particle; beyond is a runaway [m/s], > 0
  double runaway_strain = 50.0;  ///< of a spring that carries load; beyond is a runaway [-], > 0
  int tear_log_size = 100000;    ///< events kept for those who ask later, >= 1
};

/// Everything wrong with `params`, one sentence each, naming the field; empty if they can be used.
std::vector<std::string> problems(const SimulationParams& params);

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

  /// Takes hold of the cloth. Pinned particles are passed over.
  /// @throws Refusal if nothing is within reach, or a particle is held by another grasp
  GraspTaken grasp(const GraspRequest& request);

  /// Sends a grasp on its way; a second drag replaces the first.
  /// @throws Refusal if there is no such grasp or the target is not usable
  void drag(std::uint64_t grasp, const DragTarget& target) { grippers_.drag(grasp, target); }

  /// Lets go. @throws Refusal if there is no such grasp
  void release(std::uint64_t grasp) { grippers_.release(cloth_, grasp); }

  /// Lets go of everything. @return how many grasps there were
  int releaseAll() { return grippers_.releaseAll(cloth_); }

  /// The full set of streamed spheres: known ids move on from where they are, others are new,
  /// missing ones vanish.
  /// @throws Refusal naming everything wrong with them, twice the same id among it
  void setSpheres(const std::vector<Sphere>& spheres);

  /// @return the id of the thrown sphere
  /// @throws Refusal naming everything wrong with it, or that there are too many spheres
  std::uint64_t throwSphere(const ThrowRequest& request) { return spheres_.throwOne(request); }

  /// Changes the rules from the next step on, to switch tearing on and off or tune it; hem_width
  /// counts from the next build of the cloth.
  /// @throws Refusal naming everything wrong with them, or as the constructor if they switch it on
  void setTearRules(const TearRules& rules);

  /// Puts every particle where `positions` [m] says, at rest: to show where cloth belongs.
  /// @throws Refusal if there are not as many positions as particles, or one is out of range
  void place(const std::vector<Vec3>& positions);

  const SimulationParams& params() const { return params_; }
  const Cloth& cloth() const { return cloth_; }
  const std::vector<Grasp>& grasps() const { return grippers_.all(); }
  const std::vector<Sphere>& spheres() const { return spheres_.all(); }
  double time() const { return start_time_ + step_ * params_.solver.time_step; }
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

  Snapshot snapshot() const;
  Summary summary() const;
  std::uint64_t stateHash() const;

private:
  /// What a step may change before it tears, to go back to if the step goes wrong.
  struct Undo
  {
    std::vector<Vec3> velocity;
    std::vector<Grasp> grasps;
    std::vector<Sphere> spheres;
  };

  void watchSprings();
  double scan();
  void remember();
  void undo();
  std::string findFault(double max_strain) const;
  Stability findStability();
  void checkStability(std::vector<std::string>& notes);
  void refuseTooSoft(const TearRules& rules) const;
  void record(StepReport& report);
  TearCause causeOf(const Vec3d& position) const;

  SimulationParams params_;
  Cloth untorn_;  ///< as built, for reset()
  Cloth cloth_;
  SolverHandle solver_;
  SphereContact contact_;
  Tearing tearing_;
  LoosePieces loose_pieces_;
  Grippers grippers_;
  SphereSet spheres_;
  std::vector<Vec3> acceleration_;  ///< scratch of a step [m/s^2]
  Undo undo_;
  Stability stability_;
  TearLog log_;
  std::array<std::uint64_t, TEAR_KINDS> tears_{};  ///< by kind, since the last reset
  Stability start_stability_;                      ///< of the cloth as built
  double start_time_ = 0.0;                        ///< of the epoch [s]
  std::uint64_t step_ = 0;
  std::uint32_t epoch_ = 0;
};

}  // namespace cloth
