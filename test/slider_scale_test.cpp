// Claims of a slider's scale: from end to end, the same factor a step, numbers that people would
// write.
#include "cloth_tearing/rviz/slider_scale.h"

#include <gtest/gtest.h>

#include <iomanip>
#include <sstream>
#include <string>

using cloth_tearing::SliderScale;

TEST(SliderScale, GoesFromEndToEnd)
{
  const SliderScale scale(0.01, 10.0);
  EXPECT_EQ(scale.position(0.01), 0);
  EXPECT_EQ(scale.position(10.0), SliderScale::STEPS);
  EXPECT_EQ(scale.value(0), 0.01);
  EXPECT_EQ(scale.value(SliderScale::STEPS), 10.0);
}

TEST(SliderScale, StaysAtItsEndsWithValuesBeyond)
{
  const SliderScale scale(0.01, 10.0);
  EXPECT_EQ(scale.position(0.0), 0);
  EXPECT_EQ(scale.position(-1.0), 0);
  EXPECT_EQ(scale.position(1e6), SliderScale::STEPS);
}

TEST(SliderScale, IsTheSameFactorEverywhere)
{
  const SliderScale scale(0.01, 100.0);
  EXPECT_EQ(scale.position(0.1), SliderScale::STEPS / 4);
  EXPECT_EQ(scale.position(1.0), SliderScale::STEPS / 2);
  EXPECT_EQ(scale.value(SliderScale::STEPS / 2), 1.0);
}

TEST(SliderScale, FindsEveryPositionAgain)
{
  const SliderScale scale(0.01, 2.0);
  for (int position = 0; position <= SliderScale::STEPS; ++position)
  {
    EXPECT_EQ(scale.position(scale.value(position)), position);
  }
}

TEST(SliderScale, SaysThreeDigits)
{
  const SliderScale scale(0.01, 2.0);
  for (int position = 1; position < SliderScale::STEPS; ++position)
  {
    const double value = scale.value(position);
    std::ostringstream text;
    text << std::setprecision(3) << value;
    EXPECT_DOUBLE_EQ(std::stod(text.str()), value);
  }
}
