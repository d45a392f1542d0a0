// Sends what a user wants of a dynamic_reconfigure server while a slider is being dragged.
#pragma once

#ifndef Q_MOC_RUN
#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>

#include <QObject>
#include <QTimer>
#include <map>
#include <string>

#include "cloth_tearing/rviz/service_caller.h"
#endif

namespace cloth_tearing
{

/// Not more often than ten times a second, one after the other, and the last values always.
class TuningSender : public QObject
{
  Q_OBJECT

public:
  using Values = std::map<std::string, double>;  ///< by name

  /// @param caller outlives this
  explicit TuningSender(ServiceCaller& caller);

  /// Takes another server, such as /cloth/tearing, and forgets what is under way to the one before.
  void setServer(const std::string& name);

  /// What is wanted at once is granted or refused together.
  void want(const Values& values);

  /// Whether something is under way: what the server said meanwhile is old.
  bool isBusy() const { return calling_ || !wanted_.empty(); }

Q_SIGNALS:
  /// Nothing is under way any more, and these are the values.
  /// @param refused it has other ones than were wanted last
  void settled(const dynamic_reconfigure::Config& values, bool refused);

  void failed(const QString& problem);

private:
  void send();
  void onAnswer(const Values& sent,
                const ServiceCaller::Answer<dynamic_reconfigure::ReconfigureResponse>& answer);

  ServiceCaller& caller_;
  std::string server_;
  Values wanted_;  ///< not sent yet
  bool calling_ = false;
  QTimer pause_;  ///< runs as long as nothing may be sent
};

}  // namespace cloth_tearing
