// What is said on /diagnostics of which state.
#include "cloth_tearing/node/diagnostics.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace cloth_tearing;  // NOLINT: the subject of every line below
using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

namespace
{

DiagnosticStatusWrapper solver(const StatusSource& source)
{
  DiagnosticStatusWrapper entry;
  describeSolver(source, entry);
  return entry;
}

std::string value(const DiagnosticStatus& entry, const std::string& key)
{
  const auto found = std::find_if(entry.values.begin(), entry.values.end(),
                                  [&key](const auto& pair) { return pair.key == key; });
  return found == entry.values.end() ? "there is no " + key : found->value;
}

}  // namespace

TEST(SolverEntry, IsAsBadAsTheWorst)
{
  StatusSource source;
  source.loop.real_time_factor = 1.0;
  EXPECT_EQ(solver(source).level, DiagnosticStatus::OK);
  source.loop.real_time_factor = 0.5;
  EXPECT_EQ(solver(source).message, "slower than it should be");
  EXPECT_EQ(solver(source).level, DiagnosticStatus::WARN);
  source.loop.awaits_clock = true;
  EXPECT_EQ(solver(source).message, "waits for a clock to follow");
  EXPECT_EQ(solver(source).level, DiagnosticStatus::WARN);
  source.loop.paused = true;
  EXPECT_EQ(solver(source).message, "paused");
  EXPECT_EQ(solver(source).level, DiagnosticStatus::WARN);
  source.fault = "too fast";
  EXPECT_EQ(solver(source).message, "paused itself: too fast");
  EXPECT_EQ(solver(source).level, DiagnosticStatus::ERROR);
}

TEST(SolverEntry, IsNotLateWhereRealTimeIsNotItsPace)
{
  StatusSource source;
  source.loop.real_time_factor = 0.0;
  EXPECT_EQ(solver(source).level, DiagnosticStatus::OK) << "not measured yet";
  source.loop.real_time_factor = 0.5;
  for (const cloth::Pace pace : { cloth::Pace::FREE, cloth::Pace::STEP, cloth::Pace::CLOCK })
  {
    source.loop.pace = pace;
    EXPECT_EQ(solver(source).level, DiagnosticStatus::OK) << name(pace);
  }
}

TEST(SolverEntry, IsLateByTheSpeedThatIsWanted)
{
  StatusSource source;
  source.time_step = 0.001;
  source.loop.speed = 2.0;
  source.loop.real_time_factor = 1.0;
  EXPECT_EQ(solver(source).level, DiagnosticStatus::WARN);
  source.loop.speed = 0.1;
  source.loop.real_time_factor = 0.1;
  EXPECT_EQ(solver(source).level, DiagnosticStatus::OK);
  source.loop.speed = 0.0019;  // at times one step a second, at times two
  source.loop.real_time_factor = 0.001;
  EXPECT_EQ(solver(source).level, DiagnosticStatus::OK);
}

TEST(SolverEntry, IsLateWhereItFallsBehindTheClockThatItFollows)
{
  StatusSource source;
  source.loop.pace = cloth::Pace::CLOCK;
  source.loop.real_time_factor = 1.0;  // of a clock that is faster
  source.loop.falls_behind = true;
  EXPECT_EQ(solver(source).level, DiagnosticStatus::WARN);
  EXPECT_EQ(solver(source).message, "slower than the clock that it follows");
}

TEST(SolverEntry, TellsHowItRuns)
{
  StatusSource source;
  source.loop.speed = 2.0;
  source.loop.real_time_factor = 0.97;
  source.loop.clock_jumps = 3;
  source.loop.lost_time = 1.5;
  source.summary.utilisation = 0.25;
  source.refusals = 2;
  source.last_refusal = "grasp: no";
  source.recording = "/somewhere";

  const DiagnosticStatusWrapper entry = solver(source);

  EXPECT_EQ(value(entry, "pace"), "wall");
  EXPECT_EQ(value(entry, "substeps a step"), "1");
  EXPECT_EQ(value(entry, "speed"), "2");
  EXPECT_EQ(value(entry, "real-time factor"), "0.97");
  EXPECT_EQ(value(entry, "clock jumps"), "3");
  EXPECT_EQ(value(entry, "lost time [s]"), "1.5");
  EXPECT_EQ(value(entry, "worst utilisation"), "0.25");
  EXPECT_EQ(value(entry, "refusals"), "2");
  EXPECT_EQ(value(entry, "last refusal"), "grasp: no");
  EXPECT_EQ(value(entry, "recording"), "/somewhere");
}

TEST(SolverEntry, WarnsWhenTheRunIsNotRecordedAnyMore)
{
  StatusSource source;
  source.recording_problem = "the disk is full";
  EXPECT_EQ(solver(source).level, DiagnosticStatus::WARN);
  EXPECT_EQ(solver(source).message, "is not recorded any more: the disk is full");
}

TEST(TopologyEntry, CountsTearsAndPieces)
{
  StatusSource source;
  source.summary.revision = 10;
  source.summary.tears = { 1, 2, 3, 4 };
  source.summary.pieces = 5;
  source.summary.pieces_at_rest = 6;
  source.summary.particles = 7;
  DiagnosticStatusWrapper entry;

  describeTopology(source, entry);

  EXPECT_EQ(entry.level, DiagnosticStatus::OK);
  EXPECT_EQ(entry.message, "torn");
  EXPECT_EQ(value(entry, "basic tears"), "1");
  EXPECT_EQ(value(entry, "weak-point tears"), "2");
  EXPECT_EQ(value(entry, "one-point tears"), "3");
  EXPECT_EQ(value(entry, "released springs"), "4");
  EXPECT_EQ(value(entry, "pieces"), "5");
  EXPECT_EQ(value(entry, "pieces at rest"), "6");
  EXPECT_EQ(value(entry, "particles"), "7");
}
