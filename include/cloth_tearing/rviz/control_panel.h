// The rviz panel that runs, watches and tunes a cloth's node.
#pragma once

#ifndef Q_MOC_RUN
#include <cloth_tearing/NamedState.h>
#include <cloth_tearing/SimulationStatus.h>
#include <dynamic_reconfigure/Config.h>
#include <rviz/panel.h>

#include <QTimer>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "cloth_tearing/rviz/node_watch.h"
#include "cloth_tearing/rviz/service_caller.h"
#include "cloth_tearing/rviz/tuning_sender.h"
#endif

class QCheckBox;
class QComboBox;
class QLabel;
class QLayout;
class QLineEdit;
class QPushButton;
class QSpinBox;

namespace cloth_tearing
{

class StatusView;
class ValueSlider;

/// Buttons ask the node's services, sliders its dynamic_reconfigure; what is shown is what the node
/// says. Waits for nobody. Without news from the node all but the choice of a node is disabled.
class ControlPanel : public rviz::Panel
{
  Q_OBJECT

public:
  explicit ControlPanel(QWidget* parent = nullptr);

  void onInitialize() override;
  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

private:
  QWidget* makeControls();
  QLayout* makeNodeRow();
  QLayout* makeButtons();
  QLayout* makeSliders();
  QLayout* makeStates();
  QPushButton* makeButton(const QString& text, const QString& name, const QString& meaning);
  ValueSlider* makeSlider(const QString& name, double low, double high, double least, double most);

  // the user
  void choose(const QString& node);
  void onPause();
  void onStep();
  void onReset();
  void onState(const std::string& service, const QString& done);
  void onTearStrain(double value);
  void onWeakStrain(double value);

  // the node
  void onNodes(const QStringList& nodes);
  void onStatus(const SimulationStatus& status);
  void onValues(const QString& server, const dynamic_reconfigure::Config& values);
  void onSilence(const QString& why);
  void showSpeed(const dynamic_reconfigure::Config& values);
  void showStrains(const dynamic_reconfigure::Config& values);

  /// Calls the node's `service` unless the same call is under way; says what came of it.
  /// @param done makes the text of a call that was done from its response
  template <class Service, class Done>
  void ask(ServiceCaller& caller, const std::string& service,
           const typename Service::Request& request, Done done);

  void say(const QString& text);
  void complain(const QString& problem);

  /// Of the last request; gone after a while.
  void answer(const QString& text, bool problem);

  NodeWatch watch_;
  ServiceCaller caller_;
  ServiceCaller stepper_;  ///< ~step may take long, and the others must get through
  TuningSender speed_sender_{ caller_ };
  TuningSender strain_sender_{ caller_ };
  std::set<std::string> asked_;  ///< services whose answers are awaited
  bool paused_ = false;
  std::optional<std::uint64_t> refusals_;  ///< the node's, as last told
  std::uint64_t epoch_ = 0;                ///< likewise
  bool complaining_ = false;               ///< the answer that is shown tells a problem
  QTimer answer_ends_;

  QComboBox* nodes_;
  QLabel* state_;
  QLabel* fault_;
  QWidget* controls_;
  QPushButton* pause_;
  QPushButton* step_;
  QSpinBox* steps_;
  ValueSlider* speed_;
  StatusView* status_;
  ValueSlider* tear_strain_;
  ValueSlider* weak_strain_;
  QLineEdit* state_name_;
  QCheckBox* in_file_;
  QLabel* answer_;
};

}  // namespace cloth_tearing
