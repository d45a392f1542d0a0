// Moves data of grasps and pulls between the core's types and the messages, and begins pulls.
#pragma once

#include <cloth_tearing/GraspEvents.h>
#include <cloth_tearing/GraspStates.h>
#include <cloth_tearing/GraspTargets.h>
#include <cloth_tearing/Pin.h>
#include <cloth_tearing/PullFeedback.h>
#include <cloth_tearing/PullGoal.h>
#include <cloth_tearing/PullResult.h>

#include <cstdint>
#include <string>
#include <vector>

#include "cloth_tearing/core/simulation.h"
#include "cloth_tearing/node/conversions.h"

namespace cloth_tearing
{

// -- out -----------------------------------------------------------------------------------------

std::vector<GraspEvent> toMessages(const std::vector<cloth::GraspEvent>& events,
                                   const Placement& placement);

/// All that ~grasp_states tells. The header has no stamp yet.
GraspStates graspStates(const cloth::Simulation& simulation, const Placement& placement);

PullFeedback toFeedback(const cloth::PullProgress& progress, const cloth::Simulation& simulation);

/// @param simulation whose pull it was: it knows the tears under way
PullResult toResult(const cloth::PullEnd& end, const cloth::Simulation& simulation,
                    const Placement& placement);

// -- in ------------------------------------------------------------------------------------------

/// As for the other messages: everything wrong by itself, whatever the cloth.
std::vector<std::string> problems(const Pin::Request& request);
std::vector<std::string> problems(const GraspTargets& message);
std::vector<std::string> problems(const PullGoal& goal);

/// The following take messages without problems.
cloth::PinRequest toCore(const Pin::Request& request, const cloth::Pose& to_cloth);

/// Where a grasp with `now` is sent by a target with or without an orientation of its own.
cloth::Pose poseFor(const geometry_msgs::Pose& target, const cloth::Pose& to_cloth,
                    const cloth::Pose& now);

/// @param taken the grasp, and where its frame is now
cloth::PullRequest toCore(const PullGoal& goal, const cloth::Pose& to_cloth,
                          const cloth::Grasp& taken);

/// What a pull without a grasp takes hold of first.
cloth::GraspRequest graspOf(const PullGoal& goal, const cloth::Pose& to_cloth);

/// Takes hold of the cloth first if the goal asks for it.
/// @return the id of the pull
/// @throws cloth::Refusal and nothing has changed
std::uint64_t beginPull(cloth::Simulation& simulation, const PullGoal& goal,
                        const cloth::Pose& to_cloth);

}  // namespace cloth_tearing
