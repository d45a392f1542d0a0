// Begins pulls, tells how they go and how they ended.
#include "cloth_tearing/node/pull_server.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>

#include "cloth_tearing/core/refusal.h"

namespace cloth_tearing
{

namespace
{

const std::string ENDING = "the simulation is ending";
constexpr std::chrono::milliseconds FEEDBACK(50);  // 20 Hz
constexpr std::chrono::milliseconds IDLE(1000);
constexpr std::size_t MOST_PREDICTIONS = 4;  // at once
constexpr int GIVING_WAY = 10;               // nice value of a prediction's thread

template <class GoalHandle>
bool isCancelled(const GoalHandle& handle)
{
  const std::uint8_t status = handle.getGoalStatus().status;
  return status == actionlib_msgs::GoalStatus::RECALLING ||
         status == actionlib_msgs::GoalStatus::PREEMPTING;
}

template <class GoalHandle>
void reject(GoalHandle& handle, const std::string& reason)
{
  PullResult result;
  result.outcome = PullResult::REFUSED;
  result.message = reason;
  handle.setRejected(result, reason);
}

template <class GoalHandle>
void finish(GoalHandle& handle, const PullResult& result)
{
  switch (result.outcome)
  {
    case PullResult::LOST:
      handle.setAborted(result, result.message);
      break;
    case PullResult::CANCELLED:
      handle.setCanceled(result, result.message);
      break;
    default:
      handle.setSucceeded(result, result.message);
  }
}

template <class GoalHandle>
void abort(GoalHandle& handle, const std::string& reason)
{
  PullResult result;
  result.outcome = PullResult::LOST;
  result.message = reason;
  handle.setAborted(result, reason);
}

template <class GoalHandle>
void publishProgress(GoalHandle& handle, const cloth::Simulation& simulation, std::uint64_t pull)
{
  for (const cloth::PullProgress& progress : simulation.pulls())
  {
    if (progress.pull == pull)
    {
      handle.publishFeedback(toFeedback(progress, simulation));
    }
  }
}

}  // namespace

// -- ~pull ----------------------------------------------------------------------------------------

PullServer::PullServer(const NodeContext& context, NewestNumber& ends)
    : context_(context)
    , ends_(ends)
    , thread_([this] { run(); })
    , server_(
          context_.node, "pull", [this](GoalHandle handle) { onGoal(handle); },
          [this](GoalHandle handle) { onCancel(handle); }, false)
{
  server_.start();
}

PullServer::~PullServer()
{
  stop();
}

void PullServer::stop()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    ends_.end();
  }
  if (thread_.joinable())
  {
    thread_.join();
  }
  std::map<std::uint64_t, GoalHandle> left;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    left.swap(goals_);
  }
  for (auto& goal : left)
  {
    abort(goal.second, ENDING);
  }
}

/// The lock is held from before the pull begins until it is known here: it may end at once.
void PullServer::onGoal(GoalHandle handle)
{
  const PullGoal& goal = *handle.getGoal();
  const std::string reason = context_.requests.refusal(
      "pull",
      [&]
      {
        cloth::refuseIf(problems(goal));
        const cloth::Pose to_cloth = context_.frames.toCloth(goal.header);
        const std::lock_guard<std::mutex> lock(mutex_);
        if (stopping_)
        {
          throw cloth::Refusal(ENDING);
        }
        if (isCancelled(handle))
        {
          PullResult result;
          result.outcome = PullResult::CANCELLED;
          result.message = "cancelled before it began";
          handle.setCanceled(result, result.message);
          return;
        }
        const std::uint64_t pull = context_.loop.call(
            [&](cloth::Simulation& simulation) { return beginPull(simulation, goal, to_cloth); });
        handle.setAccepted();
        goals_[pull] = handle;
        ends_.wake();
      });
  if (!reason.empty())
  {
    reject(handle, reason);
    return;
  }
  context_.publisher.touch();
}

/// It is run() that cancels: a simulation that is busy now is asked again.
void PullServer::onCancel(GoalHandle handle)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& goal : goals_)
  {
    if (goal.second == handle)
    {
      unwanted_.insert(goal.first);
    }
  }
  ends_.wake();
}

void PullServer::run()
{
  auto next_feedback = std::chrono::steady_clock::now();
  std::uint64_t told = 0;
  bool under_way = false;
  while (true)
  {
    ends_.waitFor(told, under_way ? FEEDBACK : IDLE);
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopping_)
    {
      return;
    }
    try
    {
      cancelPulls();
      tellEnds();
      const auto now = std::chrono::steady_clock::now();
      if (!goals_.empty() && now >= next_feedback)
      {
        tellProgress();
        next_feedback = now + FEEDBACK;
      }
    }
    catch (const cloth::Busy&)  // another turn comes
    {
    }
    told = told_;
    under_way = !goals_.empty();
  }
}

void PullServer::cancelPulls()
{
  if (unwanted_.empty())
  {
    return;
  }
  context_.loop.call(
      [this](cloth::Simulation& simulation)
      {
        for (const std::uint64_t pull : unwanted_)
        {
          simulation.cancelPull(pull);
        }
      });
  unwanted_.clear();
}

void PullServer::tellEnds()
{
  std::map<std::uint64_t, PullResult> results;  // by pull
  context_.loop.call(
      [&](cloth::Simulation& simulation)
      {
        for (const cloth::PullEnd& end : simulation.pullEndsSince(told_ + 1, mostOf(0)))
        {
          results[end.progress.pull] = toResult(end, simulation, context_.placement);
          told_ = end.sequence;
        }
      });
  for (const auto& result : results)
  {
    const auto goal = goals_.find(result.first);
    if (goal != goals_.end())
    {
      finish(goal->second, result.second);
      goals_.erase(goal);
    }
  }
}

void PullServer::tellProgress()
{
  std::map<std::uint64_t, PullFeedback> feedbacks;  // by pull
  context_.loop.call(
      [&](cloth::Simulation& simulation)
      {
        for (const cloth::PullProgress& progress : simulation.pulls())
        {
          feedbacks[progress.pull] = toFeedback(progress, simulation);
        }
      });
  for (auto& goal : goals_)
  {
    const auto feedback = feedbacks.find(goal.first);
    if (feedback != feedbacks.end())
    {
      goal.second.publishFeedback(feedback->second);
    }
  }
}

// -- ~predict_pull --------------------------------------------------------------------------------

PullPredictor::PullPredictor(const NodeContext& context)
    : context_(context)
    , server_(
          context_.node, "predict_pull", [this](GoalHandle handle) { onGoal(handle); },
          [this](GoalHandle handle) { onCancel(handle); }, false)
{
  server_.start();
}

PullPredictor::~PullPredictor()
{
  stop();
}

void PullPredictor::stop()
{
  std::vector<std::unique_ptr<Prediction>> predictions;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    predictions.swap(predictions_);
  }
  for (auto& prediction : predictions)
  {
    prediction->ending = true;
    prediction->thread.join();
  }
}

void PullPredictor::onGoal(GoalHandle handle)
{
  const PullGoal& goal = *handle.getGoal();
  const std::string reason = context_.requests.refusal(
      "predict_pull",
      [&]
      {
        cloth::refuseIf(problems(goal));
        const cloth::Pose to_cloth = context_.frames.toCloth(goal.header);
        auto copy = context_.loop.call([](cloth::Simulation& simulation)
                                       { return std::make_unique<cloth::Simulation>(simulation); });
        if (goal.grasp_id != 0 && !copy->findGrasp(goal.grasp_id).followed.empty())
        {
          copy->stopFollowing(goal.grasp_id);  // what its frame will do is not known
        }
        const std::uint64_t pull = beginPull(*copy, goal, to_cloth);
        start(handle, std::move(copy), pull);
      });
  if (!reason.empty())
  {
    reject(handle, reason);
  }
}

void PullPredictor::start(GoalHandle handle, std::unique_ptr<cloth::Simulation> copy,
                          std::uint64_t pull)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  forgetOld();
  if (stopping_)
  {
    throw cloth::Refusal(ENDING);
  }
  if (predictions_.size() >= MOST_PREDICTIONS)
  {
    throw cloth::Refusal("there are " + std::to_string(predictions_.size()) +
                         " predictions under way, must be less than " +
                         std::to_string(MOST_PREDICTIONS) + " for one to begin");
  }
  predictions_.push_back(std::make_unique<Prediction>());
  Prediction& prediction = *predictions_.back();
  prediction.handle = handle;
  prediction.ends_before = copy->loggedPullEnds()[1];
  prediction.cancelled = isCancelled(handle);
  prediction.handle.setAccepted();
  prediction.thread = std::thread(
      [this, &prediction, pull, world = std::shared_ptr<cloth::Simulation>(std::move(copy))]
      {
        try
        {
          predict(prediction, *world, pull);
        }
        catch (const std::exception& error)
        {
          abort(prediction.handle, error.what());
        }
        prediction.over = true;
      });
}

void PullPredictor::forgetOld()
{
  const auto old = std::stable_partition(predictions_.begin(), predictions_.end(),
                                         [](const auto& prediction) { return !prediction->over; });
  for (auto prediction = old; prediction != predictions_.end(); ++prediction)
  {
    (*prediction)->thread.join();
  }
  predictions_.erase(old, predictions_.end());
}

void PullPredictor::onCancel(GoalHandle handle)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  for (auto& prediction : predictions_)
  {
    if (prediction->handle == handle)
    {
      prediction->cancelled = true;
    }
  }
}

void PullPredictor::predict(Prediction& prediction, cloth::Simulation& copy,
                            std::uint64_t pull) const
{
  setpriority(PRIO_PROCESS, 0, GIVING_WAY);  // on Linux: of this thread alone
  auto next_feedback = std::chrono::steady_clock::now() + FEEDBACK;
  while (!finished(prediction, copy, pull))
  {
    if (prediction.ending)
    {
      abort(prediction.handle, ENDING);
      return;
    }
    if (prediction.cancelled)
    {
      copy.cancelPull(pull);
      continue;
    }
    const std::string fault = copy.step().fault;
    if (!fault.empty())
    {
      abort(prediction.handle, fault);
      return;
    }
    const auto now = std::chrono::steady_clock::now();
    if (now >= next_feedback)
    {
      publishProgress(prediction.handle, copy, pull);
      next_feedback = now + FEEDBACK;
    }
  }
}

/// Tells the end of the pull. @return whether it has ended
bool PullPredictor::finished(Prediction& prediction, const cloth::Simulation& copy,
                             std::uint64_t pull) const
{
  for (const cloth::PullEnd& end : copy.pullEndsSince(prediction.ends_before + 1, mostOf(0)))
  {
    if (end.progress.pull == pull)
    {
      PullResult result = toResult(end, copy, context_.placement);
      result.grasp_id = prediction.handle.getGoal()->grasp_id;  // no other one exists
      finish(prediction.handle, result);
      return true;
    }
  }
  return false;
}

}  // namespace cloth_tearing
