// The running node refuses bad input in words that name field, value and limit, and its cloth stays
// as it is: the tables' machinery, and their count.
#include <cloth_tearing/Grasp.h>
#include <cloth_tearing/Release.h>
#include <cloth_tearing/Step.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "bad_inputs.h"

namespace
{

/// The suite has more: it must not shrink unseen.
constexpr std::size_t LEAST_INPUTS = 2600;

/// A refusal that is not told within this has not happened [s].
constexpr double SOON = 5.0;

std::size_t tried = 0;  // NOLINT: counts over all tables

constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
constexpr double INFINITE = std::numeric_limits<double>::infinity();
constexpr double DENORMAL = std::numeric_limits<double>::denorm_min();

bool holds(const cloth::Range& range, double value)
{
  return (range.above_low ? value > range.low : value >= range.low) && value <= range.high;
}

/// " is VALUE, must be ...": what the range's own sentence says after the field.
std::string sentence(double value, const cloth::Range& range)
{
  std::vector<std::string> found;
  cloth::check(found, "", value, range);
  EXPECT_EQ(found.size(), 1u) << value;
  return found.empty() ? "" : found.front();
}

std::uint64_t hashNow()
{
  return ask<cloth_tearing::Step>("/cloth/step").state_hash;
}

void expectWords(const BadInput& input)
{
  ++tried;
  const std::string reason = input.send();
  EXPECT_NE(reason, "") << input.name << " was not refused";
  for (const std::string& word : input.words)
  {
    EXPECT_TRUE(reason.empty() || reason.find(word) != std::string::npos)
        << input.name << " was refused without \"" << word << "\": " << reason;
  }
}

geometry_msgs::TransformStamped frame(const std::string& name, const std::string& parent, double x,
                                      double w)
{
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = parent;
  transform.header.stamp = ros::Time::now();
  transform.child_frame_id = name;
  transform.transform.translation.x = x;
  transform.transform.rotation.w = w;
  return transform;
}

/// The frames of badFrames() that are told to tf, and good ones: "hand", "moving" and "old" of some
/// time ago; "mad" is infinitely far away, "far" out of the cloth's world.
class TellFrames : public testing::Environment
{
public:
  void SetUp() override
  {
    still_ = std::make_unique<tf2_ros::StaticTransformBroadcaster>();
    moving_ = std::make_unique<tf2_ros::TransformBroadcaster>();
    still_->sendTransform({ frame("not_a_number", "world", NOT_A_NUMBER, 1.0),
                            frame("not_a_rotation", "world", 0.0, 2.0),
                            frame("mad", "world", INFINITE, 1.0), frame("far", "world", 1e6, 1.0),
                            frame("snake", "tail", 0.0, 1.0), frame("tail", "snake", 0.0, 1.0),
                            frame("hand", "world", 0.0, 1.0) });
    const auto known = [this](const std::string& name)
    {
      moving_->sendTransform(frame("moving", "world", 0.0, 1.0));
      geometry_msgs::TransformStamped old = frame("old", "world", 0.0, 1.0);
      old.header.stamp -= ros::Duration(5.0);
      moving_->sendTransform(old);
      cloth_tearing::Grasp::Request request;
      request.header.frame_id = name;
      request.point.x = 5.0;  // in empty space
      return refusalOf<cloth_tearing::Grasp>("grasp", request).find("no particle") !=
             std::string::npos;
    };
    for (const char* name : { "hand", "moving", "old" })
    {
      ASSERT_TRUE(isSoon([&] { return known(name); })) << name;
    }
  }
  void TearDown() override
  {
    moving_.reset();
    still_.reset();
  }

private:
  std::unique_ptr<tf2_ros::StaticTransformBroadcaster> still_;
  std::unique_ptr<tf2_ros::TransformBroadcaster> moving_;
};

class Count : public testing::Environment
{
public:
  void TearDown() override
  {
    testing::Test::RecordProperty("bad_inputs", static_cast<int>(tried));
    std::cout << tried << " bad inputs" << std::endl;
    const bool all = testing::GTEST_FLAG(filter) == "*";
    EXPECT_TRUE(!all || tried >= LEAST_INPUTS) << "only " << tried << " bad inputs were tried";
  }
};

}  // namespace

void expectRefused(const BadInputs& inputs)
{
  const std::uint64_t before = hashNow();
  for (const BadInput& input : inputs)
  {
    expectWords(input);
    ASSERT_EQ(hashNow(), before) << input.name << " has changed the cloth";
  }
}

void expectRefusedInWords(const BadInputs& inputs)
{
  for (const BadInput& input : inputs)
  {
    expectWords(input);
  }
}

std::vector<BadNumber> badNumbers(const cloth::Range& range)
{
  std::vector<BadNumber> bad;
  for (const double value : { NOT_A_NUMBER, -NOT_A_NUMBER, INFINITE, -INFINITE })
  {
    bad.push_back({ value, { " is " + cloth::text(value) + ", must be" } });
  }
  for (const double value :
       { 1e308, -1e308, -1.0, 0.0, -0.0, DENORMAL, -DENORMAL, std::nextafter(range.low, -INFINITE),
         std::nextafter(range.high, INFINITE) })
  {
    if (std::isfinite(value) && !holds(range, value))
    {
      bad.push_back({ value, { sentence(value, range) } });
    }
  }
  return bad;
}

std::vector<BadNumber> badWholeNumbers(const cloth::Range& range)
{
  std::vector<BadNumber> bad;
  const double most = std::numeric_limits<int>::max();
  for (const double value : { range.low - 1.0, range.high + 1.0, -1.0, -most - 1.0, most })
  {
    if (!holds(range, value) && value <= most)
    {
      bad.push_back({ value, { " is ", "must be at least " + cloth::text(range.low) } });
    }
  }
  return bad;
}

std::vector<std::array<double, 4>> badRotations()
{
  std::vector<std::array<double, 4>> bad = {
    { 0, 0, 0, 2 }, { 0, 0, 0, 0.5 }, { 1, 1, 1, 1 }, { 1e308, 1e308, 0, 0 }, { DENORMAL, 0, 0, 0 }
  };
  for (std::size_t i = 0; i < 4; ++i)
  {
    for (const double value : { NOT_A_NUMBER, INFINITE, -INFINITE, 1e308 })
    {
      std::array<double, 4> q = { 0, 0, 0, 1 };
      q[i] = value;
      bad.push_back(q);
    }
  }
  return bad;
}

std::vector<BadFrame> badFrames()
{
  return { { "nowhere", { "no transform from nowhere to world" } },
           { "/world", { " is \"/world\", must not begin with a slash" } },
           { std::string(256, 'f'), { "a name of 256 characters, must be at most 255" } },
           { std::string(1000000, 'f'), { "a name of 1000000 characters, must be at most 255" } },
           { "snake", { "no transform from snake to world" } },
           { "not_a_number", { "no transform from not_a_number to world" } },
           { "not_a_rotation", { "no transform from not_a_rotation to world" } },
           { "world\n", { "no transform from world" } } };
}

std::vector<BadHeader> badHeaders()
{
  std::vector<BadHeader> bad;
  for (const BadFrame& frame : badFrames())
  {
    BadHeader header;
    header.header.frame_id = frame.name;
    header.words = frame.words;
    header.words.push_back("header.frame_id");
    bad.push_back(header);
  }
  BadHeader none;
  none.words = { "header.frame_id is empty, must name the frame" };
  bad.push_back(none);
  for (const double stamp : { 1.0, 4e9 })
  {
    BadHeader header;
    header.header.frame_id = "moving";
    header.header.stamp = ros::Time(stamp);
    header.words = { "header.frame_id", "no transform from moving to world" };
    bad.push_back(header);
  }
  return bad;
}

std::vector<std::string> badNames()
{
  return { "",
           ".",
           "..",
           ".hidden",
           "../outside",
           "a/b",
           "/etc/x",
           "a b",
           "a\nb",
           std::string("a\0b", 3),
           "caf\xc3\xa9",
           "a\\b",
           "a:b",
           "a*",
           "$HOME",
           std::string(65, 'n'),
           std::string(100000, 'n') };
}

RefusalWatch::RefusalWatch()
{
  const boost::function<void(const cloth_tearing::SimulationStatus&)> take =
      [this](const cloth_tearing::SimulationStatus& status)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    latest_ = status;
    changed_.notify_all();
  };
  subscriber_ =
      ros::NodeHandle().subscribe<cloth_tearing::SimulationStatus>("/cloth/status", 1, take);
}

cloth_tearing::SimulationStatus RefusalWatch::waitFor(
    const std::function<bool(const cloth_tearing::SimulationStatus&)>& condition)
{
  std::unique_lock<std::mutex> lock(mutex_);
  const bool told = changed_.wait_for(lock, std::chrono::duration<double>(SOON),
                                      [&] { return condition(latest_); });
  return told ? latest_ : cloth_tearing::SimulationStatus();
}

/// The count after a refusal of our own, which is told by the number of the grasp that it is about.
std::uint64_t RefusalWatch::countNow()
{
  cloth_tearing::Release::Request request;
  request.grasp_id = 1000000000 + ++asked_;
  refusalOf<cloth_tearing::Release>("release", request);
  const std::string name = std::to_string(request.grasp_id);
  return waitFor([&name](const auto& status)
                 { return status.last_refusal.find(name) != std::string::npos; })
      .refusals;
}

std::string RefusalWatch::after(const std::function<void()>& send)
{
  const std::uint64_t before = countNow();
  send();
  const cloth_tearing::SimulationStatus status =
      waitFor([before](const auto& now) { return now.refusals > before; });
  EXPECT_TRUE(status.refusals == 0 || status.refusals == before + 1);
  return status.last_refusal;
}

void resetCloth()
{
  EXPECT_TRUE(ask<std_srvs::Trigger>("/cloth/reset").success);
}

std::uint64_t takeMiddle()
{
  cloth_tearing::Grasp::Request request;
  request.header.frame_id = "world";
  request.point.z = -0.4;
  const auto answer = ask<cloth_tearing::Grasp>("/cloth/grasp", request);
  EXPECT_TRUE(answer.success) << answer.message;
  return answer.grasp_id;
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "bad_inputs_rostest");
  const ros::NodeHandle node;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  testing::AddGlobalTestEnvironment(new TellFrames);  // gtest deletes them
  testing::AddGlobalTestEnvironment(new Count);
  return RUN_ALL_TESTS();
}
