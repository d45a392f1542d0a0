// Claims of thesis 3.3, figure 3.22: torn cloth that is put back shows the texture it had.
#include "cloth_tearing/experiments/texture_experiment.h"

#include <gtest/gtest.h>

#include <map>

#include "scenes.h"

namespace cloth
{
namespace
{

/// A cloth, the same torn, and what it shows.
struct Torn
{
  Simulation hung;
  Simulation torn;
  std::vector<TexturedTriangle> untorn_triangles;
  std::vector<TexturedTriangle> put_back;

  explicit Torn(const Setting& setting) : hung(hungCloth(setting)), torn(hung)
  {
    tearBadly(torn);
    untorn_triangles = texturedTriangles(hung.cloth());
    put_back = putBack(torn.cloth(), hung.cloth());
  }
};

class TexturePutBack : public ::testing::TestWithParam<RectanglePattern>
{
protected:
  /// Torn once for all tests.
  static const Torn& torn()
  {
    static std::map<RectanglePattern, Torn> cloths;
    Setting setting;
    setting.pattern = GetParam();
    const auto known = cloths.find(GetParam());
    return known != cloths.end() ? known->second
                                 : cloths.emplace(GetParam(), Torn(setting)).first->second;
  }

  static TextureFit fitOf(const std::vector<TexturedTriangle>& triangles)
  {
    return compareTexture(torn().untorn_triangles, triangles);
  }
};

std::string patternName(const ::testing::TestParamInfo<RectanglePattern>& info)
{
  static const char* const NAMES[] = { "OneDiagonal", "Alternating", "Irregular" };
  return NAMES[static_cast<int>(info.param)];
}

INSTANTIATE_TEST_SUITE_P(Meshes, TexturePutBack,
                         ::testing::Values(RectanglePattern::ONE_DIAGONAL,
                                           RectanglePattern::ALTERNATING,
                                           RectanglePattern::IRREGULAR),
                         patternName);

TEST_P(TexturePutBack, FitsAtEveryPoint)
{
  ASSERT_GT(torn().torn.revision(), 50u);
  ASSERT_GT(torn().torn.summary().tears[static_cast<int>(TearKind::BASIC)], 5u)
      << "triangles are halved";
  ASSERT_GT(torn().torn.cloth().damage.pieces, 1) << "a piece is torn off";

  const TextureFit fit = fitOf(torn().put_back);

  EXPECT_EQ(fit.points, 10000);
  EXPECT_EQ(fit.uncovered, 0);
  EXPECT_EQ(fit.covered_twice, 0);
  EXPECT_LE(fit.deviation, 1e-6);
  EXPECT_NEAR(fit.area_after / fit.area_before, 1.0, 1e-12);
  EXPECT_TRUE(fit.fits());
}

TEST_P(TexturePutBack, DoesNotFitWithTwoCornersOfATriangleSwapped)
{
  const TextureFit fit = fitOf(withSwappedCorners(torn().put_back));

  EXPECT_GT(fit.deviation, 1e-3);
  EXPECT_FALSE(fit.fits());
}

TEST_P(TexturePutBack, DoesNotFitWithoutATriangleOrWithOneTwice)
{
  std::vector<TexturedTriangle> all = torn().put_back;
  all.push_back(all.front());
  EXPECT_GT(fitOf(all).covered_twice, 0);
  EXPECT_FALSE(fitOf(all).fits());

  all = torn().put_back;
  all.erase(all.begin());
  EXPECT_GT(fitOf(all).uncovered, 0);
  EXPECT_FALSE(fitOf(all).fits());
}

TEST_P(TexturePutBack, DoesNotFitWhileTheClothIsStillTorn)
{
  EXPECT_GT(fitOf(texturedTriangles(torn().torn.cloth())).uncovered, 9000);
}

TEST_P(TexturePutBack, ShowsTheClothAtHomeInTheEnd)
{
  int steps = 0;
  Simulation simulation = torn().torn;
  putBackSlowly(simulation, torn().hung.cloth(),
                [&](const Simulation&, const StepReport&) { ++steps; });

  EXPECT_EQ(steps, 2500);
  const std::vector<Vec3d> home = homes(simulation.cloth(), torn().hung.cloth());
  for (std::size_t i = 0; i < home.size(); ++i)
  {
    EXPECT_LT((simulation.cloth().state.position[i].cast<double>() - home[i]).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace cloth
