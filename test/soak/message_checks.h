// What is wrong with messages of the node, whatever it is doing.
#pragma once

#include <cloth_tearing/ClothSurface.h>
#include <cloth_tearing/GraspEvents.h>
#include <cloth_tearing/GraspStates.h>
#include <cloth_tearing/PullResult.h>
#include <cloth_tearing/SimulationStatus.h>
#include <cloth_tearing/TearEvents.h>
#include <ros/serialization.h>
#include <visualization_msgs/MarkerArray.h>

#include <cmath>
#include <string>
#include <vector>

namespace soak
{

/// A stream for ros::serialization that only looks whether all real numbers are finite.
class FiniteLook
{
public:
  bool finite() const { return finite_; }

  void next(double value) { finite_ = finite_ && std::isfinite(value); }
  void next(float value) { finite_ = finite_ && std::isfinite(value); }

  template <class T>
  void next(const std::vector<T>& values)
  {
    nextAll(values);
  }
  template <class T, std::size_t N>
  void next(const boost::array<T, N>& values)
  {
    nextAll(values);
  }
  template <class T>
  void next(const T& value)
  {
    if constexpr (ros::message_traits::IsMessage<T>::value)
    {
      ros::serialization::Serializer<T>::template allInOne<FiniteLook, const T&>(*this, value);
    }
  }

private:
  template <class Values>
  void nextAll(const Values& values)
  {
    for (const auto& value : values)
    {
      next(value);
    }
  }

  bool finite_ = true;
};

using Problems = std::vector<std::string>;

/// Sizes that do not agree, indices out of range, event numbers that do not rise by one each,
/// values that their type does not know. Nothing to find in other messages.
void look(const cloth_tearing::ClothSurface& surface, Problems& found);
void look(const cloth_tearing::SimulationStatus& status, Problems& found);
void look(const cloth_tearing::GraspStates& states, Problems& found);
void look(const cloth_tearing::GraspEvent& event, Problems& found);
void look(const cloth_tearing::TearEvent& event, Problems& found);
void look(const cloth_tearing::PullResult& result, Problems& found);
void look(const visualization_msgs::MarkerArray& markers, Problems& found);

template <class Event>
void look(const std::vector<Event>& events, Problems& found)
{
  for (std::size_t i = 0; i < events.size(); ++i)
  {
    look(events[i], found);
    if (i > 0 && events[i].sequence != events[i - 1].sequence + 1)
    {
      found.push_back("event " + std::to_string(events[i].sequence) + " comes after " +
                      std::to_string(events[i - 1].sequence));
    }
  }
}
inline void look(const cloth_tearing::TearEvents& message, Problems& found)
{
  look(message.events, found);
}
inline void look(const cloth_tearing::GraspEvents& message, Problems& found)
{
  look(message.events, found);
}
template <class Message>
void look(const Message& /*message*/, Problems& /*found*/)
{
}

/// Everything wrong with `message` by itself, one sentence each.
template <class Message>
Problems problems(const Message& message)
{
  Problems found;
  FiniteLook numbers;
  numbers.next(message);
  if (!numbers.finite())
  {
    found.push_back("a number is not finite");
  }
  look(message, found);
  return found;
}

}  // namespace soak
