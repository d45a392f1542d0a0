// Many clients that call the node's services at the same time.
#pragma once

#include <string>
#include <vector>

/// What became of all calls.
struct StormReport
{
  int calls = 0;
  int answered = 0;                  ///< whatever the answer
  int served = 0;                    ///< with success
  std::vector<double> milliseconds;  ///< of each answered call, ascending
};

/// Each client has connections of its own and calls ~grasp, ~release, ~get_tear_events and ~step 0
/// in turn, the next as soon as one was answered. Needs no spinner.
/// @param node its name
/// @param clients at once
/// @param calls of each
StormReport serviceStorm(const std::string& node, int clients, int calls);
