// A slider beside its value in digits.
#include "cloth_tearing/rviz/value_slider.h"

#include <QDoubleSpinBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QSlider>

namespace cloth_tearing
{

namespace
{

constexpr int DECIMALS = 3;
constexpr int PAGES = 10;          // of the slider
constexpr double WIDEST = 1000.0;  // that the digits have room for

}  // namespace

ValueSlider::ValueSlider(const SliderScale& scale, double least, double most)
    : scale_(scale), slider_(new QSlider(Qt::Horizontal)), digits_(new QDoubleSpinBox)
{
  slider_->setRange(0, SliderScale::STEPS);
  slider_->setPageStep(SliderScale::STEPS / PAGES);
  slider_->setMinimumWidth(60);
  digits_->setDecimals(DECIMALS);
  digits_->setRange(0.0, WIDEST);
  digits_->setFixedWidth(digits_->sizeHint().width());  // below each other, sliders are alike
  digits_->setRange(least, most);
  digits_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  digits_->setKeyboardTracking(false);  // half a number is none
  for (QWidget* part : { static_cast<QWidget*>(slider_), static_cast<QWidget*>(digits_) })
  {
    part->setFocusPolicy(Qt::StrongFocus);
    part->installEventFilter(this);
  }

  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(slider_, 1);
  row->addWidget(digits_);

  connect(slider_, &QSlider::valueChanged, this,
          [this](int position)
          {
            const QSignalBlocker quiet(digits_);
            digits_->setValue(scale_.value(position));
            Q_EMIT wanted(digits_->value());
          });
  connect(digits_, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          [this](double value)
          {
            const QSignalBlocker quiet(slider_);
            slider_->setValue(scale_.position(value));
            Q_EMIT wanted(value);
          });
}

void ValueSlider::setName(const QString& name)
{
  slider_->setObjectName(name + "_slider");
  digits_->setObjectName(name + "_value");
}

void ValueSlider::setValue(double value)
{
  const QSignalBlocker quiet_slider(slider_);
  const QSignalBlocker quiet_digits(digits_);
  slider_->setValue(scale_.position(value));
  digits_->setValue(value);
}

double ValueSlider::value() const
{
  return digits_->value();
}

QWidget* ValueSlider::digits() const
{
  return digits_;
}

bool ValueSlider::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() == QEvent::Wheel && !static_cast<QWidget*>(watched)->hasFocus())
  {
    event->ignore();
    return true;
  }
  return QWidget::eventFilter(watched, event);
}

}  // namespace cloth_tearing
