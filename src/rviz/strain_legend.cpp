// A line in rviz's Displays panel that shows which colour stands for which strain.
#include "cloth_tearing/rviz/strain_legend.h"

#include <QPainter>
#include <QStyleOptionViewItem>

#include "cloth_tearing/rviz/cloth_texture.h"

namespace cloth_tearing
{

namespace
{

constexpr int MARGIN = 3;  // [pixels]

QString percent(float strain)
{
  return QString::number(100.0 * static_cast<double>(strain), 'g', 3) + " %";
}

}  // namespace

StrainLegend::StrainLegend(rviz::Property* parent)
    : rviz::Property("Legend", QVariant(), "The colours of strain, from the lowest to the highest.",
                     parent)
{
  setReadOnly(true);
  setShouldBeSaved(false);
}

void StrainLegend::setRange(const std::array<float, 2>& range)
{
  range_ = range;
  setValue(percent(range[0]) + " to " + percent(range[1]));  // has the line painted again
}

bool StrainLegend::paint(QPainter* painter, const QStyleOptionViewItem& option) const
{
  const QRect bar = option.rect.adjusted(0, 1, -MARGIN, -1);
  const QRect words = bar.adjusted(MARGIN, 0, -MARGIN, 0);
  painter->save();
  painter->drawImage(bar, strainImage());
  painter->setPen(Qt::white);
  painter->drawText(words, Qt::AlignLeft | Qt::AlignVCenter, percent(range_[0]));
  painter->drawText(words, Qt::AlignRight | Qt::AlignVCenter, percent(range_[1]));
  painter->setPen(Qt::black);
  painter->drawText(words, Qt::AlignCenter, percent(0.5F * (range_[0] + range_[1])));
  painter->restore();
  return true;
}

}  // namespace cloth_tearing
