// The rviz panel that runs, watches and tunes a cloth's node.
#include "cloth_tearing/rviz/control_panel.h"

#include <cloth_tearing/SolverConfig.h>
#include <cloth_tearing/Step.h>
#include <cloth_tearing/TearingConfig.h>
#include <dynamic_reconfigure/config_tools.h>
#include <ros/names.h>
#include <std_srvs/Trigger.h>

#include <QCheckBox>
#include <QComboBox>
#include <QFrame>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QSpinBox>
#include <QStyle>
#include <QVBoxLayout>
#include <chrono>
#include <pluginlib/class_list_macros.hpp>

#include "cloth_tearing/rviz/status_view.h"
#include "cloth_tearing/rviz/value_slider.h"

namespace cloth_tearing
{

using dynamic_reconfigure::Config;
using dynamic_reconfigure::ConfigTools;

namespace
{

const char* const DEFAULT_NODE = "/cloth";
const char* const PROBLEM_STYLE = "color: #b00020;";
constexpr int MOST_STEPS = 1000000;
constexpr int ANSWER_LINES = 3;
constexpr std::chrono::seconds ANSWER_STAYS{ 10 };
constexpr int LONGEST_NAME = 64;  // of a state, as the node takes it
constexpr int LONGEST_PART = 16;  // of a word that may not be wrapped
constexpr double SLOWEST = 0.01;  // of the slider; the digits go further
constexpr double FASTEST = 10.0;
constexpr double LEAST_STRAIN = 0.01;
constexpr double MOST_STRAIN = 2.0;

void showValue(const Config& values, const std::string& name, ValueSlider& slider)
{
  double value = 0.0;
  if (ConfigTools::getParameter(values, name, value))
  {
    slider.setValue(value);
  }
}

QLabel* labelFor(QWidget* widget, const QString& text, const QString& meaning)
{
  auto* label = new QLabel(text);
  label->setBuddy(widget);
  label->setToolTip(meaning);
  return label;
}

/// May be wrapped within paths and long names too.
QString breakable(const QString& text)
{
  QString pieces;
  int part = 0;
  for (const QChar c : text)
  {
    pieces += c;
    part = c.isSpace() ? 0 : part + 1;
    if (part >= LONGEST_PART || QString("_/.-").contains(c))
    {
      pieces += QChar(0x200B);  // a space without width
      part = 0;
    }
  }
  return pieces;
}

/// As wide as there is room, whatever it says.
QLabel* makeText(const QString& name)
{
  auto* text = new QLabel;
  text->setObjectName(name);
  text->setWordWrap(true);
  QSizePolicy policy = text->sizePolicy();
  policy.setHorizontalPolicy(QSizePolicy::Ignored);
  text->setSizePolicy(policy);
  text->setTextFormat(Qt::PlainText);
  text->setTextInteractionFlags(Qt::TextSelectableByMouse);
  return text;
}

QFrame* makeLine()
{
  auto* line = new QFrame;
  line->setFrameStyle(static_cast<int>(QFrame::HLine) | static_cast<int>(QFrame::Sunken));
  return line;
}

/// In a word.
QString stateOf(const SimulationStatus& status)
{
  if (!status.fault.empty())
  {
    return "fault";
  }
  if (status.paused)
  {
    return "paused";
  }
  return status.pace == "step" ? "steps when told" : "running";
}

}  // namespace

// -- the widgets ---------------------------------------------------------------------------------

ControlPanel::ControlPanel(QWidget* parent) : rviz::Panel(parent)
{
  auto* content = new QWidget;
  auto* rows = new QVBoxLayout(content);
  rows->setContentsMargins(4, 4, 4, 4);
  rows->addLayout(makeNodeRow());
  rows->addWidget(makeControls());
  fault_ = makeText("fault");
  fault_->setStyleSheet(PROBLEM_STYLE);
  fault_->hide();
  rows->addWidget(fault_);
  answer_ = makeText("answer");
  answer_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  answer_->setMinimumHeight(ANSWER_LINES * answer_->fontMetrics().lineSpacing());
  rows->addWidget(answer_, 1);
  answer_ends_.setSingleShot(true);
  connect(&answer_ends_, &QTimer::timeout, this, [this] { say(""); });

  auto* area = new QScrollArea;  // a small window stays possible
  area->setFrameShape(QFrame::NoFrame);
  area->setWidgetResizable(true);
  area->setWidget(content);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->addWidget(area);

  connect(&watch_, &NodeWatch::nodesCame, this, &ControlPanel::onNodes);
  connect(&watch_, &NodeWatch::statusCame, this, &ControlPanel::onStatus);
  connect(&watch_, &NodeWatch::valuesCame, this, &ControlPanel::onValues);
  connect(&watch_, &NodeWatch::fellSilent, this, &ControlPanel::onSilence);
}

QLayout* ControlPanel::makeNodeRow()
{
  nodes_ = new QComboBox;
  nodes_->setObjectName("node");
  nodes_->setEditable(true);
  nodes_->setInsertPolicy(QComboBox::NoInsert);
  nodes_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  nodes_->setMinimumContentsLength(8);
  nodes_->setToolTip("The node of the cloth; the list holds those that are running.");
  state_ = new QLabel;
  state_->setObjectName("state");
  connect(nodes_, qOverload<int>(&QComboBox::activated), this,
          [this] { choose(nodes_->currentText()); });
  connect(nodes_->lineEdit(), &QLineEdit::editingFinished, this,
          [this] { choose(nodes_->currentText()); });

  auto* row = new QHBoxLayout;
  row->addWidget(labelFor(nodes_, "&Node", nodes_->toolTip()));
  row->addWidget(nodes_, 1);
  row->addWidget(state_);
  return row;
}

QWidget* ControlPanel::makeControls()
{
  controls_ = new QWidget;
  auto* rows = new QVBoxLayout(controls_);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->addLayout(makeButtons());
  rows->addWidget(makeLine());
  status_ = new StatusView;
  rows->addWidget(status_);
  rows->addWidget(makeLine());
  rows->addLayout(makeSliders());
  rows->addWidget(makeLine());
  rows->addLayout(makeStates());
  controls_->setEnabled(false);
  return controls_;
}

QPushButton* ControlPanel::makeButton(const QString& text, const QString& name,
                                      const QString& meaning)
{
  auto* button = new QPushButton(text);
  button->setObjectName(name);
  button->setToolTip(meaning);
  button->setMinimumWidth(40);
  return button;
}

QLayout* ControlPanel::makeButtons()
{
  pause_ = makeButton("Pa&use", "pause", "Stops the simulation, and lets it go on.");
  step_ = makeButton("S&tep", "step", "Does so many steps, while it is paused.");
  QPushButton* reset = makeButton("&Reset", "reset", "The cloth as it was at the start.");
  steps_ = new QSpinBox;
  steps_->setObjectName("steps");
  steps_->setRange(1, MOST_STEPS);
  steps_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  steps_->setToolTip("So many steps at a time.");
  connect(pause_, &QPushButton::clicked, this, &ControlPanel::onPause);
  connect(step_, &QPushButton::clicked, this, &ControlPanel::onStep);
  connect(reset, &QPushButton::clicked, this, &ControlPanel::onReset);
  connect(steps_, qOverload<int>(&QSpinBox::valueChanged), this, &ControlPanel::configChanged);

  auto* row = new QHBoxLayout;
  row->addWidget(pause_, 2);
  row->addWidget(step_, 1);
  row->addWidget(steps_, 1);
  row->addWidget(reset, 1);
  return row;
}

ValueSlider* ControlPanel::makeSlider(const QString& name, double low, double high, double least,
                                      double most)
{
  auto* slider = new ValueSlider(SliderScale(low, high), least, most);
  slider->setName(name);
  return slider;
}

QLayout* ControlPanel::makeSliders()
{
  const SolverConfig& least = SolverConfig::__getMin__();
  const SolverConfig& most = SolverConfig::__getMax__();
  speed_ = makeSlider("speed", SLOWEST, FASTEST, least.speed, most.speed);
  speed_->setToolTip("So many simulated seconds in a second, with pace wall.");
  const TearingConfig& low = TearingConfig::__getMin__();
  const TearingConfig& high = TearingConfig::__getMax__();
  tear_strain_ =
      makeSlider("tear_strain", LEAST_STRAIN, MOST_STRAIN, low.tear_strain, high.tear_strain);
  tear_strain_->setToolTip(
      "Sound cloth tears above this strain. Never below the weak strain, which it takes along.");
  weak_strain_ = makeSlider("weak_strain", LEAST_STRAIN, MOST_STRAIN, low.weak_tear_strain,
                            high.weak_tear_strain);
  weak_strain_->setToolTip(
      "A tear runs on above this strain. Never above the tear strain, which it takes along.");
  connect(speed_, &ValueSlider::wanted, this,
          [this](double value) {
            speed_sender_.want({ { "speed", value } });
          });
  connect(tear_strain_, &ValueSlider::wanted, this, &ControlPanel::onTearStrain);
  connect(weak_strain_, &ValueSlider::wanted, this, &ControlPanel::onWeakStrain);
  const auto settle = [this](TuningSender& sender, void (ControlPanel::*show)(const Config&))
  {
    connect(&sender, &TuningSender::failed, this, &ControlPanel::complain);
    connect(&sender, &TuningSender::settled, this,
            [this, show](const Config& values, bool refused)
            {
              (this->*show)(values);
              if (!refused)
              {
                say("");
              }
              else if (!complaining_)  // else the reason has come already
              {
                complain("refused");
              }
            });
  };
  settle(speed_sender_, &ControlPanel::showSpeed);
  settle(strain_sender_, &ControlPanel::showStrains);

  auto* table = new QGridLayout;
  int row = 0;
  for (const auto& [text, slider] :
       { std::pair("Spee&d", speed_), std::pair("Tear str&ain", tear_strain_),
         std::pair("&Weak strain", weak_strain_) })
  {
    table->addWidget(labelFor(slider->digits(), text, slider->toolTip()), row, 0);
    table->addWidget(slider, row++, 1);
  }
  table->setColumnStretch(1, 1);
  return table;
}

QLayout* ControlPanel::makeStates()
{
  state_name_ = new QLineEdit("state");
  state_name_->setObjectName("state_name");
  state_name_->setMaxLength(LONGEST_NAME);
  state_name_->setToolTip("Letters, digits, '_', '-' and '.'");
  in_file_ = new QCheckBox("in a fil&e");
  in_file_->setObjectName("in_file");
  in_file_->setToolTip(
      "In a file of the node's state_folder, which outlives the node, instead of in memory.");
  QPushButton* save = makeButton("&Save", "save", "Keeps the cloth as it is under this name.");
  QPushButton* restore =
      makeButton("Rest&ore", "restore", "Goes back to the cloth that was saved under this name.");
  connect(save, &QPushButton::clicked, this, [this] { onState("save_state", "saved"); });
  connect(restore, &QPushButton::clicked, this, [this] { onState("restore_state", "restored"); });
  connect(state_name_, &QLineEdit::textEdited, this, &ControlPanel::configChanged);
  connect(in_file_, &QCheckBox::toggled, this, &ControlPanel::configChanged);

  auto* name = new QHBoxLayout;
  name->addWidget(labelFor(state_name_, "State na&me", state_name_->toolTip()));
  name->addWidget(state_name_, 1);
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(save, 1);
  buttons->addWidget(restore, 1);
  buttons->addWidget(in_file_);
  auto* rows = new QVBoxLayout;
  rows->addLayout(name);
  rows->addLayout(buttons);
  return rows;
}

void ControlPanel::onInitialize()
{
  choose(DEFAULT_NODE);
}

void ControlPanel::load(const rviz::Config& config)
{
  rviz::Panel::load(config);
  QString text;
  int steps = 0;
  bool in_file = false;
  if (config.mapGetString("State Name", &text))
  {
    state_name_->setText(text);
  }
  if (config.mapGetBool("In a File", &in_file))
  {
    in_file_->setChecked(in_file);
  }
  if (config.mapGetInt("Steps", &steps))
  {
    steps_->setValue(steps);
  }
  if (config.mapGetString("Node", &text))
  {
    choose(text);
  }
}

void ControlPanel::save(rviz::Config config) const
{
  rviz::Panel::save(config);
  config.mapSetValue("Node", QString::fromStdString(watch_.node()));
  config.mapSetValue("Steps", steps_->value());
  config.mapSetValue("State Name", state_name_->text());
  config.mapSetValue("In a File", in_file_->isChecked());
}

// -- the user ------------------------------------------------------------------------------------

void ControlPanel::choose(const QString& node)
{
  std::string name = watch_.node();
  try
  {
    const QString text = node.trimmed();
    name = text.isEmpty() || text == "/" ? name : ros::names::resolve(text.toStdString());
  }
  catch (const ros::InvalidNameException& error)
  {
    complain(error.what());
  }
  nodes_->setEditText(QString::fromStdString(name));
  if (name == watch_.node())
  {
    return;
  }
  caller_.cut();  // the node before may never answer
  stepper_.cut();
  asked_.clear();
  speed_sender_.setServer(name);
  strain_sender_.setServer(name + "/tearing");
  onSilence("waiting");
  say("");
  watch_.follow(name);
  Q_EMIT configChanged();
}

template <class Service, class Done>
void ControlPanel::ask(ServiceCaller& caller, const std::string& service,
                       const typename Service::Request& request, Done done)
{
  if (!asked_.insert(service).second)
  {
    return;
  }
  say(QString::fromStdString(service) + " ...");
  caller.call<Service>(watch_.node() + "/" + service, request,
                       [this, service, done](const auto& answer)
                       {
                         asked_.erase(service);
                         answer.done() ? say(done(answer.response))
                                       : complain(QString::fromStdString(answer.problem));
                       });
}

void ControlPanel::onPause()
{
  const bool pause = !paused_;
  ask<std_srvs::Trigger>(caller_, pause ? "pause" : "resume", {},
                         [pause](const auto&) { return pause ? "paused" : "resumed"; });
}

void ControlPanel::onStep()
{
  Step::Request request;
  request.steps = static_cast<std::uint32_t>(steps_->value());
  ask<Step>(stepper_, "step", request,
            [](const Step::Response& response)
            {
              return QString("%1 steps done, %2 tears: step %3")
                  .arg(response.steps_done)
                  .arg(response.tears)
                  .arg(response.step);
            });
}

void ControlPanel::onReset()
{
  ask<std_srvs::Trigger>(caller_, "reset", {}, [](const auto&) { return "reset"; });
}

void ControlPanel::onState(const std::string& service, const QString& done)
{
  NamedState::Request request;
  request.name = state_name_->text().toStdString();
  request.file = in_file_->isChecked();
  ask<NamedState>(caller_, service, request,
                  [done, name = state_name_->text()](const NamedState::Response& response)
                  { return QString("\"%1\" %2: step %3").arg(name, done).arg(response.step); });
}

/// Takes the weak strain along, which may not be above.
void ControlPanel::onTearStrain(double value)
{
  TuningSender::Values wanted = { { "tear_strain", value } };
  if (weak_strain_->value() > value)
  {
    weak_strain_->setValue(value);
    wanted["weak_tear_strain"] = value;
  }
  strain_sender_.want(wanted);
}

/// Takes the tear strain along, which may not be below.
void ControlPanel::onWeakStrain(double value)
{
  TuningSender::Values wanted = { { "weak_tear_strain", value } };
  if (tear_strain_->value() < value)
  {
    tear_strain_->setValue(value);
    wanted["tear_strain"] = value;
  }
  strain_sender_.want(wanted);
}

// -- the node ------------------------------------------------------------------------------------

void ControlPanel::onNodes(const QStringList& nodes)
{
  const QString text = nodes_->currentText();
  nodes_->clear();
  nodes_->addItems(nodes);
  nodes_->setEditText(text);
}

void ControlPanel::onStatus(const SimulationStatus& status)
{
  paused_ = status.paused;
  status_->setStatus(status);
  state_->setText(stateOf(status));
  state_->setStyleSheet(status.fault.empty() ? "" : PROBLEM_STYLE);
  fault_->setText(breakable(QString::fromStdString(status.fault)));
  fault_->setVisible(!status.fault.empty());
  pause_->setText(paused_ ? "Res&ume" : "Pa&use");
  pause_->setIcon(style()->standardIcon(paused_ ? QStyle::SP_MediaPlay : QStyle::SP_MediaPause));
  step_->setEnabled(paused_ || status.pace == "step");
  speed_->setEnabled(status.pace == "wall");
  controls_->setEnabled(true);
  if (complaining_ && epoch_ != status.epoch)
  {
    say("");  // it was of a cloth that is gone
  }
  epoch_ = status.epoch;
  if (refusals_ && status.refusals > *refusals_)
  {
    complain(QString::fromStdString(status.last_refusal));
  }
  refusals_ = status.refusals;
}

void ControlPanel::onValues(const QString& server, const Config& values)
{
  if (server.isEmpty() && !speed_sender_.isBusy())
  {
    showSpeed(values);
  }
  else if (server == "tearing" && !strain_sender_.isBusy())
  {
    showStrains(values);
  }
}

void ControlPanel::showSpeed(const Config& values)
{
  showValue(values, "speed", *speed_);
}

void ControlPanel::showStrains(const Config& values)
{
  showValue(values, "tear_strain", *tear_strain_);
  showValue(values, "weak_tear_strain", *weak_strain_);
}

void ControlPanel::onSilence(const QString& why)
{
  controls_->setEnabled(false);
  state_->setText(why);
  state_->setStyleSheet(PROBLEM_STYLE);
  fault_->hide();
  refusals_.reset();
}

void ControlPanel::say(const QString& text)
{
  answer(text, false);
}

void ControlPanel::complain(const QString& problem)
{
  answer(problem, true);
}

void ControlPanel::answer(const QString& text, bool problem)
{
  complaining_ = problem;
  answer_->setStyleSheet(problem ? PROBLEM_STYLE : "");
  answer_->setText(breakable(text));
  answer_ends_.start(ANSWER_STAYS);
}

}  // namespace cloth_tearing

PLUGINLIB_EXPORT_CLASS(cloth_tearing::ControlPanel, rviz::Panel)  // NOLINT(cert-err58-cpp)
