// Calls a master or a node by XML-RPC and never waits for ever: roscpp's own calls may.
#pragma once

#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <atomic>
#include <chrono>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>

namespace cloth_tearing
{

/// Nobody serves there, or not in time, or what it says is no answer.
class NoAnswer : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// One connection, for one thread, to be used for calls that follow each other closely.
class XmlRpcPeer
{
public:
  /// @param uri of a master or node, http://HOST:PORT/
  /// @param patience with each call [s]
  /// @param giving_up ends a call under way soon, once it is true
  /// @throws NoAnswer if `uri` is none
  XmlRpcPeer(const std::string& uri, std::chrono::duration<double> patience,
             const std::atomic<bool>& giving_up);

  /// Calls `method` in the name of this node, which is the first argument of all ROS calls.
  /// @return what it answers; nothing if it says that it could not do so
  /// @throws NoAnswer
  std::optional<XmlRpc::XmlRpcValue> call(const std::string& method,
                                          const std::initializer_list<XmlRpc::XmlRpcValue>& rest);

private:
  struct Place
  {
    std::string host;
    int port = 0;
  };

  static Place placeOf(const std::string& uri);
  XmlRpc::XmlRpcValue answer(const std::string& method, const XmlRpc::XmlRpcValue& arguments);

  XmlRpcPeer(const Place& place, std::chrono::duration<double> patience,
             const std::atomic<bool>& giving_up);

  XmlRpc::XmlRpcClient client_;
  std::chrono::duration<double> patience_;
  const std::atomic<bool>& giving_up_;
};

}  // namespace cloth_tearing
