// A message that is published again and again.
#pragma once

#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>

namespace cloth_tearing
{

/// Is filled again where it is, so that its memory is asked for once; but never while a subscriber
/// in this process still reads it.
template <class Message>
class KeptMessage
{
public:
  /// To be called before it is filled. @return whether it is a new message, with nothing in it
  bool renew()
  {
    if (message_ != nullptr && message_.use_count() == 1)
    {
      return false;
    }
    message_ = boost::make_shared<Message>();
    return true;
  }

  Message& operator*() const { return *message_; }
  Message* operator->() const { return message_.get(); }

  /// For publishing.
  const boost::shared_ptr<Message>& shared() const { return message_; }

private:
  boost::shared_ptr<Message> message_;
};

}  // namespace cloth_tearing
