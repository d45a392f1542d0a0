// Shows a node's status as a table.
#include "cloth_tearing/rviz/status_view.h"

#include <QGridLayout>
#include <QLabel>
#include <QProgressBar>
#include <algorithm>
#include <cmath>

namespace cloth_tearing
{

namespace
{

constexpr double HIGH_FROM = 0.7;
constexpr double TEARING_FROM = 0.95;
constexpr int FULL_BAR = 1000;

const char* const NONE = "\u2013";

QString colorOf(Strain strain)
{
  return strain == Strain::LOW ? "#7cc48a" : strain == Strain::HIGH ? "#f0b040" : "#ee6a5a";
}

QString chunkOf(Strain strain)
{
  return "QProgressBar { border: 1px solid #a0a4aa; border-radius: 3px; text-align: center; }"
         "QProgressBar::chunk { border-radius: 2px; background: " +
         colorOf(strain) + "; }";
}

QString seconds(double time)
{
  const int decimals = time < 1e3 ? 2 : time < 1e5 ? 1 : 0;  // the column is narrow
  return QString::number(time, 'f', decimals) + " s";
}

}  // namespace

Strain strainAt(double utilisation)
{
  return utilisation < HIGH_FROM      ? Strain::LOW
         : utilisation < TEARING_FROM ? Strain::HIGH
                                      : Strain::TEARING;
}

StatusView::StatusView() : table_(new QGridLayout(this)), utilisation_(new QProgressBar)
{
  table_->setContentsMargins(0, 0, 0, 0);
  table_->setVerticalSpacing(2);
  table_->setHorizontalSpacing(5);
  table_->setColumnStretch(1, 1);
  table_->setColumnStretch(3, 1);
  time_ = add("Time", "time", "Simulation time; rises for the node's life.");
  step_ = add("Step", "step", "Steps since the epoch began.");
  reached_ = add("Reached", "reached",
                 "Simulated over real time, over about the last second; none while it is paused or "
                 "has just been told another speed.");
  epoch_ = add("Epoch", "epoch", "Rises with each reset and restored state.");
  basic_ = add("Basic tears", "basic_tears", "Springs of sound cloth that were split.");
  weak_point_ =
      add("Weak point", "weak_point_tears", "Tears that ran on from where one had ended.");
  one_point_ = add("One-point", "one_point_tears", "Connections by a single particle that tore.");
  released_ = add("Released", "released_springs", "Springs that could be split no further.");
  pieces_ = add("Pieces", "pieces", "Of cloth that hang together, those at rest included.");
  at_rest_ = add("At rest", "pieces_at_rest", "Pieces that left the bounds and stand still.");
  grasps_ = add("Grasps", "grasps", "Grippers that hold the cloth.");
  spheres_ = add("Spheres", "spheres", "Streamed and thrown.");
  max_strain_ = add("Max. strain", "max_strain", "Largest strain of a spring that carries load.");
  refusals_ = add("Refusals", "refusals", "Requests refused since the node started.");

  const QString meaning =
      "The strain that tearing reads over its threshold, at the worst place: 1 = it tears.";
  auto* name = new QLabel("Utilisation");
  name->setToolTip(meaning);
  table_->addWidget(name, cells_ / 2, 0);
  utilisation_->setObjectName("utilisation");
  utilisation_->setToolTip(meaning);
  utilisation_->setRange(0, FULL_BAR);
  utilisation_->setFormat("");
  utilisation_->setFixedHeight(name->sizeHint().height() + 2);
  utilisation_->setStyleSheet(chunkOf(strain_));
  table_->addWidget(utilisation_, cells_ / 2, 1, 1, 3);
}

QLabel* StatusView::add(const QString& name, const QString& object_name, const QString& meaning)
{
  auto* label = new QLabel(name);
  auto* value = new QLabel(NONE);
  label->setToolTip(meaning);
  value->setToolTip(meaning);
  value->setObjectName(object_name);
  value->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  const int column = cells_ % 2 * 2;
  table_->addWidget(label, cells_ / 2, column);
  table_->addWidget(value, cells_ / 2, column + 1);
  ++cells_;
  return value;
}

void StatusView::setStatus(const SimulationStatus& status)
{
  time_->setText(seconds(status.time));
  step_->setText(QString::number(status.step));
  reached_->setText(status.paused || status.real_time_factor == 0.0
                        ? QString(NONE)
                        : QString::number(status.real_time_factor, 'g', 3) + " x");
  epoch_->setText(QString::number(status.epoch));
  basic_->setText(QString::number(status.basic_tears));
  weak_point_->setText(QString::number(status.weak_point_tears));
  one_point_->setText(QString::number(status.one_point_tears));
  released_->setText(QString::number(status.released_springs));
  pieces_->setText(QString::number(status.pieces));
  at_rest_->setText(QString::number(status.pieces_at_rest));
  grasps_->setText(QString::number(status.grasps));
  spheres_->setText(QString::number(status.spheres));
  max_strain_->setText(QString::number(status.max_strain, 'f', 3));
  refusals_->setText(QString::number(status.refusals));
  showUtilisation(status.utilisation);
}

void StatusView::showUtilisation(double utilisation)
{
  const double shown = std::isfinite(utilisation) ? std::clamp(utilisation, 0.0, 1.0) : 1.0;
  utilisation_->setValue(static_cast<int>(std::lround(FULL_BAR * shown)));
  utilisation_->setFormat(QString::number(utilisation, 'f', 2));
  if (strainAt(utilisation) != strain_)
  {
    strain_ = strainAt(utilisation);
    utilisation_->setStyleSheet(chunkOf(strain_));
  }
}

}  // namespace cloth_tearing
