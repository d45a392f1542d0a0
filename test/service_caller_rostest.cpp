// Claims of the calls of a window: nobody waits for a service, and everybody is told once.
#include "cloth_tearing/rviz/service_caller.h"

#include <cloth_tearing/NamedState.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/Empty.h>
#include <std_srvs/Trigger.h>

#include <QCoreApplication>
#include <future>
#include <memory>
#include <vector>

#include "cloth_tearing/rviz/tuning_sender.h"

using cloth_tearing::NamedState;
using cloth_tearing::ServiceCaller;
using cloth_tearing::TuningSender;
using dynamic_reconfigure::Config;
using dynamic_reconfigure::ConfigTools;
using dynamic_reconfigure::Reconfigure;
using std_srvs::Empty;
using std_srvs::Trigger;

namespace
{

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds PATIENCE{ 20 };
constexpr std::chrono::seconds LAST_CALLS{ 1 };  // that the end of a caller may take

/// Lets this thread do what comes, as a window does, until `ready()`. @return whether it was in
/// time
template <class Ready>
bool isSoon(Ready ready)
{
  const Clock::time_point deadline = Clock::now() + PATIENCE;
  while (!ready())
  {
    if (Clock::now() > deadline)
    {
      return false;
    }
    QCoreApplication::processEvents();
    std::this_thread::yield();
  }
  return true;
}

/// Services on threads of their own.
class Calls : public ::testing::Test
{
protected:
  Calls()
  {
    node_.setCallbackQueue(&queue_);
    count_ = node_.advertiseService("/count", &Calls::onCount, this);
    refuse_ = node_.advertiseService("/refuse", &Calls::onRefuse, this);
    empty_ = node_.advertiseService("/empty", &Calls::onEmpty, this);
    hang_ = node_.advertiseService("/hang", &Calls::onHang, this);
    tune_ = node_.advertiseService("/tuned/set_parameters", &Calls::onTune, this);
    spinner_.start();
  }

  ~Calls() override
  {
    answer_.set_value();
    spinner_.stop();
  }

  bool onCount(NamedState::Request& request, NamedState::Response& response)
  {
    response.success = true;
    response.step = std::stoul(request.name);
    return true;
  }
  bool onRefuse(Trigger::Request& /*request*/, Trigger::Response& response)
  {
    response.message = "radius [m] is -1, must be at least 0";
    return true;
  }
  bool onEmpty(Empty::Request& /*request*/, Empty::Response& /*response*/) { return true; }
  bool onHang(Trigger::Request& /*request*/, Trigger::Response& response)
  {
    hangs_ = true;
    answered_.wait_for(4 * PATIENCE);
    response.success = true;
    return true;
  }

  /// Values above 1 are refused.
  bool onTune(Reconfigure::Request& request, Reconfigure::Response& response)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& wanted : request.config.doubles)
    {
      tuned_[wanted.name] = wanted.value > 1.0 ? tuned_[wanted.name] : wanted.value;
      ++tunings_;
    }
    for (const auto& [name, value] : tuned_)
    {
      ConfigTools::appendParameter(response.config, name, value);
    }
    return true;
  }

  /// A call that is not answered as long as the test lasts.
  void callInVain(ServiceCaller& caller)
  {
    caller.call<Trigger>("/hang", {}, [](const auto&) { ADD_FAILURE() << "nobody is told"; });
    ASSERT_TRUE(isSoon([this] { return hangs_.load(); }));
  }

  std::string problemOf(const std::string& service)
  {
    std::string problem;
    bool answered = false;
    ServiceCaller caller;
    caller.call<Trigger>(service, {},
                         [&](const auto& answer)
                         {
                           problem = answer.problem;
                           answered = true;
                           EXPECT_FALSE(answer.done());
                         });
    EXPECT_TRUE(isSoon([&] { return answered; }));
    return problem;
  }

  std::atomic<bool> hangs_{ false };
  std::mutex mutex_;
  std::map<std::string, double> tuned_;  ///< guarded by mutex_
  int tunings_ = 0;                      ///< guarded by mutex_

private:
  std::promise<void> answer_;
  std::future<void> answered_ = answer_.get_future();
  ros::NodeHandle node_;
  ros::CallbackQueue queue_;
  ros::ServiceServer count_;
  ros::ServiceServer refuse_;
  ros::ServiceServer empty_;
  ros::ServiceServer hang_;
  ros::ServiceServer tune_;
  ros::AsyncSpinner spinner_{ 2, &queue_ };
};

}  // namespace

TEST_F(Calls, AreAnsweredInOrderInTheThreadThatMadeTheCaller)
{
  constexpr std::size_t CALLS = 30;
  ServiceCaller caller;
  std::vector<std::uint64_t> answers;
  for (std::size_t i = 0; i < CALLS; ++i)
  {
    NamedState::Request request;
    request.name = std::to_string(i);
    caller.call<NamedState>("/count", request,
                            [&, thread = std::this_thread::get_id()](const auto& answer)
                            {
                              EXPECT_TRUE(answer.done()) << answer.problem;
                              EXPECT_EQ(std::this_thread::get_id(), thread);
                              answers.push_back(answer.response.step);
                            });
  }
  EXPECT_TRUE(answers.empty()) << "only between events";

  ASSERT_TRUE(isSoon([&] { return answers.size() == CALLS; }));
  for (std::size_t i = 0; i < CALLS; ++i)
  {
    EXPECT_EQ(answers[i], i);
  }
  EXPECT_TRUE(isSoon([&] { return caller.waiting() == 0.0; })) << "nothing is under way any more";
}

TEST_F(Calls, TellARefusalByItsMessage)
{
  EXPECT_EQ(problemOf("/refuse"), "radius [m] is -1, must be at least 0");
}

TEST_F(Calls, TellOfAMissingService)
{
  EXPECT_EQ(problemOf("/nowhere"), "there is no service /nowhere: its node is not running");
}

TEST_F(Calls, AreDoneWhereTheAnswerCannotSayNo)
{
  ServiceCaller caller;
  bool done = false;
  caller.call<Empty>("/empty", {}, [&](const auto& answer) { done = answer.done(); });
  EXPECT_TRUE(isSoon([&] { return done; }));
}

TEST_F(Calls, ThatAreNotAnsweredHoldUpNobody)
{
  auto caller = std::make_unique<ServiceCaller>();
  callInVain(*caller);
  EXPECT_TRUE(isSoon([&] { return caller->waiting() > 0.0; }));
  caller->call<Trigger>("/refuse", {}, [](const auto&) { ADD_FAILURE() << "behind the other"; });

  const Clock::time_point start = Clock::now();
  caller.reset();

  EXPECT_LT(Clock::now() - start, LAST_CALLS + PATIENCE / 2);
  QCoreApplication::processEvents();
}

TEST_F(Calls, OfManyCallersThatFinishTogetherHoldUpNoLongerThanThoseOfOne)
{
  constexpr std::size_t CALLERS = 6;
  std::vector<std::unique_ptr<ServiceCaller>> callers;
  for (std::size_t i = 0; i < CALLERS; ++i)
  {
    callers.push_back(std::make_unique<ServiceCaller>());
    callInVain(*callers.back());
    EXPECT_TRUE(isSoon([&] { return callers.back()->waiting() > 0.0; }));
  }

  const Clock::time_point start = Clock::now();
  for (const auto& caller : callers)
  {
    caller->finishBy(start + LAST_CALLS);
  }
  callers.clear();

  EXPECT_GE(Clock::now() - start, LAST_CALLS);
  EXPECT_LT(Clock::now() - start, CALLERS * LAST_CALLS / 2);
}

TEST_F(Calls, ThatAreLeftAreDoneBeforeTheEnd)
{
  auto caller = std::make_unique<ServiceCaller>();
  TuningSender sender(*caller);
  sender.setServer("/tuned");
  sender.want({ { "speed", 0.5 } });

  caller.reset();

  const std::lock_guard<std::mutex> lock(mutex_);
  EXPECT_EQ(tuned_["speed"], 0.5);
}

TEST_F(Calls, GoOnAfterACutOfOneThatIsNotAnswered)
{
  ServiceCaller caller;
  callInVain(caller);
  caller.call<Empty>("/empty", {}, [](const auto&) { ADD_FAILURE() << "waited behind it"; });

  caller.cut();

  bool done = false;
  caller.call<Empty>("/empty", {}, [&](const auto& answer) { done = answer.done(); });
  EXPECT_TRUE(isSoon([&] { return done; }));
}

TEST_F(Calls, TakeTurnsWithOtherWork)
{
  ServiceCaller caller;
  std::thread::id worker;
  caller.run([] { return std::this_thread::get_id(); },
             [&, thread = std::this_thread::get_id()](std::thread::id id)
             {
               worker = id;
               EXPECT_EQ(std::this_thread::get_id(), thread);
             });
  EXPECT_TRUE(isSoon([&] { return worker != std::thread::id(); }));
  EXPECT_NE(worker, std::this_thread::get_id());
}

/// What a slider wants while it is dragged.
class Tunings : public Calls
{
protected:
  Tunings()
  {
    sender_.setServer("/tuned");
    QObject::connect(&sender_, &TuningSender::settled,
                     [this](const Config& values, bool refused)
                     {
                       settled_.push_back(values);
                       refused_ = refused;
                     });
    QObject::connect(&sender_, &TuningSender::failed,
                     [this](const QString& problem) { problem_ = problem; });
  }

  double settledValue(const std::string& name)
  {
    double value = -1.0;
    EXPECT_TRUE(ConfigTools::getParameter(settled_.back(), name, value));
    return value;
  }

  ServiceCaller caller_;
  TuningSender sender_{ caller_ };
  std::vector<Config> settled_;
  bool refused_ = false;
  QString problem_;
};

TEST_F(Tunings, AreSentNowAndThenAndTheLastOneAlways)
{
  const Clock::time_point start = Clock::now();
  int wanted = 0;
  ASSERT_TRUE(isSoon(
      [&]
      {
        ++wanted;
        sender_.want({ { "strain", 1e-9 * wanted } });
        return Clock::now() - start > std::chrono::milliseconds(550);
      }));
  sender_.want({ { "strain", 0.75 } });
  EXPECT_TRUE(sender_.isBusy());

  ASSERT_TRUE(isSoon([&] { return !sender_.isBusy(); }));

  EXPECT_EQ(settledValue("strain"), 0.75);
  EXPECT_FALSE(refused_);
  const auto intervals = (Clock::now() - start) / std::chrono::milliseconds(90);  // and a little
  EXPECT_GT(wanted, 100);
  EXPECT_GE(tunings_, 2);
  EXPECT_LE(tunings_, 1 + intervals);
}

TEST_F(Tunings, ThatBelongTogetherAreSentTogether)
{
  sender_.want({ { "tear", 0.2 }, { "weak", 0.2 } });
  ASSERT_TRUE(isSoon([&] { return !sender_.isBusy(); }));
  EXPECT_EQ(settledValue("tear"), 0.2);
  EXPECT_EQ(settledValue("weak"), 0.2);
  EXPECT_EQ(settled_.size(), 1u);
}

TEST_F(Tunings, ThatAreRefusedShowTheValuesInForce)
{
  tuned_["strain"] = 0.3;
  sender_.want({ { "strain", 2.0 } });
  ASSERT_TRUE(isSoon([&] { return !sender_.isBusy(); }));
  EXPECT_TRUE(refused_);
  EXPECT_EQ(settledValue("strain"), 0.3);
}

TEST_F(Tunings, TellOfAMissingServer)
{
  sender_.setServer("/nowhere");
  sender_.want({ { "strain", 0.1 } });
  ASSERT_TRUE(isSoon([&] { return !sender_.isBusy(); }));
  EXPECT_TRUE(problem_.contains("there is no service /nowhere/set_parameters"))
      << problem_.toStdString();
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "service_caller_rostest");
  QCoreApplication application(argc, argv);
  const ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
