// Requests that save the whole state and go back to it.
#pragma once

#include <cloth_tearing/NamedState.h>

#include <functional>

#include "cloth_tearing/node/request_server.h"
#include "cloth_tearing/node/state_store.h"

namespace cloth_tearing
{

/// ~save_state and ~restore_state.
class StateServices
{
public:
  /// @param on_restore called after each: the state has brought its own parameters
  /// @param store outlives this
  StateServices(const NodeContext& context, StateStore& store, std::function<void()> on_restore);

private:
  void onSave(const NamedState::Request& request, NamedState::Response& response);
  void onRestore(const NamedState::Request& request, NamedState::Response& response);

  NodeContext context_;
  StateStore& store_;
  std::function<void()> on_restore_;
};

}  // namespace cloth_tearing
