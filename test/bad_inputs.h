// Tables of bad input: which values a field must refuse, in which words, and how all are tried on a
// node whose cloth they must leave as it is.
#pragma once

#include <cloth_tearing/SimulationStatus.h>
#include <std_msgs/Header.h>

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "cloth_tearing/core/checks.h"
#include "node_client.h"

/// One input that must be refused.
struct BadInput
{
  std::string name;
  std::function<std::string()> send;  ///< @return why it was refused; empty if it was not
  std::vector<std::string> words;     ///< that the reason must have
};

using BadInputs = std::vector<BadInput>;

inline void append(BadInputs& all, const BadInputs& more)
{
  all.insert(all.end(), more.begin(), more.end());
}

/// Sends all of them: each is refused in its words, and the state's hash stays what it was. They
/// are counted.
void expectRefused(const BadInputs& inputs);

/// The same without a node: nothing but the words.
void expectRefusedInWords(const BadInputs& inputs);

/// A field that holds a number, and what it may be.
template <class Message>
struct Field
{
  std::vector<std::string> words;       ///< by which a refusal names it
  std::function<double&(Message&)> at;  ///< in a message
  cloth::Range range;
};

/// A number that a range does not hold, and the words that say so.
struct BadNumber
{
  double value;
  std::vector<std::string> words;
};

/// Not a number, infinities, the largest numbers, and the nearest ones beyond both ends, with
/// denormal ones beside 0.
std::vector<BadNumber> badNumbers(const cloth::Range& range);

/// Whole numbers beyond both ends, and the extreme ones.
std::vector<BadNumber> badWholeNumbers(const cloth::Range& range);

/// Components x, y, z, w that make no unit quaternion.
std::vector<std::array<double, 4>> badRotations();

/// Each field of `fields` with each number that it must refuse, the rest being as in `base`.
/// @param send sends a message, and says why it was refused
template <class Message>
BadInputs badNumbersIn(const std::string& name, const Message& base,
                       const std::vector<Field<Message>>& fields,
                       const std::function<std::string(const Message&)>& send)
{
  BadInputs inputs;
  for (const Field<Message>& field : fields)
  {
    for (const BadNumber& bad : badNumbers(field.range))
    {
      Message message = base;
      field.at(message) = bad.value;
      BadInput input;
      input.send = [send, message] { return send(message); };
      input.words = field.words;
      input.words.insert(input.words.end(), bad.words.begin(), bad.words.end());
      input.name =
          name + ": " + testing::PrintToString(field.words) + " = " + cloth::text(bad.value);
      inputs.push_back(input);
    }
  }
  return inputs;
}

/// The coordinates of a point or vector, each up to `limit`.
/// @param at gives the point of a message
template <class Message, class At>
std::vector<Field<Message>> coordinates(const std::string& word, At at, double limit)
{
  const cloth::Range range = cloth::Range::between(-limit, limit);
  return { { { word, ".x is" }, [at](Message& m) -> double& { return at(m).x; }, range },
           { { word, ".y is" }, [at](Message& m) -> double& { return at(m).y; }, range },
           { { word, ".z is" }, [at](Message& m) -> double& { return at(m).z; }, range } };
}

/// Each rotation that is none, at an orientation of `base`.
template <class Message, class At>
BadInputs badRotationsIn(const std::string& name, const Message& base, const std::string& word,
                         At at, const std::function<std::string(const Message&)>& send)
{
  BadInputs inputs;
  for (const std::array<double, 4>& q : badRotations())
  {
    Message message = base;
    at(message).x = q[0];
    at(message).y = q[1];
    at(message).z = q[2];
    at(message).w = q[3];
    inputs.push_back({ name + ": " + word + " " + testing::PrintToString(q),
                       [send, message] { return send(message); },
                       { word, "has length", "must be a unit quaternion" } });
  }
  return inputs;
}

/// A frame that cannot be used.
struct BadFrame
{
  std::string name;
  std::vector<std::string> words;
};
std::vector<BadFrame> badFrames();

/// Headers that cannot be used: their frames, and stamps of long ago and long after.
struct BadHeader
{
  std_msgs::Header header;
  std::vector<std::string> words;
};
std::vector<BadHeader> badHeaders();

template <class Message>
BadInputs badHeadersIn(const std::string& name, const Message& base,
                       const std::function<std::string(const Message&)>& send)
{
  BadInputs inputs;
  for (const BadHeader& bad : badHeaders())
  {
    Message message = base;
    message.header = bad.header;
    inputs.push_back({ name + ": header.frame_id = " + bad.header.frame_id.substr(0, 20) +
                           ", stamp " + std::to_string(bad.header.stamp.toSec()),
                       [send, message] { return send(message); }, bad.words });
  }
  return inputs;
}

/// Names that no file may have, and the words that refuse them.
std::vector<std::string> badNames();

/// Calls a service of the node under test. @return its message, empty if it was granted
template <class Service>
std::string refusalOf(const std::string& name, const typename Service::Request& request)
{
  const typename Service::Response answer = ask<Service>("/cloth/" + name, request);
  EXPECT_NE(answer.success != 0, !answer.message.empty()) << name << ": " << answer.message;
  return answer.success != 0 ? "" : answer.message;
}

/// The same as a function of the request.
template <class Service>
std::function<std::string(const typename Service::Request&)> refusalsOf(const std::string& name)
{
  return [name](const typename Service::Request& request)
  { return refusalOf<Service>(name, request); };
}

/// What ~status tells of refusals of what has no answer.
class RefusalWatch
{
public:
  RefusalWatch();

  /// Does `send`, which has to be refused, and waits until it is counted.
  /// @return the reason; empty if nothing was refused in time
  std::string after(const std::function<void()>& send);

private:
  cloth_tearing::SimulationStatus waitFor(
      const std::function<bool(const cloth_tearing::SimulationStatus&)>& condition);
  std::uint64_t countNow();

  std::mutex mutex_;
  std::condition_variable changed_;
  cloth_tearing::SimulationStatus latest_;
  std::uint64_t asked_ = 0;
  ros::Subscriber subscriber_;
};

/// Brings back the cloth as it was built.
void resetCloth();

/// Takes hold of the middle of the lower edge. @return the grasp
std::uint64_t takeMiddle();
