// Draws handles for grasps, spheres and a free hand as interactive markers.
#include "cloth_tearing/node/handle_markers.h"

#include <array>
#include <cmath>

namespace cloth_tearing
{

using visualization_msgs::InteractiveMarker;
using visualization_msgs::InteractiveMarkerControl;
using visualization_msgs::Marker;

namespace
{

struct Rgba
{
  float r, g, b, a;
};

constexpr Rgba GRASP_COLOR = { 1.00F, 0.90F, 0.10F, 0.90F };
constexpr Rgba FOLLOWING_COLOR = { 0.45F, 0.50F, 0.55F, 0.75F };
constexpr Rgba SPHERE_COLOR = { 1.00F, 1.00F, 1.00F, 0.30F };
constexpr Rgba HAND_COLOR = { 0.20F, 0.40F, 0.90F, 0.45F };
constexpr Rgba NOTE_COLOR = { 0.70F, 0.05F, 0.05F, 1.00F };

constexpr double GRASP_BALL = 0.5;     // of what the hand takes hold of: the cloth is to be seen
constexpr double SPHERE_SHELL = 1.05;  // of the sphere itself, to be in front of it
constexpr double AXES = 3.5;           // from end to end, in radii of the hand
constexpr double ARROW_LENGTH = 2.0;   // of the direction in which it throws, likewise
constexpr double ARROW_SHAFT = 0.25;
constexpr double ARROW_HEAD = 0.5;

constexpr std::size_t NOTE_WIDTH = 30;  // characters in a line
constexpr double NOTE_HEIGHT = 0.2;     // of a line, in sizes of the handle
constexpr double NOTE_PLACE = 1.0;      // above it, likewise

const char* wordsOf(HandleCommand command)
{
  switch (command)
  {
    case HandleCommand::RELEASE:
      return "Release";
    case HandleCommand::RELEASE_AND_PIN:
      return "Release and pin";
    case HandleCommand::THROW_AT_CLOTH:
      return "Throw at the cloth";
    case HandleCommand::REMOVE:
      return "Remove";
    case HandleCommand::TAKE_HOLD:
      return "Take hold here";
    case HandleCommand::THROW_BALL:
      return "Throw a ball from here";
    case HandleCommand::PIN:
      return "Pin here";
    case HandleCommand::UNPIN:
      break;
  }
  return "Unpin here";
}

/// `text` in lines of about NOTE_WIDTH, cut between words.
std::string wrapped(const std::string& text)
{
  std::string lines;
  std::size_t width = 0;
  for (const char c : text)
  {
    const bool cut = c == ' ' && width >= NOTE_WIDTH;
    lines += cut ? '\n' : c;
    width = cut || c == '\n' ? 0 : width + 1;
  }
  return lines;
}

std::string descriptionOf(const Handle& handle)
{
  if (!handle.note.empty())
  {
    return wrapped(handle.note);
  }
  std::string words = nameOf(handle);
  for (char& c : words)
  {
    c = c == '_' ? ' ' : c;
  }
  return handle.followed.empty() ? words : words + " follows " + handle.followed;
}

Rgba colorOf(const Handle& handle)
{
  switch (handle.kind)
  {
    case HandleKind::HAND:
      return HAND_COLOR;
    case HandleKind::GRASP:
      return handle.followed.empty() ? GRASP_COLOR : FOLLOWING_COLOR;
    default:
      return SPHERE_COLOR;
  }
}

Marker shape(int type, const Rgba& color)
{
  Marker marker;
  marker.type = type;
  marker.pose.orientation.w = 1.0;
  marker.color.r = color.r;
  marker.color.g = color.g;
  marker.color.b = color.b;
  marker.color.a = color.a;
  return marker;
}

Marker ball(const Handle& handle)
{
  Marker marker = shape(Marker::SPHERE, colorOf(handle));
  marker.scale.x = marker.scale.y = marker.scale.z = 2.0 * handle.radius;
  return marker;
}

/// Along the x axis, in which the hand throws.
Marker arrow(const Handle& handle)
{
  Marker marker = shape(Marker::ARROW, colorOf(handle));
  marker.points.resize(2);
  marker.points[1].x = ARROW_LENGTH * handle.radius;
  marker.scale.x = ARROW_SHAFT * handle.radius;
  marker.scale.y = ARROW_HEAD * handle.radius;
  return marker;
}

/// Why it was refused. Some clients draw the description in white, which is not seen everywhere.
InteractiveMarkerControl noteOf(const Handle& handle)
{
  InteractiveMarkerControl control;
  control.name = "note";
  control.orientation.w = 1.0;
  control.always_visible = true;
  Marker words = shape(Marker::TEXT_VIEW_FACING, NOTE_COLOR);
  words.text = wrapped(handle.note);
  words.scale.z = NOTE_HEIGHT * handle.size;
  words.pose.position.z = NOTE_PLACE * handle.size;
  control.markers.push_back(words);
  return control;
}

/// What is dragged by the pointer in the view plane, or has the menu alone.
InteractiveMarkerControl body(const Handle& handle)
{
  InteractiveMarkerControl control;
  const bool moves = handle.followed.empty();
  control.name = moves ? "move" : "menu";
  control.interaction_mode =
      moves ? InteractiveMarkerControl::MOVE_3D : InteractiveMarkerControl::MENU;
  control.orientation.w = 1.0;
  control.always_visible = true;
  control.markers.push_back(ball(handle));
  if (handle.kind == HandleKind::HAND)
  {
    control.markers.push_back(arrow(handle));
  }
  return control;
}

/// An arrow pair to move along each axis and a ring to turn about it: as clients draw them.
void addAxes(InteractiveMarker& marker)
{
  const std::array<cloth::Quatd, 3> turns = { cloth::Quatd(1, 1, 0, 0), cloth::Quatd(1, 0, 0, 1),
                                              cloth::Quatd(1, 0, 1, 0) };  // x to x, y and z
  const std::array<const char*, 3> names = { "x", "y", "z" };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    InteractiveMarkerControl control;
    const cloth::Quatd turn = turns[axis].normalized();
    control.orientation.x = turn.x();
    control.orientation.y = turn.y();
    control.orientation.z = turn.z();
    control.orientation.w = turn.w();
    control.name = std::string("move_") + names[axis];
    control.interaction_mode = InteractiveMarkerControl::MOVE_AXIS;
    marker.controls.push_back(control);
    control.name = std::string("turn_") + names[axis];
    control.interaction_mode = InteractiveMarkerControl::ROTATE_AXIS;
    marker.controls.push_back(control);
  }
}

Handle handleOf(const cloth::Grasp& grasp, const HandleParams& params)
{
  Handle handle;
  handle.kind = HandleKind::GRASP;
  handle.id = grasp.id;
  handle.pose = grasp.pose;
  handle.radius = GRASP_BALL * params.radius;
  handle.size = AXES * params.radius;
  handle.followed = grasp.followed;
  return handle;
}

Handle handleOf(const cloth::Sphere& sphere)
{
  Handle handle;
  handle.kind = sphere.source == cloth::SphereSource::STREAMED ? HandleKind::STREAMED_SPHERE
                                                               : HandleKind::THROWN_SPHERE;
  handle.id = sphere.id;
  handle.pose.position = sphere.center;
  handle.radius = SPHERE_SHELL * sphere.radius;
  handle.size = 2.0 * sphere.radius;
  handle.followed = sphere.frame;
  return handle;
}

}  // namespace

std::string nameOf(const Handle& handle)
{
  switch (handle.kind)
  {
    case HandleKind::GRASP:
      return "grasp_" + std::to_string(handle.id);
    case HandleKind::STREAMED_SPHERE:
      return "sphere_" + std::to_string(handle.id);
    case HandleKind::THROWN_SPHERE:
      return "thrown_" + std::to_string(handle.id);
    case HandleKind::HAND:
      break;
  }
  return "hand";
}

std::vector<HandleCommand> commandsOf(HandleKind kind)
{
  switch (kind)
  {
    case HandleKind::GRASP:
      return { HandleCommand::RELEASE, HandleCommand::RELEASE_AND_PIN };
    case HandleKind::HAND:
      return { HandleCommand::TAKE_HOLD, HandleCommand::THROW_BALL, HandleCommand::PIN,
               HandleCommand::UNPIN };
    default:
      return { HandleCommand::THROW_AT_CLOTH, HandleCommand::REMOVE };
  }
}

bool looksSame(const Handle& a, const Handle& b)
{
  return a.kind == b.kind && a.id == b.id && a.radius == b.radius && a.size == b.size &&
         a.followed == b.followed && a.note == b.note;
}

Handle handAt(const cloth::Pose& pose, const HandleParams& params)
{
  Handle hand;
  hand.pose = pose;
  hand.radius = params.radius;
  hand.size = AXES * params.radius;
  return hand;
}

std::vector<Handle> handlesOf(const cloth::Simulation& simulation, const HandleParams& params)
{
  std::vector<Handle> handles;
  for (const cloth::Grasp& grasp : simulation.grasps())
  {
    handles.push_back(handleOf(grasp, params));
  }
  for (const cloth::Sphere& sphere : simulation.spheres())
  {
    handles.push_back(handleOf(sphere));
  }
  return handles;
}

cloth::Pose handHome(const cloth::Cloth& cloth)
{
  Eigen::AlignedBox3d box;
  for (int i = 0; i < cloth.state.size(); ++i)
  {
    if (!cloth.damage.at_rest[i])
    {
      box.extend(cloth.state.position[i].cast<double>().eval());
    }
  }
  cloth::Pose home;
  if (box.isEmpty())
  {
    return home;
  }
  int thin = 0;
  box.sizes().minCoeff(&thin);
  const bool lies = thin == 2;
  const int down = lies ? 1 : 2;
  home.position = box.center();
  home.position[down] = box.min()[down];
  if (lies)
  {
    home.rotation = cloth::Quatd(1, 0, 1, 0).normalized();  // x to -z
  }
  else if (thin == 1)
  {
    home.rotation = cloth::Quatd(1, 0, 0, 1).normalized();  // x to y
  }
  return home;
}

InteractiveMarker draw(const Handle& handle, const Placement& placement)
{
  InteractiveMarker marker;
  marker.header.frame_id = placement.frame_id;
  marker.name = nameOf(handle);
  marker.description = descriptionOf(handle);
  marker.pose = toPose(handle.pose, placement);
  marker.scale = static_cast<float>(handle.size);
  marker.controls.push_back(body(handle));
  if (!handle.note.empty())
  {
    marker.controls.push_back(noteOf(handle));
  }
  if (handle.followed.empty() &&
      (handle.kind == HandleKind::GRASP || handle.kind == HandleKind::HAND))
  {
    addAxes(marker);
  }
  for (const HandleCommand command : commandsOf(handle.kind))
  {
    visualization_msgs::MenuEntry entry;
    entry.id = static_cast<std::uint32_t>(command);
    entry.title = wordsOf(command);
    entry.command_type = visualization_msgs::MenuEntry::FEEDBACK;
    marker.menu_entries.push_back(entry);
  }
  return marker;
}

}  // namespace cloth_tearing
