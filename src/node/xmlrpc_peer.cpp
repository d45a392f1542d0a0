// Calls a master or a node by XML-RPC and never waits for ever: roscpp's own calls may.
#include "cloth_tearing/node/xmlrpc_peer.h"

#include <ros/network.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcException.h>

namespace cloth_tearing
{

namespace
{

constexpr double MOMENT = 0.05;  // so long at a time it cannot be made to give up [s]

}  // namespace

XmlRpcPeer::Place XmlRpcPeer::placeOf(const std::string& uri)
{
  Place place;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, place.host, port))
  {
    throw NoAnswer("\"" + uri + "\" is no address");
  }
  place.port = static_cast<int>(port);
  return place;
}

XmlRpcPeer::XmlRpcPeer(const std::string& uri, std::chrono::duration<double> patience,
                       const std::atomic<bool>& giving_up)
    : XmlRpcPeer(placeOf(uri), patience, giving_up)
{
}

XmlRpcPeer::XmlRpcPeer(const Place& place, std::chrono::duration<double> patience,
                       const std::atomic<bool>& giving_up)
    : client_(place.host.c_str(), place.port, "/"), patience_(patience), giving_up_(giving_up)
{
}

std::optional<XmlRpc::XmlRpcValue> XmlRpcPeer::call(
    const std::string& method, const std::initializer_list<XmlRpc::XmlRpcValue>& rest)
{
  XmlRpc::XmlRpcValue arguments;
  arguments[0] = ros::this_node::getName();
  for (const XmlRpc::XmlRpcValue& argument : rest)
  {
    arguments[arguments.size()] = argument;
  }
  try
  {
    XmlRpc::XmlRpcValue said = answer(method, arguments);
    if (client_.isFault() || static_cast<int>(said[0]) != 1)
    {
      return std::nullopt;
    }
    return said[2];
  }
  catch (const XmlRpc::XmlRpcException& error)
  {
    throw NoAnswer(method + " was answered with something else: " + error.getMessage());
  }
}

XmlRpc::XmlRpcValue XmlRpcPeer::answer(const std::string& method,
                                       const XmlRpc::XmlRpcValue& arguments)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(patience_);
  XmlRpc::XmlRpcValue said;
  bool done = false;
  bool connected = client_.executeNonBlock(method.c_str(), arguments);
  while (connected && !done && Clock::now() < end && !giving_up_)
  {
    client_._disp.work(MOMENT);
    done = client_.executeCheckDone(said);
    connected = !client_._disp._sources.empty();  // it leaves when its connection fails
  }
  if (!said.valid())
  {
    client_.close();
    throw NoAnswer(method + " was not answered");
  }
  return said;
}

}  // namespace cloth_tearing
