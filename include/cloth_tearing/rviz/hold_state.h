// What is known of a grasp that somebody has asked a node for, and what to tell of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cloth_tearing/Grasp.h"
#include "cloth_tearing/GraspEvents.h"
#include "cloth_tearing/GraspStates.h"
#include "cloth_tearing/Release.h"
#include "cloth_tearing/SimulationStatus.h"

namespace cloth_tearing
{

/// Follows one grasp at a time from the request to its end, whoever ends it. Knows neither threads
/// nor clocks: times are seconds from any beginning and never go back.
class HoldState
{
public:
  enum class Phase
  {
    IDLE,   ///< nothing is held
    ASKED,  ///< the node has not answered yet
    HELD
  };

  explicit HoldState(std::string node) : node_(std::move(node)) {}

  Phase phase() const { return phase_; }
  bool letsGo() const { return let_go_.has_value(); }  ///< as soon as the answer is there
  std::uint64_t grasp() const { return grasp_; }       ///< the one held last; 0 = none yet

  /// A grasp was asked for. Only while idle.
  void ask();

  /// The node has answered.
  ///
  /// @param problem why there is no grasp; empty = there is
  /// @return what to ask for now: it was let go in the meantime
  std::optional<Release::Request> answer(const std::string& problem,
                                         const Grasp::Response& response, double now);

  /// Somebody wants to let go.
  ///
  /// @return what to ask for; nothing as long as the node has not answered, and while idle
  std::optional<Release::Request> letGo(bool pin);

  /// The node has answered that.
  void released(const std::string& problem, bool pinned);

  void hear(const GraspStates& states, double now);
  void hear(const GraspEvents& events);
  void hear(const SimulationStatus& status, double now);

  /// Nobody publishes any more.
  void loseNode();

  /// Nothing was heard of the node for a while.
  bool silent(double now) const;

  /// What to tell, without mark-up: what is held and how, or how it ended.
  std::string words(double now) const;

private:
  void end(const std::string& reason);
  std::string holding() const;
  std::string hindrance(double now) const;

  std::string node_;
  Phase phase_ = Phase::IDLE;
  std::optional<Release::Request> let_go_;
  std::uint64_t grasp_ = 0;
  std::uint32_t particles_ = 0;
  GraspState felt_;
  bool seen_ = false;        ///< among the node's grasps
  double since_ = 0.0;       ///< of the answer
  double last_heard_ = 0.0;  ///< of the node
  std::string stands_;       ///< why the cloth does not move; empty = it does
  bool ended_alone_ = false;
  std::string note_;  ///< how the last one ended; empty = there was none yet
};

}  // namespace cloth_tearing
