// What is known of a grasp that somebody has asked a node for, and what to tell of it.
#include "cloth_tearing/rviz/hold_state.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cloth_tearing
{

namespace
{

constexpr double SILENCE = 2.0;  // after which it is told [s]
constexpr double DELAY = 0.5;    // for which a grasp may be missing on a topic that lags behind [s]

/// "1.5 N, 40 %".
std::string feeling(const GraspState& grasp)
{
  const geometry_msgs::Vector3& f = grasp.wrench.force;
  char text[100];
  std::snprintf(text, sizeof text, "%.2f N, %.0f %% of what tears it",
                std::sqrt(f.x * f.x + f.y * f.y + f.z * f.z), 100.0 * grasp.utilisation);
  return text;
}

std::string count(std::uint32_t particles)
{
  return std::to_string(particles) + (particles == 1 ? " particle" : " particles");
}

}  // namespace

void HoldState::ask()
{
  phase_ = Phase::ASKED;
  let_go_.reset();
  note_.clear();
  felt_ = GraspState();
  seen_ = false;
  ended_alone_ = false;
}

std::optional<Release::Request> HoldState::answer(const std::string& problem,
                                                  const Grasp::Response& response, double now)
{
  if (!problem.empty())
  {
    phase_ = Phase::IDLE;
    note_ = "Not taken: " + problem;
    return std::nullopt;
  }
  phase_ = Phase::HELD;
  grasp_ = response.grasp_id;
  particles_ = response.held_particles;
  since_ = now;
  last_heard_ = now;
  return let_go_ ? letGo(let_go_->pin != 0) : std::nullopt;
}

std::optional<Release::Request> HoldState::letGo(bool pin)
{
  Release::Request request;
  request.pin = pin;
  request.grasp_id = grasp_;
  switch (phase_)
  {
    case Phase::ASKED:
      let_go_ = request;
      return std::nullopt;
    case Phase::HELD:
      phase_ = Phase::IDLE;
      return request;
    default:
      return std::nullopt;
  }
}

void HoldState::released(const std::string& problem, bool pinned)
{
  if (phase_ != Phase::IDLE)  // of the grasp before
  {
    return;
  }
  note_ = pinned ? "Pinned: " + count(particles_) : "Let go";
  if (!problem.empty())
  {
    note_ = (pinned ? "Not pinned: " : "Not let go: ") + problem;
  }
}

void HoldState::end(const std::string& reason)
{
  phase_ = Phase::IDLE;
  ended_alone_ = true;
  note_ = "The grasp has ended: " + reason;
}

void HoldState::hear(const GraspStates& states, double now)
{
  last_heard_ = now;
  if (phase_ != Phase::HELD)
  {
    return;
  }
  const auto felt = std::find_if(states.grasps.begin(), states.grasps.end(),
                                 [this](const GraspState& g) { return g.grasp_id == grasp_; });
  if (felt != states.grasps.end())
  {
    felt_ = *felt;
    particles_ = felt->held_particles;
    seen_ = true;
  }
  else if (seen_ || now > since_ + DELAY)
  {
    end(node_ + " does not hold it any more");
  }
}

/// They may be later than the state that lacks the grasp, but know why.
void HoldState::hear(const GraspEvents& events)
{
  for (const GraspEvent& event : events.events)
  {
    const bool ends = event.kind == GraspEvent::RELEASED || event.kind == GraspEvent::SLIPPED;
    if (ends && event.grasp_id == grasp_ && (phase_ == Phase::HELD || ended_alone_))
    {
      end(event.reason);
    }
  }
}

void HoldState::hear(const SimulationStatus& status, double now)
{
  last_heard_ = now;
  stands_ = status.pace == "step" ? "It stands, and only moves by steps"
            : status.paused       ? "It is PAUSED"
                                  : "";
}

void HoldState::loseNode()
{
  if (phase_ == Phase::HELD)
  {
    end(node_ + " is gone");
  }
}

bool HoldState::silent(double now) const
{
  return now > last_heard_ + SILENCE;
}

std::string HoldState::words(double now) const
{
  switch (phase_)
  {
    case Phase::ASKED:
      return "Taking hold of " + node_ + " ...";
    case Phase::HELD:
      return holding() + hindrance(now);
    default:
      return note_;
  }
}

std::string HoldState::holding() const
{
  return "Holding " + count(particles_) + " of " + node_ +
         (seen_ ? ": " + feeling(felt_) : std::string());
}

/// Why the cloth may not move.
std::string HoldState::hindrance(double now) const
{
  if (silent(now))
  {
    return ". SILENT for " + std::to_string(static_cast<int>(now - last_heard_)) + " s";
  }
  return stands_.empty() ? std::string() : ". " + stands_;
}

}  // namespace cloth_tearing
