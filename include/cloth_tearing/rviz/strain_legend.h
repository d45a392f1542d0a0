// A line in rviz's Displays panel that shows which colour stands for which strain.
#pragma once

#include <rviz/properties/property.h>

#include <array>

namespace cloth_tearing
{

class StrainLegend : public rviz::Property
{
public:
  explicit StrainLegend(rviz::Property* parent);

  /// Strains at the left and the right end [-].
  void setRange(const std::array<float, 2>& range);

  bool paint(QPainter* painter, const QStyleOptionViewItem& option) const override;

private:
  std::array<float, 2> range_ = { { 0.0F, 1.0F } };
};

}  // namespace cloth_tearing
