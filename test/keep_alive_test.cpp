// Claims of grasps that last as long as somebody speaks for them.
#include "cloth_tearing/node/keep_alive.h"

#include <gtest/gtest.h>

namespace cloth_tearing
{
namespace
{

KeepAlive::Time at(int milliseconds)
{
  return KeepAlive::Time() + std::chrono::hours(1) + std::chrono::milliseconds(milliseconds);
}

class AKeepAlive : public testing::Test
{
protected:
  AKeepAlive() { watched_.watch({ 7, 2, 0.3 }, at(0)); }

  /// The grasps that are silent then.
  std::vector<std::uint64_t> silent(int milliseconds)
  {
    std::vector<std::uint64_t> found;
    for (const KeepAlive::Watched& grasp : watched_.takeSilent(at(milliseconds)))
    {
      found.push_back(grasp.grasp);
    }
    return found;
  }

  KeepAlive watched_;
};

using Ids = std::vector<std::uint64_t>;

TEST_F(AKeepAlive, NamesASilentGraspOnceItsPatienceIsOverAndThenNeverAgain)
{
  EXPECT_FALSE(watched_.look(at(300)));
  EXPECT_EQ(silent(300), Ids());

  EXPECT_TRUE(watched_.look(at(301)));
  const std::vector<KeepAlive::Watched> found = watched_.takeSilent(at(301));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].grasp, 7u);
  EXPECT_EQ(found[0].epoch, 2u);
  EXPECT_EQ(found[0].patience, 0.3);
  EXPECT_TRUE(watched_.empty());
  EXPECT_FALSE(watched_.look(at(400)));
}

TEST_F(AKeepAlive, EverySignOfLifeBeginsThePatienceAnew)
{
  watched_.hear(7, at(200));
  watched_.hear(8, at(250));
  EXPECT_EQ(silent(500), Ids());
  EXPECT_EQ(silent(501), Ids{ 7 });
}

TEST_F(AKeepAlive, ALateSignOfLifeIsWorthNoLessThanOneBefore)
{
  watched_.hear(7, at(200));
  watched_.hear(7, at(100));
  EXPECT_EQ(silent(450), Ids());
}

TEST_F(AKeepAlive, EachGraspHasAPatienceOfItsOwn)
{
  watched_.watch({ 9, 2, 0.1 }, at(0));
  EXPECT_EQ(silent(150), Ids{ 9 });
  EXPECT_EQ(silent(350), Ids{ 7 });
}

TEST_F(AKeepAlive, ForgetsWhatWasReleased)
{
  watched_.watch({ 9, 2, 0.1 }, at(0));
  watched_.forget(7);
  EXPECT_EQ(silent(1000), Ids{ 9 });
  watched_.watch({ 7, 2, 0.3 }, at(1000));
  watched_.forgetAll();
  EXPECT_TRUE(watched_.empty());
}

TEST_F(AKeepAlive, BlamesNobodyForATimeInWhichNobodyListened)
{
  EXPECT_FALSE(watched_.look(at(60000)));
  EXPECT_EQ(silent(60300), Ids());
  EXPECT_TRUE(watched_.look(at(60301)));
}

TEST_F(AKeepAlive, ALookThatTookLongIsNoSuchTime)
{
  EXPECT_TRUE(watched_.look(at(350)));
  watched_.skip(at(1350));
  EXPECT_TRUE(watched_.look(at(1450)));
}

}  // namespace
}  // namespace cloth_tearing
