// Who pauses, resets, saves, restores and exchanges the cloth, and looks at what was saved.
#include <cloth_tearing/Export.h>
#include <cloth_tearing/LoadModel.h>
#include <cloth_tearing/NamedState.h>
#include <cloth_tearing/Step.h>
#include <std_srvs/Trigger.h>

#include <fstream>
#include <iterator>

#include "cloth_tearing/core/mesh.h"
#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/core/simulation.h"
#include "cloth_tearing/node/conversions.h"
#include "cloth_tearing/node/node_params.h"
#include "users.h"

using namespace cloth_tearing;  // NOLINT: the messages are what all of this is about

namespace soak
{

namespace
{

cloth::Simulation defaultSimulation()
{
  const NodeParams params;
  const PlacedModel placed = placedModel(params);
  cloth::SimulationParams simulation_params = inClothFrame(params);
  simulation_params.place = toWords(Placement{ params.frame_id, params.cloth_pose.position });
  return { placed.model, placed.pinned, simulation_params };
}

/// The only one who does these things: so it knows what has to succeed.
class Keeper : public User
{
public:
  Keeper(World& world, std::uint64_t seed, const std::string& states)
      : User(world, seed), states_(states), simulation_(defaultSimulation())
  {
    longest_pause_ = 0.6;
  }

private:
  void act() override
  {
    const int choice = dice_.below(100);
    if (choice < 20)
    {
      world_.ask<std_srvs::Trigger>("reset", {}, Expect::SUCCESS);
    }
    else if (choice < 35)
    {
      stepByStep();
    }
    else if (choice < 45)
    {
      save(false);
    }
    else if (choice < 60)
    {
      save(true);
    }
    else if (choice < 80)
    {
      restore(dice_.oneIn(2));
    }
    else if (choice < 88)
    {
      exchange();
    }
    else if (choice < 92)
    {
      writeOut();
    }
    else
    {
      askWrongly();
    }
  }

  void leave() override { world_.ask<std_srvs::Trigger>("reset", {}, Expect::SUCCESS); }

  void stepByStep()
  {
    Step::Request request;
    request.steps = 10;
    world_.ask<Step>("step", request);  // refused: it runs, unless there was a fault
    world_.ask<std_srvs::Trigger>("pause", {}, Expect::SUCCESS);
    for (int i = dice_.below(4); i > 0; --i)
    {
      request.steps = static_cast<std::uint32_t>(dice_.below(300));
      const Step::Response done = world_.ask<Step>("step", request);
      if (done.success != (done.steps_done == request.steps))
      {
        world_.fail("step", "made " + std::to_string(done.steps_done) + " of " +
                                std::to_string(request.steps));
      }
    }
    world_.ask<std_srvs::Trigger>("resume", {}, Expect::SUCCESS);
  }

  std::string someName() { return "soak_" + std::to_string(dice_.below(4)); }

  void save(bool file)
  {
    NamedState::Request request;
    request.name = someName();
    request.file = file;
    const auto saved = world_.ask<NamedState>("save_state", request, Expect::SUCCESS);
    if (!saved.success)
    {
      return;
    }
    (file ? files_ : names_).push_back(request.name);
    if (file)
    {
      lookAtFile(states_ + "/" + request.name + ".cloth", saved.state_hash);
    }
  }

  /// What was saved has to be the cloth whose hash was told, without a defect.
  void lookAtFile(const std::string& path, std::uint64_t told_hash)
  {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{ std::istreambuf_iterator<char>(file), {} };
    try
    {
      cloth::Simulation restored = simulation_.restored(bytes);
      if (restored.stateHash() != told_hash)
      {
        world_.fail("saved state", "has another hash than was told");
      }
      lookAtMesh(restored);
      world_.count("saved states without a defect");
    }
    catch (const cloth::Refusal& refusal)
    {
      world_.fail("saved state", refusal.what());
    }
  }

  void lookAtMesh(const cloth::Simulation& simulation)
  {
    for (const std::string& defect : defects(simulation.cloth().mesh))
    {
      world_.fail("defect", defect);
    }
  }

  void restore(bool file)
  {
    const std::vector<std::string>& known = file ? files_ : names_;
    if (known.empty())
    {
      return;
    }
    NamedState::Request request;
    request.name = dice_.oneOf(known);
    request.file = file;
    world_.ask<NamedState>("restore_state", request, Expect::SUCCESS);
  }

  void exchange()
  {
    static const std::vector<std::string> MODELS = { "", "", "towel.obj", "tunic.obj" };
    LoadModel::Request request;
    request.model = dice_.oneOf(MODELS);
    request.weld_distance = request.model.empty() ? 0.0 : -1.0;
    world_.ask<LoadModel>("load_model", request);
  }

  void writeOut()
  {
    Export::Request request;
    request.name = "soak";
    request.replace = true;
    world_.ask<Export>("export", request, Expect::SUCCESS);
    request.replace = false;
    world_.ask<Export>("export", request, Expect::REFUSAL);
  }

  void askWrongly()
  {
    NamedState::Request state;
    state.name = "../soak";
    world_.ask<NamedState>("save_state", state, Expect::REFUSAL);
    state.name = "never_saved";
    state.file = dice_.oneIn(2);
    world_.ask<NamedState>("restore_state", state, Expect::REFUSAL);
    LoadModel::Request model;
    model.model = "../cloth.yaml";
    world_.ask<LoadModel>("load_model", model, Expect::REFUSAL);
    model.model = "towel.obj";
    model.scale = badNumber();
    world_.ask<LoadModel>("load_model", model, Expect::REFUSAL);
  }

  std::string states_;
  cloth::Simulation simulation_;  ///< of the same place as the node's
  std::vector<std::string> files_;
  std::vector<std::string> names_;
};

}  // namespace

std::unique_ptr<User> makeKeeper(World& world, std::uint64_t seed, const std::string& states)
{
  return std::make_unique<Keeper>(world, seed, states);
}

}  // namespace soak
