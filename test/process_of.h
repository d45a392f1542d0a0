// Which process a node is.
#pragma once

#include <ros/master.h>
#include <ros/network.h>
#include <sys/types.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <string>

/// Of the node itself, not of what watches over it; 0 if nobody answers.
inline pid_t processOf(const std::string& node)
{
  XmlRpc::XmlRpcValue lookup, answer, uri;
  lookup[0] = "/tester";
  lookup[1] = node;
  std::string host;
  std::uint32_t port = 0;
  if (!ros::master::execute("lookupNode", lookup, answer, uri, false) ||
      !ros::network::splitURI(static_cast<std::string>(uri), host, port))
  {
    return 0;
  }
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue caller;
  caller[0] = "/tester";
  return client.execute("getPid", caller, answer) ? static_cast<int>(answer[2]) : 0;
}
