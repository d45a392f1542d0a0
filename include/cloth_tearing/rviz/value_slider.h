// A slider beside its value in digits.
#pragma once

#include <QWidget>

#include "cloth_tearing/rviz/slider_scale.h"

class QDoubleSpinBox;
class QEvent;
class QSlider;

namespace cloth_tearing
{

/// Tells of values that the user wants, not of those that it is made to show. The digits may go
/// beyond the slider's ends.
class ValueSlider : public QWidget
{
  Q_OBJECT

public:
  /// @param least,most that the digits take
  ValueSlider(const SliderScale& scale, double least, double most);

  /// For tests and keyboards, which find them by name: "<name>_slider" and "<name>_value".
  void setName(const QString& name);

  void setValue(double value);
  double value() const;

  /// Where the keyboard's focus goes.
  QWidget* digits() const;

Q_SIGNALS:
  void wanted(double value);

protected:
  /// Keeps the wheel, which scrolls the panel, from changing what has no focus.
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  SliderScale scale_;
  QSlider* slider_;
  QDoubleSpinBox* digits_;
};

}  // namespace cloth_tearing
