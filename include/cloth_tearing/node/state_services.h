// Requests that save the whole state and go back to it.
#pragma once

#include <cloth_tearing/NamedState.h>

#include "cloth_tearing/node/request_server.h"
#include "cloth_tearing/node/state_store.h"

namespace cloth_tearing
{

/// ~save_state and ~restore_state.
class StateServices
{
public:
  StateServices(const NodeContext& context, const StateStoreParams& params);

private:
  void onSave(const NamedState::Request& request, NamedState::Response& response);
  void onRestore(const NamedState::Request& request, NamedState::Response& response);

  NodeContext context_;
  StateStore store_;
};

}  // namespace cloth_tearing
