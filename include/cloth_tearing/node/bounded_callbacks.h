// What roscpp calls with the bytes of requests and messages, whatever these say of themselves.
#pragma once

#include <ros/advertise_service_options.h>
#include <ros/service_callback_helper.h>
#include <ros/service_traits.h>
#include <ros/subscribe_options.h>
#include <ros/subscription_callback_helper.h>

#include <boost/make_shared.hpp>

#include <functional>
#include <string>
#include <utility>

#include "cloth_tearing/node/bounded_stream.h"

namespace cloth_tearing
{

/// Is told why bytes were no message.
using OnMalformed = std::function<void(const std::string& reason)>;

/// Answers requests by `work(request, response)`, which does not throw. Malformed ones are told of
/// and answered as roscpp answers for a service that failed: with the reason.
template <class Service, class Work>
class BoundedService : public ros::ServiceCallbackHelper
{
public:
  BoundedService(Work work, OnMalformed on_malformed)
      : work_(std::move(work)), on_malformed_(std::move(on_malformed))
  {
  }

  bool call(ros::ServiceCallbackHelperCallParams& params) override
  {
    typename Service::Request request;
    typename Service::Response response;
    const ros::SerializedMessage& bytes = params.request;
    const std::size_t before = bytes.message_start - bytes.buf.get();
    try
    {
      BoundedStream::read(bytes.message_start, bytes.num_bytes - before, request);
    }
    catch (const MalformedMessage& error)
    {
      on_malformed_(error.what());
      params.response =
          ros::serialization::serializeServiceResponse(false, std::string(error.what()));
      return true;  // of false, roscpp would make an answer without words
    }
    work_(request, response);
    params.response = ros::serialization::serializeServiceResponse(true, response);
    return true;
  }

private:
  Work work_;
  OnMalformed on_malformed_;
};

template <class Service, class Work>
ros::AdvertiseServiceOptions boundedService(const std::string& name, Work work,
                                            OnMalformed on_malformed)
{
  namespace traits = ros::service_traits;
  ros::AdvertiseServiceOptions options;
  options.service = name;
  options.md5sum = traits::md5sum<Service>();
  options.datatype = traits::datatype<Service>();
  options.req_datatype = ros::message_traits::datatype<typename Service::Request>();
  options.res_datatype = ros::message_traits::datatype<typename Service::Response>();
  options.helper =
      boost::make_shared<BoundedService<Service, Work>>(std::move(work), std::move(on_malformed));
  return options;
}

/// Hands messages on; malformed ones are told of and dropped.
template <class Message>
class BoundedSubscription
    : public ros::SubscriptionCallbackHelperT<const boost::shared_ptr<const Message>&>
{
public:
  using Base = ros::SubscriptionCallbackHelperT<const boost::shared_ptr<const Message>&>;

  BoundedSubscription(const typename Base::Callback& callback, OnMalformed on_malformed)
      : Base(callback), on_malformed_(std::move(on_malformed))
  {
  }

  ros::VoidConstPtr deserialize(
      const ros::SubscriptionCallbackHelperDeserializeParams& params) override
  {
    const auto message = boost::make_shared<Message>();
    try
    {
      checkType((*params.connection_header)["md5sum"]);
      BoundedStream::read(params.buffer, params.length, *message);
    }
    catch (const MalformedMessage& error)
    {
      on_malformed_(error.what());
      return {};
    }
    return message;
  }

private:
  /// Only publishers see whether both sides mean the same: roscpp believes what they say.
  static void checkType(const std::string& md5sum)
  {
    const std::string expected = ros::message_traits::md5sum<Message>();
    if (md5sum != expected && md5sum != "*")
    {
      throw MalformedMessage("its type has the md5sum " + md5sum + ", must be " + expected);
    }
  }

  OnMalformed on_malformed_;
};

/// @param callback takes a boost::shared_ptr<const Message>
template <class Message, class Callback>
ros::SubscribeOptions boundedSubscription(const std::string& topic, std::uint32_t queue_size,
                                          Callback callback, OnMalformed on_malformed)
{
  ros::SubscribeOptions options(topic, queue_size, ros::message_traits::md5sum<Message>(),
                                ros::message_traits::datatype<Message>());
  options.helper =
      boost::make_shared<BoundedSubscription<Message>>(callback, std::move(on_malformed));
  return options;
}

}  // namespace cloth_tearing
