// Draws handles for grasps, spheres and a free hand as interactive markers. Pure functions.
#pragma once

#include <visualization_msgs/InteractiveMarker.h>

#include <cstdint>
#include <string>
#include <vector>

#include "cloth_tearing/core/simulation.h"
#include "cloth_tearing/node/conversions.h"
#include "cloth_tearing/node/node_params.h"

namespace cloth_tearing
{

/// What a handle is on.
enum class HandleKind
{
  GRASP,
  STREAMED_SPHERE,
  THROWN_SPHERE,
  HAND,  ///< on nothing: it goes where it is dragged
};

/// Entries of the menus, as numbered in menu_entry_id.
enum class HandleCommand : std::uint32_t
{
  RELEASE = 1,
  RELEASE_AND_PIN,
  THROW_AT_CLOTH,
  REMOVE,
  TAKE_HOLD,
  THROW_BALL,
  PIN,
  UNPIN,
};

/// A handle, as far as it does not depend on who looks at it.
struct Handle
{
  HandleKind kind = HandleKind::HAND;
  std::uint64_t id = 0;  ///< of the grasp or sphere
  cloth::Pose pose;      ///< cloth frame
  double radius = 0.1;   ///< of the ball that is dragged [m]
  double size = 0.2;     ///< of axes and words [m]
  std::string followed;  ///< frame that moves what it is on: it cannot be dragged; or empty
  std::string note;      ///< is shown instead of its name; or empty
};

/// grasp_ID, sphere_ID, thrown_ID or hand.
std::string nameOf(const Handle& handle);

/// What its menu offers.
std::vector<HandleCommand> commandsOf(HandleKind kind);

/// Whether two handles differ in nothing but their pose.
bool looksSame(const Handle& a, const Handle& b);

Handle handAt(const cloth::Pose& pose, const HandleParams& params);

/// Of all grasps and spheres.
std::vector<Handle> handlesOf(const cloth::Simulation& simulation, const HandleParams& params);

/// Where the hand is to begin with: in the middle of the cloth's lower border, its x axis through
/// the cloth.
cloth::Pose handHome(const cloth::Cloth& cloth);

/// Without a stamp: clients are to see it in its frame as that is now.
visualization_msgs::InteractiveMarker draw(const Handle& handle, const Placement& placement);

}  // namespace cloth_tearing
