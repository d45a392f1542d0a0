// The actions ~pull and ~predict_pull: on the cloth, and on a copy of it.
#pragma once

#include <actionlib/server/action_server.h>
#include <cloth_tearing/PullAction.h>

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "cloth_tearing/node/grasp_conversions.h"
#include "cloth_tearing/node/newest_number.h"
#include "cloth_tearing/node/request_server.h"

namespace cloth_tearing
{

using PullActionServer = actionlib::ActionServer<PullAction>;

/// ~pull. The simulation itself watches its pulls, step by step; what it says of them is passed on
/// by a thread of this.
class PullServer
{
public:
  /// @param ends the number of the last pull that ended, as the loop's thread raises it
  PullServer(const NodeContext& context, NewestNumber& ends);
  PullServer(const PullServer&) = delete;
  PullServer& operator=(const PullServer&) = delete;
  ~PullServer();

  /// Goals under way are aborted; none is accepted from now on.
  void stop();

private:
  using GoalHandle = PullActionServer::GoalHandle;

  void onGoal(GoalHandle handle);
  void onCancel(GoalHandle handle);
  void run();
  void cancelPulls();
  void tellEnds();
  void tellProgress();

  NodeContext context_;
  NewestNumber& ends_;
  std::mutex mutex_;                           // guards what follows
  std::map<std::uint64_t, GoalHandle> goals_;  ///< under way, by pull
  std::set<std::uint64_t> unwanted_;           ///< pulls that are to be cancelled
  std::uint64_t told_ = 0;                     ///< number of the last end that was told
  bool stopping_ = false;

  std::thread thread_;
  PullActionServer server_;  ///< last: it calls onGoal()
};

/// ~predict_pull: each goal on a copy of its own, on a thread that gives way to others.
class PullPredictor
{
public:
  explicit PullPredictor(const NodeContext& context);
  PullPredictor(const PullPredictor&) = delete;
  PullPredictor& operator=(const PullPredictor&) = delete;
  ~PullPredictor();

  /// Cuts predictions under way short; no goal is accepted from now on.
  void stop();

private:
  using GoalHandle = PullActionServer::GoalHandle;

  struct Prediction
  {
    GoalHandle handle;
    std::atomic<bool> cancelled{ false };
    std::uint64_t ends_before = 0;      ///< number of the last pull that ended before it
    std::atomic<bool> ending{ false };  ///< the node is
    std::atomic<bool> over{ false };
    std::thread thread;
  };

  void onGoal(GoalHandle handle);
  void onCancel(GoalHandle handle);
  void start(GoalHandle handle, std::unique_ptr<cloth::Simulation> copy, std::uint64_t pull);
  void predict(Prediction& prediction, cloth::Simulation& copy, std::uint64_t pull) const;
  bool finished(Prediction& prediction, const cloth::Simulation& copy, std::uint64_t pull) const;
  void forgetOld();

  NodeContext context_;
  std::mutex mutex_;  // guards what follows
  std::vector<std::unique_ptr<Prediction>> predictions_;
  bool stopping_ = false;

  PullActionServer server_;  ///< last: it calls onGoal()
};

}  // namespace cloth_tearing
