// How the node is doing, on /diagnostics.
#include "cloth_tearing/node/diagnostics.h"

#include <diagnostic_msgs/DiagnosticArray.h>

#include "cloth_tearing/core/checks.h"

namespace cloth_tearing
{

namespace
{

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

constexpr std::chrono::seconds PERIOD(1);

/// Below this part of the speed that is wanted, it is not kept.
constexpr double LATE = 0.9;

/// One step more or less within the second that was measured is nothing.
bool isLate(const StatusSource& source)
{
  const cloth::LoopState& loop = source.loop;
  return loop.falls_behind || (loop.pace == cloth::Pace::WALL && loop.real_time_factor > 0.0 &&
                               loop.real_time_factor + source.time_step < LATE * loop.speed);
}

void summarise(const StatusSource& source, DiagnosticStatusWrapper& entry)
{
  if (!source.fault.empty())
  {
    entry.summary(DiagnosticStatus::ERROR, "paused itself: " + source.fault);
  }
  else if (!source.recording_problem.empty())
  {
    entry.summary(DiagnosticStatus::WARN, "is not recorded any more: " + source.recording_problem);
  }
  else if (source.loop.paused)
  {
    entry.summary(DiagnosticStatus::WARN, "paused");
  }
  else if (source.loop.awaits_clock)
  {
    entry.summary(DiagnosticStatus::WARN, "waits for a clock to follow");
  }
  else if (isLate(source))
  {
    entry.summary(DiagnosticStatus::WARN, source.loop.falls_behind
                                              ? "slower than the clock that it follows"
                                              : "slower than it should be");
  }
  else
  {
    entry.summary(DiagnosticStatus::OK, "as it should");
  }
}

}  // namespace

void describeSolver(const StatusSource& source, DiagnosticStatusWrapper& entry)
{
  summarise(source, entry);
  entry.add("pace", name(source.loop.pace));
  entry.add("speed", cloth::text(source.loop.speed));
  entry.add("real-time factor", cloth::text(source.loop.real_time_factor));
  entry.add("substeps a step", source.summary.substeps);
  entry.add("clock jumps", source.loop.clock_jumps);
  entry.add("lost time [s]", cloth::text(source.loop.lost_time));
  entry.add("time [s]", cloth::text(source.summary.time));
  entry.add("step", source.summary.step);
  entry.add("epoch", source.summary.epoch);
  entry.add("worst utilisation", cloth::text(source.summary.utilisation));
  entry.add("maximum strain", cloth::text(source.summary.max_strain));
  entry.add("refusals", source.refusals);
  entry.add("last refusal", source.last_refusal);
  entry.add("recording", source.recording);
}

void describeTopology(const StatusSource& source, DiagnosticStatusWrapper& entry)
{
  const cloth::Summary& summary = source.summary;
  const auto tears = [&summary](cloth::TearKind kind)
  { return summary.tears[static_cast<std::size_t>(kind)]; };
  entry.summary(DiagnosticStatus::OK, summary.revision == 0 ? "whole" : "torn");
  entry.add("basic tears", tears(cloth::TearKind::BASIC));
  entry.add("weak-point tears", tears(cloth::TearKind::WEAK_POINT));
  entry.add("one-point tears", tears(cloth::TearKind::ONE_POINT));
  entry.add("released springs", tears(cloth::TearKind::RELEASED));
  entry.add("pieces", summary.pieces);
  entry.add("pieces at rest", summary.pieces_at_rest);
  entry.add("particles", summary.particles);
  entry.add("triangles", summary.triangles);
}

Diagnostics::Diagnostics(ros::NodeHandle node)
    : topic_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 1))
    , updater_(node, node, node.getNamespace())
    , due_(Clock::now())
{
  updater_.setHardwareID("none");
  updater_.add("solver",
               [this](DiagnosticStatusWrapper& entry) { describeSolver(source_, entry); });
  updater_.add("topology",
               [this](DiagnosticStatusWrapper& entry) { describeTopology(source_, entry); });
}

void Diagnostics::publish(const StatusSource& source)
{
  source_ = source;
  updater_.force_update();
  due_ = Clock::now() + PERIOD;
}

}  // namespace cloth_tearing
