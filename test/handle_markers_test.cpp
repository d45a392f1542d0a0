// Claims of handles as they are drawn: what they are on, where, and what their menus offer.
#include "cloth_tearing/node/handle_markers.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace cloth_tearing
{
namespace
{

using visualization_msgs::InteractiveMarker;
using visualization_msgs::InteractiveMarkerControl;

const Placement PLACE = { "map", cloth::Vec3d(10.0, 0.0, 5.0) };

std::vector<std::string> titles(const InteractiveMarker& marker)
{
  std::vector<std::string> titles;
  for (const visualization_msgs::MenuEntry& entry : marker.menu_entries)
  {
    titles.push_back(entry.title);
  }
  return titles;
}

/// An upright sheet with a grasp, a streamed sphere and a thrown one.
cloth::Simulation scene(const std::string& followed)
{
  cloth::Simulation simulation(cloth::upright(cloth::sheet(1.0, 1.0, 11, 11)), { 0 },
                               cloth::untearable());
  cloth::GraspRequest request;
  request.point = cloth::Vec3d(0.0, 0.0, -1.0);
  request.frame.position = request.point;
  request.followed = followed;
  simulation.grasp(request);
  cloth::Sphere sphere;
  sphere.id = 7;
  sphere.center = cloth::Vec3d(0.0, -1.0, 0.0);
  sphere.frame = followed;
  simulation.setSpheres({ sphere });
  simulation.throwSphere({});
  return simulation;
}

std::vector<InteractiveMarker> drawn(const cloth::Simulation& simulation)
{
  std::vector<InteractiveMarker> markers;
  for (const Handle& handle : handlesOf(simulation, HandleParams()))
  {
    markers.push_back(draw(handle, PLACE));
  }
  return markers;
}

TEST(HandleMarkers, AreNamedPlacedAndOfferedByWhatTheyAreOn)
{
  const std::vector<InteractiveMarker> markers = drawn(scene(""));
  ASSERT_EQ(markers.size(), 3u);
  EXPECT_EQ(markers[0].name, "grasp_1");
  EXPECT_EQ(titles(markers[0]), (std::vector<std::string>{ "Release", "Release and pin" }));
  EXPECT_EQ(markers[1].name, "sphere_7");
  EXPECT_EQ(titles(markers[1]), (std::vector<std::string>{ "Throw at the cloth", "Remove" }));
  EXPECT_EQ(markers[2].name, "thrown_1");
  EXPECT_EQ(titles(markers[2]), titles(markers[1]));

  EXPECT_EQ(markers[0].header.frame_id, "map");
  EXPECT_EQ(markers[0].pose.position.x, 10.0);
  EXPECT_EQ(markers[0].pose.position.z, 4.0);
  EXPECT_EQ(markers[1].pose.position.y, -1.0);
}

TEST(HandleMarkers, TurnGraspsAndTheHandButNotBalls)
{
  const std::vector<InteractiveMarker> markers = drawn(scene(""));
  EXPECT_EQ(markers[0].controls.size(), 7u);
  EXPECT_EQ(markers[1].controls.size(), 1u);
  EXPECT_EQ(markers[2].controls.size(), 1u);
  const InteractiveMarker hand = draw(handAt({}, HandleParams()), PLACE);
  EXPECT_EQ(hand.controls.size(), 7u);
  EXPECT_EQ(titles(hand), (std::vector<std::string>{ "Take hold here", "Throw a ball from here",
                                                     "Pin here", "Unpin here" }));
}

TEST(HandleMarkers, CannotBeDraggedWhereAFrameMovesWhatTheyAreOn)
{
  const std::vector<InteractiveMarker> markers = drawn(scene("arm"));
  for (const std::size_t i : { 0u, 1u })
  {
    ASSERT_EQ(markers[i].controls.size(), 1u) << markers[i].name;
    EXPECT_EQ(markers[i].controls[0].interaction_mode, InteractiveMarkerControl::MENU);
    EXPECT_NE(markers[i].description.find("follows arm"), std::string::npos);
  }
  EXPECT_EQ(markers[2].controls[0].interaction_mode, InteractiveMarkerControl::MOVE_3D);
}

TEST(HandleMarkers, SayANoteInLinesInsteadOfTheirName)
{
  Handle hand = handAt({}, HandleParams());
  const Handle silent = hand;
  hand.note = "there is no particle within 0.05 m (radius) of the point";
  EXPECT_FALSE(looksSame(hand, silent));
  const InteractiveMarker marker = draw(hand, PLACE);
  EXPECT_EQ(marker.description, "there is no particle within 0.05\nm (radius) of the point");
  EXPECT_EQ(marker.controls[1].markers.at(0).text, marker.description);
  EXPECT_EQ(marker.controls.size(), draw(silent, PLACE).controls.size() + 1);
}

TEST(HandleMarkers, OfTheHandBeginAtTheLowerBorderAndPointThroughTheCloth)
{
  const auto home = [](const cloth::ClothModel& model)
  { return handHome(cloth::Simulation(model, { 0 }, cloth::untearable()).cloth()); };
  const cloth::ClothModel flat = cloth::sheet(1.0, 1.0, 5, 5);

  const cloth::Pose hanging = home(cloth::upright(flat));
  EXPECT_TRUE(hanging.position.isApprox(cloth::Vec3d(0.0, 0.0, -1.0), 1e-6));
  EXPECT_TRUE((hanging.rotation * cloth::Vec3d(1, 0, 0)).isApprox(cloth::Vec3d(0, 1, 0), 1e-9));

  const cloth::Pose lying = home(flat);
  EXPECT_TRUE(lying.position.isApprox(cloth::Vec3d(0.0, -1.0, 0.0), 1e-6));
  EXPECT_TRUE((lying.rotation * cloth::Vec3d(1, 0, 0)).isApprox(cloth::Vec3d(0, 0, -1), 1e-9));
}

}  // namespace
}  // namespace cloth_tearing
