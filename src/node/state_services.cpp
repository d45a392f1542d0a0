// Saves and restores states, as requested.
#include "cloth_tearing/node/state_services.h"

#include <utility>

namespace cloth_tearing
{

StateServices::StateServices(const NodeContext& context, StateStore& store,
                             std::function<void()> on_restore)
    : context_(context), store_(store), on_restore_(std::move(on_restore))
{
  context_.requests.serve<NamedState>(
      context_.node, "save_state", [this](auto& q, auto& a) { onSave(q, a); }, Effect::LOOKS);
  context_.requests.serve<NamedState>(context_.node, "restore_state",
                                      [this](auto& q, auto& a) { onRestore(q, a); });
}

void StateServices::onSave(const NamedState::Request& request, NamedState::Response& response)
{
  std::string bytes;
  context_.loop.call(
      [&](cloth::Simulation& simulation)
      {
        bytes = simulation.save();
        response.step = simulation.stepCount();
        response.state_hash = simulation.stateHash();
      });
  if (request.file)
  {
    store_.write(request.name, bytes);
  }
  else
  {
    store_.keep(request.name, std::move(bytes));
  }
}

/// The faults so far are settled with it, as by a reset.
void StateServices::onRestore(const NamedState::Request& request, NamedState::Response& response)
{
  const StateStore::Bytes bytes =
      request.file ? store_.read(request.name) : store_.kept(request.name);
  const std::uint64_t settled = context_.publisher.faults();
  const cloth::StepAnswer answer = context_.loop.restore(*bytes);
  context_.publisher.clearFault(settled);
  on_restore_();
  response.step = answer.step;
  response.state_hash = answer.state_hash;
}

}  // namespace cloth_tearing
