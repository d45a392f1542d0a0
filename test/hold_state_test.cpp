// Claims of what the Pull tool knows of a grasp: from asking for it to its end, whoever ends it.
#include "cloth_tearing/rviz/hold_state.h"

#include <gtest/gtest.h>

namespace cloth_tearing
{
namespace
{

using Phase = HoldState::Phase;
using testing::Test;

GraspStates states(const std::vector<std::uint64_t>& grasps)
{
  GraspStates message;
  for (const std::uint64_t id : grasps)
  {
    GraspState grasp;
    grasp.grasp_id = id;
    grasp.held_particles = 9;
    grasp.wrench.force.x = 3.0;
    grasp.wrench.force.z = -4.0;
    grasp.utilisation = 0.42;
    message.grasps.push_back(grasp);
  }
  return message;
}

GraspEvents event(std::uint8_t kind, std::uint64_t grasp, const std::string& reason)
{
  GraspEvents message;
  message.events.resize(1);
  message.events[0].kind = kind;
  message.events[0].grasp_id = grasp;
  message.events[0].reason = reason;
  return message;
}

SimulationStatus status(bool paused, const std::string& pace)
{
  SimulationStatus message;
  message.paused = paused;
  message.pace = pace;
  return message;
}

class AHold : public Test
{
protected:
  AHold()
  {
    response_.success = true;
    response_.grasp_id = 7;
    response_.held_particles = 5;
  }

  void take()
  {
    state_.ask();
    EXPECT_FALSE(state_.answer("", response_, 10.0));
  }

  bool tells(const std::string& part, double now = 10.1) const
  {
    return state_.words(now).find(part) != std::string::npos;
  }

  Grasp::Response response_;
  HoldState state_{ "/cloth" };
};

TEST_F(AHold, TellsWhatIsHeldAndFelt)
{
  EXPECT_EQ(state_.words(0.0), "");
  state_.ask();
  EXPECT_TRUE(tells("Taking hold of /cloth"));
  state_.answer("", response_, 10.0);
  EXPECT_TRUE(tells("Holding 5 particles of /cloth"));

  state_.hear(states({ 3, 7 }), 10.1);

  EXPECT_EQ(state_.phase(), Phase::HELD);
  EXPECT_TRUE(tells("Holding 9 particles of /cloth: 5.00 N, 42 %")) << state_.words(10.1);
}

TEST_F(AHold, TellsWhyItWasRefused)
{
  state_.ask();
  EXPECT_FALSE(state_.answer("no particle within 0.05 m", Grasp::Response(), 10.0));

  EXPECT_EQ(state_.phase(), Phase::IDLE);
  EXPECT_TRUE(tells("no particle within 0.05 m"));
}

TEST_F(AHold, IsLetGoOnceByItsNumber)
{
  take();

  const auto request = state_.letGo(true);

  ASSERT_TRUE(request);
  EXPECT_EQ(request->grasp_id, 7u);
  EXPECT_TRUE(request->pin);
  EXPECT_FALSE(state_.letGo(false));
  EXPECT_EQ(state_.phase(), Phase::IDLE);
}

TEST_F(AHold, LetGoBeforeTheAnswerIsLetGoWithIt)
{
  state_.ask();
  EXPECT_FALSE(state_.letGo(true));
  EXPECT_TRUE(state_.letsGo());
  EXPECT_EQ(state_.phase(), Phase::ASKED);

  const auto request = state_.answer("", response_, 10.0);

  ASSERT_TRUE(request);
  EXPECT_EQ(request->grasp_id, 7u);
  EXPECT_TRUE(request->pin);
  EXPECT_EQ(state_.phase(), Phase::IDLE);
}

TEST_F(AHold, LetGoBeforeItIsRefusedAsksForNothing)
{
  state_.ask();
  state_.letGo(false);

  EXPECT_FALSE(state_.answer("refused", Grasp::Response(), 10.0));

  state_.ask();
  EXPECT_FALSE(state_.letsGo());
  EXPECT_FALSE(state_.answer("", response_, 11.0));
  EXPECT_EQ(state_.phase(), Phase::HELD);
}

TEST_F(AHold, TellsHowLettingGoWent)
{
  take();
  state_.letGo(true);
  state_.released("", true);
  EXPECT_TRUE(tells("Pinned: 5 particles"));
  state_.released("there is no grasp 7", false);
  EXPECT_TRUE(tells("Not let go: there is no grasp 7"));

  state_.ask();
  state_.released("", false);  // that of the grasp before
  EXPECT_TRUE(tells("Taking hold"));
}

TEST_F(AHold, EndsWithTheReasonOfItsEvent)
{
  for (const std::uint8_t kind : { GraspEvent::SLIPPED, GraspEvent::RELEASED })
  {
    take();
    state_.hear(event(kind, 8, "of another"));
    state_.hear(event(GraspEvent::SPLIT, 7, "goes on"));
    ASSERT_EQ(state_.phase(), Phase::HELD);

    state_.hear(event(kind, 7, "force 12 N above force_limit 10 N"));

    EXPECT_EQ(state_.phase(), Phase::IDLE);
    EXPECT_TRUE(tells("force 12 N above force_limit 10 N"));
    EXPECT_FALSE(state_.letGo(false)) << "there is nothing to let go";
  }
}

TEST_F(AHold, EndsWhenTheNodeDoesNotHoldItAnyMore)
{
  take();
  state_.hear(states({ 7 }), 10.1);
  state_.hear(states({ 3 }), 10.2);

  EXPECT_EQ(state_.phase(), Phase::IDLE);
  EXPECT_TRUE(tells("does not hold it any more"));

  state_.hear(event(GraspEvent::RELEASED, 7, "reset"));
  EXPECT_TRUE(tells("reset")) << "the event knows why, even if it is late";
}

TEST_F(AHold, DoesNotEndByAStateFromBeforeIt)
{
  take();
  state_.hear(states({}), 10.1);
  EXPECT_EQ(state_.phase(), Phase::HELD);

  state_.hear(states({}), 11.0);
  EXPECT_EQ(state_.phase(), Phase::IDLE);
}

TEST_F(AHold, DoesNotTellOfEventsAfterItWasLetGo)
{
  take();
  state_.letGo(false);
  state_.released("", false);

  state_.hear(event(GraspEvent::RELEASED, 7, "released on request"));

  EXPECT_EQ(state_.words(10.1), "Let go");
}

TEST_F(AHold, TellsThatTheNodeIsSilentAndGoesOnWhenItIsBack)
{
  take();
  state_.hear(states({ 7 }), 10.1);
  EXPECT_FALSE(tells("SILENT", 12.0));
  EXPECT_TRUE(tells("SILENT for 3 s", 13.5));

  state_.hear(states({ 7 }), 14.0);

  EXPECT_FALSE(tells("SILENT", 14.1));
  EXPECT_EQ(state_.phase(), Phase::HELD);
}

TEST_F(AHold, EndsWithItsNode)
{
  state_.loseNode();
  EXPECT_EQ(state_.words(0.0), "");
  take();

  state_.loseNode();

  EXPECT_EQ(state_.phase(), Phase::IDLE);
  EXPECT_TRUE(tells("/cloth is gone"));
}

TEST_F(AHold, TellsThatTheSimulationStands)
{
  take();
  state_.hear(status(true, "wall"), 10.1);
  EXPECT_TRUE(tells("PAUSED"));
  state_.hear(status(false, "wall"), 10.2);
  EXPECT_FALSE(tells("PAUSED"));
  state_.hear(status(false, "step"), 10.3);
  EXPECT_TRUE(tells("only moves by steps"));
}

}  // namespace
}  // namespace cloth_tearing
