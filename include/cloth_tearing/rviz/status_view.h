// Shows a node's status as a table.
#pragma once

#ifndef Q_MOC_RUN
#include <cloth_tearing/SimulationStatus.h>

#include <QWidget>
#include <vector>
#endif

class QGridLayout;
class QLabel;
class QProgressBar;

namespace cloth_tearing
{

/// How near the next tear is.
enum class Strain
{
  LOW,
  HIGH,    ///< from 0.7 of the threshold
  TEARING  ///< from 0.95
};

Strain strainAt(double utilisation);

class StatusView : public QWidget
{
  Q_OBJECT

public:
  StatusView();

  void setStatus(const SimulationStatus& status);

private:
  /// A value with its name on the left; two of them stand in a row.
  QLabel* add(const QString& name, const QString& object_name, const QString& meaning);

  void showUtilisation(double utilisation);

  QGridLayout* table_;
  int cells_ = 0;
  QLabel* time_;
  QLabel* step_;
  QLabel* reached_;
  QLabel* epoch_;
  QLabel* basic_;
  QLabel* weak_point_;
  QLabel* one_point_;
  QLabel* released_;
  QLabel* pieces_;
  QLabel* at_rest_;
  QLabel* grasps_;
  QLabel* spheres_;
  QLabel* max_strain_;
  QLabel* refusals_;
  QProgressBar* utilisation_;
  Strain strain_ = Strain::LOW;
};

}  // namespace cloth_tearing
