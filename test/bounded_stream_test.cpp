// Claims of reading bytes whose counts may lie.
#include "cloth_tearing/node/bounded_stream.h"

#include <cloth_tearing/CollisionSpheres.h>
#include <cloth_tearing/GraspTargets.h>
#include <cloth_tearing/Pin.h>
#include <dynamic_reconfigure/Config.h>
#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>

#include <cstring>

#include "message_bytes.h"

namespace cloth_tearing
{
namespace
{

template <class Message>
std::vector<std::uint8_t> bytesOf(const Message& message)
{
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

CollisionSpheres spheres()
{
  CollisionSpheres message;
  message.header.frame_id = "world";
  message.header.stamp = ros::Time(12, 34);
  message.spheres.resize(3);
  message.spheres[1].frame = "finger";
  message.spheres[1].radius = 0.125;
  return message;
}

GraspTargets targets()
{
  GraspTargets message;
  message.header.frame_id = "hand";
  message.targets.resize(2);
  message.targets[1].pose.position.z = 3.0;
  return message;
}

PinRequest pins()
{
  PinRequest request;
  request.particles = { 1, 2, 3, 500 };
  return request;
}

tf2_msgs::TFMessage transforms()
{
  tf2_msgs::TFMessage message;
  message.transforms.resize(2);
  message.transforms[0].child_frame_id = "tool";
  message.transforms[1].transform.rotation.w = 1.0;
  return message;
}

dynamic_reconfigure::Config config()
{
  dynamic_reconfigure::Config message;
  message.bools.resize(1);
  message.doubles.resize(2);
  message.doubles[1].name = "stiffness";
  message.groups.resize(1);
  return message;
}

template <class Message>
class BoundedStreamOf : public testing::Test
{
};

template <class Message>
Message example();
template <>
CollisionSpheres example()
{
  return spheres();
}
template <>
GraspTargets example()
{
  return targets();
}
template <>
PinRequest example()
{
  return pins();
}
template <>
tf2_msgs::TFMessage example()
{
  return transforms();
}
template <>
dynamic_reconfigure::Config example()
{
  return config();
}

using Messages = testing::Types<CollisionSpheres, GraspTargets, PinRequest, tf2_msgs::TFMessage,
                                dynamic_reconfigure::Config>;
TYPED_TEST_SUITE(BoundedStreamOf, Messages);

TYPED_TEST(BoundedStreamOf, AMessageReadsWhatRoscppWrites)
{
  const auto written = example<TypeParam>();
  std::vector<std::uint8_t> bytes = bytesOf(written);
  TypeParam read;
  BoundedStream::read(bytes.data(), bytes.size(), read);
  EXPECT_TRUE(sameBytes(read, written));
}

TYPED_TEST(BoundedStreamOf, AMessageRefusesEachTruncation)
{
  std::vector<std::uint8_t> bytes = bytesOf(example<TypeParam>());
  for (std::size_t length = 0; length < bytes.size(); ++length)
  {
    std::vector<std::uint8_t> cut(bytes.begin(), bytes.begin() + length);
    TypeParam read;
    EXPECT_THROW(BoundedStream::read(cut.data(), cut.size(), read), MalformedMessage)
        << length << " bytes";
  }
}

/// Whatever is made of four bytes: a message in proportion, or a refusal.
TYPED_TEST(BoundedStreamOf, AMessageMakesNoRoomForCountsThatLie)
{
  std::vector<std::uint8_t> bytes = bytesOf(example<TypeParam>());
  for (std::uint32_t lie : { 0xffffffffU, 0x7fffffffU, 0x01000000U, 1000U })
  {
    for (std::size_t at = 0; at + 4 <= bytes.size(); ++at)
    {
      std::vector<std::uint8_t> lying = bytes;
      std::memcpy(lying.data() + at, &lie, sizeof lie);
      TypeParam read;
      try
      {
        BoundedStream::read(lying.data(), lying.size(), read);
        EXPECT_LE(ros::serialization::serializationLength(read), lying.size());
      }
      catch (const MalformedMessage& error)
      {
        EXPECT_STRNE(error.what(), "");
      }
    }
  }
}

TEST(BoundedStream, SaysHowManyElementsDoNotFit)
{
  std::uint8_t bytes[] = { 0xff, 0xff, 0xff, 0xff, 1, 2, 3, 4 };
  std::vector<std::uint32_t> numbers;
  BoundedStream stream(bytes, sizeof bytes);
  try
  {
    stream.next(numbers);
    FAIL() << "was read";
  }
  catch (const MalformedMessage& error)
  {
    EXPECT_STREQ(
        error.what(),
        "malformed: there have to be 4294967295 elements of at least 4 bytes, but 4 bytes are "
        "left");
  }
  EXPECT_EQ(numbers.capacity(), 0U);
}

TEST(BoundedStream, MakesNoRoomForAsManyElementsAsThereAreBytes)
{
  std::uint8_t bytes[] = { 8, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8 };
  std::vector<std::uint32_t> numbers;
  BoundedStream stream(bytes, sizeof bytes);
  EXPECT_THROW(stream.next(numbers), MalformedMessage);
  EXPECT_EQ(numbers.capacity(), 0U);
}

}  // namespace
}  // namespace cloth_tearing
