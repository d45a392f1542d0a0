// Whether a cloth can be simulated with its parameters, and how these change while it lives.
#include <algorithm>
#include <limits>
#include <optional>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/core/recorded_calls.h"
#include "cloth_tearing/core/simulation.h"

namespace cloth
{
namespace
{

/// Solver::stiffnessNumber at which a hanging cloth stretches about twice as far as it should.
constexpr double SOFT = 4.0;

/// What a step may add to the strain of the hanging cloth, as a fraction of tear_strain. Sheets of
/// 30 x 30 and 60 x 60 particles hold at 0.7 and tear by their own weight at 0.95.
constexpr double LARGEST_SAG = 0.5;

/// Square of how many springs a wave across hanging cloth may cross in a step, where lines of
/// springs are solved as wholes. By theory 1, and that at the highest point alone: sheets hang
/// calmly up to 1.7 and rattle until they tear from 3 on.
constexpr double LARGEST_WAVE = 2.0;

/// And up to this they also bear wind of 2 m/s and a ball pressed into them: tauter cloth has
/// faster waves.
constexpr double LARGE_WAVE = 0.7;

/// How far the cloth reaches: the diagonal of the box around it [m].
double reachOf(const Cloth& cloth)
{
  Vec3 low = Vec3::Constant(std::numeric_limits<Real>::max());
  Vec3 high = -low;
  for (const Vec3& x : cloth.state.position)
  {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return (high - low).cast<double>().norm();
}

/// Strain of cloth that bears all its weight, as if it hung by one end of its reach [-].
double strainByWeight(const SimulationParams& params, const Cloth& untorn)
{
  return params.material.areal_density * params.environment.gravity.norm() * reachOf(untorn) /
         params.material.stiffness;
}

/// See Solver::lineNumber().
double squaredWave(const SimulationParams& params, const Cloth& untorn, const SolverHandle& solver)
{
  const double number = solver->lineNumber(untorn.state, untorn.springs, params.solver.time_step);
  return number > 0.0 ? 0.5 * number * strainByWeight(params, untorn) : 0.0;
}

/// A step that is too long softens the cloth, or lets it rattle: then its own weight would tear it.
void refuseTooSoft(const SimulationParams& params, const Cloth& untorn, const SolverHandle& solver)
{
  if (!params.tearing.enabled)
  {
    return;
  }
  const double dt = params.solver.time_step;
  const std::string fault =
      "time_step [s] is " + text(dt) +
      ", too long for so fine a mesh: the cloth would tear by its own weight. ";
  const std::string remedy = ": lower time_step, take a coarser mesh, or switch tearing off";
  const double number = solver->stiffnessNumber(untorn.state, untorn.springs, dt);
  const double sag = strainByWeight(params, untorn) * number / SOFT;  // SOFT doubles the strain
  const double limit = LARGEST_SAG * params.tearing.tear_strain;
  if (sag > limit)
  {
    throw Refusal(fault + "The step alone adds a strain of " + text(sag) + ", must be at most " +
                  text(limit) + ", half of tear_strain" + remedy);
  }
  const double squared_wave = squaredWave(params, untorn, solver);
  if (squared_wave > LARGEST_WAVE)
  {
    throw Refusal(fault + "(time_step / spacing)^2 gravity reach is " + text(squared_wave) +
                  ", must be at most " + text(LARGEST_WAVE) + " with lines" + remedy);
  }
}

bool same(const Material& one, const Material& other)
{
  const auto& [areal_density, stiffness_law, stiffness, bend_shear_stiffness, damping] = one;
  return areal_density == other.areal_density && stiffness_law == other.stiffness_law &&
         stiffness == other.stiffness && bend_shear_stiffness == other.bend_shear_stiffness &&
         damping == other.damping;
}

SimulationParams tuned(SimulationParams params, const Tuning& tuning)
{
  params.material = tuning.material;
  params.environment = tuning.environment;
  params.tearing = tuning.tearing;
  params.contact = tuning.contact;
  params.solver.max_strain = tuning.max_strain;
  params.solver.max_substeps = tuning.max_substeps;
  return params;
}

/// Whether a solver that was made for one set of parameters has to be made anew for the other.
bool sameMotion(const SimulationParams& one, const SimulationParams& other)
{
  return same(one.material, other.material) && one.airRate() == other.airRate() &&
         one.solver.max_strain == other.solver.max_strain &&
         one.solver.max_substeps == other.solver.max_substeps;
}

}  // namespace

Tuning tuningOf(const SimulationParams& params)
{
  return { params.material, params.environment,       params.tearing,
           params.contact,  params.solver.max_strain, params.solver.max_substeps };
}

void Simulation::refuseUnfit(const SimulationParams& params, const Cloth& untorn,
                             const SolverHandle& solver, const Stability& stability)
{
  if (stability.floored > 0)
  {
    throw Refusal(
        "time_step [s] is " + text(params.solver.time_step) +
        ", too long for the force springs of " + std::to_string(stability.floored) +
        " particles even in max_substeps = " + std::to_string(params.solver.max_substeps) +
        " substeps: lower it or the stiffness, or raise areal_density or max_substeps");
  }
  refuseTooSoft(params, untorn, solver);
}

std::vector<std::string> Simulation::startNotes() const
{
  std::vector<std::string> notes;
  const double dt = params_.solver.time_step;
  const double number = solver_->stiffnessNumber(untorn_.state, untorn_.springs, dt);
  if (number > SOFT)
  {
    notes.push_back("the cloth is softer than stiffness says: (1/m_a + 1/m_b) dt^2 k is " +
                    text(number) + ", should be at most " + text(SOFT) +
                    "; lower time_step or stiffness, or raise areal_density");
  }
  const double squared_wave = squaredWave(params_, untorn_, solver_);
  if (squared_wave > LARGE_WAVE)
  {
    notes.push_back(
        "cloth that is more than hung may rattle and tear: (time_step / spacing)^2 gravity reach "
        "is " +
        text(squared_wave) + ", should be at most " + text(LARGE_WAVE) +
        " with lines; lower time_step");
  }
  if (start_stability_.substeps > 1)
  {
    notes.push_back("the force springs take " + std::to_string(start_stability_.substeps) +
                    " substeps a step");
  }
  return notes;
}

std::vector<std::string> Simulation::tune(const Tuning& tuning)
{
  const SimulationParams params = tuned(params_, tuning);
  refuseIf(problems(params));
  std::optional<Cloth> other_untorn;
  const bool other_material = !same(params.material, params_.material);
  if (other_material)
  {
    other_untorn = untorn_;
    other_untorn->setMaterial(params.material);
    other_untorn->springs.changes.forget();  // nobody follows the untorn cloth
  }
  const Cloth& untorn = other_material ? *other_untorn : untorn_;
  const bool other_motion = !sameMotion(params, params_);
  SolverHandle solver(params.solver);
  const Stability stability = solver->checkStability(untorn.state, untorn.springs,
                                                     params.solver.time_step, params.airRate());
  refuseUnfit(params, untorn, solver, stability);

  const bool other_hem = params.tearing.hem_width != params_.tearing.hem_width;
  keepBalance();
  params_ = params;
  if (other_material)
  {
    untorn_ = std::move(*other_untorn);
    cloth_.setMaterial(params.material);
    cloth_.springs.changes.forget();  // who follows this one looks at all of it anew
  }
  if (other_hem)
  {
    untorn_.markHem(params.tearing.hem_width);
    cloth_.takeHem(untorn_);
  }
  tearing_ = Tearing(params.tearing);
  std::vector<std::string> notes;
  if (other_motion)
  {
    SolverMemory kept;
    kept.lines = solver_->memory().lines;  // cloth that lies crumpled has no straight ones
    makeSolver();
    solver_->recall(kept);
    start_stability_ = stability;
    stability_ = stability;
    notes = startNotes();
    checkStability(notes);
  }
  watchSprings();
  note<&Simulation::tune>(tuning);
  return notes;
}

void Simulation::setTearRules(const TearRules& rules)
{
  Tuning tuning = tuningOf(params_);
  tuning.tearing = rules;
  tune(tuning);
}

void Simulation::takeCloth(Simulation other)
{
  other.params_.life = params_.life;
  other.params_.place = params_.place;
  const std::string saved = recorder_.get() != nullptr ? other.save() : std::string();
  params_ = std::move(other.params_);
  untorn_ = std::move(other.untorn_);
  start_stability_ = other.start_stability_;
  workers_ = std::move(other.workers_);
  loose_pieces_ = {};
  contact_ = {};
  startOver("another cloth was put in its place");
  note<&Simulation::takeSaved>(saved);
}

}  // namespace cloth
