// What a window hears of one node, and which nodes there are.
#pragma once

#ifndef Q_MOC_RUN
#include <cloth_tearing/SimulationStatus.h>
#include <dynamic_reconfigure/Config.h>
#include <ros/subscriber.h>

#include <QElapsedTimer>
#include <QObject>
#include <QStringList>
#include <QTimer>
#include <memory>
#include <string>
#include <vector>

#include "cloth_tearing/rviz/service_caller.h"
#endif

namespace cloth_tearing
{

/// Never waits for the master. Needs ROS' global callback queue to be called by its own thread, as
/// rviz does.
class NodeWatch : public QObject
{
  Q_OBJECT

public:
  NodeWatch();
  ~NodeWatch() override;

  /// Hears this node from now on, and no other.
  void follow(const std::string& node);

  const std::string& node() const { return node_; }

Q_SIGNALS:
  void statusCame(const cloth_tearing::SimulationStatus& status);

  /// Values of a dynamic_reconfigure server: "tearing", or "" for that of the node itself.
  void valuesCame(const QString& server, const dynamic_reconfigure::Config& values);

  /// There was no status for a while. Comes again when the reason is another.
  /// @param why in a word or two
  void fellSilent(const QString& why);

  /// All nodes that publish a status.
  void nodesCame(const QStringList& nodes);

private:
  class Ears;

  /// What the master said.
  struct Seen
  {
    bool master = false;
    QStringList nodes;
  };

  void look();
  void onLook(const Seen& seen);
  void onStatus(const SimulationStatus& status);
  void onTimer();
  QString silence() const;

  std::string node_;
  Seen seen_;
  bool looking_ = false;
  QString silence_;      ///< as it was told; empty = there is none
  QElapsedTimer heard_;  ///< since the last status, or the beginning
  QElapsedTimer looked_;
  QTimer timer_;
  std::shared_ptr<Ears> ears_;  ///< of the thread of `master_`
  ServiceCaller master_;
};

}  // namespace cloth_tearing
